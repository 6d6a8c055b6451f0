#!/usr/bin/env bash
# VTK's own readers find in the exported files what the run wrote: shapes, parts, patches, descriptors, the grid, colours.
set -euo pipefail
# shellcheck source=tests/whole_run/fixture.sh
source "$(dirname "${BASH_SOURCE[0]}")/../fixture.sh"

"$COSEG" generate pliers --count 4 --seed 2 --faces 2000 --out "$work/set" >"$work/out"
"$COSEG" run --quiet --patches 20 --oversegmentations 1 --geodesic-samples 40 --no-choose --parts 3 \
    --out "$work/result" "$work/set/meshes"
ranks 2 "$COSEG" export "$work/result" --to vtk,obj --truth "$work/set/truth" >"$work/out"
grep -q collection.vtm "$work/out" || fail "export does not say where the collection is"
[[ $(head -n 2 "$work/result/obj/pliers_0000.obj" | tail -n 1) == "mtllib parts.mtl" ]] || fail "OBJ without materials"
[[ $(grep -c '^f ' "$work/result/obj/pliers_0000.obj") -eq $(wc -l <"$work/result/labels/pliers_0000.seg") ]] || fail "faces of the OBJ"
[[ $(grep -c newmtl "$work/result/obj/parts.mtl") -eq 3 ]] || fail "materials"
printf 'left jaw\nright jaw\npin\n' >"$work/names"
"$COSEG" export "$work/result" --to obj --names "$work/names" --out "$work/called" >/dev/null
printf '1 body\n9 handle\n' >"$work/from_one"
refuses "names of other parts" 3 "label 9 has a name, but there are" "$COSEG" export "$work/result" --to obj --names "$work/from_one" --out "$work/other"
grep -q '^g left_jaw$' "$work/called/obj/pliers_0000.obj" || fail "OBJ without names of parts"
# What an earlier export has split is not left among the new parts.
"$COSEG" export "$work/result" --to obj --split --names "$work/names" --out "$work/called" >/dev/null
touch "$work/called/obj/pliers_0000/party.obj"
"$COSEG" export "$work/result" --to obj --split --out "$work/called" >/dev/null
[[ $(ls "$work/called/obj/pliers_0000") == $'part_0.obj\npart_1.obj\npart_2.obj\nparts.mtl\nparty.obj' ]] ||
    fail "parts of an earlier export: $(ls "$work/called/obj/pliers_0000")"
# Names that are longer than a file's may be are cut, between characters.
printf '%s\n%s\n' "$(printf 'ä%.0s' {1..150})" "$(printf 'x%.0s' {1..300})" >"$work/long_names"
for format in obj glb; do
    "$COSEG" export "$work/result" --to $format --split --names "$work/long_names" --out "$work/long" >/dev/null || fail "long names in $format"
done
[[ $(find "$work/long/obj/pliers_0000" -name 'part_[01]_*.obj' | wc -l) -eq 2 ]] || fail "files of parts with long names"
find "$work/long" | iconv -f UTF-8 -t UTF-8 >/dev/null || fail "a torn character in the name of a file"
mkdir -p "$work/in/off"
cp "$work"/set/meshes/pliers_000[0-3].off "$work/in/off"
refuses "an export over the meshes" 4 "is a mesh of the run, which would be overwritten" \
    "$COSEG" export "$work/result" --meshes "$work/in/off" --to off --out "$work/in"
refuses "an export below a file" 4 "is a file); name another folder" "$COSEG" export "$work/result" --to off --out "$work/names/x"
"$COSEG" export "$work/result" --to ply --out "$work/again" >"$work/out"
cmp "$work/result/ply/pliers_0001.ply" "$work/again/ply/pliers_0001.ply" || fail "the exported PLY is not the run's"
cp -r "$work/result" "$work/edited"
sed -i '7s/.*/1/;8s/.*/2/' "$work/edited/labels/pliers_0001.seg" "$work/edited/labels/pliers_0002.seg"
ranks 2 "$COSEG" export "$work/edited" --to off >"$work/out" 2>"$work/err" || fail "labels that were edited"
grep -q "warning: $work/edited/labels/pliers_000[12].seg: is not as the run wrote it, but damaged or edited" "$work/err" ||
    fail "no warning of labels that were edited: $(cat "$work/err")"
