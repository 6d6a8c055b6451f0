#!/usr/bin/env bash
# Runs that are killed at random moments and continue on other numbers of ranks end with the bytes of a run left alone: a few
# rounds of bench/kills.py, other moments every time. Single bits that are flipped in what runs keep are found or do no harm: a few
# flips of bench/flips.py.
set -euo pipefail
# shellcheck source=tests/whole_run/fixture.sh
source "$(dirname "${BASH_SOURCE[0]}")/../fixture.sh"

export OMPI_MCA_odls_base_sigkill_timeout=1 # Open MPI's own value: what is told to end has a second for it
seed=$(date +%j%H%M)
echo "seed $seed"
mkdir "$work/kills" "$work/flips"
tables 6 "$work/kills/shapes"
tables 4 "$work/flips/shapes"
timeout --signal=KILL 500 python3 "$COSEG_SOURCE/bench/kills.py" --coseg "$COSEG" --kills 6 --shapes 6 --seed "$seed" --scratch "$work/kills" \
    --out "$work/kills.json" -- --patches 10 --geodesic-samples 50 --oversegmentations 3 || fail "kills.py; its rounds: $(cat "$work/kills.json")"
echo "ok: $(python3 -c 'import json, sys; print(sum(len(r["kills"]) for r in json.load(open(sys.argv[1]))["rounds"]))' "$work/kills.json") kills"

python3 "$COSEG_SOURCE/bench/flips.py" --coseg "$COSEG" --flips 36 --seed "$seed" --scratch "$work/flips" --meshes "$work/flips/shapes/meshes" --out "$work/flips.json" ||
    fail "flips.py: $(cat "$work/flips.json")"
echo "ok: 36 flips of a bit"
