#!/usr/bin/env bash
# A real Slurm of four nodes on this machine runs docker/farm/frames.sbatch, 200 frames; one node is killed on the way.
# The set has to be complete, and the same bytes as this machine's own run without Slurm.
#   bash tests/farm/slurm.sh build/release/awan
# By hand and as root: installs slurm-wlm and munge, of which it starts its own daemons on ports 17001 to 17005.
set -uo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
. "$here/../shell_checks.sh"
awan=$(realpath "$1")
recipe=$here/../../docker/farm/frames.sbatch
[ "$(id -u)" = 0 ] || { echo "slurm.sh: run this as root" >&2; exit 1; }
command -v slurmctld munged >/dev/null ||
    { apt-get update -qq && DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends slurm-wlm munge; } \
    >/dev/null || exit 1
work=$(mktemp -d)
daemons=()
cleanup() {
    kill -KILL "${daemons[@]}" 2>/dev/null
    wait 2>/dev/null
    [ "$failures" = 0 ] && rm -rf "$work" || echo "slurm.sh: logs are in $work" >&2
}
trap cleanup EXIT
cd "$work" || exit 1

# --- the cluster
# munged wants folders that nobody else can write to.
chmod 755 "$work"
mkdir -m 700 munge
mkdir -m 755 munge-socket
dd if=/dev/urandom of=munge/key bs=64 count=1 status=none
chmod 600 munge/key
munged --foreground --force --key-file="$work/munge/key" --socket="$work/munge-socket/socket" \
    --pid-file="$work/munge/pid" --log-file="$work/munge/log" --seed-file="$work/munge/seed" >munged.log 2>&1 &
daemons+=($!)

mkdir state
name=$(hostname -s)
cat >slurm.conf <<END_CONF
ClusterName=awan
SlurmctldHost=$name(127.0.0.1)
SlurmctldPort=17001
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
# Who is not answered by a node gets another after 5 s, not 2 minutes.
AuthInfo=socket=$work/munge-socket/socket,cred_expire=5
StateSaveLocation=$work/state
SlurmctldPidFile=$work/slurmctld.pid
SlurmctldLogFile=$work/slurmctld.log
SlurmdPidFile=$work/slurmd.%n.pid
SlurmdLogFile=$work/slurmd.%n.log
SlurmdSpoolDir=$work/spool.%n
SlurmdTimeout=10
SlurmdParameters=config_overrides
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=batch_sched_delay=0,sched_interval=1
ReturnToService=2
KillWait=2
NodeName=node[1-4] NodeHostname=$name NodeAddr=127.0.0.1 Port=[17002-17005] CPUs=1 RealMemory=1024
PartitionName=farm Nodes=ALL Default=YES State=UP MaxTime=INFINITE
END_CONF
echo CgroupPlugin=cgroup/v1 >cgroup.conf
export SLURM_CONF=$work/slurm.conf
slurmctld -D -f slurm.conf >slurmctld.out 2>&1 &
daemons+=($!)
declare -A node
for n in 1 2 3 4; do
    mkdir "spool.node$n"
    # A group of its own: a node's death takes its work with it.
    setsid slurmd -D -N "node$n" -f slurm.conf >"slurmd.node$n.out" 2>&1 &
    node[$n]=$!
    daemons+=($!)
done
for _ in $(seq 300); do
    [ "$(sinfo -h -o %D -t idle 2>/dev/null)" = 4 ] && break
    sleep 0.2
done
same "nodes that wait for work" 4 "$(sinfo -h -o %D -t idle)"
[ "$failures" = 0 ] || exit 1

# --- the frames
cat >scene.json <<'END_SCENE'
{"clouds":[{"velocity":[1,0,0],"cubes":[{"particles":60,"size":[2,1,2],"center":[0,0,0],"radius":0.5}]}],
 "sequence":{"from":0,"to":20,"frames":200},"image":{"width":16,"height":12},"accuracy":{"rung":"transport-16"}}
END_SCENE
mkdir alone farm
"$awan" render scene.json --frames all -o 'alone/frame.####.exr' >/dev/null 2>alone.log || fail "the run without Slurm"

made() { find farm -name 'frame.*.exr' | wc -l; }
begin=$SECONDS
job=$(env AWAN="$awan" SCENE="$work/scene.json" FRAMES="$work/farm" sbatch --parsable --export=ALL "$recipe")
until [ "$(made)" -ge 40 ]; do
    sleep 0.1
    [ $((SECONDS - begin)) -lt 300 ] || { fail "only $(made) frames in 300 s"; exit 1; }
done
# One dies with all that it runs: the daemon, and this job's tasks there with the steps that would report their end. They are
# stopped first, so that none ends between being found and being killed.
doomed=()
while [ ${#doomed[@]} = 0 ]; do
    for environment in $(grep -lzx "SLURMD_NODENAME=node2" /proc/[0-9]*/environ); do
        grep -qzx "FRAMES=$work/farm" "$environment" || continue
        task=$(cut -d/ -f3 <<<"$environment")
        step=$(awk '/^PPid:/{print $2}' "/proc/$task/status")
        [ "$(cat "/proc/$step/comm")" = slurmstepd ] && kill -STOP "$step" && doomed+=("$step" "$task")
    done 2>/dev/null
    [ $((SECONDS - begin)) -lt 300 ] || { fail "nothing runs on node2"; exit 1; }
done
kill -KILL "${node[2]}" "${doomed[@]}" 2>/dev/null
{ wait "${node[2]}"; } 2>/dev/null
echo "slurm.sh: node2 killed after $(made) frames"
while [ -n "$(squeue -h -j "$job" 2>&1)" ]; do
    sleep 0.5
    [ $((SECONDS - begin)) -lt 500 ] || { fail "not done in 500 s: $(squeue -h)"; exit 1; }
done
same "state of the killed node" "down*" "$(sinfo -h -n node2 -o %t)"
same "frames" 200 "$(made)"
for frame in alone/*; do
    cmp -s "$frame" "farm/$(basename "$frame")" || fail "$frame is another by Slurm"
done
same "nothing half-written" 200 "$(find farm -type f | wc -l)"
same "what the killed node ran" 1 "$(grep -c 'equeue.* node node2' slurmctld.log)"
echo "slurm.sh: $(made) frames in $((SECONDS - begin)) s; $(grep 'equeue.* node node2' slurmctld.log)"
exit "$failures"
