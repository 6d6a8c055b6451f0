#!/usr/bin/env python3
"""The level of the truth's number of parts in runs at another number, against a run at that number, as a Markdown table.

usage: bench/levels.py [--coseg build/bin/coseg] [--data $COSEG_DATA] [--sets NAME ...] [--off -1 2] [--ranks 2]
                       [--seed 1] [--state DIR]

The sets are those of bench/accuracy.py. Figures are one-to-one accuracy by area in percent. --off: how many parts more
than the truth has the other runs are asked for; those below 2 are left out. --state keeps what is computed of each set in
DIR/SET, so that only the cut is made for each number.
"""
import argparse
import os
import tempfile

from accuracy import find_sets
from examples import run_with_state
from program import PROGRAM, one_to_one


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--coseg", default=PROGRAM)
    parser.add_argument("--data", default=os.environ.get("COSEG_DATA", ""))
    parser.add_argument("--sets", nargs="*")
    parser.add_argument("--off", type=int, nargs="+", default=[-1, 2])
    parser.add_argument("--ranks", type=int, default=2)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--state", default="")
    arguments = parser.parse_args()
    print("| set (K) | run at K | " + " | ".join(f"level K, run at K{off:+d}" for off in arguments.off) + " |")
    print("| --- |" + " --- |" * (1 + len(arguments.off)))
    with tempfile.TemporaryDirectory() as work:
        for name, sample in find_sets(arguments.data, arguments.sets).items():
            parts, cells = sample["parts"], []
            for off in [0] + arguments.off:
                if parts + off < 2:
                    cells.append("-")
                    continue
                out = os.path.join(work, "run")
                run_with_state(arguments, dict(sample, parts=parts + off), os.path.join(arguments.state or work, name), out, ["--levels"])
                level = os.path.join(out, "levels", str(parts))
                cells.append(f"{one_to_one(arguments, sample['truth'], level, sample['meshes']):.1f}")
            print(f"| {name} ({parts}) | " + " | ".join(cells) + " |", flush=True)


main()
