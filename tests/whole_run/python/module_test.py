"""Tests of the Python module, run by python_test.sh, which says where the program (COSEG) is and where to write."""

import copy
import inspect
import json
import os
import pathlib
import pickle
import shutil
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import coseg

WORK = pathlib.Path(os.environ["COSEG_WORK"])
SET = pathlib.Path(os.environ["COSEG_SET"])  # tables that the program generated, with their truth
QUICK = dict(patches=20, geodesic_samples=50, oversegmentations=1)
TINY = dict(patches=4, geodesic_samples=10, oversegmentations=1, choose=False)


def program(*words):
    answer = subprocess.run([os.environ["COSEG"], *map(str, words)], capture_output=True, text=True, check=False)
    assert answer.returncode == 0, answer.stderr
    return answer.stdout


def seg(path):
    return np.loadtxt(path, dtype=int)


@pytest.fixture(scope="module")
def run():
    """A run of the program on generated tables, and the names of its shapes."""
    WORK.mkdir(exist_ok=True)
    for kind in ("set/meshes", "set/truth"):
        (WORK / kind).mkdir(parents=True)
        for k in range(4):
            for path in (SET / kind[4:]).glob(f"table_{k:04}.*"):
                shutil.copy(path, WORK / kind)
    program("run", "--quiet", "--parts", 2, "--patches", 20, "--geodesic-samples", 50, "--oversegmentations", 1, "--no-sheet", "--no-html",
            "--out", WORK / "run", WORK / "set/meshes")
    return WORK / "run", [f"table_{k:04}" for k in range(4)]


@pytest.fixture(scope="module")
def tables():
    return coseg.generate("table", 4, seed=5, faces=2000)


def equals_run(result, run, order=(0, 1, 2, 3)):
    folder, names = run
    for row, k in enumerate(order):
        assert result.names[row] == names[k]
        assert np.array_equal(result.labels[row], seg(folder / f"labels/{names[k]}.seg"))
        assert np.array_equal(result.patches[row], seg(folder / f"patches/{names[k]}.seg"))
    return True


def test_generated_shapes_are_those_of_the_program(run, tables):
    for mesh, name in zip(tables, run[1]):
        from_file = coseg.load_mesh(WORK / f"set/meshes/{name}.off")
        assert mesh.name == name
        assert np.array_equal(mesh.vertices, from_file.vertices) and np.array_equal(mesh.faces, from_file.faces)
        assert np.array_equal(mesh.labels, seg(WORK / f"set/truth/{name}.seg"))


def test_arrays_have_the_labels_of_the_program_in_any_order_and_again(run, tables):
    order = (2, 0, 3, 1)
    shapes = [(tables[k].vertices, tables[k].faces) for k in order]
    names = [run[1][k] for k in order]
    first, result = (coseg.segment(shapes, 2, names=names, **QUICK) for _ in range(2))
    assert equals_run(first, run, order) and equals_run(result, run, order)
    assert first.part_areas.tobytes() == result.part_areas.tobytes() and first.certificate == result.certificate
    assert first.alignment.matrices.tobytes() == result.alignment.matrices.tobytes()
    assert result.parts == 2 and not result.set_aside
    assert np.allclose(result.part_areas.sum(axis=1), 1)
    report = json.loads((run[0] / "report.json").read_text())
    assert result.certificate["objective"] == report["optimisation"]["objective"]
    assert result.certificate["reached"] and result.certificate["relative_gap"] <= 1e-4
    assert result.report["optimisation"] == report["optimisation"]
    assert [mesh["name"] for mesh in result.report["meshes"]] == run[1]


def test_files_folders_and_mixtures_have_the_labels_of_the_program(run, tables):
    files = coseg.mesh_files(WORK / "set/meshes")
    assert equals_run(coseg.segment(WORK / "set/meshes", 2, **QUICK), run)
    mixed = [files[0], pathlib.Path(files[1]), tables[2], (tables[3].vertices.astype(np.float64), tables[3].faces.tolist())]
    result = coseg.segment(mixed, 2, names=run[1], out=WORK / "mixed", sheet=False, html=False, **QUICK)
    assert equals_run(result, run) and result.folder == str(WORK / "mixed")
    loaded = coseg.Result.load(WORK / "mixed")
    assert equals_run(loaded, run)
    assert loaded.certificate == result.certificate and loaded.parts == 2 and not loaded.warnings
    report = WORK / "mixed/report.json"
    report.write_text(report.read_text().replace('"seed": 1,', '"seed": 3,'))
    labels = WORK / f"mixed/labels/{run[1][2]}.seg"
    labels.write_text(labels.read_text() + "\n")
    assert [warning.split(":")[0] for warning in coseg.Result.load(WORK / "mixed").warnings] == [str(report), str(labels)]
    with pytest.raises(coseg.Error, match="not empty.*with replace=True$") as error:
        coseg.segment(mixed, 2, names=run[1], out=WORK / "mixed", **QUICK)
    assert error.value.code == 4


def test_state_folder_serves_arrays(run, tables):
    shapes = [(mesh.vertices, mesh.faces) for mesh in tables]
    for again in (False, True):
        result = coseg.segment(shapes, 2, names=run[1], state=WORK / "state", **QUICK)
        assert equals_run(result, run)
        assert all(mesh["reused"] == again for mesh in result.report["meshes"])
    moved = [(tables[0].vertices * 2, tables[0].faces)] + shapes[1:]
    result = coseg.segment(moved, 2, names=run[1], state=WORK / "state", **QUICK)
    assert [mesh["reused"] for mesh in result.report["meshes"]] == [False, True, True, True]


