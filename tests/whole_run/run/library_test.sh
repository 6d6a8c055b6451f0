#!/usr/bin/env bash
# The installed tree serves as a library (examples/two_meshes builds from it and runs) and as Debian packages.
set -euo pipefail
# shellcheck source=tests/whole_run/fixture.sh
source "$(dirname "${BASH_SOURCE[0]}")/../fixture.sh"

build=$(cd "$(dirname "$COSEG")/.." && pwd)
for library in src/libcoseg_src.a io/libcoseg_io.a solvers/libcoseg_solvers.a mpi_drivers/libcoseg_drivers.a; do
    [[ -f $build/$library ]] || fail "$library is not built"
done
cmake --install "$build" --prefix "$work/prefix" >"$work/log" 2>&1 || { tail "$work/log"; fail "cmake --install"; }
[[ -s $work/prefix/share/man/man1/coseg.1 && -s $work/prefix/share/bash-completion/completions/coseg ]] || fail "help files"
"$work/prefix/bin/coseg" --version | grep -q "^coseg " || fail "the installed program"
# The interface is two headers, which include nothing but the C++ library, and who links needs no command line.
headers=$(cd "$work/prefix/include" && find . -type f | sort | tr '\n' ' ')
[[ $headers == "./coseg/coseg.hpp ./coseg/shapes.hpp " ]] || fail "headers: $headers"
for header in coseg shapes; do
    printf '#include <coseg/%s.hpp>\n' "$header" | "${CXX:-c++}" -std=c++20 -Wall -Wextra -Wpedantic -Werror -fsyntax-only \
        -I "$work/prefix/include" -x c++ - || fail "$header.hpp by itself"
