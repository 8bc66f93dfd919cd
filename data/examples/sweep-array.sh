#!/bin/bash
# A sweep as a Slurm job array: each task runs its own shard into its own database.
#
#     sbatch --array=1-8 data/examples/sweep-array.sh PLAN.json FOLDER [OPTION ...]
#
# with any options of batten sweep behind, and, when all tasks are done,
#
#     batten merge whole.db FOLDER/part*.db
#
# BATTEN names the program where it is not in the PATH. A task that runs out of time gets USR1 a while
# before; it then stores what it has, and is put back into the queue, where it goes on.
#SBATCH --job-name=batten-sweep
#SBATCH --cpus-per-task=2
#SBATCH --time=04:00:00
#SBATCH --signal=B:USR1@300
#SBATCH --requeue
#SBATCH --open-mode=append
set -u
plan=$1
folder=$2
shift 2

# Nodes that share a home would write to one cache of kernels.
POCL_CACHE_DIR=${TMPDIR:-/tmp}/pocl-$(id -un)
export POCL_CACHE_DIR

"${BATTEN:-batten}" sweep "$plan" --out "$folder/part$SLURM_ARRAY_TASK_ID.db" \
	--shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT" --resume --quiet "$@" &
task=$!

# Slurm signals this script only; a signal also ends the wait, which is then taken up again.
trap 'kill -USR1 "$task" 2>/dev/null' USR1 TERM
while :; do
	wait "$task"
	code=$?
	kill -0 "$task" 2>/dev/null || break
done
if [ "$code" -gt 128 ]; then # the end came together with the signal
	wait "$task"
	code=$?
fi

# 75: interrupted, can go on. 1: all designs are there, but some failed, as their rows say.
if [ "$code" -eq 75 ]; then
	scontrol requeue "${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID"
	exit 75
fi
[ "$code" -le 1 ] || exit "$code"
