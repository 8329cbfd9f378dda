"""bindpose deform: poses whose result is known, sequences, and invalid poses."""

import json

import bindpose
import numpy as np
import pytest
import shapes
from bindpose.meshes import add_point_array, points_of, to_dataset
from vtkmodules.util import numpy_support

METHODS = ["lbs", "dqs", "stbs", "cor", "reduced-arap", "full-arap", "mls"]


@pytest.fixture
def bar(folder):
    """Write a bar whose weights blend linearly between its ends, so that no solver is needed."""
    mesh = to_dataset(shapes.bar())
    x = points_of(mesh)[:, 0] / 6
    add_point_array(mesh, "Weights", np.stack([1 - x, x], axis=1), ["b1", "b2"])
    bindpose.write(mesh, folder / "bar.vtp")
    folder.write("h.tgf", shapes.TWO_BONES)
    folder.points = points_of(mesh)
    return folder


def deform(folder, pose, *more, method="lbs", output="out.vtp"):
    folder.write("pose.json", pose if isinstance(pose, str) else json.dumps(pose))
    return folder.run("deform", "bar.vtp", "--handles", "h.tgf", "--pose", "pose.json", "--method", method,
                      "-o", output, *more)


def test_children_follow_their_parents(bar):
    turn = {"rotate": {"axis": [0, 0, 1], "degrees": 90}}
    result = deform(bar, {"version": 2, "handles": {"b1": turn}}).is_good()
    assert result.err == ""
    x, y, z = bar.points.T
    turned = np.stack([1 - y, x, z], axis=1)  # rotation about (0.5, 0.5)
    assert points_of(bindpose.read(bar / "out.vtp")) == pytest.approx(turned, abs=1e-12)
    # In version 1 of the pose format, the child b2 does not move with its parent. The program warns about this only
    # once, even for a sequence of several poses.
    result = deform(bar, {"frames": [{"handles": {"b1": turn}}] * 3}, output="old.vtp").is_good()
    assert result.err.count("warning") == 1 and '"version": 2' in result.err
    ends = points_of(bindpose.read(bar / "old_0002.vtp"))[x == 6]
    assert ends == pytest.approx(bar.points[x == 6], abs=1e-12)


@pytest.mark.parametrize("method", METHODS)
def test_rest_and_rigid_poses(bar, method):
    deform(bar, {"handles": {}}, method=method).is_good()
    assert points_of(bindpose.read(bar / "out.vtp")) == pytest.approx(bar.points, abs=1e-8)
    turn = {"rotate": {"axis": [0, 0, 1], "degrees": 90}}
    # Each bone rotates about its own head. The translation of the second bone keeps its head at the tail of the first.
    pose = {"handles": {"b1": turn, "b2": {**turn, "translate": [-2.5, 2.5, 0]}}}
    deform(bar, pose, "--overwrite", method=method).is_good()
    head = np.array([0.5, 0.5, 0.5])
    x = bar.points - head
    expected = head + np.stack([-x[:, 1], x[:, 0], x[:, 2]], axis=1)
    assert points_of(bindpose.read(bar / "out.vtp")) == pytest.approx(expected, abs=1e-8)


@pytest.mark.parametrize("method", ["reduced-arap", "full-arap"])
def test_translated_handles_turn_freely(bar, method):
    def posed(pose):
        deform(bar, pose, "--overwrite", method=method).is_good()
        return points_of(bindpose.read(bar / "out.vtp"))

    up = {"translate": [-0.5, 2, 0]}
    found = posed({"version": 2, "handles": {"b2": {**up, "space": "world"}}})
    position = {"mode": "position"}
    full = {"mode": "full"}
    assert found == pytest.approx(posed({"version": 2, "handles": {"b1": full, "b2": {**position, **up, "space": "world"}}}),
                                  abs=1e-12)
    sheared = posed({"version": 2, "handles": {"b1": full, "b2": {**full, **up, "space": "world"}}})
    assert abs(found - sheared).max() > 0.1
    # Lengths along the bar change less if the method also computes the rotation of the handle b2.
    def strain(points):
        steps = np.linalg.norm(points[1:] - points[:-1], axis=1) / np.linalg.norm(bar.points[1:] - bar.points[:-1], axis=1)
        return np.abs(steps - 1).max()
    assert strain(found) < strain(sheared)


