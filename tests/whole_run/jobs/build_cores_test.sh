#!/usr/bin/env bash
# The scripts build on all cores that they may use, whatever OpenMP's variables say: clusters set OMP_NUM_THREADS=1.
set -euo pipefail
# shellcheck source=tests/whole_run/fixture.sh
source "$COSEG_SOURCE/tests/whole_run/fixture.sh"

# expects COUNT VARIABLE... : what jobs/build_steps.sh takes for the number of cores in this environment.
expects() {
    local count=$1 found
    shift
    # shellcheck disable=SC2016  # $0 and $cores belong to the inner shell
    found=$(env "$@" bash -c 'source "$0"; echo "$cores"' "$COSEG_SOURCE/jobs/build_steps.sh")
    [[ $found == "$count" ]] || fail "with $*: $found cores, not $count"
    echo "ok: $* builds on $count"
}

allowed=$(python3 -c 'import os; print(len(os.sched_getaffinity(0)))')
expects "$allowed" OMP_NUM_THREADS=1
expects "$allowed" OMP_NUM_THREADS=1000
expects "$allowed" OMP_THREAD_LIMIT=1
