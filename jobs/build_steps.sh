# shellcheck shell=bash
# What jobs/quickstart.sh and tests/run.sh share: the build folder, and how ranks are started on one machine.
# Sets `root`, the project's folder, and `build`.

# The cores that this process may use. nproc takes OMP_NUM_THREADS and OMP_THREAD_LIMIT for their number; clusters set the
# former to 1, and the build would then use one core of many.
cores=$(env -u OMP_NUM_THREADS -u OMP_THREAD_LIMIT nproc)
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$root/build

# shellcheck source=jobs/dependencies.sh
source "$root/jobs/dependencies.sh"

# logged LOG COMMAND... : the command's output goes to the log, and to the terminal only if it fails.
logged() {
    local log=$1 status=0
    shift
    "$@" >"$log" 2>&1 </dev/null || status=$?
    if ((status != 0)); then
        tail -n 60 "$log" >&2
        echo "error: '$*' failed with exit code $status; the whole log is $log" >&2
    fi
    return "$status"
}

is_configured() { [[ -f $build/build.ninja || -f $build/Makefile ]]; }

# configure OPTION... : a Release build in build/. Options that are not named keep the value they have there, so that
# the scripts that share the folder do not undo each other's work.
configure() {
    local generator=()
    if ! is_configured && command -v ninja >/dev/null; then generator=(-G Ninja); fi
    logged "$build/configure.log" cmake -S "$root" -B "$build" "${generator[@]}" -DCMAKE_BUILD_TYPE=Release "$@"
}

# build_target NAME : builds it on all cores.
build_target() {
    logged "$build/build.log" cmake --build "$build" --parallel "$cores" --target "$1"
}

# Open MPI on one machine, in a container too: as root, with more ranks than cores, ranks not pinned to the cores that
# another run uses, idle ranks yielding, and no copying between processes that containers forbid.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_hwloc_base_binding_policy=none OMPI_MCA_mpi_yield_when_idle=1
export OMPI_MCA_btl_vader_single_copy_mechanism=none
# One rank is one thread of work.
export OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1
