#!/usr/bin/env bash
# coseg check: one line a mesh, the same on any number of ranks, the sentences of a run, and an exit code.
set -euo pipefail
# shellcheck source=tests/whole_run/fixture.sh
source "$(dirname "${BASH_SOURCE[0]}")/../fixture.sh"

mkdir "$work/set"
peanut "$work/set/a.off" 0.5
{ peanut "$work/all" 0.6 && cat "$work/all" && echo '<!DOCTYPE FilterScript>'; } >"$work/set/b.off"
awk 'NR == 1 { print; next } NR == 2 { print 2 * $1, 2 * $2, 0; next } NF == 3 { v[n++] = $0; next } { f[m++] = $0 }
    END { for (i = 0; i < n; ++i) print v[i]
          for (i = 0; i < n; ++i) { split(v[i], p); print p[1] + 9, p[2], p[3] }
          for (i = 0; i < m; ++i) print f[i]
          for (i = 0; i < m; ++i) { split(f[i], q); print 3, q[2] + n, q[3] + n, q[4] + n } }' "$work/all" >"$work/set/c.off"
printf 'version https://git-lfs.github.com/spec/v1\n' >"$work/set/d.obj"
ln -s nowhere "$work/set/e.ply"
peanut "$work/set/"$'caf\xe9.off' 0.7

code=0
"$COSEG" check "$work/set" --json "$work/check.json" >"$work/one" 2>"$work/err" || code=$?
[[ $code -eq 3 ]] || fail "exit code $code, not 3: $(cat "$work/err")"
[[ $(cat "$work/err") == "coseg: 2 of 6 meshes would be set aside; "* ]] || fail "the sentence at the end: $(cat "$work/err")"
cat >"$work/expected" <<END
$work/set/a.off: 554 vertices, 1104 faces, 1 piece
$work/set/b.off: 554 vertices, 1104 faces, 1 piece; line 1661: the file goes on after the 1104 faces that its header promises; what follows, from '<!DOCTYPE' on, is left out
$work/set/c.off: 1108 vertices, 2208 faces, 2 pieces
$work/set/caf@.off: 554 vertices, 1104 faces, 1 piece
$work/set/d.obj: set aside: the file is a Git LFS pointer, not the mesh itself; fetch the mesh with 'git lfs pull'
$work/set/e.ply: set aside: is a link to nowhere, which is not there
6 meshes: 3 as they are, 1 with something to repair or to know, 2 set aside
END
LC_ALL=C sed 's/caf\xe9/caf@/' "$work/one" | diff - "$work/expected" || fail "what check prints"
for count in 2 4; do
    ranks "$count" "$COSEG" check "$work/set" --json "$work/check_$count.json" >"$work/more" 2>"$work/err" || true
    cmp "$work/one" "$work/more" || fail "another text on $count ranks"
    cmp "$work/check.json" "$work/check_$count.json" || fail "another JSON on $count ranks"
done
echo "ok: the same lines on 1, 2 and 4 ranks"

refuses "findings over a mesh" 2 "has the name of a mesh" "$COSEG" check --json "$work/set/a.off" "$work/set/b.off"
echo "$work/set/a.off" >"$work/list"
refuses "findings over the list" 2 "is an input, which would be overwritten" "$COSEG" check "@$work/list" --json "$work/./list"
[[ $(cat "$work/list") == "$work/set/a.off" && $(head -n 1 "$work/set/a.off") == OFF ]] || fail "an input is overwritten"

# What check says is what a run says.
"$COSEG" run --quiet --parts 2 --patches 10 --geodesic-samples 40 --no-html --out "$work/run" "$work/set" 2>"$work/err"
python3 - "$work/check.json" "$work/run/report.json" <<'END' || fail "check and run differ"
import json, sys
check, run = (json.load(open(path, encoding="utf-8")) for path in sys.argv[1:])
assert check["totals"] == {"meshes": 6, "warned": 1, "set_aside": 2}, check["totals"]
usable = [mesh for mesh in check["meshes"] if not mesh["set_aside"]]
for key in ("path", "faces", "warnings"):
    assert [m[key] for m in usable] == [m[key] for m in run["meshes"]], key
assert [m.get("name_bytes") for m in usable] == [None, None, None, b"caf\xe9".hex()]
aside = {m["path"]: m["set_aside"] for m in check["meshes"] if m["set_aside"]}
assert aside == {m["path"]: m["reason"] for m in run["set_aside"]}, aside
END
echo "ok: check says what a run says"

rm "$work/set/d.obj" "$work/set/e.ply"
"$COSEG" check "$work/set" >"$work/out" || fail "meshes that can be used give another exit code than 0"
refuses "nothing to check" 3 "no such file" "$COSEG" check "$work/nowhere"
refuses "a JSON file that cannot be written" 4 "check.json" "$COSEG" check "$work/set" --json "$work/nowhere/check.json"

# One surface, whatever the file makes of it: every face twice, the copies with vertices of their own; and a seam.
mkdir "$work/once" "$work/odd"
for waist in 5 6 7; do peanut "$work/once/p$waist.off" "0.$waist"; done
python3 - "$work/once" "$work/odd" <<'END'
import pathlib, shutil, sys
once, odd = map(pathlib.Path, sys.argv[1:])
def parts(name):
    rows = [line.split() for line in (once / name).read_text().splitlines()[2:]]
    return [r for r in rows if len(r) == 3], [[int(k) for k in r[1:]] for r in rows if len(r) == 4]
def write(name, points, faces):
    lines = ["OFF", f"{len(points)} {len(faces)} 0", *map(" ".join, points), *(" ".join(map(str, (3, *f))) for f in faces)]
    (odd / name).write_text("\n".join(lines) + "\n")
points, faces = parts("p5.off")
write("p5.off", points * 2, faces + [[k + len(points) for k in reversed(f)] for f in faces])
points, faces = parts("p6.off")
copy = {}
for face in faces:
    if all(float(points[k][2]) > -1e-9 for k in face):
        for i, k in enumerate(face):
            if abs(float(points[k][2])) < 1e-9:
                if k not in copy:
                    copy[k] = len(points)
                    points.append([*points[k][:2], "1e-3"])
                face[i] = copy[k]
write("p6.off", points, faces)
shutil.copy(once / "p7.off", odd)
END
"$COSEG" check "$work/odd" >"$work/out"
grep -q "p5.off: 1108 vertices, 2208 faces, 1 piece; .*1104 faces lie upon others and share their parts$" "$work/out" || fail "doubles: $(cat "$work/out")"
grep -q "p6.off: 578 vertices, 1104 faces, 2 pieces; 2 pieces have borders that nearly touch, 2.*e-04 of the size apart; .* --weld 3e-04$" "$work/out" ||
    fail "a seam: $(cat "$work/out")"
"$COSEG" check --weld 3e-04 "$work/odd" >"$work/welded"
grep -q "p6.off: .* 1 piece; .*24 vertices on borders that nearly touch are welded$" "$work/welded" || fail "--weld"
for set in once odd; do
    "$COSEG" run --quiet --parts 2 --patches 10 --geodesic-samples 40 --no-html --no-sheet --weld 3e-04 --out "$work/run_$set" "$work/$set" 2>"$work/err"
done
for name in p6 p7; do cmp "$work"/run_{once,odd}/labels/$name.seg || fail "$name: a seam changes labels"; done
cat "$work"/run_once/labels/p5.seg{,} | cmp - "$work/run_odd/labels/p5.seg" || fail "doubled faces have other labels than the faces once"
refuses "a tolerance that is none" 2 "is none of auto, exact" "$COSEG" check --weld 1 "$work/odd"
