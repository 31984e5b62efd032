#!/usr/bin/env bash
# Times a whole `glissade build` of every shipped design, each run a process of its own (cold: nothing is kept
# between two runs), beside writing the same number of bytes with one dd in the same run.
#   bench/build_designs.sh [PROGRAM] [RUNS]
set -eu
cd "$(dirname "$0")/.."
program=${1:-build/release/app/glissade}
runs=${2:-5}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

now() { date +%s%N; }

# best RUNS COMMAND...: least wall clock of the runs, in ms
best() {
  local count=$1 least='' start elapsed
  shift
  for ((run = 0; run < count; ++run)); do
    start=$(now)
    "$@" >/dev/null 2>&1
    elapsed=$((($(now) - start) / 1000))
    if [ -z "$least" ] || [ "$elapsed" -lt "$least" ]; then least=$elapsed; fi
  done
  awk -v us="$least" 'BEGIN {printf "%.1f", us / 1000}'
}

printf '%-22s %10s %10s %12s %10s %8s\n' design triangles 'MB written' 'plain write' build ratio
for design in designs/*.yaml; do
  name=$(basename "$design" .yaml)
  "$program" build "$design" -o "$scratch/$name" --json >"$scratch/$name.json"
  bytes=$(cat "$scratch/$name"/* | wc -c)
  triangles=$(sed -n 's/^ *"triangles": *\([0-9]*\).*/\1/p' "$scratch/$name.json")
  plain=$(best "$runs" dd if=/dev/zero of="$scratch/plain" bs="$bytes" count=1)
  whole=$(best "$runs" "$program" build "$design" -o "$scratch/$name" -q)
  printf '%-22s %10s %10.2f %9s ms %7s ms %8.0f\n' "$name" "$triangles" \
    "$(awk -v b="$bytes" 'BEGIN {print b / 1e6}')" "$plain" "$whole" \
    "$(awk -v w="$whole" -v p="$plain" 'BEGIN {print w / p}')"
done