def test_linear_blend_is_linear(bar):
    deform(bar, {"handles": {"b2": {"translate": [0, 1, 2]}}}).is_good()
    x = bar.points[:, :1] / 6
    assert points_of(bindpose.read(bar / "out.vtp")) == pytest.approx(bar.points + x * [0, 1, 2], abs=1e-12)


def test_report(bar):
    report = deform(bar, shapes.BENT, "--report", "-", method="reduced-arap").is_good().report
    assert report["status"] == "ok" and report["energy"] >= 0 and report["iterations"] >= 1
    assert report["microseconds_per_iteration"] > 0
    assert {"bind", "solve", "skin", "total"} <= set(report["seconds"])
    assert report["counts"]["handles"] == 2 and report["counts"]["vertices"] == len(bar.points)
    report = deform(bar, shapes.BENT, "--report", "-", "--overwrite").is_good().report
    assert {"bind", "skin"} <= set(report["seconds"]) and "energy" not in report


@pytest.mark.parametrize("method", METHODS)
def test_an_ignored_stretch_is_said_once(bar, method):
    frames = [{"handles": {"b1": {"twist": [0, 20 * k]}, "b2": {"stretch": 1 + 0.1 * k}}} for k in range(4)]
    run = deform(bar, {"version": 2, "frames": frames}, method=method).is_good()
    said = [line for line in run.err.splitlines() if "stretches or twists bones" in line]
    assert len(said) == (0 if method == "stbs" else 1), run.err
    if method == "lbs":
        run = deform(bar, {"version": 2, **frames[3]}, output="posed.glb").is_good()
        assert run.err.count("stretches or twists bones") == 1  # glTF joints support neither stretch nor twist
    # If the posed ends of a bone preserve its length up to round-off, the bone is not stretched.
    ends = {"handles": {"b1": {"mode": "full"}, "b2": {"head": [3, 0.5, 0.5], "tail": [3, 3, 0.5]}}}
    assert "stretches" not in deform(bar, {"version": 2, **ends}, "--overwrite", method=method).is_good().err


@pytest.mark.parametrize("method", METHODS)
def test_sequences(bar, method):
    frames = [{"handles": {"b2": {"rotate": {"axis": [0, 0, 1], "degrees": 10 * k}}}} for k in range(3)]
    run = deform(bar, {"frames": frames, "fps": 4}, "--report", "r.json", method=method).is_good()
    assert run.new_files == ["out.pvd", "out_0000.vtp", "out_0001.vtp", "out_0002.vtp", "r.json"]
    collection = (bar / "out.pvd").read_text()
    assert 'timestep="0.25" file="out_0001.vtp"' in collection
    assert json.loads((bar / "r.json").read_text())["counts"]["frames"] == 3
    # The solve of a frame starts from the previous frame, and the solve of a single pose starts from the rest pose. The
    # two results are equal up to a tolerance.
    deform(bar, frames[2], method=method, output="single.vtp").is_good()
    assert points_of(bindpose.read(bar / "single.vtp")) == pytest.approx(
        points_of(bindpose.read(bar / "out_0002.vtp")), abs={"reduced-arap": 5e-4, "full-arap": 1e-3}.get(method, 1e-12))


