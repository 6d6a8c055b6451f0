#!/usr/bin/env bash
# coseg score against an independent scorer, on real shapes whose truth has been perturbed.
set -euo pipefail
data=${COSEG_DATA:-$COSEG_SOURCE/../shared/data}
scorer=${COSEG_SCORER:-$data/../tools/score.py}
if [[ ! -d $data || ! -f $scorer ]]; then
    echo "skipped: no data in $data or no scorer at $scorer (set COSEG_DATA and COSEG_SCORER)"
    exit 77
fi
data=$(realpath "$data")
scorer=$(realpath "$scorer")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# perturb TRUTH LABELS KIND : other numbers for the parts, and more or fewer of them, or faces at random
perturb() {
    python3 - "$@" <<'END'
import os, random, sys
truth, labels, kind = sys.argv[1:4]
os.makedirs(labels)
chosen = random.Random(1)
for number, name in enumerate(sorted(f for f in os.listdir(truth) if f.endswith(".seg"))):
    with open(os.path.join(truth, name)) as file:
        parts = [int(t) for t in file.read().split()]
    if kind == "missing" and number % 5 == 0:
        continue
    if kind == "split":      # more clusters than labels: the upper half of each part's faces is another one
        parts = [10 * p + (i > len(parts) // 2) for i, p in enumerate(parts)]
    elif kind == "merged":   # fewer clusters than labels
        parts = [min(p, 1) for p in parts]
    elif kind == "swapped":  # numbers differ from shape to shape in a third of them
        parts = [9 - p if number % 3 else p for p in parts]
    else:
        parts = [chosen.randrange(-3, 4) if chosen.random() < 0.3 else p for p in parts]
    with open(os.path.join(labels, name), "w") as file:
        file.writelines(f"{p}\n" for p in parts)
END
}

compare() { # OURS THEIRS WHAT
    python3 - "$@" <<'END'
import json, sys
with open(sys.argv[1]) as a, open(sys.argv[2]) as b:
    ours, theirs = json.load(a), json.load(b)
for key in ("one_to_one", "many_to_one"):
    assert abs(ours[key] - theirs[key]) < 0.01, (sys.argv[3], key, ours[key], theirs[key])
for key in ("clusters", "labels", "shapes", "missing"):
    assert ours[key] == theirs[key], (sys.argv[3], key, ours[key], theirs[key])
for name, accuracy in theirs["per_shape"].items():
    assert abs(ours["per_shape"][name] - accuracy) < 0.06, (sys.argv[3], name, ours["per_shape"][name], accuracy)
print(f"{sys.argv[3]}: {ours['one_to_one']:.2f} and {theirs['one_to_one']:.2f}, "
      f"{ours['many_to_one']:.2f} and {theirs['many_to_one']:.2f}")
END
}

compared=0
for set_name in psb_plier humans_adobe; do
    [[ -d $data/$set_name ]] || continue
    set=$work/$set_name
    mkdir "$set"
    # Six shapes of a set are enough: the other scorer takes its time.
    for mesh in $(find "$data/$set_name" -maxdepth 1 -name '*.off' | sort | head -n 6); do
        ln -s "$mesh" "${mesh%.off}.seg" "$set"
    done
    for kind in random missing split merged swapped; do
        perturb "$set" "$work/$set_name.$kind" "$kind"
        "$COSEG" score --truth "$set" --labels "$work/$set_name.$kind" --json "$set" >"$work/ours.json"
        python3 "$scorer" "$set" "$set" "$work/$set_name.$kind" --json >"$work/theirs.json"
        compare "$work/ours.json" "$work/theirs.json" "$set_name, $kind"
        compared=$((compared + 1))
    done
done
((compared > 0)) || {
    echo "skipped: neither psb_plier nor humans_adobe in $data"
    exit 77
}
