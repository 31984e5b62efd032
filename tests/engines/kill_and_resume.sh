#!/usr/bin/env bash
# kill_and_resume.sh PROGRAM DESIGN [KILLS]: a sweep killed (SIGKILL) at random moments and begun again gives the rows of
# one that was left alone; so does one that Ctrl-C interrupts. GLISSADE_SEED repeats the moments.
set -u
program=$1 design=$2 kills=${3:-8}
[ -z "${CI:-}" ] || kills=${3:-20}
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
cd "$place" || exit 1
RANDOM=${GLISSADE_SEED:-$$}
echo "GLISSADE_SEED=${GLISSADE_SEED:-$$}"
fail() { echo "failed: $1"; exit 1; }
sweep=("$program" sweep "$design" --scatter "body.friction_angle=normal(17deg,1.5deg)" --samples 5000 --set centerline.kind=straight --columns travel_time_s,exit_speed_m_per_s --quiet)
"${sweep[@]}" -o alone || fail "the sweep that is left alone ends with $?"
"$program" sweep --merge alone -o alone.csv --quiet || fail "merging it"

killed=0
for _ in $(seq "$kills"); do
  "${sweep[@]}" -o killed & worker=$!
  sleep "$(printf '0.%03d' $((RANDOM % 400)))"
  kill -9 $worker 2>/dev/null && killed=$((killed + 1))
  wait $worker 2>/dev/null
done
[ "$killed" -gt 0 ] || fail "no sweep was running any more when it was killed"
"${sweep[@]}" -o killed || fail "the last one ends with $?"
"$program" sweep --merge killed -o killed.csv --quiet || fail "merging what was killed"
cmp alone.csv killed.csv || fail "the rows differ after $killed kills"

"${sweep[@]}" -o stopped 2>message & worker=$!
sleep 0.3
kill -INT $worker
wait $worker
code=$?
[ $code -eq 130 ] || [ $code -eq 0 ] || fail "interrupted, it ends with $code"
[ $code -eq 0 ] || grep -q 'goes on where this one ended' message || fail "its message: $(cat message)"
"${sweep[@]}" -o stopped || fail "begun again, it ends with $?"
"$program" sweep --merge stopped -o stopped.csv --quiet || fail "merging what was interrupted"
cmp alone.csv stopped.csv || fail "the rows differ after Ctrl-C"

# Two at once in one directory do the same work and harm nothing.
"${sweep[@]}" -o both & first=$!
"${sweep[@]}" -o both & second=$!
wait $first || fail "the first of two at once"
wait $second || fail "the second of two at once"
"$program" sweep --merge both -o both.csv --quiet || fail "merging what two wrote"
cmp alone.csv both.csv || fail "the rows differ where two worked at once"
# A directory in which nothing may be written. Root may write everywhere unless that right is taken from it.
guard=()
[ "$(id -u)" -ne 0 ] || guard=(setpriv --bounding-set=-dac_override,-dac_read_search)
if "${guard[@]}" true 2>/dev/null; then
  mkdir -p locked/chunks
  cp alone/manifest.json locked
  chmod 555 locked/chunks
  "${guard[@]}" "${sweep[@]}" -o locked 2>message
  code=$?
  [ $code -eq 5 ] || fail "in a read-only directory it ends with $code"
  grep -q 'locked/chunks/000000.csv' message || fail "its message: $(cat message)"
  [ -z "$(ls -A locked/chunks)" ] || fail "something lies in the read-only directory"
  chmod 755 locked/chunks
  "${sweep[@]}" -o locked || fail "made writable, it ends with $?"
  "$program" sweep --merge locked -o locked.csv --quiet || fail "merging what was read-only"
  cmp alone.csv locked.csv || fail "the rows differ after a read-only directory"
else
  echo "the read-only directory is not tried: setpriv cannot take root's right to write everywhere"
fi
echo "$killed kills, an interruption and two at once: the rows are the same"