def test_assign_by_result_and_by_folder_are_the_program_s(run, tables):
    new = [coseg.load_mesh(SET / f"meshes/table_{k:04}.off") for k in (4, 5)]
    names = ["new_a", "new_b"]
    for mesh, name in zip(new, names):
        with open(WORK / f"{name}.obj", "w", encoding="ascii") as file:
            file.writelines(f"v {x!r} {y!r} {z!r}\n" for x, y, z in mesh.vertices.tolist())
            file.writelines(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in mesh.faces)
    program("assign", "--quiet", "--no-sheet", "--no-html", "--to", run[0], "--out", WORK / "assigned",
            WORK / "new_a.obj", WORK / "new_b.obj")
    wanted = [seg(WORK / f"assigned/labels/{name}.seg") for name in names]
    result = coseg.segment(tables, 2, names=run[1], **QUICK)
    for to in (result, run[0], coseg.Result.load(run[0])):
        found = coseg.assign(new, to, names=names)
        assert all(np.array_equal(a, b) for a, b in zip(found.labels, wanted))
    # Of the first half of a shape's faces the other part is said.
    said = np.where(np.arange(len(wanted[0])) < len(wanted[0]) // 2, 1 - wanted[0], -1)
    examples = WORK / "examples"
    examples.mkdir()
    np.savetxt(examples / "new_a.seg", said, fmt="%d")
    found = coseg.assign(new, result, names=names, examples=examples)
    assert np.array_equal(found.labels[0][said >= 0], said[said >= 0])
    np.savetxt(examples / "new_b.seg", said[:3], fmt="%d")
    with pytest.raises(coseg.InputError, match="new_b.seg"):
        coseg.assign(new, result, names=names, examples=examples)
    with pytest.raises(coseg.UsageError, match="keep_model"):
        coseg.assign(new, coseg.segment(tables[:2], 2, keep_model=False, **TINY))
    with pytest.raises(coseg.InputError, match="is no run"):
        coseg.assign(new, WORK / "set")
    with pytest.raises(coseg.UsageError, match=r"it is of assign\(\); give the result of segment"):
        coseg.assign(new, found)


def test_score_is_that_of_the_program(run, tables):
    wanted = json.loads(program("score", "--json", "--truth", WORK / "set/truth", "--labels", run[0] / "labels",
                                WORK / "set/meshes"))
    found = coseg.score(tables, coseg.Result.load(run[0]), [mesh.labels for mesh in tables])
    assert found.accuracy == pytest.approx(wanted["one_to_one"] / 100, abs=1e-6)
    assert found.rand_index == pytest.approx(wanted["rand_index"], abs=1e-4)
    assert found.shapes[2]["accuracy"] == pytest.approx(wanted["per_shape"]["table_0002"] / 100, abs=1e-6)
    perfect = coseg.score(tables, [1 - mesh.labels for mesh in tables], [mesh.labels for mesh in tables])
    assert perfect.accuracy == pytest.approx(1)
    with pytest.raises(coseg.InputError, match="shape 1: 3 labels for"):
        coseg.score(tables[:2], [tables[0].labels, [0, 1, 0]], [mesh.labels for mesh in tables[:2]])


def test_describe(tables):
    mesh = tables[1]
    first, scaled = coseg.describe([mesh, (mesh.vertices * 3, mesh.faces)], names=["a", "b"], remesh="never",
                                   geodesic_samples=50)
    corners = mesh.vertices[mesh.faces]
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
    assert np.allclose(first.areas, areas) and np.allclose(scaled.areas, 9 * areas)
    assert {"shape_diameter", "gaussian_curvature"} <= set(first.descriptors)
    for values in first.descriptors.values():
        assert len(values) == len(mesh.faces) and np.isfinite(values).all()
    assert any(values.ndim == 2 for values in first.descriptors.values())
    assert np.allclose(first.descriptors["shape_diameter"], scaled.descriptors["shape_diameter"], rtol=1e-6)
    only = coseg.describe([mesh], feature_weights=[0, 1, 0, 0, 0])[0]
    assert list(only.descriptors) == ["shape_diameter"]


def test_clusters_have_the_objective_that_they_certify():
    random = np.random.default_rng(1)
    truth = np.repeat([0, 1, 2], 12)
    views = [np.abs(np.eye(3)[truth] @ random.random((3, d)) + 0.02 * random.random((36, d))) for d in (8, 5)]
    alpha, beta, lambda_ = 0.02, 0.05, 0.5
    found = coseg.cluster(views, 3, alpha=alpha, beta=beta, lambda_=lambda_, unit_items=True, gap=1e-8)
    assert len({(a, b) for a, b in zip(found.labels, truth)}) == 3
    columns = [(view / np.linalg.norm(view, axis=1, keepdims=True)).T for view in views]
    w = [matrix.toarray() for matrix in found.coefficients]
    objective = sum(np.sum((x @ m - x) ** 2) + lambda_ * np.sum(m.sum(axis=1) ** 2) for x, m in zip(columns, w))
    objective += alpha * np.sqrt(sum(m ** 2 for m in w)).sum() + beta * sum(np.abs(m).sum() for m in w)
    assert found.certificate["objective"] == pytest.approx(objective, rel=1e-6)
    assert found.certificate["lower_bound"] <= found.certificate["objective"]
    norms = np.sqrt(sum(m ** 2 for m in w))
    assert np.allclose(found.affinity.toarray(), (norms + norms.T) / 2)
    model = coseg.SubspaceClustering(3, alpha=alpha, beta=beta, lambda_=lambda_, unit_items=True, gap=1e-8)
    assert np.array_equal(model.fit_predict(views), found.labels)
    grouped = coseg.cluster(views, 3, groups=list("ab") * 18, unit_items=True)
    groups = np.tile([0, 1], 18)
    for matrix in grouped.coefficients:
        entries = matrix.tocoo()
        assert (groups[entries.row] != groups[entries.col]).all()
    for bad, words in ((dict(parts=0), "parts"), (dict(parts=99), "99 parts"), (dict(parts=2, variant="x"), "multi-feature"),
                       (dict(parts=2, alpha=float("nan")), "alpha"), (dict(parts=2, groups=[1]), "groups")):
        with pytest.raises((coseg.UsageError, coseg.InputError), match=words):
            coseg.cluster(views, **bad)
    with pytest.raises(coseg.InputError, match="feature 0"):
        coseg.cluster(-views[0], 3)


@pytest.mark.parametrize("arguments, words", [
    (dict(alpha=True), "alpha: True is no number"),
    (dict(alpha="0.1"), "alpha: '0.1' is no number"),
    (dict(alpha=np.array([0.1])), r"alpha: array\(\[0.1\]\) is no number"),
    (dict(beta=float("inf")), "beta: inf is not finite"),
    (dict(beta=-1), "beta"),
    (dict(lambda_=-1), "lambda"),
    (dict(gap=-1), "gap"),
    (dict(gap=float("nan")), "gap: nan is not finite"),
    (dict(max_seconds=float("nan")), "max_seconds: nan is not finite"),
    (dict(max_seconds=-1), "max.seconds"),
    (dict(max_iterations=0), "max.iterations"),
    (dict(max_iterations=1e4), "max_iterations: 10000.0 is no whole number"),
    (dict(max_iterations=2 ** 70), "max_iterations: 1180591620717411303424 is out of range"),
    (dict(seed=-1), "seed: -1 is out of range"),
    (dict(seed=[1]), r"seed: \[1\] is no whole number"),
    (dict(links=True), "links: True is no whole number"),
    (dict(links=-3), "links"),
    (dict(unit_items="no"), "unit_items: 'no' is neither True nor False"),
    (dict(variant=3), "variant: 3 is no text"),
    (dict(scope="everything"), "scope|everything"),
    (dict(affinity=["links"]), "affinity: .* is no text"),
    (dict(parts=[2]), r"parts: \[2\] is no whole number"),
    (dict(groups=[[1], [2], [3], [4]]), "groups: give one for each item"),
    (dict(groups=[1, 2, 3, float("nan")]), "groups: give one for each item"),
    (dict(groups=[1, 2, "a", None]), "groups: give one for each item|groups"),
    (dict(progress=5), "progress: 5 is no function"),
    (dict(comm=[0]), "comm: give a communicator"),
    (dict(features=np.ma.masked_less(np.eye(4) + 1, 1.5)), "feature 0: values are masked"),
    (dict(features=np.full((4, 2), np.nan)), r"^feature 0, item 0 \(both counted from 0\) holds a value that is not a finite number"),
    (dict(features=[np.ones((4, 2)), np.diag([1, 1, -1, 1])]), r"^feature 1, item 2 \(both counted from 0\) holds the negative value"),
    (dict(features=np.diag([1, 0, 1, 1])), r"^feature 0, item 1 \(.*\) is all zeros .*; leave that item out$"),
    (dict(features=[["a", "b"]] * 4), "feature 0: give an array"),
    (dict(parts=2 ** 31), "parts: 2147483648 is not in 1 .. 1000"),
    (dict(scope="meshes"), "scope: 'meshes' needs groups"),
    (dict(scope="meshes", groups=[1, 1, 1, 1]), "scope: 'meshes' needs groups"),
    (dict(groups=np.ma.masked_equal([1, 2, 3, 4], 3)), "groups: are masked"),
    (dict(variant=""), "variant: has an empty value"),
    (dict(affinity="\ud800"), "affinity: .* has a character that is none"),
    (dict(features=[np.ones((4, 2)), np.ones((3, 2))]), "feature 1 has 3 items"),
    (dict(features=[]), "feature 0"),
])
def test_bad_arguments_of_cluster_are_exceptions(arguments, words):
    given = {"features": np.eye(4) + 1, "parts": 2, **arguments}
    with pytest.raises((coseg.UsageError, coseg.InputError), match=words):
        coseg.cluster(given.pop("features"), given.pop("parts"), **given)


def test_numbers_of_numpy_are_taken_like_those_of_python():
    shapes = [(CUBE, QUADS), (CUBE * 2, QUADS)]
    plain = coseg.segment(shapes, 2, alpha=0.5, feature_weights=[1, 0.5], **TINY)
    numpy = {**TINY, "patches": np.int64(TINY["patches"]), "choose": np.bool_(False)}
    other = coseg.segment(shapes, np.uint8(2), alpha=np.float64(0.5), feature_weights=np.array([1, 0.5]), **numpy)
    assert other.report["options"] == plain.report["options"]
    assert other.report["options"]["alpha"] == 0.5
    zero_d = coseg.segment(shapes, np.array(2), alpha=np.array(0.5), feature_weights=(1, np.float32(0.5)), links=8, **TINY)
    assert zero_d.report["options"] == {**plain.report["options"], "links": 8}


CUBE = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float)
QUADS = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
CAP = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7], [1, 7, 3]]


