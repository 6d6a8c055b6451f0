#!/usr/bin/env bash
# The installed tree serves as a library (examples/two_meshes builds from it and runs) and as a Debian package.
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
