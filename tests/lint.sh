#!/usr/bin/env bash
# Checks on the text of the project; each is a test of CTest.
#
#   tests/lint.sh format    C++ files are as .clang-format says
#   tests/lint.sh shell     shell scripts pass shellcheck
#
# Exit code 77: skipped, as the checker is not installed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

need() {
    command -v "$1" >/dev/null || {
        echo "skipped: $1 is not installed"
        exit 77
    }
}

case "${1:-}" in
    format)
        need clang-format
        folders=()
        for folder in include src io solvers mpi_drivers python examples tests bench; do
            if [[ -d $folder ]]; then folders+=("$folder"); fi
        done
        find "${folders[@]}" \( -name '*.cpp' -o -name '*.hpp' \) -print0 |
            sort -z | xargs -0 clang-format --dry-run -Werror
        ;;
    shell)
        need shellcheck
        # Files that are sourced are checked through those that source them.
        find .ci jobs tests -type f \( -executable -o -path 'tests/*' -name '*.sh' \) ! -name '*.py' -print0 |
            sort -z | xargs -0 shellcheck -x
        ;;
    *)
        echo "usage: tests/lint.sh format|shell" >&2
        exit 2
        ;;
esac
