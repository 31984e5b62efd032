#!/usr/bin/env bash
# Draws docs/images/grain_chute.png anew from the shipped design. Needs Debian's openscad and xvfb.
set -eu
cd "$(dirname "$0")/.."
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
./run build designs/grain_chute.yaml -q -o "$scratch"
printf 'use <grain_chute.scad>\ncolor("LightSteelBlue") glissade_solid();\n' >"$scratch/view.scad"
xvfb-run -a openscad -o docs/images/grain_chute.png --imgsize=900,640 --colorscheme=Tomorrow --projection=p \
  --camera=2700,0,3650,58,0,124,21500 "$scratch/view.scad" 2>/dev/null
