#!/usr/bin/env bash
# Glissade against a particle code that knows nothing of tracks: Debian's liggghts (optional, not set up by ./run or ./test).
#   scripts/particle_check.sh sphere [GLISSADE]   one sphere that slides on the exported floor; seconds
#   scripts/particle_check.sh stream [GLISSADE]   some 8000 grains in a channel; minutes
# GLISSADE is the built program, build/release/app/glissade unless it is given. Results: docs/accuracy.md.
set -euo pipefail
what=${1:-sphere}
root=$(cd "$(dirname "$0")/.." && pwd)
glissade=$(realpath "${2:-$root/build/release/app/glissade}")
deck=$root/scripts/particle_check
command -v liggghts > /dev/null || { echo "particle_check: liggghts is missing: apt-get install liggghts" >&2; exit 77; }
case $what in sphere|stream) ;; *) sed -n '2,5p' "$0"; exit 2;; esac

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
if [ "$what" = sphere ]; then
  "$glissade" build "$deck/arc.yaml" -o out -q
  python3 "$deck/floor.py" out/arc.stl floor.stl 0.004
  read -r x z vx vz < <(python3 "$deck/sphere.py" start out/arc.csv)
  sed "s/@X@/$x/; s/@Z@/$z/; s/@VX@/$vx/; s/@VZ@/$vz/" "$deck/sphere.in" > deck.in
  liggghts -in deck.in > log.txt
  python3 "$deck/sphere.py" compare out/arc.csv log.txt
else
  "$glissade" build "$deck/arc.yaml" -o out -q --set "mesh.largest_kink=0.2 deg"
  python3 "$deck/floor.py" out/arc.stl floor.stl 1
  liggghts -in "$deck/stream.in" > log.txt
  python3 "$deck/stream.py" grains.txt "$glissade" 0.4 0.5 0.6
fi
