#!/usr/bin/env bash
# Draws the pictures of docs/gallery.md anew: scripts/gallery.sh
set -eu
cd "$(dirname "$0")/.."
pictures=docs/images/gallery
mkdir -p "$pictures"
for design in designs/*.yaml; do
  name=$(basename "$design" .yaml)
  what=profile
  ! grep -q '^limits:' "$design" || what=profile,load
  ./run plot "$design" --what "$what" --quiet -o "$pictures/$name.svg"
done
./run compare designs/pudasaini_figure_1.yaml --friction-sweep 11deg,13deg,15deg,17deg,20deg,25deg,40deg \
  --quiet --svg "$pictures/friction_sweep.svg" >/dev/null
./run compare designs/ski_jump_inrun_with_limits.yaml --quiet --svg "$pictures/kinds.svg" >/dev/null