def test_a_variational_surface_needs_no_weights(folder):
    n = 8
    x, y = np.meshgrid(np.arange(n + 1) / n, np.arange(n + 1) / n)
    points = np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1)
    corner = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
    triangles = np.concatenate([np.stack([corner, corner + 1, corner + n + 2], axis=1),
                                np.stack([corner, corner + n + 2, corner + n + 1], axis=1)])
    depth = np.rint(np.minimum(points, 1 - points)[:, :2].min(axis=1) * n)
    mesh = to_dataset((points, triangles))
    add_point_array(mesh, "Fixed", 1.0 * (depth < 2))
    bindpose.write(mesh, folder / "bar.vtp")
    folder.write("h.tgf", "1 0.5 0.5 0\n#\n#\n1\n")
    middle = len(points) // 2
    pose = {"handles": {"p1": {"translate": [0, 0, 1]}}}
    heights = {}
    for words in (["--order", "1"], ["--order", "3"], ["--boundary", "tangent", "--tangent-source", "clamped"], ["--fair"]):
        deform(folder, pose, *words, "--overwrite", method="variational").is_good()
        posed = points_of(bindpose.read(folder / "out.vtp"))
        assert posed[middle] == pytest.approx([0.5, 0.5, 1]) and np.array_equal(posed[depth < 2], points[depth < 2])
        heights[words[1] if len(words) > 1 else ""] = posed[middle + 1, 2]
    assert heights["1"] < heights["tangent"] and heights["1"] < heights["3"]  # order 1 gives a membrane, which sags
    deform(folder, pose, "--order", "4", method="variational").is_refused("4", code=1)

    # Fairing needs no handles. The patch between the fixed points becomes flat, for any initial shape.
    bent = points + np.where(depth >= 2, 0.3, 0)[:, None] * [0, 0, 1]
    mesh = to_dataset((bent, triangles))
    add_point_array(mesh, "Fixed", 1.0 * (depth < 2))
    bindpose.write(mesh, folder / "bent.vtp")
    fair = ["deform", "bent.vtp", "--method", "variational"]
    folder.run(*fair, "--fair", "-o", "fair.vtp", "--report", "f.json").is_good()
    flat = points_of(bindpose.read(folder / "fair.vtp"))
    assert flat == pytest.approx(points_of(bindpose.fair(mesh)), abs=1e-12)
    assert abs(flat[:, 2]).max() < 1e-12
    assert json.loads((folder / "f.json").read_text())["counts"]["constrained"] == int((depth < 2).sum())
    folder.run(*fair, "-o", "x.vtp").is_refused("--handles is required", code=1)
    folder.run(*fair, "--fair", "--handles", "h.tgf", "-o", "x.vtp").is_refused("--pose is required")
    folder.run(*fair, "--fair", "-o", "x.glb").is_refused("cannot write .glb")


def test_single_precision_and_few_influences(bar):
    deform(bar, shapes.BENT, output="exact.vtp").is_good()
    deform(bar, shapes.BENT, "--single-precision", output="single.vtp").is_good()
    deform(bar, shapes.BENT, "--maximum-influences", "1", "--report", "r.json", output="one.vtp").is_good()
    deform(bar, shapes.BENT, "--smallest-weight", "0.1", output="few.vtp").is_good()
    exact, single, one = (points_of(bindpose.read(bar / f"{name}.vtp")) for name in ("exact", "single", "one"))
    assert 0 < abs(single - exact).max() < 1e-5 and abs(one - exact).max() > 1e-3
    assert json.loads((bar / "r.json").read_text())["dropped_share"] > 0.1


def test_poses_of_libigl(bar):
    x = points_of(bindpose.read(bar / "bar.vtp"))
    turn = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]])
    block = np.vstack([turn.T, [1, 2, 3]])  # transposed, because the result is (p, 1) times the block
    pose = np.vstack([block, block])

    def dmat(name, matrix):
        matrix = np.asarray(matrix, dtype=float)
        bar.write(name, f"{matrix.shape[1]} {matrix.shape[0]}\n" + "\n".join(map(repr, map(float, matrix.T.ravel()))) + "\n")
        return bar.run("deform", "bar.vtp", "--handles", "h.tgf", "--pose", name, "-o", "out.vtp", "--overwrite")

    dmat("pose.dmat", pose).is_good()
    assert points_of(bindpose.read(bar / "out.vtp")) == pytest.approx(x @ turn.T + [1, 2, 3], abs=1e-12)
    # The matrix contains the rotations of both bones as quaternions. The second rotation already includes the first
    # one, so the second bone must not move with its parent.
    half = np.sqrt(0.5)
    dmat("turns.dmat", np.array([[0, 0, half, half, 0, 0, 0, 1]]).T).is_good()
    head = [float(c) for c in (bar / "h.tgf").read_text().splitlines()[0].split()[1:4]]
    assert points_of(bindpose.read(bar / "out.vtp")) == pytest.approx((x - head) @ turn.T + head, abs=1e-12)
    dmat("short.dmat", pose[:7]).is_refused("short.dmat", "7 x 3", "8 x 3", "6 x 2", "8 x 1")
    dmat("nan.dmat", np.full((8, 3), np.nan)).is_refused("nan.dmat", "finite")
    bar.write("broken.dmat", "3 8\n1 2")
    bar.run("deform", "bar.vtp", "--handles", "h.tgf", "--pose", "broken.dmat", "-o", "x.vtp").is_refused("broken.dmat")


