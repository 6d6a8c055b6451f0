#!/usr/bin/env bash
# How long a build from nothing takes, and what each measure saves of it.
#
#   bench/build_time.sh [FOLDER]
#
# Builds the program, and then its tests, four times in FOLDER (a scratch folder if none is named): with precompiled
# headers and with rooms compiled together, with one of them, with neither. Prints a table of seconds on the clock and
# seconds of all cores; only the latter mean something on a machine that does other work too. A compiler cache is not used.
set -euo pipefail
# shellcheck source=jobs/build_steps.sh
source "$(dirname "${BASH_SOURCE[0]}")/../jobs/build_steps.sh"

folder=${1:-}
if [[ -z $folder ]]; then
    folder=$(mktemp -d)
    trap 'rm -rf "$folder"' EXIT
fi
mkdir -p "$folder"
export CCACHE_DISABLE=1
TIMEFORMAT='%R %U %S'

# seconds TARGET : of a build of it in the folder `build`, "on the clock, of all cores".
seconds() {
    { time build_target "$1"; } 2>&1 | awk 'NF == 3 && $1 + 0 == $1 { printf "%.0f %.0f", $1, $2 + $3; found = 1 } !found { print > "/dev/stderr" }'
}

echo "$cores cores, $(c++ --version | head -n 1)"
echo "| rooms together | precompiled headers | program: clock (s) | program: cores (s) | tests: clock (s) | tests: cores (s) |"
echo "| --- | --- | --- | --- | --- | --- |"
for unity in ON OFF; do
    for precompiled in ON OFF; do
        build=$folder/unity_$unity-precompiled_$precompiled
        rm -rf "$build"
        mkdir -p "$build"
        configure -DCOSEG_BUILD_TESTS=ON -DCOSEG_UNITY=$unity -DCOSEG_PRECOMPILED_HEADERS=$precompiled
        read -r program_clock program_cores < <(seconds coseg)
        read -r tests_clock tests_cores < <(seconds all)
        echo "| $unity | $precompiled | $program_clock | $program_cores | $tests_clock | $tests_cores |"
    done
done
