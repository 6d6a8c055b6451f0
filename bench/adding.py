#!/usr/bin/env python3
"""What it costs to add shapes to a collection whose earlier run kept its state: `coseg run --state DIR`.

usage: adding.py --coseg build/bin/coseg [--shapes 400] [--added 10] [--faces 3000] [--family chair] [--ranks 2]

Generates the shapes, runs the collection without the last ones, then the whole, then the whole again, and prints for each
run the wall seconds up to the optimisation (stages describe and features) and up to the labels, the meshes described and
those taken from the state. The bars: adding takes less than 15 % of the first run up to the optimisation, and the second
identical run describes nothing. Exit code 1 if a bar is missed. Takes minutes; run it on a quiet machine.
"""
import argparse
import json
import os
import sys
import tempfile

from program import command_output


def run(args, scratch, name, meshes):
    listing = os.path.join(scratch, name + ".txt")
    with open(listing, "w") as text:
        text.writelines(mesh + "\n" for mesh in meshes)
    out = os.path.join(scratch, name)
    command_output(["mpirun", "--oversubscribe", "-n", str(args.ranks), args.coseg, "run", "--quiet", "--no-sheet", "--no-html",
                    "--parts", str(args.parts), "--state", os.path.join(scratch, "state"), "--out", out, "@" + listing])
    with open(os.path.join(out, "report.json")) as text:
        report = json.load(text)
    seconds = {stage["stage"]: stage["seconds_wall"] for stage in report["stages"]}
    state = report["state"]
    row = {"before": seconds["describe"] + seconds["features"], "all": report["seconds"],
           "described": state["meshes_described"], "reused": state["meshes_reused"]}
    print(f"| {name} | {len(meshes)} | {row['before']:.1f} | {row['all']:.1f} | {row['described']} | {row['reused']} |",
          flush=True)
    return row


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--coseg", required=True)
    parser.add_argument("--shapes", type=int, default=400)
    parser.add_argument("--added", type=int, default=10)
    parser.add_argument("--faces", type=int, default=3000)
    parser.add_argument("--family", default="chair")
    parser.add_argument("--parts", type=int, default=4)
    parser.add_argument("--ranks", type=int, default=2)
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        made = os.path.join(scratch, "shapes")
        command_output([args.coseg, "generate", args.family, "--count", str(args.shapes), "--faces", str(args.faces), "--out", made])
        meshes = [os.path.join(made, "meshes", name) for name in sorted(os.listdir(os.path.join(made, "meshes")))]
        print("| run | shapes | s up to the optimisation | s in all | described | from the state |\n" + "|" + " --- |" * 6)
        first = run(args, scratch, "first", meshes[:-args.added])
        added = run(args, scratch, "added", meshes)
        again = run(args, scratch, "again", meshes)
    share = 100.0 * added["before"] / first["before"]
    print(f"\nadding {args.added} to {args.shapes - args.added}: {share:.1f} % of the first run up to the optimisation; "
          f"described by the second identical run: {again['described']}")
    return 0 if share < 15.0 and again["described"] == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
