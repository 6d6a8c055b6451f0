#!/usr/bin/env python3
"""How the time and memory of `coseg run` grow, and how well the ranks share the work.

    bench/growth.py --coseg build/bin/coseg --out growth.json --table growth.md [--largest 512000] [--only faces]

Four series over generated shapes, refined by midpoint subdivision where they must be larger than the generator makes
them:
    faces    two shapes of 2k, 8k, 32k ... faces on two ranks: seconds a mesh in the describe stage
    patches  p = 25 ... 200 patches an over-segmentation, twenty shapes of 5k faces
    shapes   shapes of 3k faces, ten a rank on one rank and on --ranks, then ten to eighty on --ranks
    balance  shapes that differ 64-fold in size on --ranks: the share of the describe stage that ranks idle,
             1 - mean / max of the seconds that the ranks worked in it
With --make FOLDER nothing is measured: --count such shapes of about --faces faces are left there, e.g. for speed.py:
    bench/growth.py --coseg build/bin/coseg --make large --faces 50000 --count 4
Figures are those of the runs' report.json. Nothing here is a test: times depend on what else the machine does.
"""
import argparse
import json
import pathlib
import shutil
import tempfile

from collection import write_result
from program import command_output, read_off


def write_off(path, vertices, faces):
    with open(path, "w", encoding="ascii") as file:
        file.write(f"OFF\n{len(vertices)} {len(faces)} 0\n")
        file.writelines(f"{x:.9g} {y:.9g} {z:.9g}\n" for x, y, z in vertices)
        file.writelines(f"3 {a} {b} {c}\n" for a, b, c in faces)


def subdivided(vertices, faces):
    """Each triangle in four, by the midpoints of its edges."""
    vertices = list(vertices)
    middle = {}

    def midpoint(a, b):
        key = (a, b) if a < b else (b, a)
        if key not in middle:
            middle[key] = len(vertices)
            vertices.append(tuple(0.5 * (x + y) for x, y in zip(vertices[a], vertices[b])))
        return middle[key]

    finer = []
    for a, b, c in faces:
        ab, bc, ca = midpoint(a, b), midpoint(b, c), midpoint(c, a)
        finer += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    return vertices, finer


class Bench:
    def __init__(self, options, scratch):
        self.options = options
        self.scratch = scratch

    def generated(self, family, count, faces, seed=1):
        folder = self.scratch / f"{family}_{count}_{faces}_{seed}"
        if not folder.is_dir():
            command_output([self.options.coseg, "generate", family, "--count", count, "--faces", faces, "--seed", seed,
                            "--out", folder])
        return sorted((folder / "meshes").glob("*.off"))

    def refined(self, files, rounds, prefix):
        """The files, each face in 4^rounds."""
        folder = self.scratch / f"{prefix}_{rounds}"
        folder.mkdir(exist_ok=True)
        made = []
        for file in files:
            mesh = read_off(file)
            for _ in range(rounds):
                mesh = subdivided(*mesh)
            made.append(folder / f"{prefix}_{rounds}_{file.name}")
            write_off(made[-1], *mesh)
        return made

    def run(self, files, ranks, *options):
        with tempfile.TemporaryDirectory(dir=self.scratch) as out:
            command_output([self.options.coseg, "run", "--ranks", ranks, "--quiet", "--no-sheet", "--no-html",
                            "--parts", 3, "--force", "--out", out, *options, *files])
            report = json.loads((pathlib.Path(out) / "report.json").read_text(encoding="utf-8"))
        stages = {stage["stage"]: stage for stage in report["stages"]}
        describe = stages["describe"]
        return {
            "ranks": ranks,
            "shapes": len(report["meshes"]),
            "faces": sum(mesh["faces"] for mesh in report["meshes"]),
            "seconds_a_mesh": sum(mesh["seconds"] for mesh in report["meshes"]) / len(report["meshes"]),
            "describe": describe["seconds_wall"],
            "idle": 1.0 - describe["seconds_mean"] / describe["seconds_max"],
            "rest": sum(stage["seconds_wall"] for name, stage in stages.items() if name != "describe"),
            "mib_a_rank": report["peak_memory_max_mib"],
        }


