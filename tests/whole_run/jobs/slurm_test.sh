#!/usr/bin/env bash
# Every job script under a real Slurm on this machine: munged, slurmctld and slurmd in a scratch folder, stopped at the end.
# Skips where Slurm is not installed or we are not root, who alone may start it.
set -euo pipefail
# shellcheck source=tests/whole_run/fixture.sh
source "$(dirname "${BASH_SOURCE[0]}")/../fixture.sh"

export PATH=$PATH:/usr/sbin
for program in munged slurmctld slurmd sbatch scancel scontrol; do
    command -v "$program" >/dev/null || { echo "skipped: $program is not installed"; exit 77; }
done
((EUID == 0)) || { echo "skipped: only root can start Slurm"; exit 77; }
id munge >/dev/null 2>&1 || { echo "skipped: there is no user munge"; exit 77; }

jobs=$COSEG_SOURCE/jobs
scratch=$work/slurm
export SLURM_CONF=$scratch/slurm.conf COSEG_HOME=$COSEG_SOURCE COSEG
daemons=()
stop_all() {
    scancel --user=root 2>/dev/null || true
    ((${#daemons[@]} == 0)) || kill "${daemons[@]}" 2>/dev/null || true
    wait 2>/dev/null || true
    rm -rf "$work"
}
trap stop_all EXIT

free_ports() {
    python3 -c 'import socket
sockets = [socket.socket() for _ in range(2)]
for s in sockets: s.bind(("127.0.0.1", 0))
print(*(s.getsockname()[1] for s in sockets))'
}

# wait_until WHAT SECONDS COMMAND... : until the command succeeds.
wait_until() {
    local what=$1 end=$((SECONDS + $2))
    shift 2
    until "$@"; do
        ((SECONDS < end)) || { tail -n 20 "$scratch"/*.log "$work"/*.log >&2 || true; fail "$what: not in time"; }
        sleep 0.2
    done
}

start_slurm() {
    local ports host
    read -r -a ports <<<"$(free_ports)"
    host=$(hostname -s)
    chmod 755 "$work"
    mkdir -p "$scratch/munge" "$scratch/state" "$scratch/spool"
    head -c 1024 /dev/urandom >"$scratch/munge/key"
    chown -R munge "$scratch/munge"
    chmod 700 "$scratch/munge"
    chmod 400 "$scratch/munge/key"
    cat >"$SLURM_CONF" <<END
ClusterName=coseg
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$scratch/munge/socket,cred_expire=8
SlurmctldPort=${ports[0]}
SlurmdPort=${ports[1]}
StateSaveLocation=$scratch/state
SlurmdSpoolDir=$scratch/spool
SlurmctldPidFile=$scratch/slurmctld.pid
SlurmdPidFile=$scratch/slurmd.pid
SlurmctldLogFile=$scratch/slurmctld.log
SlurmdLogFile=$scratch/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmdParameters=config_overrides
SchedulerParameters=sched_interval=2,sched_min_interval=0,bf_interval=2
MpiDefault=none
SwitchType=switch/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
ReturnToService=2
KillWait=10
NodeName=$host NodeAddr=127.0.0.1 CPUs=4 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
END
    setpriv --reuid=munge --regid=munge --clear-groups munged --foreground --force --key-file="$scratch/munge/key" \
        --socket="$scratch/munge/socket" --pid-file="$scratch/munge/pid" --log-file="$scratch/munge/log" \
        --seed-file="$scratch/munge/seed" --origin=127.0.0.1 >"$scratch/munged.log" 2>&1 &
    daemons+=($!)
    wait_until "munged" 30 test -S "$scratch/munge/socket"
    slurmctld -D >"$scratch/slurmctld.out.log" 2>&1 &
    daemons+=($!)
    slurmd -D -N "$host" >"$scratch/slurmd.out.log" 2>&1 &
    daemons+=($!)
    wait_until "the node" 60 node_is_idle
}
node_is_idle() { sinfo --noheader --format=%T 2>/dev/null | grep -q '^idle$'; }

# state_of JOB, is JOB STATE... : how Slurm calls what the job is doing.
state_of() { scontrol show job --oneliner "$1" 2>/dev/null | grep -o 'JobState=[A-Z_]*' | sort -u | cut -d= -f2; }
is() {
    local job=$1 now
    shift
    now=$(state_of "$job")
    [[ " $* " == *" $now "* ]]
}
has_ended() { is "$1" COMPLETED FAILED CANCELLED TIMEOUT NODE_FAIL; }
completes() {
    wait_until "$1" 120 has_ended "$2"
    is "$2" COMPLETED || { cat "$work"/*.log >&2; fail "$1: job $2 is $(state_of "$2")"; }
}
same() { diff -r "$work/$2/labels" "$work/$1/labels" >/dev/null || fail "$1: other labels than mpirun's"; }

mkdir "$work/sub"
tables 6 "$work/set"
fast=(--quiet --no-sheet --no-html --patches 10 --geodesic-samples 50 --oversegmentations 3)
slow=(--quiet --no-sheet --no-html --patches 10 --geodesic-samples 1000 --oversegmentations 3)
for kind in fast slow; do
    declare -n options=$kind
    ranks 2 "$COSEG" run "${options[@]}" --parts 2 --out "$work/$kind" "$work/set/meshes"
done

start_slurm
cd "$work/sub"
submit=(sbatch --parsable --time=20 --output="$work/job-%j.log" --ntasks=2)

# A plain run, as submit.sh hands it in, and what --dry-run says of it.
"$jobs/submit.sh" "$work/set/meshes" 2 --dry-run --ntasks 2 --out "$work/plain" 2>"$work/dry" >"$work/out"
refuses "a folder for a list" 3 "is no list that can be read" "$jobs/submit.sh" "@$work/set/meshes" 2 --dry-run
grep -q "^sbatch .*--ntasks=2.*coseg.sbatch run --parts 2 .*$work/set/meshes" "$work/dry" || { cat "$work/dry" >&2; fail "--dry-run"; }
"$jobs/submit.sh" "$work/set/meshes" 2 --ntasks 2 --time 20 --state "$work/plain.state" --out "$work/plain" -- "${fast[@]}" >"$work/out"
plain=$(sed 's/job \([0-9]*\).*/\1/' "$work/out")

# An array of two shards and the job that depends on it.
array=$("${submit[@]}" --ntasks=1 --array=0-1 "$jobs/descriptors.sbatch" --state "$work/array.state" --patches 10 --geodesic-samples 50 --oversegmentations 3 "$work/set/meshes")
solve=$("${submit[@]}" --ntasks=3 --dependency=afterok:"$array" "$jobs/solve.sbatch" --parts 2 --state "$work/array.state" --out "$work/solved" "${fast[@]}" "$work/set/meshes")
completes "a plain run" "$plain"
same plain fast
echo "ok: a plain run gives mpirun's bytes"
completes "array and dependent job" "$solve"
same solved fast
python3 -c 'import json, sys; sys.exit(json.load(open(sys.argv[1]))["state"]["meshes_described"] != 0)' "$work/solved/report.json" ||
    fail "the dependent job describes meshes again"
echo "ok: array and dependent job"

# start_slow NAME : a job that is at work on its descriptions; sets `job`.
start_slow() {
    job=$("${submit[@]}" "$jobs/coseg.sbatch" run "${slow[@]}" --parts 2 --state "$work/$1.state" --out "$work/$1" "$work/set/meshes")
    wait_until "$1: a first description" 120 compgen -G "$work/$1.state/meshes/*/*.h5" >"$work/out"
}

# What Slurm sends before the time limit; the job goes back into the queue and continues.
start_slow limit
scancel --batch --signal=USR1 "$job"
completes "time limit" "$job"
same limit slow
scontrol show job --oneliner "$job" | grep -q 'Restarts=1' || fail "time limit: the job was not requeued"
grep -q "goes back into the queue" "$work/job-$job.log" || fail "time limit: the log does not say so"
echo "ok: checkpoint, requeue, the same bytes"

# A rank dies: the job fails soon and says why, and can be handed in again.
start_slow killed
pkill -KILL --oldest --full "^$COSEG run .*$work/killed.state"
wait_until "a killed rank" 30 has_ended "$job"
is "$job" FAILED || fail "a killed rank: the job is $(state_of "$job")"
grep -q "signal 9" "$work/job-$job.log" || fail "a killed rank: the log gives no reason"
job=$("${submit[@]}" "$jobs/coseg.sbatch" run "${slow[@]}" --parts 2 --state "$work/killed.state" --out "$work/killed" "$work/set/meshes")

# scaling.sbatch meanwhile.
scaling=$("${submit[@]}" "$jobs/scaling.sbatch" "$work/scaling" "$work/set/meshes" --parts 2 --no-sheet --no-html --patches 10 --geodesic-samples 50 --oversegmentations 3)
completes "handed in again" "$job"
same killed slow
echo "ok: a killed rank ends the job with a reason; the next one gives the same bytes"

start_slow cancelled
scancel "$job"
wait_until "scancel" 60 has_ended "$job"
wait_until "scancel: processes stay" 60 bash -c "! pgrep --full '^$COSEG run .*$work/cancelled.state' >/dev/null"
[[ ! -e $work/cancelled ]] || fail "scancel: half a result"
"$COSEG" state verify "$work/cancelled.state" >"$work/out" || fail "scancel: a damaged state"
echo "ok: scancel"

completes "scaling" "$scaling"
python3 - "$work/scaling" <<'END' || fail "scaling.json"
import json, sys, xml.dom.minidom
data = json.load(open(sys.argv[1] + "/scaling.json"))
assert [row["ranks"] for row in data["strong"]] == [1, 2] and data["weak"][0]["meshes"] == 3, data
assert all(row["seconds"] > 0 and row["efficiency"] > 0 for kind in ("strong", "weak") for row in data[kind])
xml.dom.minidom.parse(sys.argv[1] + "/scaling.svg")
END
echo "ok: scaling"
