#!/bin/sh
# A sweep as shards by GNU parallel, on this machine or, with --sshlogin in PARALLEL, on several, and
# then put together. Started again, it goes on.
#
#     sh data/examples/sweep-parallel.sh PLAN.json FOLDER SHARDS
#
# BATTEN names the program where it is not in the PATH.
set -eu
plan=$1
folder=$2
shards=$3
BATTEN=${BATTEN:-batten}
mkdir -p "$folder"

# Exit code 1 says that designs failed, as their rows do; the others end it.
seq "$shards" | parallel --will-cite --halt soon,fail=1 \
	"$BATTEN sweep '$plan' --out '$folder/part{}.db' --shard {}/$shards --resume --quiet --threads 1" \
	'|| [ $? -eq 1 ]'
exec "$BATTEN" merge "$folder/whole.db" "$folder"/part*.db
