# shellcheck shell=bash
# What whole-run tests share: a scratch folder, small meshes made in place, and checks of exit code and message.

# What is started without mpirun is one process here; parallel_start_test.sh sees to the other way.
export COSEG_RANKS=1

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

fail() {
    echo "FAILED: $*" >&2
    exit 1
}

# ranks N COMMAND... : the command on N ranks, killed after 100 s, which no case here may need.
ranks() {
    local count=$1
    shift
    timeout --signal=KILL 100 mpirun --oversubscribe -n "$count" "$@"
}

# peanut FILE WAIST : a closed surface of revolution of 1,104 triangles, two bulbs joined at a waist.
peanut() {
    awk -v waist="$2" 'BEGIN {
        pi = atan2(0, -1); rings = 23; around = 24
        print "OFF"; print rings * around + 2, 2 * rings * around, 0
        for (i = 1; i <= rings; ++i) {
            t = pi * i / (rings + 1)
            r = sin(t) * (1 - waist * exp(-8 * cos(t) ^ 2))
            for (j = 0; j < around; ++j) print r * cos(2 * pi * j / around), r * sin(2 * pi * j / around), 2 * cos(t)
        }
        print 0, 0, 2; print 0, 0, -2
        top = rings * around; bottom = top + 1; last = (rings - 1) * around
        for (j = 0; j < around; ++j) {
            k = (j + 1) % around
            print 3, top, j, k; print 3, bottom, last + k, last + j
            for (i = 0; i + 1 < rings; ++i) {
                a = i * around
                print 3, a + j, a + around + j, a + around + k; print 3, a + j, a + around + k, a + k
            }
        }
    }' >"$1"
}

# tables COUNT FOLDER : the first generated tables of seed 5, of 2,000 faces, with their truth. To make one takes as long as to
# cut it, so CTest has them made once for all tests (COSEG_TABLES).
tables() {
    if [[ -z ${COSEG_TABLES:-} ]]; then
        "$COSEG" generate table --count "$1" --seed 5 --faces 2000 --out "$2" >/dev/null
        return
    fi
    mkdir -p "$2/meshes" "$2/truth"
    cp "$COSEG_TABLES/truth/labels.txt" "$2/truth/"
    local k name
    for ((k = 0; k < $1; ++k)); do
        name=$(printf 'table_%04d' "$k")
        cp "$COSEG_TABLES/meshes/$name.off" "$2/meshes/"
        cp "$COSEG_TABLES/truth/$name.seg" "$2/truth/"
    done
}

# refuses WHAT CODE WORDS COMMAND... : the command ends with CODE and says WORDS (a fixed string) once; no partial folder stays.
refuses() {
    local what=$1 code=$2 words=$3 status=0
    shift 3
    "$@" >"$work/out" 2>"$work/err" </dev/null || status=$?
    [[ $status -eq $code ]] || { cat "$work/err" >&2; fail "$what: exit code $status, not $code"; }
    local told
    told=$(grep -c -F -- "$words" "$work/err" || true)
    [[ $told -eq 1 ]] || { cat "$work/err" >&2; fail "$what: '$words' said $told times, not once"; }
    if compgen -G "$work/*.partial-*" >/dev/null; then fail "$what: a partial folder is left"; fi
    echo "ok: $what"
}