def test_every_kind_of_faces_keeps_its_place():
    class Trimesh:  # pylint: disable=too-few-public-methods
        vertices, faces = CUBE.astype(np.float32), np.array(QUADS, dtype=np.uint8)

    result = coseg.segment([(CUBE.tolist(), QUADS), (CUBE, CAP), Trimesh(), (CUBE.astype(int), [np.array(q) for q in CAP])],
                           2, **TINY)
    assert [len(labels) for labels in result.labels] == [6, 7, 6, 7]
    assert result.names == ["shape_0000", "shape_0001", "shape_0002", "shape_0003"]


@pytest.mark.parametrize("mesh, words", [
    ((CUBE[:, :2], QUADS), r"shape 1: the vertices have the shape \(8, 2\), not \(V, 3\)"),
    ((CUBE[0], QUADS), r"shape 1: the vertices have the shape \(3,\)"),
    ((CUBE.astype(str), QUADS), "shape 1: the vertices are of type <U"),
    ((CUBE.astype(complex), QUADS), "shape 1: the vertices are of type complex"),
    ((np.where(CUBE == CUBE[5], np.nan, CUBE), QUADS), "shape 1: vertex 0 has a coordinate that is not finite|shape 1: vertex"),
    ((CUBE * 1e300, QUADS), "shape 1: vertex"),
    ((CUBE, QUADS[:5] + [[1, 5, 7, 8]]), "shape 1: face 5 refers to vertex 8, but there are 8 vertices"),
    ((CUBE, QUADS[:2] + [[-1, 5, 7, 3]]), "shape 1: face 2 refers to vertex -1"),
    ((CUBE, CAP[:6] + [[1, 7, 2 ** 40]]), "shape 1: face 6 refers to vertex 1099511627776"),
    ((CUBE, np.array(QUADS[:4] + [[0, 1, 2, 2 ** 63 - 1]])), "shape 1: face 4 refers to vertex 9223372036854775807"),
    ((CUBE, np.array(QUADS, dtype=float)), "shape 1: the faces are of type float64, not whole numbers"),
    ((CUBE, np.array(QUADS)[:, :2]), r"shape 1: the faces have the shape \(6, 2\)"),
    ((CUBE, np.zeros((2, 2, 3), dtype=int)), r"shape 1: the faces have the shape \(2, 2, 3\)"),
    ((CUBE, [[[0, 1], [2, 3]], [1, 2, 3]]), "shape 1: face 0|shape 1: the faces"),
    ((CUBE, []), "shape 1: the mesh has no faces"),
    ((np.zeros((0, 3)), QUADS), "shape 1: face 0 refers to vertex 0, but there are 0"),
    ((CUBE * 0, QUADS), "shape 1: the mesh has no area"),
    (7, "shape 1: give a path, .*, not int"),
    ("missing.off", "missing.off: no such file"),
    (str(WORK), "is no mesh file|has no"),
])
def test_bad_shapes_are_exceptions_that_name_shape_and_face(mesh, words):
    WORK.mkdir(exist_ok=True)
    with pytest.raises(coseg.InputError, match=words) as error:
        coseg.segment([(CUBE, QUADS), mesh], 2, **TINY)
    assert error.value.code == 3
    if isinstance(mesh, tuple):
        with pytest.raises(coseg.InputError, match=words):
            coseg.describe([(CUBE, QUADS), mesh], **{k: TINY[k] for k in ("patches", "geodesic_samples")})


