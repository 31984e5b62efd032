#!/usr/bin/env bash
# parallel.sh PROGRAM DESIGN: a sweep in 8 shards under GNU parallel, held byte for byte against the same in one process.
# 77 (skipped) where GNU parallel is not installed.
set -u
program=$1 design=$2
command -v parallel >/dev/null && parallel --version 2>/dev/null | grep -q 'GNU parallel' || { echo "skipped: GNU parallel is not installed"; exit 77; }
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
cd "$place" || exit 1
# From rest: the fastest track that each point is compared with takes microseconds.
vary=(--set centerline.kind=straight --vary body.friction_angle=10deg:25deg:1001 --vary track.finish.z=0m:1m:8)
"$program" sweep "$design" "${vary[@]}" -o one --quiet || exit 1
"$program" sweep --merge one -o one.csv --quiet || exit 1
parallel --will-cite -j2 "$program" sweep "$design" "${vary[@]}" -o many --jobs 1 --quiet --shard '{}/8' ::: $(seq 0 7) || exit 1
"$program" sweep --merge many -o many.csv --quiet || exit 1
cmp one.csv many.csv || { echo "the rows differ"; exit 1; }
cmp one/sweep.html many/sweep.html || { echo "the pages differ"; exit 1; }
echo "8 shards under GNU parallel gave the $(($(wc -l <one.csv) - 1)) rows of one process, byte for byte"
