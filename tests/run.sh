#!/usr/bin/env bash
# Installs what is missing, builds, and runs all tests.
#
#   ./tests/run.sh [ARGUMENTS OF CTEST]        e.g. ./tests/run.sh -R Assignment
#
# The build folder is build/, shared with jobs/quickstart.sh. The exit code is CTest's.
# COSEG_WARNINGS_AS_ERRORS=1 makes compiler warnings errors, =0 turns that off again.
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

mkdir -p "$build"
install_missing "$build/install.log" "${coseg_packages[@]}" "${coseg_test_packages[@]}"
configure "${options[@]}"
echo "building the program and its tests in $build"
build_target all
exec ctest --test-dir "$build" --output-on-failure --no-tests=error --parallel "$cores" "$@"
