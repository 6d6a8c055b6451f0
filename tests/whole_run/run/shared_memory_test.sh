#!/usr/bin/env bash
# Features are held once a node: the same bytes whichever ranks are taken for a node, and where shared memory is too small.
set -euo pipefail
# shellcheck source=tests/whole_run/fixture.sh
source "$(dirname "${BASH_SOURCE[0]}")/../fixture.sh"

mkdir "$work/set"
for waist in 0.40 0.45 0.50 0.55 0.60 0.65; do peanut "$work/set/p$waist.off" $waist; done
common=(--patches 8 --geodesic-samples 40 --oversegmentations 3 --bins 20 --parts 2 --no-sheet --no-html)
objective() { grep '"objective"' "$1/report.json"; }
same() {
    diff -r "$work/alone/labels" "$work/$1/labels" || fail "$2: other labels"
    diff <(objective "$work/alone") <(objective "$work/$1") || fail "$2: another objective"
    if [[ -s $work/$1.log ]]; then
        cat "$work/$1.log"
        fail "$2: says something"
    fi
    echo "ok: $2"
}
"$COSEG" run --quiet "${common[@]}" --keep-features --out "$work/alone" "$work/set" 2>"$work/alone.log"

for most in 1 2 3; do
    COSEG_RANKS_PER_NODE=$most ranks 4 "$COSEG" run --quiet "${common[@]}" --keep-features --out "$work/nodes$most" \
        "$work/set" 2>"$work/nodes$most.log"
    same "nodes$most" "4 ranks as nodes of $most"
    COSEG_RANKS_PER_NODE=$most ranks 4 "$COSEG" cluster --parts 2 --unit-columns --out "$work/k$most.txt" \
        --coefficients "$work/w$most.h5" "$work/nodes$most/features.h5" >"$work/k$most.json"
done
COSEG_RANKS_PER_NODE=2 ranks 4 "$COSEG" run --quiet "${common[@]}" --scope rows --subsets 4 --out "$work/subsets" "$work/set"
"$COSEG" run --quiet "${common[@]}" --scope rows --subsets 4 --out "$work/alone_subsets" "$work/set"
diff -r "$work/alone_subsets/labels" "$work/subsets/labels" || fail "subsets on two nodes: other labels"
"$COSEG" cluster --parts 2 --unit-columns --out "$work/k.txt" --coefficients "$work/w.h5" "$work/alone/features.h5" \
    >"$work/k.json"
for most in 1 2 3; do
    for file in k.txt w.h5 k.json; do
        cmp "$work/$file" "$work/${file/./$most.}" || fail "cluster on nodes of $most: another $file"
    done
done
echo "ok: cluster and subsets on several nodes"

# As in a container whose /dev/shm is small, though not too small for the messages between ranks.
if ! unshare --mount true 2>/dev/null; then
    echo "skipped: no right to mount a small /dev/shm"
    exit 77
fi
small() {
    unshare --mount bash -c 'mount -t tmpfs -o size=20m none /dev/shm && head -c 14m /dev/zero >/dev/shm/taken && "$@"' - "$@"
}
export -f ranks
export OMPI_MCA_btl_vader_segment_size=1m
small bash -c 'ranks 2 "$@"' - "$COSEG" run "${common[@]}" --out "$work/small" "$work/set" >"$work/small.txt" 2>&1 ||
    { cat "$work/small.txt"; fail "little shared memory"; }
grep -q "shared memory (/dev/shm) has no room for the features" "$work/small.txt" || { cat "$work/small.txt"; fail "no note"; }
same small "little shared memory"
