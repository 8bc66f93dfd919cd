# Shards by GNU parallel and by a Slurm of this test's own, on this machine: the same rows as one run. A
# task that is signalled goes back into the queue and goes on.
. "$(dirname "$0")/lib.sh"
. "$(dirname "$0")/sweep_lib.sh"
source=$DATA/..
export BATTEN

plan a.json 240 "$faired" "$kept" "$judged"
expect 0 sweep a.json --out a.db

# ---- GNU parallel ----
HOME=$folder sh "$source/data/examples/sweep-parallel.sh" a.json parts 3 >"$out" 2>"$talk" ||
	{ fail 'sweep-parallel.sh'; cat "$talk"; }
same_rows a.db parts/whole.db

# ---- Slurm: one node, its daemons run by this user, everything in this folder ----
user=$(id -un)
base=$((20000 + $$ % 20000))
mkdir -p slurm/state slurm/spool slurm/munge
chmod 700 slurm/munge
head -c 128 /dev/urandom >slurm/munge/key
chmod 600 slurm/munge/key
cat >slurm/slurm.conf <<END
ClusterName=test
SlurmctldHost=$(hostname -s)(127.0.0.1)
SlurmUser=$user
SlurmdUser=$user
AuthType=auth/munge
AuthInfo=socket=$folder/slurm/munge/socket,cred_expire=5
CredType=cred/munge
CryptoType=crypto/munge
SlurmctldPort=$base
SlurmdPort=$((base + 1))
StateSaveLocation=$folder/slurm/state
SlurmdSpoolDir=$folder/slurm/spool
SlurmctldPidFile=$folder/slurm/slurmctld.pid
SlurmdPidFile=$folder/slurm/slurmd.pid
SlurmctldLogFile=$folder/slurm/slurmctld.log
SlurmdLogFile=$folder/slurm/slurmd.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
JobAcctGatherType=jobacct_gather/none
MpiDefault=none
ReturnToService=2
KillWait=10
MinJobAge=2
SchedulerParameters=sched_interval=1,batch_sched_delay=0
NodeName=$(hostname -s) NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
END
touch slurm/cgroup.conf
SLURM_CONF=$folder/slurm/slurm.conf
export SLURM_CONF
stop_slurm()
{
	for _pid in slurm/slurmd.pid slurm/slurmctld.pid slurm/munge/pid; do
		[ -s "$folder/$_pid" ] && kill "$(cat "$folder/$_pid")" 2>/dev/null
	done
	for _try in 1 2 3 4 5 6 7 8 9 10; do
		sleep 0.3
		[ -e "$folder/slurm/slurmctld.pid" ] || break
	done
}
trap 'stop_slurm; rm -rf "$folder" "$links"' EXIT
PATH=$PATH:/usr/sbin
munged --force --socket="$folder/slurm/munge/socket" --key-file="$folder/slurm/munge/key" \
	--pid-file="$folder/slurm/munge/pid" --log-file="$folder/slurm/munge/log" \
	--seed-file="$folder/slurm/munge/seed" >daemons 2>&1 &&
	slurmctld -f "$SLURM_CONF" >>daemons 2>&1 &&
	slurmd -f "$SLURM_CONF" >>daemons 2>&1 || { fail 'Slurm does not start:'; cat daemons; }
tries=0
until sinfo -h -o %T 2>/dev/null | grep -q idle; do
	tries=$((tries + 1))
	if [ $tries -gt 100 ]; then
		fail 'the node does not become idle:'
		tail -n 5 slurm/*.log daemons
		finish
	fi
	sleep 0.2
done

# ask_queue JOB: how many tasks of it are not done.
ask_queue()
{
	squeue -h -r -j "$1" -t all -o %T 2>/dev/null | grep -c 'PENDING\|RUNNING\|COMPLETING\|REQUEUE\|SUSPENDED'
}

# Blocks so small that a shard is not at its end before the signal comes: kernels are built first.
mkdir array
TMPDIR=$folder/array
export TMPDIR
job=$(sbatch --parsable --array=1-2 --cpus-per-task=1 --time=10 --chdir="$folder" \
	--output="$folder/array/%a.out" "$source/data/examples/sweep-array.sh" a.json array --block 8) ||
	fail 'sbatch refused the script'
# A shard that has begun is told to stop; Slurm reaches the script only.
tries=0
until [ "$(ls array/*.db 2>/dev/null | wc -l)" -eq 2 ] || [ $tries -gt 200 ]; do
	tries=$((tries + 1))
	sleep 0.1
done
scancel --batch --signal=USR1 "${job}_1"
tries=0
while [ "$(ask_queue "$job")" -gt 0 ] && [ $tries -lt 180 ]; do
	tries=$((tries + 1))
	sleep 0.5
done
equals 'tasks that are left' "$(ask_queue "$job")" 0
expect 0 merge whole.db array/part1.db array/part2.db
same_rows a.db whole.db
equals 'runs of the shard that was stopped' "$(ask array/part1.db 'SELECT count(*) FROM runs')" 2
grep -q '^to go on: batten sweep' array/1.out || { fail 'the task was not interrupted'; cat array/1.out; }
finish