def test_a_sequence_is_there_whole_or_not_at_all(bar):
    frames = [{"handles": {}}, {"handles": {}}]
    bar.write("out_0001.vtp", "precious")
    deform(bar, {"frames": frames})  # this also writes pose.json
    deform(bar, {"frames": frames}).is_refused("out_0001.vtp", "the file exists")
    assert (bar / "out_0001.vtp").read_text() == "precious"
    assert not (bar / "out_0000.vtp").exists()


def test_a_sequence_that_fails_leaves_what_was_there(bar):
    good = {"handles": {"b2": {"translate": [0, 1, 0]}}}
    deform(bar, {"frames": [good, good]}).is_good()
    before = (bar / "out_0000.vtp").read_bytes()
    # The last frame of the sequence cannot be written, because a folder has the name of its file.
    (bar / "out_0001.vtp").unlink()
    (bar / "out_0001.vtp").mkdir()
    deform(bar, {"frames": [{"handles": {}}, {"handles": {}}]}, "--overwrite").is_refused("out_0001.vtp")
    assert (bar / "out_0000.vtp").read_bytes() == before


def test_tets_and_other_endings(bar):
    folder = bar
    tets = to_dataset((6 * np.eye(4, 3), np.array([[3, 0, 1, 2]])))
    x = points_of(tets)[:, 0] / 6
    add_point_array(tets, "Weights", np.stack([1 - x, x], axis=1), ["b1", "b2"])
    bindpose.write(tets, folder / "tw.vtu")
    folder.write("pose.json", shapes.BENT)
    for ending in ("vtu", "mesh"):
        folder.run("deform", "tw.vtu", "--handles", "h.tgf", "--pose", "pose.json", "-o", f"o.{ending}").is_good()
        assert bindpose.read(folder / f"o.{ending}").GetNumberOfCells() == tets.GetNumberOfCells()
    folder.run("deform", "tw.vtu", "--handles", "h.tgf", "--pose", "pose.json", "-o", "o.vtp").is_refused("o.vtp")
    deform(bar, shapes.BENT, output="o.obj").is_good()


@pytest.mark.parametrize("pose, words", [
    ('{"handles": {"elbow": {}}}', ["elbow"]),
    ('{"handles": {"b1": {"rotate": {"axis": [0, 0, 0], "degrees": 5}}}}', ["b1"]),
    ('{"handles": {"b1": {"scale": -1}}}', ["b1"]),
    ('{"handles": {"b1": {"translate": [1, 2]}}}', ["b1"]),
    ('{"handles": {"b1": {"mode": "half"}}}', ["b1"]),
    ('{"handles": {"b1": {"turn": 3}}}', ["turn"]),
    ('{"handles": {"b1": {"translate": [1, 2, 1e999]}}}', []),
    ('{"handles": ', []),
    ("", []),
    ("[]", []),
    ('{"frames": []}', []),
])
def test_poses_that_cannot_be(bar, pose, words):
    deform(bar, {"handles": {}}, output="first.vtp").is_good()  # this also writes pose.json
    deform(bar, pose).is_refused(*words)


def test_meshes_that_do_not_fit(bar):
    bar.write("pose.json", shapes.BENT)
    bar.off("plain.off", shapes.bar())

    def refused(*words, mesh="bar.vtp", handles="h.tgf", pose="pose.json", output="out.vtp"):
        bar.run("deform", mesh, "--handles", handles, "--pose", pose, "-o", output).is_refused(*words)

    refused("Weights", mesh="plain.off")
    bar.write("three.tgf", "1 0 0 0\n2 1 0 0\n3 2 0 0\n#\n")
    bar.write("three.json", "{}")
    refused(handles="three.tgf", pose="three.json")
    refused("none.json", pose="none.json")
    refused("none.tgf", handles="none.tgf")
    refused("no/out.vtp", output="no/out.vtp")
    refused("out.doc", output="out.doc")