def test_alignment(run, tables):
    from_file = coseg.Result.load(run[0]).alignment
    called = coseg.segment(tables[::-1], 2, names=[mesh.name for mesh in tables[::-1]], **QUICK).alignment
    kept = json.loads((run[0] / "alignment.json").read_text())
    assert not kept["aligned"] and not called.aligned and called.reason == from_file.reason == kept["reason"]
    for key in ("rotations", "scales", "translations", "agreement", "residuals", "reflected", "found"):
        assert np.array_equal(getattr(called, key)[::-1], getattr(from_file, key)), key
    assert np.array_equal(from_file.translations, [shape["translation"] for shape in kept["shapes"]])
    placed = called.apply(3, tables[0].vertices)
    assert np.allclose(placed, tables[0].vertices @ called.matrices[3, :3, :3].T + called.matrices[3, :3, 3])
    assert np.abs(placed.mean(axis=0)).max() < 0.6 and 0.7 < placed.std() < 1.4
    added = coseg.assign(tables[:2], str(run[0])).alignment
    assert not added.aligned and np.array_equal(added.rotations, np.tile(np.eye(3), (2, 1, 1)))
    assert "run's shapes" in added.reason
    shapes = len(tables)
    for shape in (shapes, -1, 10 ** 30):
        with pytest.raises(coseg.UsageError, match=f"shape: {shape} is not in 0 .. {shapes - 1}"):
            called.apply(shape, tables[0].vertices)
    with pytest.raises(coseg.UsageError, match="shape: 1.5 is no whole number"):
        called.apply(1.5, tables[0].vertices)
    with pytest.raises(coseg.InputError, match="points are masked"):
        called.apply(0, np.ma.masked_greater(tables[0].vertices, 0))
    for points in ([1, 2, 3], np.ones((4, 2)), "abc", [[1, 2, 3], [4]]):
        with pytest.raises(coseg.InputError, match="the points must be N x 3 numbers"):
            called.apply(0, points)


def test_turned_shapes_are_turned_back():
    shapes = coseg.generate("quadruped", 6, seed=3, faces=1500)
    turns = [np.linalg.qr(np.random.default_rng(k).normal(size=(3, 3)))[0] for k in range(6)]
    turns = [turn * np.linalg.det(turn) for turn in turns]
    turned = [(3.0 * shape.vertices @ turn.T + k, shape.faces) for k, (shape, turn) in enumerate(zip(shapes, turns))]
    bad = (CUBE, QUADS[:5] + [[1, 5, 7, 8]])
    alignment = coseg.segment([bad] + turned, 4, patches=30, geodesic_samples=80, strict=False).alignment
    assert alignment.aligned and np.isnan(alignment.rotations[0]).all() and not alignment.found[0]
    assert np.allclose(np.linalg.det(alignment.rotations[1:]), 1) and not alignment.reflected.any()
    together = alignment.rotations[1:] @ np.array(turns)
    angles = [[np.degrees(np.arccos(np.clip((np.trace(a.T @ b) - 1) / 2, -1, 1))) for a in together] for b in together]
    assert min(np.sort(row)[4] for row in angles) < 15, np.round(angles)
    sizes = [alignment.apply(k, turned[k - 1][0]).std(axis=0) for k in range(1, 7)]
    assert 0.6 < np.min(np.linalg.norm(sizes, axis=1)) and np.max(np.linalg.norm(sizes, axis=1)) < 2.5