done
if grep -r -i -l "CLI11" "$work/prefix/lib"*/cmake "$work/prefix/lib"/*/cmake 2>/dev/null; then fail "the library asks for CLI11"; fi
[[ -z $(find "$work/prefix" -name 'libcoseg_commands*') ]] || fail "the command line is installed as a library"
cp -r "$COSEG_SOURCE/examples/two_meshes" "$work/example"
cmake -S "$work/example" -B "$work/example/build" -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_BUILD_TYPE=Release >"$work/log" 2>&1 ||
    { tail "$work/log"; fail "find_package(coseg)"; }
cmake --build "$work/example/build" >"$work/log" 2>&1 || { tail "$work/log"; fail "building the example"; }
peanut "$work/a.off" 0.5
peanut "$work/b.off" 0.6
"$COSEG" run --quiet --parts 2 --patches 30 --no-sheet --no-html --out "$work/of_program" "$work/a.off" "$work/b.off"
for count in 1 2; do
    rm -f "$work/b.seg"
    (cd "$work" && ranks "$count" example/build/two_meshes a.off b.off >out 2>err) || { cat "$work/err" >&2; fail "the example"; }
    [[ $(grep -c "mean shape diameter 0\." "$work/out") -eq 2 ]] || fail "the example prints $(cat "$work/out")"
    cmp "$work/b.seg" "$work/of_program/labels/b.seg" || fail "labels of the library and of the program, $count ranks"
done
printf 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n' >"$work/bad.off"
refuses "a bad mesh ends the example, not MPI" 3 "bad.off:6: " ranks 2 "$work/example/build/two_meshes" "$work/a.off" "$work/bad.off"
echo "ok: the library"

# The components: reading alone brings no PETSc, the module's folder is found, and what there is not is not found.
configure() { # configure COMPONENT: a project that prints what the component gives, and links it if it is a library
    mkdir -p "$work/$1"
    cat >"$work/$1/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.22)
project(consumer LANGUAGES CXX)
find_package(coseg REQUIRED COMPONENTS $1)
message(STATUS "module in '\${coseg_PYTHON_DIR}', PETSc '\${PETSC_FOUND}'")
if(TARGET "coseg::$1")
  add_executable(consumer consumer.cpp)
  target_link_libraries(consumer PRIVATE coseg::$1)
endif()
END
    cmake -S "$work/$1" -B "$work/$1/build" -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_BUILD_TYPE=Release >"$work/log" 2>&1
}
mkdir "$work/io"
cat >"$work/io/consumer.cpp" <<'END'
#include <coseg/shapes.hpp>
#include <cstdio>
int main(int, char** arguments) try {
    std::printf("%zu faces\n", coseg::load_mesh(arguments[1]).offsets.size() - 1);
} catch (const coseg::Failure& failure) {
    std::fprintf(stderr, "%s\n", failure.what());
    return failure.code();
}
END
configure io || { tail "$work/log"; fail "find_package(coseg COMPONENTS io)"; }
grep -q "PETSc ''" "$work/log" || fail "the component io looks for PETSc"
cmake --build "$work/io/build" >"$work/log" 2>&1 || { tail "$work/log"; fail "building with coseg::io"; }
"$work/io/build/consumer" "$work/a.off" | grep -q "^$(sed -n 2p "$work/a.off" | cut -d' ' -f2) faces$" || fail "coseg::io reads another mesh"
refuses "a bad mesh ends a program of coseg::io" 3 "bad.off:6: " "$work/io/build/consumer" "$work/bad.off"
if ldd "$work/io/build/consumer" | grep -q -i "petsc\|slepc"; then fail "coseg::io brings PETSc"; fi
if [[ -f $work/prefix/lib/python3/dist-packages/coseg/__init__.py ]]; then
    configure python || { tail "$work/log"; fail "find_package(coseg COMPONENTS python)"; }
    grep -q "module in '$work/prefix/lib/python3/dist-packages'" "$work/log" || fail "the module's folder"
    # Other packages are looked for in between, and say where they are in variables of the same names.
    configure "io core python" || { tail "$work/log"; fail "find_package(coseg COMPONENTS io core python)"; }
    grep -q "module in '$work/prefix/lib/python3/dist-packages'" "$work/log" || fail "the module's folder after other components"
else
    if configure python; then fail "a module that is not installed is found"; fi
fi
if configure gpu; then fail "a component that there is not is found"; fi
echo "ok: the components"

for program in dpkg-deb cpack file; do # cpack asks file(1) which of the files are programs
    command -v "$program" >/dev/null || { echo "skipped in part: no $program"; exit 0; }
done
cpack --config "$build/CPackConfig.cmake" -G DEB -B "$work/pack" >"$work/log" 2>&1 || { tail "$work/log"; fail "cpack"; }
for package in coseg libcoseg-dev; do
    [[ -f $(echo "$work/pack/${package}"_*.deb) ]] || fail "cpack makes no $package, but $(ls "$work/pack")"
done
dpkg-deb --contents "$work"/pack/libcoseg-dev_*.deb >"$work/contents"
grep -q "usr/include/coseg/shapes.hpp" "$work/contents" || fail "libcoseg-dev has no header"
if grep -q "bin/coseg" "$work/contents"; then fail "libcoseg-dev has the program"; fi
if dpkg-deb --contents "$work"/pack/coseg_*.deb | grep -E "\.a$|/include/|dist-packages"; then fail "coseg has more than the program"; fi
if compgen -G "$build/python/coseg/_core*.so" >/dev/null; then
    dpkg-deb --contents "$work"/pack/python3-coseg_*.deb >"$work/contents"
    for file in "coseg/_core.*\.so" "coseg/__init__.py" "coseg/py.typed"; do
        grep -q "usr/lib/python3/dist-packages/$file" "$work/contents" || fail "python3-coseg has no $file"
    done
    dpkg-deb --info "$work"/pack/python3-coseg_*.deb >"$work/info"  # not a pipe: grep -q would close it early
    grep -q "Depends: .*python3-numpy" "$work/info" || fail "python3-coseg needs no NumPy"
    dpkg-deb --extract "$work"/pack/python3-coseg_*.deb "$work/python"
    PYTHONPATH=$work/python/usr/lib/python3/dist-packages /usr/bin/python3 -c \
        "import coseg; assert len(coseg.generate('table', 1)[0].faces) > 4000" || fail "the packaged module"
    echo "ok: the package for Python"
fi
dpkg-deb --info "$work"/pack/coseg_*.deb >"$work/info"
grep -q "Depends: .*petsc" "$work/info" || fail "the package does not depend on PETSc: $(cat "$work/info")"
dpkg-deb --extract "$work"/pack/coseg_*.deb "$work/root"
"$work/root/usr/bin/coseg" --version | grep -q "^coseg " || fail "the packaged program"
echo "ok: the Debian package"

# dpkg installs it into a tree that shares the machine's list of packages, so that dependencies are checked and nothing
# of the machine is changed.
(($(id -u) == 0)) || { echo "skipped in part: dpkg installs for root only"; exit 0; }
tree=$work/tree
database=$tree/var/lib/dpkg
mkdir -p "$database/info" "$database/updates" "$database/triggers"
# A coseg that the machine has is no part of the tree.
awk -v RS= -v ORS='\n\n' '!/^Package: coseg\n/' /var/lib/dpkg/status >"$database/status"
find /var/lib/dpkg/info -name '*.list' ! -name 'coseg.list' -exec cp -t "$database/info" {} +
echo 1 >"$database/info/format"
in_tree() { dpkg --root="$tree" --log="$work/dpkg.log" --force-script-chrootless "$@" >"$work/log" 2>&1; }
in_tree --install "$work"/pack/coseg_*.deb || { cat "$work/log" >&2; fail "dpkg --install"; }
installed=$tree/usr/bin/coseg
"$installed" --version | grep -q "^coseg " || fail "the installed package's program"
# A machine without manual pages has no man; the page's own text is then looked at.
if command -v man >/dev/null; then
    MANPAGER="cat" man --local-file "$tree/usr/share/man/man1/coseg.1" >"$work/page" 2>/dev/null || fail "the manual page"
else
    cp "$tree/usr/share/man/man1/coseg.1" "$work/page"
fi
grep -q "over-segment\|oversegmentations" "$work/page" || fail "the manual page lists no options"
"$installed" generate table --count 3 --faces 2000 --out "$work/tables" >"$work/log"
"$installed" run --quiet --parts 2 --patches 20 --oversegmentations 1 --geodesic-samples 40 --no-choose \
    --out "$work/tables_result" "$work/tables/meshes" || fail "a run of the installed package"
[[ $(wc -l <"$work/tables_result/labels/table_0002.seg") -eq $(wc -l <"$work/tables/truth/table_0002.seg") ]] ||
    fail "the labels of the installed package"
in_tree --remove coseg || { cat "$work/log" >&2; fail "dpkg --remove"; }
left=$(find "$tree" -path "$database" -prune -o ! -type d -print)
[[ -z $left && ! -e $tree/usr ]] || fail "dpkg --remove leaves $left in $(ls "$tree")"
echo "ok: installed by dpkg, run and removed"
