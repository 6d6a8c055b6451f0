# shellcheck shell=bash
# The one list of Debian packages that coseg needs, and how to install what is missing of them.
# Sourced by jobs/quickstart.sh and tests/run.sh.

# To build and run the program.
coseg_packages=(
    build-essential cmake ninja-build pkg-config
    openmpi-bin libopenmpi-dev
    libpetsc-real-dev libslepc-real-dev
    libopenblas-dev # without it PETSC's BLAS is the reference one, many times slower
    libeigen3-dev libspectra-dev libboost-graph-dev libnanoflann-dev
    libopenmesh-dev libembree-dev libpng-dev zlib1g-dev libexpat1-dev
    libjs-three libjs-chart.js # built into the program for report.html
    libhdf5-openmpi-dev libxxhash-dev # PETSc's packages bring the former anyway
    libcli11-dev nlohmann-json3-dev
)

# To build the Python module, which is left out where they are missing.
coseg_python_packages=(pybind11-dev python3-dev python3-numpy)

# To build and run the tests as well.
coseg_test_packages=(
    libgtest-dev python3 clang-format clang-tidy shellcheck procps file
    python3-pytest python3-scipy python3-matplotlib python3-mpi4py # for the Python module's tests
    assimp-utils # reads GLB files in glb_readers_test.sh, as a second opinion
    slurm-wlm munge # for slurm_test.sh, which starts daemons of its own; the packages' own stay off without a slurm.conf
)

# To build with sanitizers, and to fuzz the readers.
coseg_sanitizer_packages=(clang libclang-rt-14-dev)

# missing_packages NAME... : those that are not installed, one a line.
missing_packages() {
    local installed package
    # dpkg-query fails if it does not know one of the names, after it has answered for the others.
    # shellcheck disable=SC2016  # ${...} is dpkg-query's own syntax
    installed=" $(dpkg-query -W -f '${db:Status-Status}:${Package} ' "$@" 2>/dev/null || true) "
    for package in "$@"; do
        [[ "$installed" == *" installed:$package "* ]] || echo "$package"
    done
}

# install_missing LOG NAME... : installs what is missing, silently; fails with a message that says what to do.
install_missing() {
    local log=$1 as_root=()
    shift
    if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
        echo "note: no apt here, so nothing is installed; coseg is made for Debian 12 and needs: $*" >&2
        return 0
    fi
    local missing
    mapfile -t missing < <(missing_packages "$@")
    ((${#missing[@]} == 0)) && return 0

    if ((EUID != 0)); then
        if ! command -v sudo >/dev/null; then
            echo "error: packages are missing and there is no sudo; as root run" >&2
            echo "  apt-get update && apt-get install --no-install-recommends ${missing[*]}" >&2
            return 1
        fi
        as_root=(sudo)
    fi
    echo "installing ${#missing[@]} packages and what they need (a minute or two): ${missing[*]}"
    local apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive
        apt-get -q -y -o DPkg::Lock::Timeout=120 -o Acquire::Retries=3)
    # In a container nothing has to survive a power cut, and waiting for the disk is most of dpkg's time.
    [[ -d /run/systemd/system ]] || apt+=(-o DPkg::Options::=--force-unsafe-io)
    # A source of somebody else's that cannot be reached must not keep ours from being installed.
    "${apt[@]}" update >"$log" 2>&1 || echo "note: apt-get update failed in part, see $log" >&2
    if ! "${apt[@]}" install --no-install-recommends "${missing[@]}" >>"$log" 2>&1 </dev/null; then
        tail -n 20 "$log" >&2
        echo "error: apt-get could not install ${missing[*]}; the whole log is $log" >&2
        return 1
    fi
}