def faces_series(bench):
    base = bench.generated("quadruped", 2, 2000)
    rows = []
    rounds = 0
    while 2000 * 4**rounds <= bench.options.largest:
        rows.append({"at": 2000 * 4**rounds, **bench.run(bench.refined(base, rounds, "faces"), 2)})
        rounds += 1
    return rows


def patches_series(bench):
    files = bench.generated("quadruped", 20, 5000)
    return [{"at": p, **bench.run(files, bench.options.ranks, "--patches", p)} for p in (25, 50, 100, 200)]


def shapes_series(bench):
    ranks = bench.options.ranks
    rows = []
    for count, on in [(10, 1), (10 * ranks, ranks)] + [(n, ranks) for n in (10, 40, 80)]:
        rows.append({"at": count, **bench.run(bench.generated("quadruped", count, 3000), on)})
    return rows


def balance_series(bench):
    files = []
    for rounds, count in ((0, 32), (1, 12), (2, 4), (3, 1)):
        files += bench.refined(bench.generated("quadruped", count, 2000, seed=2 + rounds), rounds, "balance")
    return [{"at": len(files), **bench.run(files, bench.options.ranks)}]


def make_meshes(bench, folder, count, faces):
    """Quadrupeds that the generator makes as large as it can, and that are subdivided until they are large enough."""
    rounds = 0
    while faces // 4**rounds > LARGEST_GENERATED:
        rounds += 1
    folder.mkdir(parents=True, exist_ok=True)
    for file in bench.refined(bench.generated("quadruped", count, faces // 4**rounds), rounds, "made"):
        shutil.move(file, folder / file.name)  # another file system, perhaps


LARGEST_GENERATED = 20000  # the largest --faces of coseg generate
SERIES = {"faces": faces_series, "patches": patches_series, "shapes": shapes_series, "balance": balance_series}
COLUMNS = ("at", "ranks", "shapes", "faces", "seconds_a_mesh", "describe", "idle", "rest", "mib_a_rank")


def markdown(result):
    lines = []
    for name, rows in result["series"].items():
        lines += ["", f"| {name} | " + " | ".join(COLUMNS[1:]) + " |", "| ---: " * len(COLUMNS) + "|"]
        for row in rows:
            cells = [f"{row[key]:.3f}" if isinstance(row[key], float) else str(row[key]) for key in COLUMNS]
            lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines[1:]) + "\n"


def main():
    parser = argparse.ArgumentParser(description="How time and memory of coseg run grow.")
    parser.add_argument("--coseg", required=True, type=pathlib.Path)
    parser.add_argument("--ranks", type=int, default=2)
    parser.add_argument("--largest", type=int, default=512000, help="faces of the largest shape in the series of faces")
    parser.add_argument("--make", type=pathlib.Path, metavar="FOLDER", help="only make meshes there")
    parser.add_argument("--faces", type=int, default=50000, help="faces of a mesh that is made")
    parser.add_argument("--count", type=int, default=4, help="meshes that are made")
    parser.add_argument("--only", nargs="+", choices=SERIES, default=list(SERIES))
    parser.add_argument("--out", type=pathlib.Path, help="JSON")
    parser.add_argument("--table", type=pathlib.Path, help="Markdown; standard output without it")
    options = parser.parse_args()
    options.coseg = options.coseg.resolve()
    with tempfile.TemporaryDirectory() as scratch:
        bench = Bench(options, pathlib.Path(scratch))
        if options.make:
            make_meshes(bench, options.make, options.count, options.faces)
            return
        result = {"format": "coseg growth 1", "series": {name: SERIES[name](bench) for name in options.only}}
    write_result(options, result, markdown(result))


if __name__ == "__main__":
    main()
