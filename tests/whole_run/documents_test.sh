#!/usr/bin/env bash
# Every command of the tutorial and of the troubleshooting page runs as printed, and leaves what the text says.
set -euo pipefail
# shellcheck source=tests/whole_run/fixture.sh
source "$(dirname "${BASH_SOURCE[0]}")/fixture.sh"

docs=$COSEG_SOURCE/docs
cd "$work"
PATH=$(dirname "$COSEG"):$PATH
for page in tutorial troubleshooting; do
    awk '/^```/ { inside = ($0 == "```sh") ; next } inside' "$docs/$page.md" >"$page.sh"
    [[ $(wc -l <"$page.sh") -ge 3 ]] || fail "$page has no commands"
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
coseg run --quiet --force --no-html --no-sheet --keep-features --parts 3 --out result goblets/meshes
awk '/^```/ { inside = ($0 == "```python") ; next } inside' "$docs/tutorial.md" >three_lines.py
printf 'assert set(part) <= {0, 1, 2} and len(features) == 5, features\n' >>three_lines.py
"$python" three_lines.py || fail "the three lines of Python"
"$python" "$COSEG_SOURCE/examples/python/read_results.py" result >python.out || fail "the example in Python"
grep -q "goblet_0007 part 0: " python.out || fail "the example in Python prints no parts"
echo "ok: Python"
