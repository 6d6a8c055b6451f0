#!/usr/bin/env python3
"""Runs random hostile meshes beside healthy generated shapes, and reports hangs, crashes, time, memory and accuracy.

    bench/hostile.py --coseg build/bin/coseg [--meshes 400] [--batch 20] [--seed 1] [--ranks 2] [--families cup table]
                     [--most-faces 5000] [--healthy-faces F] [--kinds KIND ...] [--keep DIR] [--out hostile.json]
                     [--scratch DIR] [-- OPTIONS OF coseg run]

A batch is a folder of one family's healthy shapes (`coseg generate`) and of `--batch` hostile meshes; --batch 1 tries
each alone. Where many are to be tried, --healthy-faces 2000 -- --patches 10 --geodesic-samples 50 makes the runs short. The same seed makes the same meshes, whatever their number. Each run has a limit of time, 10 times that of
the healthy shapes alone and --patience s, and of memory (--memory MB a process). Reported are

- failures: a run that ends by a signal, hangs, or has an exit code other than 0, and meshes set aside with the code of an
  internal error. The meshes of a batch that fails are tried one by one, and those to blame are kept in --keep;
- time: seconds over those of the healthy run, on the clock and of the processor, of which only the latter mean something on
  a machine that does other work; beside it seconds of the slowest mesh as the report has them;
- memory: peak over that of the healthy run;
- accuracy: of the healthy shapes, against the generator's truth, with and without the hostile ones. Any shape of another
  kind takes some of the parts: what one healthy shape of --foreign costs is printed first.

The exit code is 1 if anything failed. Only the standard library is needed.
"""
import argparse
import json
import math
import os
import pathlib
import random
import resource
import shutil
import subprocess
import sys
import tempfile
import time

from program import parsed_with_options


class Mesh:
    def __init__(self, points=(), faces=()):
        self.points, self.faces = list(points), list(faces)

    def add(self, other):
        first = len(self.points)
        self.points += other.points
        self.faces += [tuple(v + first for v in face) for face in other.faces]
        return self

    def moved(self, scale=(1, 1, 1), shift=(0, 0, 0)):
        return Mesh([tuple(x * s + t for x, s, t in zip(p, scale, shift)) for p in self.points], self.faces)

    def text(self):
        lines = ["OFF", f"{len(self.points)} {len(self.faces)} 0"]
        lines += ["%.17g %.17g %.17g" % p for p in self.points]
        lines += [" ".join(map(str, (len(face), *face))) for face in self.faces]
        return "\n".join(lines) + "\n"


class Text:
    """A mesh that is written already."""

    def __init__(self, text):
        self.written = text

    def text(self):
        return self.written


def grid(rows, columns, place, closed_rows=False, closed_columns=True):
    """Quads split in two, over place(u, v) with u and v in [0, 1]."""
    at = lambda i, j: (i % rows if closed_rows else i) * width + (j % columns if closed_columns else j)
    width = columns if closed_columns else columns + 1
    points = [place(i / rows, j / columns) for i in range(rows if closed_rows else rows + 1) for j in range(width)]
    faces = []
    for i in range(rows):
        for j in range(columns):
            a, b, c, d = at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)
            faces += [(a, b, c), (a, c, d)]
    return Mesh(points, faces)


def ball(faces):
    n = max(3, round(math.sqrt(faces / 4)))

    def place(u, v):
        return (math.sin(math.pi * u) * math.cos(2 * math.pi * v), math.sin(math.pi * u) * math.sin(2 * math.pi * v),
                -math.cos(math.pi * u))

    return grid(n, 2 * n, place)


