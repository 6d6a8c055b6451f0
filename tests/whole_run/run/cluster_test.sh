#!/usr/bin/env bash
# coseg cluster: kept features of a run cluster like the run, alike on any number of ranks; what cannot be clustered is refused.
set -euo pipefail
# shellcheck source=tests/whole_run/fixture.sh
source "$(dirname "${BASH_SOURCE[0]}")/../fixture.sh"

mkdir "$work/set"
for waist in 0.4 0.5 0.6 0.7; do peanut "$work/set/p$waist.off" $waist; done
run=("$COSEG" run --quiet --no-sheet --no-html --patches 10 --geodesic-samples 40 --bins 20 --parts 2 --oversegmentations 1 --no-choose --adjacency 2)
"${run[@]}" --keep-features --out "$work/kept" "$work/set"
"${run[@]}" --out "$work/plain" "$work/set"
diff -r "$work/kept/labels" "$work/plain/labels" || fail "keeping features changes labels"
[[ -f $work/kept/features.h5 && ! -e $work/plain/features.h5 ]] || fail "features.h5"

cluster=("$COSEG" cluster --parts 2 --lambda 100 --affinity links --adjacency 2)
for count in 1 2 3; do
    ranks $count "${cluster[@]}" --out "$work/k$count.txt" --coefficients "$work/w$count.h5" "$work/kept/features.h5" \
        >"$work/k$count.json" || fail "cluster on $count ranks"
    cmp "$work/k1.txt" "$work/k$count.txt" || fail "other clusters on $count ranks"
    cmp "$work/w1.h5" "$work/w$count.h5" || fail "other coefficients on $count ranks"
    cmp "$work/k1.json" "$work/k$count.json" || fail "another certificate on $count ranks"
done
# Items of one mesh may be linked here, and concave borders between them weaken the links.
for count in 1 2 3; do
    ranks $count "$COSEG" cluster --parts 2 --scope rows --adjacency 2 --out "$work/r$count.txt" "$work/kept/features.h5" \
        >"$work/r$count.json" || fail "cluster --scope rows on $count ranks"
    cmp "$work/r1.txt" "$work/r$count.txt" || fail "other clusters with --scope rows on $count ranks"
    cmp "$work/r1.json" "$work/r$count.json" || fail "another certificate with --scope rows on $count ranks"
done
python3 - "$work/k1.json" "$work/kept/report.json" "$work" <<'END' || fail "cluster and run disagree"
import glob, json, sys
answer, report, work = json.load(open(sys.argv[1])), json.load(open(sys.argv[2])), sys.argv[3]
assert answer["reason"] == "gap_reached" and answer["scope"] == "meshes", answer
for key in ("objective", "lower_bound"):  # the file has its features in another order: other roundings
    assert abs(answer[key] - report["optimisation"][key]) <= 1e-9 * answer[key], key
parts = [int(line) for line in open(work + "/k1.txt")]
assert len(parts) == answer["n"] == sum(answer["items_of_part"]) == 40
# Patch 10 m + p of the file is patch p of mesh m: most of its faces carry its part; boundaries may have moved.
agree = total = 0
for m, path in enumerate(sorted(glob.glob(work + "/kept/labels/*.seg"))):
    labels = [int(line) for line in open(path)]
    patches = [int(line) for line in open(path.replace("labels", "patches"))]
    agree += sum(label == parts[10 * m + patch] for label, patch in zip(labels, patches))
    total += len(labels)
assert agree > 0.8 * total, (agree, total)
END

refuses "optimum W = 0" 3 "the optimum is W = 0 (certified)" "${cluster[@]}" --beta 1e6 --out "$work/x.txt" "$work/kept/features.h5"
refuses "run whose optimum is W = 0" 3 "the optimum is W = 0 (certified)" "${run[@]}" --beta 1e6 --out "$work/x" "$work/set"
[[ ! -e $work/x.txt && ! -e $work/x ]] || fail "results of an empty solution"
refuses "gap not reached" 5 "was not reached" "$COSEG" cluster --parts 2 --scope rows --lambda 0 --gap 1e-13 --max-iterations 3 \
    --out "$work/last.txt" --coefficients "$work/last.h5" "$work/kept/features.h5"
[[ -s $work/last.txt && -s $work/last.h5 ]] || fail "the last state is not kept"
refuses "more clusters than items" 2 "41 parts" "$COSEG" cluster --parts 41 --out "$work/x.txt" "$work/kept/features.h5"
refuses "no such file" 3 "none.h5" "${cluster[@]}" --out "$work/x.txt" "$work/none.h5"
refuses "no HDF5" 3 "p0.4.off" "${cluster[@]}" --out "$work/x.txt" "$work/set/p0.4.off"
refuses "no features in it" 3 "no group 'features'" "${cluster[@]}" --out "$work/x.txt" "$work/w1.h5"
refuses "unwritable result" 4 "x.txt" "${cluster[@]}" --out "$work/none/x.txt" "$work/kept/features.h5"
echo "ok: cluster"
