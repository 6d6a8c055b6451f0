#!/usr/bin/env bash
# Installs what is missing, builds, and runs all tests.
#
#   ./tests/run.sh [ARGUMENTS OF CTEST]        e.g. ./tests/run.sh -R assignment
#
# The build folder is build/, shared with jobs/quickstart.sh. The exit code is CTest's.
# COSEG_WARNINGS_AS_ERRORS=1 makes compiler warnings errors, =0 turns that off again.
# COSEG_SANITIZERS=1 afterwards builds the fuzzers of the readers and the unit tests of src and io with the address and the
# undefined-behaviour sanitizer in build-fuzzers/, and runs them too: for at most 10 minutes in all. Where Clang cannot be
# installed this is skipped with a message.
# COSEG_LINT_ALL=1 has clang-tidy check everything and not only what changed (tests/lint_tidy.py).
set -euo pipefail
# shellcheck source=jobs/build_steps.sh
source "$(dirname "${BASH_SOURCE[0]}")/../jobs/build_steps.sh"

options=(-DCOSEG_BUILD_TESTS=ON)
case "${COSEG_WARNINGS_AS_ERRORS:-}" in
    "") ;;
    1) options+=(-DCOSEG_WARNINGS_AS_ERRORS=ON) ;;
    0) options+=(-DCOSEG_WARNINGS_AS_ERRORS=OFF) ;;
    *)
        echo "error: COSEG_WARNINGS_AS_ERRORS must be 0 or 1, not '$COSEG_WARNINGS_AS_ERRORS'" >&2
        exit 2
        ;;
esac

case "${COSEG_SANITIZERS:-0}" in
    0 | 1) ;;
    *)
        echo "error: COSEG_SANITIZERS must be 0 or 1, not '$COSEG_SANITIZERS'" >&2
        exit 2
        ;;
esac

# with_sanitizers : the preset `fuzzers`, built and run.
with_sanitizers() {
    local fuzzers=$root/build-fuzzers status=0 end=$((SECONDS + 600))
    mkdir -p "$fuzzers"
    echo "building the readers and their tests with sanitizers in $fuzzers"
    (cd "$root" && logged "$fuzzers/configure.log" cmake --preset fuzzers)
    logged "$fuzzers/build.log" timeout --signal=INT $((end - SECONDS)) cmake --build "$fuzzers" --parallel "$cores" \
        --target unit_tests reader_fuzzer
    (cd "$root" && timeout --signal=INT $((end - SECONDS)) ctest --preset fuzzers --parallel "$cores") || status=$?
    if ((status == 124)); then echo "error: building and testing with sanitizers took longer than 10 minutes" >&2; fi
    return "$status"
}

# clang_has_sanitizers : whether Clang is here with its runtime libraries.
clang_has_sanitizers() {
    command -v clang++ >/dev/null &&
        echo 'extern "C" int LLVMFuzzerTestOneInput(const char*, unsigned long) { return 0; }' |
        clang++ -fsanitize=fuzzer,address,undefined -x c++ -o "$build/sanitizer_probe" - 2>/dev/null
}

mkdir -p "$build"
install_missing "$build/install.log" "${coseg_packages[@]}" "${coseg_python_packages[@]}" "${coseg_test_packages[@]}"
configure "${options[@]}"
echo "building the program and its tests in $build"
build_target all
ctest --test-dir "$build" --output-on-failure --no-tests=error --parallel "$cores" "$@"
if [[ ${COSEG_SANITIZERS:-0} == 1 ]]; then
    if install_missing "$build/install_sanitizers.log" "${coseg_sanitizer_packages[@]}" && clang_has_sanitizers; then
        with_sanitizers
    else
        echo "skipped: no tests with sanitizers, as Clang and its runtime libraries are missing (${coseg_sanitizer_packages[*]})"
    fi
fi