def tube(faces, length, radius=1.0):
    sides = max(3, min(32, faces // 8))
    rows = max(1, faces // (2 * sides))
    return grid(rows, sides, lambda u, v: (radius * math.cos(2 * math.pi * v), radius * math.sin(2 * math.pi * v), u * length))


def sheet(faces):
    n = max(1, round(math.sqrt(faces / 2)))
    return grid(n, n, lambda u, v: (u, v, 0.2 * math.sin(6 * u) * math.cos(5 * v)), closed_columns=False)


def a_body(rng, faces):
    return rng.choice((ball, sheet, lambda n: tube(n, 4.0)))(faces)


def random_point(rng, scale=1.0):
    return tuple(rng.uniform(-scale, scale) for _ in range(3))


def slivers(rng, faces):
    mesh = a_body(rng, max(1, faces // 2))
    for _ in range(max(1, min(faces // 2, 200))):
        a = random_point(rng)
        along = random_point(rng, 10 ** rng.uniform(-1, 3))
        b = tuple(x + y for x, y in zip(a, along))
        thin = random_point(rng, 10 ** rng.uniform(-12, -1))
        c = tuple(x + rng.random() * y + z for x, y, z in zip(a, along, thin))
        mesh.add(Mesh([a, b, c], [(0, 1, 2)]))
    return mesh


def spikes(rng, faces):
    mesh = a_body(rng, faces)
    for _ in range(rng.choice((1, 1, 2, 5, max(1, faces // 20)))):
        v, reach = rng.randrange(len(mesh.points)), 10 ** rng.uniform(0.5, 9)
        mesh.points[v] = tuple(x * reach for x in mesh.points[v])
    return mesh


def needles(rng, faces):
    mesh = tube(faces, 10 ** rng.uniform(1, 9))
    if rng.random() < 0.5:
        mesh = a_body(rng, max(1, faces // 2)).add(tube(max(8, faces // 2), 10 ** rng.uniform(1, 5), 10 ** rng.uniform(-6, -1)))
    return mesh


def fans(rng, faces):
    """One vertex with all triangles, flat or a cone, closed or not, in any order."""
    n, height = max(3, faces), rng.choice((0.0, 1.0, 100.0))
    points = [(0.0, 0.0, height)] + [(math.cos(2 * math.pi * i / n), math.sin(2 * math.pi * i / n), 0.0) for i in range(n)]
    order = [(0, 1 + i, 1 + (i + 1) % n) for i in range(n if rng.random() < 0.5 else n - 1)]
    if rng.random() < 0.3:
        points.append((0.0, 0.0, -1.0))
        order += [(n + 1, b, a) for _, a, b in order]
    if rng.random() < 0.5:
        rng.shuffle(order)
    return Mesh(points, order)


def doubled(rng, faces):
    mesh = a_body(rng, max(1, faces // 2))
    how = rng.randrange(4)
    if how == 0:
        mesh.faces += mesh.faces
    elif how == 1:
        mesh.faces += [face[::-1] for face in mesh.faces]
    elif how == 2:
        mesh.add(Mesh(mesh.points, mesh.faces))
    else:
        mesh.add(Mesh(mesh.points, [face[::-1] for face in mesh.faces]))
    return mesh


def dust(rng, faces):
    """Many tiny pieces, some with a body."""
    mesh = a_body(rng, faces // 2) if rng.random() < 0.5 and faces > 4 else Mesh()
    size = 10 ** rng.uniform(-6, -1)
    while len(mesh.faces) < faces:
        centre = random_point(rng)
        mesh.add(Mesh([tuple(c + x for c, x in zip(centre, random_point(rng, size))) for _ in range(3)], [(0, 1, 2)]))
    return mesh


def shells(rng, faces):
    count, mesh = rng.randrange(2, 12), Mesh()
    for k in range(count):
        scale = rng.choice((1.0 - k * 1e-4, 0.7**k, 10.0 ** (-k)))
        shell = ball(max(20, faces // count)).moved((scale,) * 3)
        if rng.random() < 0.3:
            shell.faces = [face[::-1] for face in shell.faces]
        mesh.add(shell)
    return mesh


def extremes(rng, faces):
    mesh = a_body(rng, faces)
    scale = rng.choice((1e30, 1e-30, 1e150, 1e-150, 1e300, 1.0))
    shift = rng.choice((0.0, 1e7, 1e12, 1e16)) * (scale if rng.random() < 0.5 else 1.0)
    return mesh.moved((scale,) * 3, (min(shift, 1e306),) * 3)


def aspects(rng, faces):
    return a_body(rng, faces).moved(tuple(10 ** rng.uniform(-8, 8) for _ in range(3)))


def sizes(rng, faces):
    """Pieces of very different sizes."""
    mesh = Mesh()
    for _ in range(rng.randrange(2, 6)):
        mesh.add(a_body(rng, max(4, faces // 4)).moved((10 ** rng.uniform(-7, 7),) * 3, random_point(rng, 10 ** rng.uniform(-3, 5))))
    return mesh


def soups(rng, faces):
    """Faces over any vertices: crowded edges, repeated corners, polygons that cross themselves."""
    points = [random_point(rng) for _ in range(max(3, rng.choice((faces // 10, faces // 2, faces))))]
    corners = lambda: tuple(rng.randrange(len(points)) for _ in range(rng.choice((3, 3, 3, 4, 5, 12))))
    return Mesh(points, [corners() for _ in range(max(1, faces // 2))])


def flats(rng, faces):
    """Without any thickness, or with vertices on one line."""
    mesh = a_body(rng, faces).moved((1.0, 1.0, 0.0))
    for _ in range(len(mesh.points) // 4):
        v, w = rng.randrange(len(mesh.points)), rng.randrange(len(mesh.points))
        mesh.points[v] = rng.choice((mesh.points[w], (mesh.points[v][0], 0.0, 0.0)))
    return mesh


KINDS = {f.__name__: f for f in (slivers, spikes, needles, fans, doubled, dust, shells, extremes, aspects, sizes, soups, flats)}


def hostile_mesh(kinds, seed, number, most_faces):
    rng = random.Random(f"{seed} {number}")
    kind = kinds[number % len(kinds)]
    faces = max(1, round(most_faces ** rng.random()))
    mesh = KINDS[kind](rng, faces)
    mesh.faces = mesh.faces[:most_faces]
    return f"hostile_{number:05d}_{kind}", mesh


def cpu_seconds():
    """Of all children that have ended, and theirs."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


class Runner:
    def __init__(self, args, scratch):
        self.args, self.scratch = args, scratch
        self.environment = dict(os.environ, COSEG_RANKS="1", OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1",
                                OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                                OMPI_MCA_rmaps_base_oversubscribe="1", OMPI_MCA_mpi_yield_when_idle="1")

    def coseg(self, *words, timeout=600.0, launcher=()):
        memory = self.args.memory * 2**20
        limit = lambda: resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
        return subprocess.run([*launcher, self.args.coseg, *words], env=self.environment, preexec_fn=limit, timeout=timeout,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)

    def run(self, meshes, parts, timeout):
        """What one run on the folder does: outcome, seconds and the report."""
        out = self.scratch / "out"
        shutil.rmtree(out, ignore_errors=True)
        start, worked = time.monotonic(), cpu_seconds()
        launcher = ["mpirun", "-n", str(self.args.ranks)] if self.args.ranks > 1 else []
        words = ["run", "--quiet", "--no-html", "--no-sheet", "--parts", str(parts), *self.args.options, "--out", str(out), str(meshes)]
        try:
            done = self.coseg(*words, timeout=timeout, launcher=launcher)
        except subprocess.TimeoutExpired:
            return {"outcome": "hang", "seconds": time.monotonic() - start}
        seconds = time.monotonic() - start
        if done.returncode != 0:
            last = [line for line in done.stdout.splitlines() if line.startswith("coseg: ") and "warning" not in line]
            return {"outcome": f"exit code {done.returncode}", "seconds": seconds, "says": (last or done.stdout.splitlines()[-3:])}
        report = json.loads((out / "report.json").read_text())
        return {"outcome": "ok", "seconds": seconds, "cpu": cpu_seconds() - worked, "report": report,
                "memory": report["peak_memory_max_mib"]}

    def accuracy(self, healthy):
        meshes = sorted(map(str, (healthy / "meshes").glob("*.off")))
        done = self.coseg("score", "--json", "--truth", str(healthy / "truth"), "--labels", str(self.scratch / "out/labels"), *meshes)
        return json.loads(done.stdout)["one_to_one"] if done.returncode == 0 else 0.0


def internal_failures(report):
    """Meshes set aside for a reason that is no property of theirs."""
    words = ("out of memory", "factorised", "does not give up", "bad_alloc", "std::")
    return [entry for entry in report.get("set_aside", []) if any(word in entry["reason"] for word in words)]


def folder_of(healthy, hostile, place):
    shutil.rmtree(place, ignore_errors=True)
    place.mkdir(parents=True)
    for path in (healthy / "meshes").glob("*.off"):
        os.symlink(path.resolve(), place / path.name)
    for name, mesh in hostile:
        (place / f"{name}.off").write_text(mesh.text())
    return place


def try_batch(runner, healthy, alone, hostile, parts):
    meshes = folder_of(healthy, hostile, runner.scratch / "meshes")
    result = runner.run(meshes, parts, runner.args.patience + 10.0 * alone["seconds"])
    if result["outcome"] == "ok":
        result["accuracy"] = runner.accuracy(healthy)
        result["internal"] = internal_failures(result["report"])
        if result["internal"]:
            result["outcome"] = "internal error"
    return result


def figures(result, alone, hostile):
    row = {"outcome": result["outcome"], "seconds": round(result["seconds"], 2), "meshes": [name for name, _ in hostile]}
    if "says" in result:
        row["says"] = result["says"]
    if "report" in result:
        entries = [m for m in result["report"]["meshes"] if m["name"].startswith("hostile")]
        slowest = max(entries, key=lambda m: m["seconds"], default=None)
        row.update(over_seconds=round(result["seconds"] - alone["seconds"], 2), over_cpu=round(result["cpu"] - alone["cpu"], 2), over_mib=round(result["memory"] - alone["memory"]),
                   accuracy_lost=round(alone["accuracy"] - result["accuracy"], 2), described=len(entries),
                   set_aside=len(result["report"].get("set_aside", [])), internal=result["internal"])
        if slowest:
            row["slowest"] = [slowest["name"], round(slowest["seconds"], 2), slowest["working_faces"]]
            row["most_working_faces"] = max(m["working_faces"] for m in entries)
    return row


def blame(runner, healthy, alone, hostile, parts, keep):
    """The meshes of a failed batch that fail alone."""
    guilty = []
    for one in hostile:
        result = try_batch(runner, healthy, alone, [one], parts)
        if result["outcome"] == "ok":
            continue
        guilty.append([one[0], result["outcome"], result.get("says") or result.get("internal")])
        if keep:
            pathlib.Path(keep).mkdir(parents=True, exist_ok=True)
            (pathlib.Path(keep) / f"{one[0]}.off").write_text(one[1].text())
    return guilty


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--coseg", required=True)
    parser.add_argument("--meshes", type=int, default=400)
    parser.add_argument("--first", type=int, default=0, help="number of the first mesh")
    parser.add_argument("--batch", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--ranks", type=int, default=2)
    parser.add_argument("--families", nargs="+", default=["cup:2"], help="FAMILY:PARTS")
    parser.add_argument("--shapes", type=int, default=4, help="healthy shapes")
    parser.add_argument("--most-faces", type=int, default=5000)
    parser.add_argument("--healthy-faces", type=int, help="faces of a healthy shape, as `coseg generate --faces`")
    parser.add_argument("--patience", type=float, default=300.0, help="seconds that a run may take beyond 10 times the healthy one's")
    parser.add_argument("--memory", type=int, default=6000, help="limit of a process, MB")
    parser.add_argument("--kinds", nargs="+", default=sorted(KINDS), choices=sorted(KINDS))
    parser.add_argument("--foreign", default="table", help="family of the healthy shape that stands in for a hostile one")
    parser.add_argument("--keep", help="folder for the meshes to blame")
    parser.add_argument("--out")
    parser.add_argument("--scratch")
    args, args.options = parsed_with_options(parser)
    faces = ["--faces", str(args.healthy_faces)] if args.healthy_faces else []
    args.coseg = os.path.abspath(args.coseg)
    rows, failed = [], 0
    with tempfile.TemporaryDirectory(dir=args.scratch) as scratch:
        runner = Runner(args, pathlib.Path(scratch))
        settings = {}
        for word in args.families:
            family, parts = word.split(":")
            healthy = runner.scratch / family
            runner.coseg("generate", family, "--count", str(args.shapes), *faces, "--out", str(healthy))
            alone = try_batch(runner, healthy, {"seconds": 60.0}, [], int(parts))
            if alone["outcome"] != "ok":
                sys.exit(f"the healthy shapes of {family} cannot be run: {alone}")
            settings[family] = (healthy, alone, int(parts))
            foreign = runner.scratch / "foreign"
            runner.coseg("generate", args.foreign, "--count", "1", *faces, "--out", str(foreign), "--force")
            (name, text), = ((path.stem, path.read_text()) for path in (foreign / "meshes").glob("*.off"))
            beside = try_batch(runner, healthy, alone, [(f"foreign_{name}", Text(text))], int(parts))
            print(f"{family}: healthy alone {alone['seconds']:.1f} s ({alone['cpu']:.1f} of the processor), {alone['memory']:.0f} MiB, accuracy {alone['accuracy']:.2f}; "
                  f"beside one {args.foreign} {beside['seconds']:.1f} s, accuracy {beside.get('accuracy', 0.0):.2f}", flush=True)
        for first in range(args.first, args.first + args.meshes, args.batch):
            last = min(first + args.batch, args.first + args.meshes)
            hostile = [hostile_mesh(args.kinds, args.seed, n, args.most_faces) for n in range(first, last)]
            healthy, alone, parts = settings[list(settings)[first // args.batch % len(settings)]]
            result = try_batch(runner, healthy, alone, hostile, parts)
            row = figures(result, alone, hostile)
            if row["outcome"] != "ok":
                failed += 1
                row["guilty"] = blame(runner, healthy, alone, hostile, parts, args.keep)
            rows.append(row)
            print(f"{first}-{last - 1}: " + ", ".join(f"{k} {v}" for k, v in row.items() if k != "meshes"), flush=True)
    good = [row for row in rows if "over_seconds" in row]
    print(f"{sum(len(row['meshes']) for row in rows)} hostile meshes in {len(rows)} runs, {failed} runs failed; "
          + (f"at most {max(r['over_seconds'] for r in good)} s, {max(r['over_cpu'] for r in good)} s of the processor and {max(r['over_mib'] for r in good)} MiB over the healthy run, "
             f"{max(r['accuracy_lost'] for r in good)} points of accuracy lost" if good else "no run succeeded"))
    if args.out:
        pathlib.Path(args.out).write_text(json.dumps(rows, indent=1) + "\n")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