def test_bad_shapes_can_be_set_aside():
    bad = (CUBE, QUADS[:5] + [[1, 5, 7, 8]])
    result = coseg.segment([bad, (CUBE, QUADS), (CUBE * 2, QUADS)], 2, strict=False, **TINY)
    assert list(result.set_aside) == [0] and "shape 0: face 5 refers to vertex 8" in result.set_aside[0]
    assert result.labels[0] is None and len(result.labels[1]) == 6 and np.isnan(result.part_areas[0]).all()
    assert any("face 5" in warning for warning in result.warnings)


def test_a_loaded_result_has_the_shapes_that_were_set_aside():
    bad = (CUBE, QUADS[:5] + [[1, 5, 7, 8]])
    called = coseg.segment([(CUBE, QUADS), bad, (CUBE * 2, CAP), (CUBE * 3, QUADS)], 2, names=["d", "c", "b", "a"], strict=False,
                           out=WORK / "aside", sheet=False, html=False, **TINY)
    loaded = coseg.Result.load(WORK / "aside")
    assert loaded.names == called.names == ["d", "c", "b", "a"]
    assert loaded.set_aside == called.set_aside and list(loaded.set_aside) == [1]
    assert set(loaded.warnings) == set(called.warnings) and any("parts are asked for" in one for one in loaded.warnings)
    assert f"set aside: {called.set_aside[1]}" in loaded.warnings
    for mine, other in zip(loaded.labels + loaded.patches, called.labels + called.patches):
        assert np.array_equal(mine, other)
    assert np.array_equal(loaded.part_areas, called.part_areas, equal_nan=True)
    assert np.array_equal(loaded.alignment.matrices, called.alignment.matrices, equal_nan=True)
    assert np.isnan(loaded.alignment.scales[1]) and not loaded.alignment.found[1]
    (WORK / "bad file.off").write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 9\n")
    coseg.segment([(CUBE, QUADS), (CUBE, QUADS), WORK / "bad file.off"], 2, strict=False, out=WORK / "aside", replace=True,
                  sheet=False, html=False, **TINY)
    loaded = coseg.Result.load(WORK / "aside")
    assert loaded.names == ["shape_0000", "shape_0001", "bad file"] and list(loaded.set_aside) == [2]


@pytest.mark.parametrize("kind", ["labels", "patches"])
@pytest.mark.parametrize("line, words", [
    ("7777", "face 2 has 7777, which the run did not have"),
    ("-5", "face 2 has -5, which the run did not have"),
    ("4294967297", "face 2 has 4294967297, which the run did not have"),
    ("0.5", "a label file has one integer a line, but this line has '0.5'"),
    ("nan", "a label file has one integer a line"),
    ("1e300", "a label file has one integer a line"),
    ("1 1", "a label file has one integer a line"),
    ("1_0", "a label file has one integer a line"),
    ("", "labels for"),
])
def test_loading_refuses_labels_that_cannot_be(run, kind, line, words):
    folder = WORK / "spoilt"
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(run[0], folder)
    path = folder / kind / f"{run[1][1]}.seg"
    lines = path.read_text().split("\n")
    path.write_text("\n".join(lines[:2] + [line] + lines[3:]))
    with pytest.raises(coseg.InputError, match=words) as error:
        coseg.Result.load(folder)
    assert str(error.value).startswith(str(path))


@pytest.mark.parametrize("change", [lambda report: [], lambda report: {**report, "format": 3},
                                    lambda report: {k: v for k, v in report.items() if k != "optimisation"},
                                    lambda report: {**report, "meshes": [1]}, lambda report: {**report, "meshes": []},
                                    lambda report: {**report, "set_aside": [{"path": "shape 77", "reason": ""}]}])
def test_loading_refuses_reports_of_something_else(run, change):
    folder = WORK / "other_report"
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(run[0], folder)
    report = json.loads((folder / "report.json").read_text())
    (folder / "report.json").write_text(json.dumps(change(report)))
    if "format" in change(report) and change(report).get("set_aside"):
        assert len(coseg.Result.load(folder).names) == 5
        return
    with pytest.raises(coseg.InputError, match="report.json"):
        coseg.Result.load(folder)


def test_results_can_be_pickled_copied_and_compared():
    shapes = [(CUBE, QUADS), (CUBE * 2, CAP)]
    result = coseg.segment(shapes, 2, **TINY)
    again = pickle.loads(pickle.dumps(result))
    assert again != result and result == result and len({result, again}) == 2
    assert all(np.array_equal(a, b) for a, b in zip(again.labels, result.labels)) and again.report == result.report
    with pytest.raises(coseg.UsageError, match="its model was left out when it was pickled"):
        coseg.assign(shapes, again)
    kept = coseg.segment(shapes, 2, out=WORK / "pickled", sheet=False, html=False, **TINY)
    wanted = coseg.assign(shapes, result).labels
    for other in (copy.copy(result), copy.deepcopy(result), pickle.loads(pickle.dumps(kept))):
        assert all(np.array_equal(a, b) for a, b in zip(coseg.assign(shapes, other).labels, wanted))
    assert copy.deepcopy(result).labels[0] is not result.labels[0]
    matrices = [coseg.cluster(np.eye(4) + 1, 2) for _ in range(2)]
    meshes = coseg.generate("table", 2, faces=500)
    descriptions = coseg.describe(shapes, geodesic_samples=10)
    for first, second in (matrices, meshes, descriptions, [result.alignment, again.alignment]):
        assert first != second and first == first  # pylint: disable=comparison-with-itself
        pickle.loads(pickle.dumps(first))


