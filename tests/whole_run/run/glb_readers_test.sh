#!/usr/bin/env bash
# Twenty GLB files of many forms, with textures, become twenty GLB files with named parts, which an independent reader (assimp)
# reads with the same triangles and texture coordinates, bit for bit. The bytes are compared in any case.
set -euo pipefail
# shellcheck source=tests/whole_run/fixture.sh
source "$(dirname "${BASH_SOURCE[0]}")/../fixture.sh"
glb=$COSEG_SOURCE/tests/support/glb_collection.py

ranks 2 "$COSEG" generate pliers --count 20 --seed 2 --faces 2000 --out "$work/set" >"$work/out"
python3 "$glb" make "$work/set/meshes" "$work/meshes" || fail "the collection"
"$COSEG" run --quiet --patches 10 --oversegmentations 1 --geodesic-samples 20 --no-choose --no-sheet --no-html --no-keep-model \
    --parts 3 --out "$work/result" "$work/meshes"
names=("left arm" "rechter Griff (größer)" jaw)
printf '%s\n' "${names[@]}" >"$work/result/names.txt"
"$COSEG" export "$work/result" --to glb >"$work/out"
python3 "$glb" check own "$work/meshes" "$work/result" "${names[@]}" >"$work/told" || fail "the bytes of the exported files"
echo "ok: by their bytes, $(cat "$work/told")"

if ! command -v assimp >/dev/null; then
    echo "skipped in part: no independent reader of GLB files (Debian: assimp-utils)"
    exit 0
fi
python3 "$glb" check assimp "$work/meshes" "$work/result" "${names[@]}" >"$work/told" || fail "what assimp reads"
echo "ok: by assimp, $(cat "$work/told")"