sed -i '7s/.*/3/' "$work/edited/labels/pliers_0001.seg"
refuses "a part that the run does not have" 3 "face 6 has 3, which the run did not have" "$COSEG" export "$work/edited" --to borders
sed -i '7s/.*/-1/' "$work/edited/labels/pliers_0001.seg"
refuses "a negative part" 3 "face 6 has -1" "$COSEG" render "$work/edited" --what errors --truth "$work/set/truth"
cp "$work/result/labels/pliers_0001.seg" "$work/result/labels/pliers_0002.seg" "$work/edited/labels/"
sed -i '0,/"seed": 1/s//"seed": 3/' "$work/edited/report.json"
ranks 2 "$COSEG" export "$work/edited" --to off >"$work/out" 2>"$work/err" || fail "a report that was edited"
[[ $(cat "$work/err") == "coseg: warning: $work/edited/report.json: is not as the run wrote it, but damaged or edited" ]] ||
    fail "no warning of a report that was edited: $(cat "$work/err")"
rm -r "$work/edited"
refuses "an unknown format" 2 "dxf" "$COSEG" export "$work/result" --to dxf

python=/usr/bin/python3
if ! "$python" -c "import vtkmodules" 2>/dev/null; then
    echo "skipped: python3-vtk9 is not installed"
    exit 77
fi
"$python" - "$work" <<'END' || fail "what VTK reads"
import sys
from vtkmodules.vtkIOXML import vtkXMLMultiBlockDataReader, vtkXMLPolyDataReader
from vtkmodules.vtkIOGeometry import vtkOBJReader
from vtkmodules.vtkIOPLY import vtkPLYReader
work = sys.argv[1]
names = [f"pliers_{k:04d}" for k in range(4)]
features = ["gaussian_curvature", "shape_diameter", "average_geodesic", "shape_context", "conformal_factor"]

def read(reader, path):
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()

def array(data, name):
    values = data.GetCellData().GetArray(name)
    assert values is not None, name
    return [values.GetTuple1(i) for i in range(values.GetNumberOfTuples())]

for name in names:
    data = read(vtkXMLPolyDataReader(), f"{work}/result/vtk/{name}.vtp")
    labels = [int(line) for line in open(f"{work}/result/labels/{name}.seg")]
    with open(f"{work}/set/meshes/{name}.off") as file:
        vertices, faces = map(int, file.read().split()[1:3])
    assert (data.GetNumberOfPoints(), data.GetNumberOfPolys()) == (vertices, faces)
    assert array(data, "part") == labels
    assert array(data, "patch") == [int(line) for line in open(f"{work}/result/patches/{name}.seg")]
    assert array(data, "truth") == [int(line) for line in open(f"{work}/set/truth/{name}.seg")]
    for feature in features:
        values = array(data, feature)
        assert len(values) == faces and max(values) > min(values) and all(v == v for v in values), feature
    thickness = array(data, "shape_diameter")
    assert 0 <= min(thickness) and max(thickness) <= 1.5
    assert data.GetCellData().GetScalars().GetName() == "part"
    with open(f"{work}/set/meshes/{name}.off") as file:
        first = list(map(float, file.read().split()[4:7]))
    assert all(abs(a - b) < 1e-5 for a, b in zip(first, data.GetPoint(0)))
    obj = read(vtkOBJReader(), f"{work}/result/obj/{name}.obj")
    assert (obj.GetNumberOfPoints(), obj.GetNumberOfPolys()) == (vertices, faces)
    assert read(vtkPLYReader(), f"{work}/result/ply/{name}.ply").GetNumberOfPolys() == faces

blocks = read(vtkXMLMultiBlockDataReader(), f"{work}/result/vtk/collection.vtm")
assert blocks.GetNumberOfBlocks() == 4
boxes = [blocks.GetBlock(k).GetBounds() for k in range(4)]
for a in range(4):
    for b in range(a):
        apart = any(boxes[a][2 * k] > boxes[b][2 * k + 1] or boxes[b][2 * k] > boxes[a][2 * k + 1] for k in range(3))
        assert apart, f"shapes {a} and {b} overlap in the grid"
assert array(blocks.GetBlock(2), "part") == [int(line) for line in open(f"{work}/result/labels/{names[2]}.seg")]
END
echo "ok: VTK reads what was exported"