def test_expressions_give_frames(bar):
    pose = {"handles": {"b2": {"translate": [0, "3 * t", 0]}}}
    deform(bar, pose, "--frames", "3", "--time-step", "0.5").is_good()
    x = bar.points[:, :1] / 6
    for k in range(3):
        posed = points_of(bindpose.read(bar / f"out_{k:04d}.vtp"))
        assert posed == pytest.approx(bar.points + x * [0, 1.5 * k, 0], abs=1e-12)
    assert 'timestep="0.5" file="out_0001.vtp"' in (bar / "out.pvd").read_text()
    deform(bar, {"handles": {}}, "--frames", "3", "--overwrite").is_refused("--frames needs a pose with expressions")
    bad = {"handles": {"b2": {"translate": [0, "sqrt(0.3 - t)", 0]}}}
    deform(bar, bad, "--frames", "3", "--time-step", "0.5", "--overwrite").is_refused("not a finite number at t = 0.5")


def test_dynamics_falls_and_replays(bar):
    pose = {"handles": {"b1": {"mode": "free"}, "b2": {"mode": "free"}}}
    fall = ("--dynamics", "--frames", "4", "--time-step", "0.1", "--gravity", "0,-10,0")
    report = deform(bar, pose, *fall, "--report", "-").is_good().report
    assert report["counts"]["frames"] == 4
    posed = [points_of(bindpose.read(bar / f"out_{k:04d}.vtp")) for k in range(4)]
    for n in range(4):
        assert posed[n] == pytest.approx(bar.points - [0, 0.1 * n * (n + 1) / 2, 0], abs=1e-9)
    deform(bar, pose, *fall, "--threads", "1", "--overwrite").is_good()
    assert np.array_equal(points_of(bindpose.read(bar / "out_0003.vtp")), posed[3])
    deform(bar, pose, "--dynamics", "--gravity", "1,2", "--overwrite").is_refused("--gravity", "3 numbers", code=1)
    deform(bar, pose, "--dynamics", "--time-step", "0", "--overwrite").is_refused("--time-step", "above 0", code=1)
    # If a pose becomes invalid during the sequence, the error message is one sentence.
    bad = {"handles": {"b2": {"translate": [0, "sqrt(0.15 - t)", 0]}}}
    deform(bar, bad, *fall, "--overwrite").is_refused("not a finite number at t = 0.2")


def test_a_time_budget_is_repeated_by_its_iterations(bar):
    first = deform(bar, shapes.BENT, "--time-budget", "1", "--tolerance", "1e-15", "--report", "-", method="reduced-arap")
    assert first.code == 3 and first.report["iterations"] == 2  # one iteration in single and one in double precision
    expected = points_of(bindpose.read(bar / "out.vtp"))
    deform(bar, shapes.BENT, "--maximum-iterations", "2", "--tolerance", "0", "--overwrite", method="reduced-arap").is_good()
    assert np.array_equal(points_of(bindpose.read(bar / "out.vtp")), expected)


def test_extra_weights(bar):
    for kind in ("bumps", "eigenmodes"):
        report = deform(bar, shapes.BENT, "--number-of-extra-weights", "3", "--extra-weights-kind", kind, "--overwrite", "--report", "-",
                        method="reduced-arap").is_good().report
        assert report["counts"]["extra_weights"] == 3


