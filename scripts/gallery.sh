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

# Solids, where Debian's openscad and xvfb are installed: FILE NAME, CAMERA (eye and centre, mm in the file's frame), and
# what else OpenSCAD is to draw.
solid() {
  local name=$1 camera=$2 further=${3:-} scratch
  scratch=$(mktemp -d)
  ./run build "designs/$name.yaml" --set 'export=[stl]' --no-report --quiet -o "$scratch"
  printf 'color("LightSteelBlue") import("%s.stl");\n%s\n' "$name" "$further" >"$scratch/view.scad"
  xvfb-run -a openscad -o "$pictures/${name}_solid.png" --imgsize=900,560 --colorscheme=Tomorrow --projection=p \
    --camera="$camera" "$scratch/view.scad" 2>/dev/null
  rm -r "$scratch"
}
if command -v openscad >/dev/null && command -v xvfb-run >/dev/null; then
  solid marble_run -90,-210,130,95,0,-65 'color("IndianRed") translate([40, 0, -22]) sphere(r = 8, $fn = 60);'
  solid wood_chip_chute 12500,-7500,3000,1600,0,-2050
  solid ski_jump_inrun_track 78500,1900,-36300,72500,0,-38300
fi
