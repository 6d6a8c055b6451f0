#!/usr/bin/env bash
# Fuzzes the readers of meshes, labels, names, reports, corrections, constraints, alignments, problems and NPY files with
# libFuzzer under the address and the undefined-behaviour sanitizer.
#
#   tests/fuzz/run.sh [SECONDS [SUFFIX ...]]     60 seconds each of all readers; the suffixes are those in tests/corpus
#
# Needs clang++ with its runtime libraries (Debian: clang, libclang-rt-14-dev); without them it says so and ends with 77. The
# fuzzers are built in COSEG_FUZZ_BUILD, or build-fuzz/. They start from tests/corpus and keep what they find new in corpus/
# there. A finding ends the script with exit code 1, and the bytes that led to it are finding-* there: put them into
# tests/corpus with the correction.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
seconds=${1:-60}
shift $(($# > 0 ? 1 : 0))
suffixes=("$@")
((${#suffixes[@]} > 0)) || suffixes=(.off .obj .ply .stl .glb .gltf .seg .txt .report .corrections .constraints .alignment .problem .npy)
build=${COSEG_FUZZ_BUILD:-$root/build-fuzz}
mkdir -p "$build"
if ! command -v clang++ >/dev/null ||
    ! echo 'extern "C" int LLVMFuzzerTestOneInput(const char*, unsigned long) { return 0; }' |
        clang++ -fsanitize=fuzzer,address,undefined -x c++ -o "$build/probe" - 2>/dev/null; then
    echo "skipped: no clang++ with its runtime libraries (Debian: clang, libclang-rt-14-dev)"
    exit 77
fi

sources=("$root"/io/mesh_files/*.cpp "$root"/io/gltf/*.cpp "$root"/src/mesh/{face_triangles,polygon_triangulation}.cpp
    "$root"/io/data_files/{label,name,correction,alignment,face_feature,problem}_file.cpp
    "$root"/io/folders/finished_run.cpp "$root"/io/files/{hdf5_file,content_hash}.cpp
    "$root"/io/files/{atomic_file,file_contents,text_cursor,text_encoding}.cpp "$root"/src/base/*.cpp
    "$root"/src/pictures/{part_colors,image}.cpp)
read -ra hdf5_includes < <(pkg-config --cflags hdf5)
read -ra hdf5_libraries < <(pkg-config --libs hdf5)
checks=("-fsanitize=address,undefined" -fno-sanitize-recover=undefined -D_GLIBCXX_ASSERTIONS)
ccache=()
if command -v ccache >/dev/null; then ccache=(ccache); fi
compile=("${ccache[@]}" clang++ -std=c++20 -O1 -g1 '-DCOSEG_VERSION="fuzzed"' "${checks[@]}" "-I$root" -isystem /usr/include/eigen3
    "${hdf5_includes[@]}")

echo "building the readers"
mkdir -p "$build/objects"
for source in "${sources[@]}"; do
    printf '%s\0' -o "$build/objects/$(basename "$source").o" "$source"
done | xargs -0 -n 3 -P "$(nproc)" "${compile[@]}" -fsanitize=fuzzer-no-link -c

program=$build/reader_fuzzer
"${compile[@]}" -fsanitize=fuzzer-no-link -c -o "$build/reader_fuzzer.o" "$root/tests/fuzz/reader_fuzzer.cpp"
clang++ "${checks[@]}" -fsanitize=fuzzer -o "$program" "$build/reader_fuzzer.o" "$build"/objects/*.o "${hdf5_libraries[@]}" -lxxhash

# fuzz SUFFIX : fuzzes one reader.
fuzz() {
    local suffix=$1
    local found=$build/corpus/$suffix seeds=$build/seeds/$suffix
    rm -rf "$seeds"
    mkdir -p "$found" "$seeds"
    find "$root/tests/corpus" -name "*$suffix" -exec cp --target-directory="$seeds" {} +
    echo "fuzzing the reader of $suffix for $seconds s"
    COSEG_FUZZED=$suffix "$program" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 -max_len=4096 -print_final_stats=1 -verbosity=0 \
        -artifact_prefix="$build/finding-" "$found" "$seeds" 2>&1 | tee "$build/log$suffix" | grep -E "ERROR|SUMMARY|number_of" ||
        true
    if compgen -G "$build/finding-*" >/dev/null; then
        echo "a finding: $(ls "$build"/finding-*); see $build/log$suffix" >&2
        return 1
    fi
    grep -q number_of_executed_units "$build/log$suffix" || { cat "$build/log$suffix" >&2; return 1; }
}

for suffix in "${suffixes[@]}"; do fuzz "$suffix"; done