def test_pseudo_edges_turn_dragged_points(folder):
    mesh = to_dataset(shapes.bar())
    x = points_of(mesh)[:, 0] / 6
    add_point_array(mesh, "Weights", np.stack([1 - x, x], axis=1), ["p1", "p2"])
    bindpose.write(mesh, folder / "bar.vtp")
    folder.write("h.tgf", "1 0 0.5 0.5\n2 6 0.5 0.5\n#\n1 2 0 1 0\n")
    drag = {"handles": {"p2": {"mode": "position", "translate": [-6, 6, 0]}}}  # a rotation by 90 degrees about p1
    deform(folder, drag).is_good()
    turned = points_of(bindpose.read(folder / "out.vtp"))
    deform(folder, drag, "--overwrite", "--pseudo-edges", "auto").is_good()
    assert np.array_equal(points_of(bindpose.read(folder / "out.vtp")), turned)
    p = points_of(mesh) - [0, 0.5, 0.5]
    assert turned == pytest.approx(np.stack([-p[:, 1], p[:, 0] + 0.5, p[:, 2] + 0.5], axis=1), abs=1e-6)
    deform(folder, drag, "--overwrite", "--pseudo-edges", "none").is_good()
    assert points_of(bindpose.read(folder / "out.vtp")) == pytest.approx(
        points_of(mesh) + np.outer(x, [-6, 6, 0]), abs=1e-12)
    posed = bindpose.deform(mesh, bindpose.handles([[0, 0.5, 0.5], [6, 0.5, 0.5]], pseudo_edges=[[0, 1]]), drag)
    assert np.array_equal(points_of(posed), turned)


def test_what_is_stretched_is_in_the_report_and_a_cell_array(bar):
    longer = {"handles": {"b2": {"translate": [18, 0, 0]}}}  # the end of the bar moves from x = 6 to x = 24
    report = deform(bar, longer, "--report", "-", "--stretch-array").is_good().report
    assert report["counts"]["inverted_elements"] == 0
    # Some elements are stretched, but not all.
    assert 0 < report["counts"]["stretched_elements"] < report["counts"]["elements"]
    assert report["largest_stretch"] == pytest.approx(4)
    stretch = numpy_support.vtk_to_numpy(bindpose.read(bar / "out.vtp").GetCellData().GetArray("Stretch"))
    assert stretch.max() == pytest.approx(4) and stretch.min() == pytest.approx(1)
    report = deform(bar, longer, "--report", "-", "--overwrite", "--stretch-limit", 5).is_good().report
    assert report["counts"]["stretched_elements"] == 0
    report = deform(bar, longer, "--report", "-", "--overwrite", "--stretch-limit", 0).is_good().report
    assert "largest_stretch" not in report


def test_rotations_are_arrays_that_render_colors_by(bar):
    """Check the rotation arrays. The bar follows its first bone, which rotates by 40 degrees; the second bone is free.
    """
    turn = {"handles": {"b1": {"rotate": {"axis": [0, 0, 1], "degrees": 40}}, "b2": {"mode": "free"}}}
    for method, more in (("reduced-arap", []), ("full-arap", ["--maximum-iterations", 10000, "--tolerance", 0])):
        deform(bar, turn, "--overwrite", "--rotation-arrays", *more, method=method)
        data = bindpose.read(bar / "out.vtp").GetPointData()
        assert numpy_support.vtk_to_numpy(data.GetArray("Rotation")) == pytest.approx(
            np.tile([0, 0, 40], (len(bar.points), 1)), abs=0.05)
    deform(bar, turn, "--overwrite", "--rotation-arrays", method="reduced-arap").is_good()
    clusters = numpy_support.vtk_to_numpy(bindpose.read(bar / "out.vtp").GetPointData().GetArray("RotationCluster"))
    picture = bar.run("render", "out.vtp", "--color", "rotation-cluster", "--size", "200x150", "-o", "c.png",
                      "--report", "-").is_good().report["picture"]
    assert sum(color["count"] for color in picture["colors"]) == bindpose.read(bar / "out.vtp").GetNumberOfCells()
    assert {int(color["name"]) for color in picture["colors"]} <= set(clusters)
    picture = bar.run("render", "out.vtp", "--color", "rotation", "--size", "200x150", "-o", "r.png",
                      "--report", "-").is_good().report["picture"]
    assert picture["array"] == "Rotation" and picture["range"] == [0, 45]
    deform(bar, turn, "--overwrite", method="reduced-arap").is_good()
    assert not bindpose.read(bar / "out.vtp").GetPointData().HasArray("Rotation")
    deform(bar, turn, "--overwrite", "--dynamics", "--frames", 2, "--rotation-arrays", output="moved.vtp").is_good()
    assert bindpose.read(bar / "moved_0001.vtp").GetPointData().HasArray("RotationCluster")