def test_arrays_of_a_mesh():
    for faces in (np.array(QUADS), QUADS, [np.array(face) for face in QUADS]):
        _, corners, offsets = coseg.Mesh(CUBE, faces).arrays()
        assert corners.tolist() == sum(QUADS, []) and offsets.tolist() == list(range(0, 25, 4))
    for faces in ([], np.empty((0, 3), dtype=int), np.empty(0, dtype=int)):
        _, corners, offsets = coseg.Mesh(CUBE, faces).arrays()
        assert len(corners) == 0 and offsets.tolist() == [0]


def test_faces_with_fewer_than_three_corners_keep_their_place():
    result = coseg.segment([(CUBE, QUADS + [[0], [1, 2]]), (CUBE, QUADS)], 2, **TINY)
    assert len(result.labels[0]) == 8


@pytest.mark.parametrize("arguments, words", [
    (dict(meshes=[]), "no shape is given"),
    (dict(meshes=(CUBE, QUADS)), "shape 0: give a path"),
    (dict(meshes=CUBE), "must be a list"),
    (dict(parts=0), "parts: 0 is not in 1"),
    (dict(parts=2.5), "parts: 2.5 is no whole number"),
    (dict(parts=500), "parts 500 exceeds the 8 patches"),
    (dict(patchs=3), "did you mean 'patches'"),
    (dict(out_=3), "'out' is no option"),
    (dict(patches=1), "patches"),
    (dict(patches="many"), "patches"),
    (dict(alpha=float("nan")), "alpha"),
    (dict(names=["a"]), "there are 1 for 2"),
    (dict(names=["a", "a"]), "two shapes are named 'a'"),
    (dict(names=["a", "../b"]), "without '/'"),
    (dict(feature_weights=[0, 0, 0, 0, 0]), "at least one"),
    (dict(comm=3), "comm"),
    (dict(meshes=5), "the meshes: give a list"),
    (dict(meshes={"a": 1}), "the meshes: give a list"),
    (dict(meshes=[(CUBE, QUADS), (np.ma.masked_greater(CUBE, 0.5), QUADS)]), "shape 1: vertices are masked"),
    (dict(parts=10 ** 30), "parts: 1000000000000000000000000000000 is not in 1"),
    (dict(parts=True), "parts: True is no whole number"),
    (dict(names=["a", None]), "names: None, of shape 1, is no text"),
    (dict(names="ab"), "names: give a list"),
    (dict(out=3), "3 is no path"),
    (dict(state=5), "5 is no path"),
    (dict(progress=5), "progress: 5 is no function"),
    (dict(seed=-1), "seed: -1"),
    (dict(seed=1.5), "seed: 1.5 is no whole number"),
    (dict(parts=[2]), r"parts: \[2\] is no whole number"),
    (dict(parts=np.array([2])), r"parts: array\(\[2\]\) is no whole number"),
    (dict(parts="two"), "parts: 'two' is neither a whole number nor 'auto'"),
    (dict(parts=None), "parts: None is no whole number"),
    (dict(patches=[3]), r"patches: \[3\] is no whole number"),
    (dict(patches=(3,)), r"patches: \(3,\) is no whole number"),
    (dict(patches=np.array([3])), r"patches: array\(\[3\]\) is no whole number"),
    (dict(patches="3"), "patches: '3' is no whole number"),
    (dict(patches=3.0), "patches: 3.0 is no whole number"),
    (dict(patches=-3), "patches: .*-3"),
    (dict(oversegmentations=True), "oversegmentations: True is no text"),
    (dict(max_iterations=2 ** 70), "max-iterations: .*1180591620717411303424"),
    (dict(alpha=True), "alpha: True is no number"),
    (dict(alpha=[0.1]), r"alpha: \[0.1\] is no number"),
    (dict(alpha="0.1"), "alpha: '0.1' is no number"),
    (dict(alpha=1j), "alpha: 1j is no number"),
    (dict(alpha=np.array([0.1])), r"alpha: array\(\[0.1\]\) is no number"),
    (dict(lambda_=float("inf")), "lambda_: inf is not finite"),
    (dict(beta=-1.0), "beta: .*-1"),
    (dict(gap=10 ** 400), "gap: 1000*0 is not finite"),
    (dict(feature_weights=[1, float("nan")]), "feature_weights: nan is not finite"),
    (dict(feature_weights=[1, True]), "feature_weights: True is no number"),
    (dict(feature_weights="1,0"), "feature_weights: '1,0' is no number"),
    (dict(feature_weights=[[1, 0], [1]]), r"feature_weights: \[1, 0\] is no number"),
    (dict(feature_weights=np.ones((1, 2))), r"feature_weights: array\(\[1., 1.\]\) is no number"),
    (dict(feature_weights=[]), r"feature_weights: \[\] is no list of numbers"),
    (dict(feature_weights={"a": 1}), "feature_weights: {'a': 1} is no number"),
    (dict(feature_weights=[-1]), "feature-weights: .*-1"),
    (dict(choose=1), "choose: 1 is neither True nor False"),
    (dict(choose="no"), "choose: 'no' is neither True nor False"),
    (dict(choose=[False]), r"choose: \[False\] is neither True nor False"),
    (dict(remesh=["never"]), r"remesh: \['never'\] is no text"),
    (dict(remesh=True), "remesh: True is no text"),
    (dict(remesh=""), "remesh: has an empty value; give one, or leave it out"),
    (dict(examples=""), "examples: has an empty value"),
    (dict(constraints="", seed=3), "constraints: has an empty value"),
    (dict(preset=""), "preset: has an empty value"),
    (dict(out=""), "out: has an empty value"),
    (dict(state=""), "state: has an empty value"),
    (dict(out="\ud800"), "cannot be written as the name of a file"),
    (dict(names=["a", "\ud800"]), "names: .*, of shape 1, has a character that is none"),
    (dict(preset="\ud800"), "preset: .* has a character that is none"),
    (dict(meshes=["\ud800.off", (CUBE, QUADS)]), "cannot be written as the name of a file"),
    (dict(patches__=10), "'patches__' is no option; did you mean 'patches'"),
    (dict(meshes=["", (CUBE, QUADS)]), "'' is no path, as it is empty"),
    (dict(meshes=""), "'' is no path, as it is empty"),
    (dict(lambda__=10), "'lambda__' is no option; did you mean 'lambda_'"),
    (dict(patches_=10), "'patches_' is no option; did you mean 'patches'"),
    (dict(remesh="never\0"), "remesh"),
    (dict(preset="\udcff"), "preset"),
    (dict(links=[8]), r"links: \[8\] is no text"),
    (dict(links=float("nan")), "links: nan is not finite"),
    (dict(links=1), "links: 1 is none of auto"),
    (dict(view=(30, 20)), r"view: \(30, 20\) is no text"),
    (dict(patchs=[3]), "did you mean 'patches'"),
    (dict(strict="no"), "strict: 'no' is neither True nor False"),
    (dict(strict=1), "strict: 1 is neither True nor False"),
    (dict(replace=0), "replace: 0 is neither True nor False"),
    (dict(keep_model="yes"), "keep_model: 'yes' is neither True nor False"),
    (dict(comm=True), "comm: give a communicator"),
    (dict(meshes=[(CUBE, QUADS), (CUBE, np.ma.masked_equal(QUADS, 7))]), "shape 1: faces are masked"),
    (dict(meshes=[(CUBE, QUADS), (CUBE.astype(bool), QUADS)]), "shape 1: the vertices are of type bool"),
    (dict(meshes=[(CUBE, QUADS), (CUBE.astype(object), QUADS)]), "shape 1: the vertices are of type object"),
    (dict(seed=2 ** 64), "seed: 18446744073709551616 is more than"),
    (dict(align="maybe"), "align: maybe"),
])
def test_bad_arguments_are_exceptions(arguments, words):
    given = {"meshes": [(CUBE, QUADS), (CUBE, QUADS)], "parts": 2, **TINY, **arguments}
    with pytest.raises((coseg.UsageError, coseg.InputError), match=words):
        coseg.segment(given.pop("meshes"), given.pop("parts"), **given)


