#!/usr/bin/env bash
# Every command of the README, the tutorial and the troubleshooting page runs as printed, and leaves what the text says.
# The README's ./jobs/quickstart.sh and ./tests/run.sh, which install and build, are left out: they are not marked as sh.
set -euo pipefail
# shellcheck source=tests/whole_run/fixture.sh
source "$(dirname "${BASH_SOURCE[0]}")/../fixture.sh"

docs=$COSEG_SOURCE/docs
# commands_of PAGE LEAST : the lines of the page's blocks of sh, LEAST of them or more.
commands_of() {
    awk '/^```/ { inside = ($0 == "```sh") ; next } inside' "$1"
    [[ $(grep -c '^```sh$' "$1") -ge $2 ]] || fail "$1 has too few commands"
}

# Where the README's reader stands: the program in build/bin, a folder of chairs.
mkdir -p "$work/readme/build/bin" && cd "$work/readme"
ln -s "$COSEG" build/bin/coseg
"$COSEG" generate chair --count 4 --faces 2000 --out generated >/dev/null
ln -s generated/meshes my_chairs
commands_of "$COSEG_SOURCE/README.md" 2 >readme.sh
# It asks for more ranks than small machines have cores.
OMPI_MCA_rmaps_base_oversubscribe=1 bash -euo pipefail readme.sh >out 2>err || { tail -n 20 err >&2; fail "a command of README.md"; }
grep -o "^| \`result/[^\`]*\`" "$COSEG_SOURCE/README.md" | tr -d '|` ' | sed 's/NAME/chair_0003/' >files
[[ $(wc -l <files) -ge 7 ]] || fail "README.md lists no results"
while read -r file; do [[ -s $file ]] || fail "README.md lists $file, which a run does not leave"; done <files
cmp result/labels/chair_0003.seg long_result/labels/chair_0003.seg || fail "4 ranks and --state give other labels"
grep -o "^| \`coseg [a-z]*\`" "$COSEG_SOURCE/README.md" | tr -d '|`' >named
[[ $(wc -l <named) -ge 10 ]] || fail "README.md lists no commands"
while read -r _ command; do "$COSEG" "$command" --help >/dev/null || fail "README.md lists coseg $command"; done <named
echo "ok: README"

cd "$work"
PATH=$(dirname "$COSEG"):$PATH
for page in tutorial troubleshooting; do
    commands_of "$docs/$page.md" 1 >"$page.sh"
    # Fewer rays and samples than the defaults would be quicker, but the commands are run as they stand.
    bash -euo pipefail "$page.sh" >"$page.out" 2>"$page.err" || { tail -n 20 "$page.err" >&2; fail "a command of $page.md"; }
    echo "ok: $page"
done
for file in result/contact_sheet.png result/contact_sheet_errors.png result/contact_sheet_shape_diameter.png \
    result/vtk/collection.vtm result/obj/parts.mtl mine_result/labels/second.seg again/report.json coseg.1; do
    [[ -s $file ]] || fail "the tutorial leaves no $file"
done

python=/usr/bin/python3
"$python" -c "import numpy, h5py" 2>/dev/null || { echo "skipped in part: no numpy and h5py"; exit 0; }
coseg run --quiet --force --no-html --no-sheet --keep-features --geodesic-samples 100 --oversegmentations 1 --no-choose --parts 3 --out result goblets/meshes
awk '/^```/ { inside = ($0 == "```python") ; next } inside' "$docs/tutorial.md" >three_lines.py
printf 'assert set(part) <= {0, 1, 2} and len(features) == 5, features\n' >>three_lines.py
"$python" three_lines.py || fail "the three lines of Python"
"$python" "$COSEG_SOURCE/examples/python/read_results.py" result >python.out || fail "the example in Python"
grep -q "goblet_0007 part 0: " python.out || fail "the example in Python prints no parts"
echo "ok: Python"
