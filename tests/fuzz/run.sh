#!/usr/bin/env bash
# Fuzzes the readers of meshes, labels and names with libFuzzer under the address and the undefined-behaviour sanitizer.
#
#   tests/fuzz/run.sh [SECONDS [SUFFIX ...]]     60 seconds each of .off .obj .ply .stl .seg .txt
#
# Needs clang++ with its runtime libraries (Debian: clang, libclang-rt-14-dev). The fuzzers are built in build-fuzz/. They
# start from tests/corpus and keep what they find new in build-fuzz/corpus. A finding ends the script with exit code 1, and
# the bytes that led to it are build-fuzz/finding-*: put them into tests/corpus with the correction.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
seconds=${1:-60}
shift $(($# > 0 ? 1 : 0))
suffixes=("$@")
((${#suffixes[@]} > 0)) || suffixes=(.off .obj .ply .stl .seg .txt)
build=$root/build-fuzz
mkdir -p "$build"

sources=("$root"/io/mesh_files/*.cpp "$root"/io/data_files/{label,name}_file.cpp
    "$root"/io/files/{atomic_file,file_contents,text_cursor,text_encoding}.cpp "$root"/src/base/*.cpp
    "$root"/src/pictures/part_colors.cpp)
checks=("-fsanitize=address,undefined" -fno-sanitize-recover=undefined -D_GLIBCXX_ASSERTIONS)
compile=(clang++ -std=c++20 -O1 -g1 "${checks[@]}" "-I$root" -isystem /usr/include/eigen3)

echo "building the readers"
mkdir -p "$build/objects"
for source in "${sources[@]}"; do
    printf '%s\0' -o "$build/objects/$(basename "$source").o" "$source"
done | xargs -0 -n 3 -P "$(nproc)" "${compile[@]}" -fsanitize=fuzzer-no-link -c

# fuzz SUFFIX : builds the fuzzer of one reader and runs it.
fuzz() {
    local suffix=$1
    local program=$build/fuzz$suffix found=$build/corpus/$suffix seeds=$build/seeds/$suffix
    "${compile[@]}" -fsanitize=fuzzer "-DCOSEG_FUZZED=\"$suffix\"" -o "$program" "$root/tests/fuzz/reader_fuzzer.cpp" \
        "$build"/objects/*.o
    rm -rf "$seeds"
    mkdir -p "$found" "$seeds"
    find "$root/tests/corpus" -name "*$suffix" -exec cp --target-directory="$seeds" {} +
    echo "fuzzing the reader of $suffix for $seconds s"
    "$program" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 -max_len=4096 -print_final_stats=1 -verbosity=0 \
        -artifact_prefix="$build/finding-" "$found" "$seeds" 2>&1 | tee "$build/log$suffix" | grep -E "ERROR|SUMMARY|number_of" ||
        true
    if compgen -G "$build/finding-*" >/dev/null; then
        echo "a finding: $(ls "$build"/finding-*); see $build/log$suffix" >&2
        return 1
    fi
}

for suffix in "${suffixes[@]}"; do fuzz "$suffix"; done