@pytest.mark.parametrize("call, words", [
    (lambda: coseg.assign([(CUBE, QUADS)], 5), "5 is no path"),
    (lambda: coseg.Result.load(5), "5 is no path"),
    (lambda: coseg.Result.load(None), "folder: give the folder of a run, not None"),
    (lambda: coseg.Result.load(""), "folder: has an empty value"),
    (lambda: coseg.assign([(CUBE, QUADS)], None), "to: give the folder of a run, not None"),
    (lambda: coseg.load_mesh(5), "5 is no path"),
    (lambda: coseg.load_mesh(""), "'' is no path, as it is empty"),
    (lambda: coseg.mesh_files(""), "'' is no path, as it is empty"),
    (lambda: coseg.load_mesh("\ud800"), "cannot be written as the name of a file"),
    (lambda: coseg.generate("\ud800"), "has a character that is none"),
    (lambda: coseg.SubspaceClustering(foo=1), "'foo' is no parameter of SubspaceClustering"),
    (lambda: coseg.SubspaceClustering().set_params(n_clusters=3, foo=1), "'foo' is no parameter of SubspaceClustering"),
    (lambda: coseg.draw([(CUBE, QUADS), (CUBE, CAP[:6] + [[1, 7, 8]])], [None] * 2), "shape 1: face 6 refers to vertex 8, but there are 8"),
    (lambda: coseg.draw([(CUBE, [[0, 1, 2], [0, 1, -1]])], [None]), "shape 0: face 1 refers to vertex -1"),
    (lambda: coseg.draw([(np.where(CUBE == 1, np.nan, CUBE), QUADS)], [None]), "shape 0: vertex 1 has a coordinate that is not finite"),
    (lambda: coseg.draw([(CUBE, [])], [None]), "shape 0: the mesh has no faces"),
    (lambda: coseg.draw([(CUBE, [[0, 1], [2]])], [None]), "shape 0: no face has three corners"),
    (lambda: coseg.score([(CUBE, QUADS)], None, [[1] * 6]), "labels: give a list"),
    (lambda: coseg.score([(CUBE, QUADS)], [[1] * 5], [[1] * 6]), "shape 0: 5 labels for 6 faces"),
    (lambda: coseg.generate(5), "no family '5'"),
    (lambda: coseg.generate("table", 2.5), "count: 2.5 is no whole number"),
    (lambda: coseg.draw([(CUBE, QUADS)], [[1] * 5]), "shape 0: 5 labels for 6 faces"),
    (lambda: coseg.draw([(CUBE, QUADS)], []), "1 shapes and 0 arrays"),
    (lambda: coseg.draw([(CUBE, QUADS)], [[1] * 6], up="w"), "up: 'w' is none of"),
    (lambda: coseg.draw([(CUBE, QUADS)], [[1] * 6], up=["z"]), "up: .* is none of"),
    (lambda: coseg.draw([(CUBE, QUADS)], [[1] * 6], columns=0), "columns: 0 is not positive"),
    (lambda: coseg.draw([(CUBE, QUADS)], [[1] * 6], columns=1.5), "columns: 1.5 is no whole number"),
    (lambda: coseg.draw([(CUBE, QUADS)], [[1] * 6], size=-1), "size: -1 is not positive"),
    (lambda: coseg.draw([(CUBE, QUADS)], [[1] * 6], size=float("nan")), "size: nan is not finite"),
    (lambda: coseg.describe([(CUBE, QUADS)], patches=[3]), r"patches: \[3\] is no whole number"),
    (lambda: coseg.describe([(CUBE, QUADS)], progress=5), "progress: 5 is no function"),
    (lambda: coseg.score([(CUBE, QUADS)], [np.ma.masked_equal([1] * 6, 1)], [[1] * 6]), "shape 0: the labels are masked"),
    (lambda: coseg.score([(CUBE, QUADS)], [[1.0] * 6], [[1] * 6]), "shape 0: the labels must be F whole numbers"),
    (lambda: coseg.score([(CUBE, QUADS)], [[[1]] * 6], [[1] * 6]), "shape 0: the labels must be F whole numbers"),
    (lambda: coseg.generate("table", True), "count: True is no whole number"),
    (lambda: coseg.generate("table", [2]), r"count: \[2\] is no whole number"),
    (lambda: coseg.generate(["table"]), "no family"),
    (lambda: coseg.mesh_files(), "no shape|no mesh"),
])
def test_bad_arguments_of_other_functions_are_exceptions(call, words):
    with pytest.raises((coseg.UsageError, coseg.InputError), match=words):
        call()


