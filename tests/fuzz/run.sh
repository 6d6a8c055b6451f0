#!/usr/bin/env bash
# Fuzzes the readers of meshes, labels, names, reports, corrections, constraints, alignments, problems, NPY and HDF5 files with
# libFuzzer under the address and the undefined-behaviour sanitizer.
#
#   tests/fuzz/run.sh [SECONDS [SUFFIX ...]]     60 seconds each of all readers; the suffixes are those in tests/corpus
#
# COSEG_FUZZER is the program; without it, it is built in build-fuzzers/ (the preset `fuzzers`), which needs clang++ with its
# runtime libraries (Debian: clang, libclang-rt-14-dev). As many readers are fuzzed at once as there are cores. They start from
# tests/corpus, every file of which they read first, and keep what they find new in corpus/ beside the program. A finding ends
# the script with exit code 1, and the bytes that led to it are finding.SUFFIX-* there: put them into tests/corpus with the
# correction. The HDF5 library itself is as Debian has built it: libFuzzer cannot see into it, and what it loses is no leak of ours.
set -euo pipefail
# shellcheck source=jobs/build_steps.sh
source "$(dirname "${BASH_SOURCE[0]}")/../../jobs/build_steps.sh"
seconds=${1:-60}
shift $(($# > 0 ? 1 : 0))
suffixes=("$@")
((${#suffixes[@]} > 0)) || suffixes=(.off .obj .ply .stl .glb .gltf .vtp .seg .txt .report .corrections .constraints .alignment .problem .npy .features .face_features .records)
program=${COSEG_FUZZER:-$root/build-fuzzers/bin/reader_fuzzer}
if [[ -z ${COSEG_FUZZER:-} ]]; then
    build=$root/build-fuzzers
    mkdir -p "$build"
    echo "building the readers in $build"
    (cd "$root" && logged "$build/configure.log" cmake --preset fuzzers)
    build_target reader_fuzzer
fi
results=$(dirname "$program")/../fuzz
mkdir -p "$results"

# fuzz SUFFIX : fuzzes one reader.
fuzz() {
    local suffix=$1
    local found=$results/corpus/$suffix seeds=$results/seeds/$suffix log=$results/log$suffix
    rm -rf "$seeds"
    mkdir -p "$found" "$seeds"
    find "$root/tests/corpus" -name "*$suffix" -exec cp --target-directory="$seeds" {} +
    local longest=4096 leaks=1
    case $suffix in .features | .face_features | .records) longest=65536 leaks=0 ;; esac
    COSEG_FUZZED=$suffix HDF5_USE_FILE_LOCKING=FALSE "$program" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 \
        -max_len="$longest" -detect_leaks="$leaks" -print_final_stats=1 -verbosity=0 \
        -artifact_prefix="$results/finding$suffix-" "$found" "$seeds" >"$log" 2>&1 || true
    if compgen -G "$results/finding$suffix-*" >/dev/null; then
        echo "a finding: $(ls "$results/finding$suffix"-*); see $log" >&2
        return 1
    fi
    grep -q number_of_executed_units "$log" || { cat "$log" >&2; return 1; }
    echo "fuzzed the reader of $suffix for $seconds s: $(sed -n 's/.*number_of_executed_units: *//p' "$log") inputs"
}

rm -f "$results/failed"
for suffix in "${suffixes[@]}"; do
    while (($(jobs -rp | wc -l) >= cores)); do sleep 0.2; done
    { fuzz "$suffix" || touch "$results/failed"; } &
done
wait
[[ ! -e $results/failed ]]
