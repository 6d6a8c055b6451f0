# shellcheck shell=bash
# What the job scripts share: ranks inside a Slurm allocation, and what happens when its time runs out.
# Expects COSEG (the program); sizes come from SLURM_* alone.

: "${COSEG:=${COSEG_HOME:?}/build/bin/coseg}"
[[ -x $COSEG ]] || { echo "error: $COSEG is no program; build coseg, or say where it is with COSEG=PATH" >&2; exit 2; }
export OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1
if ((EUID == 0)); then export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1; fi

run=
signalled=0
# Slurm tells the batch shell alone (--signal=B:...); mpirun hands USR1 on to all ranks, which then write their state.
pass_on() {
    signalled=1
    [[ -z $run ]] || kill -USR1 "$run" 2>/dev/null || true
}
trap pass_on USR1 TERM

# on_all_ranks ARGUMENT... : coseg with these arguments on the ranks of the allocation; sets `status` to its exit code.
on_all_ranks() {
    mpirun -n "$SLURM_NTASKS" "$COSEG" "$@" &
    run=$!
    while true; do
        signalled=0
        status=0
        wait "$run" || status=$?
        ((signalled)) || break # else it was the signal that ended the wait
    done
    run=
}

# end_or_requeue : ends the job with `status`, but puts it back into the queue if the run has been checkpointed (75).
end_or_requeue() {
    if ((status == 75)); then
        echo "checkpointed; job $SLURM_JOB_ID goes back into the queue"
        local job=$SLURM_JOB_ID
        if [[ -n ${SLURM_ARRAY_JOB_ID:-} ]]; then job=${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID; fi
        scontrol requeue "$job" && exit 0
    fi
    exit "$status"
}
