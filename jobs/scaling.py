#!/usr/bin/env python3
"""Strong and weak scaling of `coseg run` on one collection.

usage: scaling.py --coseg PROGRAM --ranks R OUT COLLECTION [OPTION OF coseg run ...]

Strong: the whole collection on 1, 2, 4, ... R ranks. Weak: the share n/R of it on n ranks. Writes OUT/scaling.json and
OUT/scaling.svg, seconds of each stage from the reports of the runs.
"""
import argparse
import json
import os
import shutil
import subprocess
import sys
import tempfile

MESHES = (".off", ".obj", ".ply", ".stl", ".glb", ".gltf", ".vtp")


def rank_counts(largest):
    counts = [1]
    while counts[-1] * 2 < largest:
        counts.append(counts[-1] * 2)
    return counts + ([largest] if largest > counts[-1] else [])


def measure(coseg, ranks, meshes, options, scratch):
    """Seconds of a run in all and by stage, and its memory."""
    listing = os.path.join(scratch, "meshes.txt")
    with open(listing, "w", encoding="utf-8") as file:
        file.write("\n".join(meshes) + "\n")
    out = os.path.join(scratch, "result")
    command = ["mpirun", "-n", str(ranks), coseg, "run", "--quiet", "--out", out, *options, "@" + listing]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)}\nended with {done.returncode}: {done.stderr}")
    with open(os.path.join(out, "report.json"), encoding="utf-8") as file:
        report = json.load(file)
    shutil.rmtree(out)
    return {"ranks": ranks, "meshes": len(meshes), "seconds": report["seconds"],
            "peak_memory_sum_mib": report["peak_memory_sum_mib"],
            "stages": {stage["stage"]: stage["seconds_wall"] for stage in report["stages"]}}


def rows_of(coseg, largest, meshes, options):
    strong, weak = [], []
    with tempfile.TemporaryDirectory() as scratch:
        for ranks in rank_counts(largest):
            strong.append(measure(coseg, ranks, meshes, options, scratch))
            count = max(2, len(meshes) * ranks // largest)
            weak.append(measure(coseg, ranks, meshes[:count], options, scratch))
    for row in strong:
        row["efficiency"] = strong[0]["seconds"] / (row["seconds"] * row["ranks"])
    for row in weak:
        row["efficiency"] = weak[0]["seconds"] / row["seconds"]
    return strong, weak


def plot(strong, weak, path):
    """Efficiency over ranks, an axis step for each doubling."""
    width, height, left, top = 640, 400, 60, 30
    steps = max(1, len(strong) - 1)
    best = max(1.0, *(row["efficiency"] for row in strong + weak))

    def place(k, efficiency):
        return left + k * (width - 2 * left) / steps, height - 40 - efficiency / best * (height - 40 - top)

    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" font-family="sans-serif" '
             'font-size="12"><rect width="100%" height="100%" fill="white"/>',
             f'<text x="{left}" y="18">parallel efficiency over ranks</text>']
    for share in (0.0, 0.25, 0.5, 0.75, 1.0):
        y = place(0, share)[1]
        parts.append(f'<line x1="{left}" x2="{width - left}" y1="{y:.1f}" y2="{y:.1f}" stroke="#ddd"/>'
                     f'<text x="{left - 8}" y="{y + 4:.1f}" text-anchor="end">{share:.2f}</text>')
    for k, row in enumerate(strong):
        parts.append(f'<text x="{place(k, 0)[0]:.1f}" y="{height - 20}" text-anchor="middle">{row["ranks"]}</text>')
    for rows, color, name, y in ((strong, "#1f77b4", "strong", 18), (weak, "#d62728", "weak", 34)):
        points = " ".join("{:.1f},{:.1f}".format(*place(k, row["efficiency"])) for k, row in enumerate(rows))
        parts.append(f'<polyline points="{points}" fill="none" stroke="{color}" stroke-width="2"/>'
                     f'<text x="{width - left}" y="{y}" text-anchor="end" fill="{color}">{name}</text>')
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(parts) + "\n</svg>\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--coseg", required=True)
    parser.add_argument("--ranks", type=int, required=True)
    parser.add_argument("out")
    parser.add_argument("collection")
    arguments, options = parser.parse_known_args()
    folder = os.path.abspath(arguments.collection)
    meshes = sorted(os.path.join(folder, name) for name in os.listdir(folder) if name.lower().endswith(MESHES))
    if len(meshes) < 2:
        sys.exit(f"{folder}: needs at least 2 meshes to measure scaling")
    os.makedirs(arguments.out, exist_ok=True)
    strong, weak = rows_of(arguments.coseg, arguments.ranks, meshes, options)
    with open(os.path.join(arguments.out, "scaling.json"), "w", encoding="utf-8") as file:
        json.dump({"format": "coseg scaling 1", "strong": strong, "weak": weak}, file, indent=1)
    plot(strong, weak, os.path.join(arguments.out, "scaling.svg"))
    for name, rows in (("strong", strong), ("weak", weak)):
        for row in rows:
            print(f"{name:6}  {row['ranks']:5} ranks  {row['meshes']:6} meshes  {row['seconds']:9.2f} s  "
                  f"efficiency {row['efficiency']:.2f}")


if __name__ == "__main__":
    main()
