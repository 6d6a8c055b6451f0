#!/usr/bin/env bash
# The installed tree serves as a library (examples/two_meshes builds from it and runs) and as a Debian package.
set -euo pipefail
# shellcheck source=tests/whole_run/fixture.sh
source "$(dirname "${BASH_SOURCE[0]}")/fixture.sh"

build=$(cd "$(dirname "$COSEG")/.." && pwd)
for library in src/libcoseg_src.a io/libcoseg_io.a solvers/libcoseg_solvers.a mpi_drivers/libcoseg_drivers.a; do
    [[ -f $build/$library ]] || fail "$library is not built"
done
cmake --install "$build" --prefix "$work/prefix" >"$work/log" 2>&1 || { tail "$work/log"; fail "cmake --install"; }
[[ -s $work/prefix/share/man/man1/coseg.1 && -s $work/prefix/share/bash-completion/completions/coseg ]] || fail "help files"
"$work/prefix/bin/coseg" --version | grep -q "^coseg " || fail "the installed program"
cp -r "$COSEG_SOURCE/examples/two_meshes" "$work/example"
cmake -S "$work/example" -B "$work/example/build" -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_BUILD_TYPE=Release >"$work/log" 2>&1 ||
    { tail "$work/log"; fail "find_package(coseg)"; }
cmake --build "$work/example/build" >"$work/log" 2>&1 || { tail "$work/log"; fail "building the example"; }
peanut "$work/a.off" 0.5
peanut "$work/b.off" 0.6
(cd "$work" && example/build/two_meshes a.off b.off >out 2>err) || { cat "$work/err" >&2; fail "the example"; }
[[ $(grep -c "mean shape diameter 0\." "$work/out") -eq 2 ]] || fail "the example prints $(cat "$work/out")"
[[ $(wc -l <"$work/two_meshes_result/labels/b.seg") -eq 1104 ]] || fail "the example's labels"
echo "ok: the library"

for program in dpkg-deb cpack file; do # cpack asks file(1) which of the files are programs
    command -v "$program" >/dev/null || { echo "skipped in part: no $program"; exit 0; }
done
cpack --config "$build/CPackConfig.cmake" -G DEB -B "$work/pack" >"$work/log" 2>&1 || { tail "$work/log"; fail "cpack"; }
dpkg-deb --info "$work"/pack/coseg_*.deb >"$work/info"
grep -q "Depends: .*petsc" "$work/info" || fail "the package does not depend on PETSc: $(cat "$work/info")"
dpkg-deb --extract "$work"/pack/coseg_*.deb "$work/root"
"$work/root/usr/bin/coseg" --version | grep -q "^coseg " || fail "the packaged program"
echo "ok: the Debian package"
