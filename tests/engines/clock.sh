#!/usr/bin/env bash
# clock.sh PROGRAM DESIGN: searches in a sweep do not look at the clock. Under one that runs ten thousand times as fast (a
# machine as slow as that), where a search alone runs out of time, the rows are the same bytes.
set -u
program=$1 limited=$(dirname "$2")/grain_chute_with_limits.yaml
command -v faketime >/dev/null || { echo "skipped: faketime is not installed"; exit 77; }
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
cd "$place" || exit 1
fail() { echo "failed: $1"; exit 1; }
sweep=("$program" sweep "$limited" --vary body.friction_angle=14deg:18deg:5 --quiet)
"${sweep[@]}" -o calm || fail "the sweep ends with $?"
faketime -f '+0 x10000' "${sweep[@]}" -o hurried || fail "under the fast clock it ends with $?"
cmp calm/chunks/000000.csv hurried/chunks/000000.csv || fail "the rows differ under a fast clock"
grep -q ',arrived,' calm/chunks/000000.csv || fail "no point arrives"
# That the clock is felt at all: a single search runs out of its minute.
faketime -f '+0 x10000' "$program" solve "$limited" >/dev/null 2>message
grep -q 'ended early' message || fail "a single search does not notice the fast clock: $(cat message)"
echo "five searches under a clock that runs 10,000 times as fast: the rows are the same"