def test_progress_tells_all_stages_and_may_end_the_call(tables):
    seen = []
    coseg.segment(tables, 2, progress=lambda *told: seen.append(told), **QUICK)
    stages = list(dict.fromkeys(stage for stage, _, _ in seen))
    assert stages[:3] == ["describe", "features", "optimise"] and stages[-1] == "label"
    assert ("describe", 3, 4) in seen and ("label", 1, 1) in seen

    def stop(stage, done, total):
        if stage == "optimise":
            raise LookupError(f"{done} of {total}")
    with pytest.raises(LookupError, match="0 of 0"):
        coseg.segment(tables, 2, progress=stop, **QUICK)

    def call_again(*_):
        coseg.cluster(np.eye(4) + 1, 2)
    with pytest.raises(coseg.UsageError, match="another call"):
        coseg.segment(tables, 2, progress=call_again, **QUICK)
    assert coseg.segment(tables[:2], 2, **TINY).parts == 2


def test_the_interpreter_is_free_and_ctrl_c_works(tables):
    ticks = []
    timer = threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT))
    beat = threading.Thread(target=lambda: [ticks.append(time.sleep(0.01)) for _ in range(20)])
    beat.start()
    timer.start()
    start = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        while True:
            coseg.describe([mesh for mesh in tables for _ in range(40)], geodesic_samples=300)
    assert time.monotonic() - start < 5
    assert len(ticks) > 5
    beat.join()
    assert coseg.segment(tables[:2], 2, **TINY).parts == 2


def test_ctrl_c_ends_generate():
    threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    start = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        coseg.generate("table", 100000, faces=500)
    assert time.monotonic() - start < 5


LEAVES = """
import os, sys, time
from sys import exit as early_exit
import coseg
how, first = sys.argv[1], os.environ["OMPI_COMM_WORLD_RANK"] == "0"
coseg.cluster([[2, 1], [1, 2], [2, 1], [1, 2]], 2, comm="world")
if how == "works on":
    try:
        sys.exit("caught")
    except SystemExit as error:
        assert error.code == "caught" and type(error).__name__ == "SystemExit"
    time.sleep(7 if first else 0)
    print("rank 0 has worked on" if first else "", flush=True)
    sys.exit(0)
if not first and how == "raised":
    raise SystemExit(how)
if not first:
    early_exit(how) if how == "early" else sys.exit(how)
coseg.cluster([[2, 1], [1, 2], [2, 1], [1, 2]], 2, comm="world")
"""


@pytest.mark.parametrize("how, code, words", [("a reason to end", 1, "a reason to end"), ("raised", 1, "raised"),
                                              ("early", 1, "early"), ("works on", 0, "rank 0 has worked on")])
def test_a_process_that_exits_ends_the_others_only_if_it_fails(how, code, words):
    answer = subprocess.run(["mpirun", "--oversubscribe", "-n", "2", sys.executable, "-c", LEAVES, how], env=dict(os.environ),
                            capture_output=True, text=True, check=False, timeout=60)
    assert answer.returncode == code and words in answer.stdout + answer.stderr, answer


def resident_mib():
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 2 ** 20


def test_a_thousand_calls_keep_no_memory():
    shapes = [(CUBE, QUADS), (CUBE * 2, QUADS)]

    def call(number):
        coseg.segment(shapes, 2, remesh="never", align="off", refine="none", keep_model=False, **TINY)
        coseg.cluster(np.eye(6)[:, :3] + 0.1, 2)
        if number % 100 == 0:  # those that take longer
            coseg.assign(shapes[:1], coseg.segment(shapes, 2, **TINY))
            coseg.describe(shapes, geodesic_samples=10)
            with pytest.raises(coseg.InputError):
                coseg.segment([(CUBE, QUADS), (CUBE, [[0, 1, 9]])], 2, **TINY)
    for number in range(101):
        call(number)
    before = resident_mib()
    for number in range(1000):
        call(number)
    assert resident_mib() - before < 1


def test_draw(tables):
    result = coseg.Result.load(WORK / "run") if (WORK / "run").exists() else coseg.segment(tables, 2, **TINY)
    figure = coseg.draw(tables + [(CUBE, CAP)], result.labels + [np.arange(7)], columns=3)
    assert len(figure.axes) == 5
    figure.savefig(WORK / "picture.png")
    assert (WORK / "picture.png").stat().st_size > 5000


def test_the_module_says_what_it_is():
    assert coseg.__version__ == program("--version").split("\n")[0].split()[1]
    assert "patches" in coseg.option_names() and "out" not in coseg.option_names()
    for name in coseg.__all__:
        value = getattr(coseg, name)
        assert value.__doc__ or not (inspect.isclass(value) or inspect.isfunction(value)), name
        if inspect.isfunction(value):
            hints = inspect.signature(value)
            assert hints.return_annotation is not inspect.Signature.empty, name
            assert all(one.annotation is not inspect.Parameter.empty for one in hints.parameters.values()), name
