#!/usr/bin/env bash
# clang-tidy over lib/ and app/, with the compile commands of one build: scripts/tidy.sh [BUILD-DIR] [FILE...]
# Needs Debian's clang-tidy. Prints the findings and ends with 1 if there are any.
set -eu
cd "$(dirname "$0")/.."
build=${1:-build/dev}
[ $# -eq 0 ] || shift
command -v clang-tidy >/dev/null || { echo "tidy.sh: clang-tidy is not installed; try: apt-get install clang-tidy" >&2; exit 2; }
cmake -S . -B "$build" -DCMAKE_EXPORT_COMPILE_COMMANDS=ON >/dev/null
[ $# -gt 0 ] || mapfile -t files < <(find lib/src app -name '*.cpp' | sort)
[ $# -eq 0 ] || files=("$@")
printf '%s\0' "${files[@]}" |
  xargs -0 -n 1 -P "$(nproc)" clang-tidy -p "$build" --quiet --extra-arg=-Wno-unknown-warning-option 2>/dev/null
