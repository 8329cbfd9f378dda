"""All functions of the Python package on arrays and datasets: the same values as the command-line program, and
exceptions.
"""

import json
import os
import subprocess
import warnings

import bindpose
import numpy as np
import pytest
import shapes
from bindpose.meshes import add_point_array, is_tets, point_array, points_of, tets_of, to_dataset
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData

PROGRAM = os.environ["BINDPOSE_PROGRAM"]
BAR = shapes.bar()
BONES = [[[0.5, 0.5, 0.5], [3, 0.5, 0.5]], [[3, 0.5, 0.5], [5.5, 0.5, 0.5]]]


def program(folder, *words):
    subprocess.run([PROGRAM, *map(str, words)], cwd=folder, check=True, capture_output=True)


def test_winding_number_at_points():
    cube = shapes.open_cube()
    values = bindpose.winding_number(cube, [[0, 0, 0], [0, 0, 0.5]], method="exact")
    assert values == pytest.approx([5 / 6, 0.704832764699], abs=1e-11)
    assert isinstance(values, np.ndarray)
    assert bindpose.report(values)["counts"]["boundary_edges"] == 4
    one = bindpose.winding_number(to_dataset(cube), np.zeros((1, 3)))
    assert one == pytest.approx([5 / 6], abs=1e-11)


def test_winding_number_on_grids_and_datasets():
    field = bindpose.winding_number(shapes.cube(), 12)
    assert isinstance(field, vtkImageData) and field.GetDimensions() == (12, 12, 12)
    field = bindpose.winding_number(shapes.cube(), (4, 5, 6), bounds=(-2, 2, -2, 2, -2, 2))
    assert field.GetDimensions() == (4, 5, 6)
    assert field.GetBounds() == pytest.approx((-2, 2, -2, 2, -2, 2))
    surface = to_dataset(shapes.sphere(8, 4, 0.5))
    there = bindpose.winding_number(shapes.cube(), surface)
    assert isinstance(there, vtkPolyData) and there.GetNumberOfCells() == surface.GetNumberOfCells()
    assert point_array(there, "WindingNumber") == pytest.approx(np.ones(there.GetNumberOfPoints()))
    assert point_array(surface, "WindingNumber") is None  # the caller's dataset is unchanged


def test_winding_number_is_the_programs(tmp_path):
    bindpose.write(shapes.open_cube(), tmp_path / "c.off")
    program(tmp_path, "winding", "c.off", "--resolution", 16, "-o", "w.vti")
    theirs = bindpose.read(tmp_path / "w.vti")
    ours = bindpose.winding_number(shapes.open_cube(), 16)
    assert np.array_equal(point_array(theirs, "WindingNumber"), point_array(ours, "WindingNumber"))


def test_fast_winding_numbers_keep_their_tolerance():
    vertices, triangles = shapes.sphere(24, 16)
    soup = vertices, np.asarray(triangles)[::2]
    points = np.random.default_rng(1).uniform(-1.5, 1.5, (500, 3))
    exact = bindpose.winding_number(soup, points, method="exact")
    for tolerance in (1e-2, 1e-5):
        fast = bindpose.winding_number(soup, points, method="fast", tolerance=tolerance)
        assert np.abs(fast - exact).max() <= tolerance
        assert bindpose.report(fast)["error_bound"] == tolerance
        assert bindpose.report(fast)["method"] == "fast"
    assert bindpose.report(bindpose.winding_number(shapes.cube(), points))["method"] == "crossings"


def test_gradient_is_the_slope():
    point = np.array([0.3, 0.2, 0.4])
    steps = 1e-5 * np.vstack([np.eye(3), -np.eye(3)])
    around = bindpose.winding_number(shapes.open_cube(), point + steps)
    value, gradient = bindpose.winding_number(shapes.open_cube(), [point], compute_gradient=True)
    assert gradient.shape == (1, 3) and value.shape == (1,)
    assert gradient[0] == pytest.approx((around[:3] - around[3:]) / 2e-5, abs=1e-8)
    grid = bindpose.winding_number(shapes.open_cube(), 6, compute_gradient=True)
    assert point_array(grid, "WindingNumberGradient").shape == (grid.GetNumberOfPoints(), 3)
    assert set(point_array(grid, "OnSurface")) <= {0, 1}


def test_contains():
    points = [[0, 0, 0], [0.9, 0.9, 0.9], [1.1, 0, 0], [np.nan, 0, 0]]
    with pytest.warns(bindpose.BindposeWarning):
        inside = bindpose.contains(shapes.cube(), points)
    assert inside.dtype == bool and list(inside) == [True, True, False, False]
    assert bindpose.report(inside)["counts"]["not_finite"] == 1
    assert list(bindpose.contains(shapes.cube(), [0, 0, 0])) == [True]
    assert list(bindpose.contains(shapes.open_cube(), points[:1], winding_threshold=0.9)) == [False]
    assert list(bindpose.contains(shapes.flipped(shapes.cube()), points[:1], orient_patches=True)) == [True]
    assert bindpose.contains(to_dataset(shapes.cube()), to_dataset(shapes.sphere(8, 4, 0.5))).all()


def test_tetrahedralize():
    vertices, tets, original, report = bindpose.tetrahedralize(BAR)
    p = vertices[tets]
    volume = np.einsum("ti,ti->t", np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), p[:, 3] - p[:, 0]) / 6
    assert volume.min() > 0 and volume.sum() == pytest.approx(6, rel=1e-10)
    assert sorted(original[original >= 0]) == list(range(len(BAR[0])))
    assert report["method"] == "cdt" and bindpose.report(bindpose.tetrahedralize(BAR))["method"] == "cdt"
    grid = bindpose.tetrahedralize(to_dataset(BAR))
    assert is_tets(grid) and np.array_equal(tets_of(grid), tets) and np.array_equal(points_of(grid), vertices)


def test_tets_of_the_hull():
    two = np.vstack([BAR[0], np.asarray(BAR[0]) + [0.0, 0.0, 2.0]]), np.vstack([BAR[1], np.asarray(BAR[1]) + len(BAR[0])])
    grid = bindpose.tetrahedralize(to_dataset(two), method="cdt", keep_outside=True)
    labels = vtk_to_numpy(grid.GetCellData().GetArray("Label"))
    a, b, c, d = np.moveaxis(points_of(grid)[tets_of(grid)], 1, 0)
    volumes = np.einsum("ij,ij->i", b - a, np.cross(c - a, d - a)) / 6
    assert volumes.sum() == pytest.approx(18) and volumes[labels > 0].sum() == pytest.approx(12)
    assert set(labels) == {0, 1} and grid.GetFieldData().GetAbstractArray("Method").GetValue(0) == "cdt"
    with pytest.raises(bindpose.InvalidInput, match="cdt"):
        bindpose.tetrahedralize(BAR, keep_outside=True)


def test_tetrahedralize_with_handles():
    handles = bindpose.handles(bones=BONES)
    vertices, _, _, report = bindpose.tetrahedralize(BAR, handles=handles)
    for handle in report["handles"]:
        assert (np.abs(points_of(handles) - vertices[handle["vertex"]]).max(axis=1) == 0).any()


def test_tetrahedralize_around_a_sheet():
    vertices, tets, original, report = bindpose.tetrahedralize(shapes.flat(), method="wrap", wrap_alpha=0.1,
                                                               wrap_offset=0.01)
    p = vertices[tets]
    volume = np.einsum("ti,ti->t", np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), p[:, 3] - p[:, 0]) / 6
    # The tets fill a shell around a square of side 1 (diagonal sqrt(2)). The thickness of the shell is 2 wrap_offset
    # diagonals, and its rim is round.
    assert volume.min() > 0 and 1.8 * 0.01 * 2**0.5 < volume.sum() < 2.2 * 0.01 * 2**0.5
    assert (original == -1).all() and report["method"] == "wrap"
    assert any("thin shell" in warning for warning in report["warnings"])


def test_ftetwild_is_named_where_it_is_missing(monkeypatch):
    monkeypatch.setenv("BINDPOSE_FTETWILD", "/nowhere/ftetwild")
    with pytest.raises(bindpose.Unavailable, match="/nowhere/ftetwild"):
        bindpose.tetrahedralize(shapes.cube(), method="ftetwild")
    with pytest.raises(bindpose.InvalidInput, match="ftetwild_epsilon"):
        bindpose.tetrahedralize(shapes.cube(), method="ftetwild", ftetwild_epsilon=1)


def test_weights_are_the_programs(tmp_path):
    handles = bindpose.handles(bones=BONES)
    ours = bindpose.weights(BAR, handles)
    assert ours.shape == (len(BAR[0]), 2) and ours.names == ["b1", "b2"]
    assert ours.sum(axis=1) == pytest.approx(np.ones(len(ours)), abs=1e-12)
    report = bindpose.report(ours)
    assert report["status"] == "ok" and report["relative_gap"] <= 1e-6 and report["transfer"] == "exact"
    bindpose.write(BAR, tmp_path / "bar.off")
    (tmp_path / "h.tgf").write_text(shapes.TWO_BONES)
    program(tmp_path, "weights", "bar.off", "--handles", "h.tgf", "-o", "w.vtp")
    theirs = bindpose.read(tmp_path / "w.vtp")
    assert np.array_equal(point_array(theirs, "Weights"), ours)
    dataset = bindpose.weights(to_dataset(BAR), str(tmp_path / "h.tgf"))
    assert np.array_equal(point_array(dataset, "Weights"), ours)
    assert bindpose.report(theirs)["status"] == "ok"


@pytest.mark.parametrize("method", ["monotone", "biharmonic", "triharmonic", "harmonic", "graph-biharmonic",
                                    "linear-subspace", "inverse-distance", "smoothed-harmonic", "bone-heat"])
def test_weights_on_given_tets(method):
    tets = bindpose.tetrahedralize(BAR)
    w = bindpose.weights(tets[:2], "auto:3", method=method)
    assert w.shape == (len(tets.vertices), 3)
    assert w.sum(axis=1) == pytest.approx(np.ones(len(w)), abs=1e-8)


def test_weights_with_terms():
    points = np.array(BAR[0], dtype=float)
    handles = bindpose.handles(points=points[[0, -1]])
    free = bindpose.weights(BAR, handles, domain="surface")
    pins = np.full((len(points), 2), np.nan)
    pinned = len(points) // 2
    pins[pinned] = [0.9, np.nan]
    sets = (np.arange(len(points)) == 3) | (np.arange(len(points)) == 4)
    w = bindpose.weights(BAR, handles, domain="surface", pinned=pins, rigid_set=sets, rigidity=np.ones(len(points)))
    assert w[pinned, 0] == 0.9 and np.array_equal(w[3], w[4])
    assert np.abs(np.asarray(w) - np.asarray(free)).max() > 1e-3
    coupled = bindpose.weights(BAR, handles, domain="surface", partition_of_unity="coupled", bounds=(-1, 2))
    assert np.allclose(np.sum(coupled, axis=1), 1, atol=1e-12)
    assert w.names == ["p1", "p2"]
    alike = bindpose.weights(BAR, handles, domain="surface", bounds={"p2": (0, 1)})
    assert np.array_equal(alike, free)
    with pytest.raises(bindpose.InvalidInput, match="unknown handle 'p3'"):
        bindpose.weights(BAR, handles, bounds={"p3": (0, 1)})
    with pytest.raises(bindpose.InvalidInput, match="bounds of handle 'p1'"):
        bindpose.weights(BAR, handles, domain="surface", bounds={"p1": (1, 0)})
    one = bindpose.weights(BAR, handles, maximum_influences=1)
    assert ((np.asarray(one) > 0).sum(axis=1) == 1).mean() > 0.9
    with pytest.raises(bindpose.InvalidInput, match="no point array 'paint'"):
        bindpose.weights(BAR, handles, rigidity="paint")
    with pytest.raises(bindpose.InvalidInput, match="harmonic"):
        bindpose.weights(BAR, handles, method="harmonic", maximum_influences=2)


def test_weights_on_the_surface():
    w = bindpose.weights(BAR, "auto:3", domain="surface")
    assert w.shape == (len(BAR[0]), 3) and (w.max(axis=0) == 1).all()
    with pytest.raises(bindpose.InvalidInput, match="surface"):
        bindpose.weights(bindpose.tetrahedralize(BAR)[:2], "auto:3", domain="surface")


@pytest.mark.parametrize("method", ["lbs", "dqs", "stbs", "cor", "reduced-arap", "full-arap", "mls"])
def test_deform_is_the_programs(tmp_path, method):
    handles = bindpose.handles(bones=BONES)
    x = np.array(BAR[0])[:, 0] / 6
    w = np.stack([1 - x, x], axis=1)
    pose = json.loads(shapes.BENT)
    ours = bindpose.deform(BAR, handles, pose, method=method, weights=w)
    assert ours.shape == (len(BAR[0]), 3) and bindpose.report(ours)["status"] == "ok"
    mesh = to_dataset(BAR)
    add_point_array(mesh, "Weights", w, ["b1", "b2"])
    bindpose.write(mesh, tmp_path / "w.vtp")
    bindpose.write(handles, tmp_path / "h.vtp")
    (tmp_path / "p.json").write_text(shapes.BENT)
    program(tmp_path, "deform", "w.vtp", "--handles", "h.vtp", "--pose", "p.json", "--method", method, "-o", "o.vtp")
    assert np.array_equal(points_of(bindpose.read(tmp_path / "o.vtp")), ours)
    posed = bindpose.deform(mesh, handles, tmp_path / "p.json", method=method)
    assert isinstance(posed, vtkPolyData) and np.array_equal(points_of(posed), ours)
    assert np.array_equal(points_of(mesh), np.array(BAR[0]))  # the caller's dataset is unchanged


def test_an_ignored_twist_is_a_warning():
    handles = bindpose.handles(bones=BONES)
    x = np.array(BAR[0])[:, 0] / 6
    w = np.stack([1 - x, x], axis=1)
    pose = {"handles": {"b2": {"twist": [0, 30]}}}
    with pytest.warns(bindpose.BindposeWarning, match="stretches or twists bones"):
        bindpose.deform(BAR, handles, pose, weights=w)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        bindpose.deform(BAR, handles, pose, method="stbs", weights=w)


def test_rotations_are_arrays_of_datasets():
    mesh = to_dataset(BAR)
    x = np.array(BAR[0])[:, 0] / 6
    add_point_array(mesh, "Weights", np.stack([1 - x, x], axis=1), ["b1", "b2"])
    pose = {"handles": {"b1": {"rotate": {"axis": [1, 0, 0], "degrees": 25}}, "b2": {"mode": "free"}}}
    handles = bindpose.handles(bones=BONES)
    options = {"rotation_arrays": True, "tolerance": 0, "maximum_iterations": 5000}
    posed = [bindpose.deform(mesh, handles, pose, method=method, **options) for method in ("reduced-arap", "full-arap")]
    posed += bindpose.dynamics(mesh, handles, pose, frames=1, rotation_arrays=True)
    for each in posed:
        turns = vtk_to_numpy(each.GetPointData().GetArray("Rotation"))
        assert turns == pytest.approx(np.tile([25, 0, 0], (len(BAR[0]), 1)), abs=0.05)
        assert vtk_to_numpy(each.GetPointData().GetArray("RotationCluster")).min() == 0


def test_sequences_are_lists():
    handles = bindpose.handles(bones=BONES)
    x = np.array(BAR[0])[:, 0] / 6
    frames = [{"handles": {"b2": {"translate": [0, k, 0]}}} for k in range(3)]
    posed = bindpose.deform(BAR, handles, {"frames": frames}, weights=np.stack([1 - x, x], axis=1))
    assert len(posed) == 3
    for k in range(3):
        assert posed[k] == pytest.approx(np.array(BAR[0]) + np.outer(x, [0, k, 0]), abs=1e-12)


def test_expressions_in_time():
    handles = bindpose.handles(bones=BONES)
    x = np.array(BAR[0])[:, 0] / 6
    w = np.stack([1 - x, x], axis=1)
    pose = {"handles": {"b2": {"translate": [0, "2 * t", 0]}}}
    posed = bindpose.deform(BAR, handles, pose, weights=w, times=[0, 0.5, 1.5])
    for k, t in enumerate([0, 0.5, 1.5]):
        assert posed[k] == pytest.approx(np.array(BAR[0]) + np.outer(x, [0, 2 * t, 0]), abs=1e-12)
    with pytest.raises(bindpose.InvalidInput, match=r"'b2'.translate is '2 \*'"):
        bindpose.deform(BAR, handles, {"handles": {"b2": {"translate": [0, "2 *", 0]}}}, weights=w)


def test_dynamics_falls():
    handles = bindpose.handles(bones=BONES)
    x = np.array(BAR[0])[:, 0] / 6
    pose = {"handles": {"b1": {"mode": "free"}, "b2": {"mode": "free"}}}
    posed = bindpose.dynamics(BAR, handles, pose, frames=11, time_step=0.1, gravity=(0, -10, 0),
                              weights=np.stack([1 - x, x], axis=1))
    assert len(posed) == 11 and bindpose.report(posed[-1])["steps"] == 10
    for n in range(11):  # falling with implicit Euler follows a parabola
        assert posed[n] == pytest.approx(np.array(BAR[0]) + [0, -10 * 0.01 * n * (n + 1) / 2, 0], abs=1e-9)


@pytest.mark.parametrize("method", ["lbs", "dqs", "stbs", "cor"])
def test_single_precision_and_few_influences(method):
    handles = bindpose.handles(bones=BONES)
    x = np.array(BAR[0])[:, 0] / 6
    pose = {"handles": {"b2": {"rotate": {"axis": [0, 0, 1], "degrees": 40}}}}
    weights = np.stack([1 - x, x], axis=1)
    exact = bindpose.deform(BAR, handles, pose, weights=weights, method=method)
    single = bindpose.deform(BAR, handles, pose, weights=weights, method=method, single_precision=True)
    assert 0 < abs(single - exact).max() < 1e-5
    one = bindpose.deform(BAR, handles, pose, weights=weights, method=method, maximum_influences=1)
    assert one.report["dropped_share"] == pytest.approx(np.minimum(x, 1 - x).max())
    assert one.report["counts"]["dropped_weights"] == np.count_nonzero(np.minimum(x, 1 - x))
    few = bindpose.deform(BAR, handles, pose, weights=weights, method=method, smallest_weight=0.2)
    assert few.report["dropped_share"] <= 0.2


def test_mixed_precision():
    handles = bindpose.handles(bones=BONES)
    x = np.array(BAR[0])[:, 0] / 6
    weights = np.stack([1 - x, x], axis=1)
    pose = {"handles": {"b2": {"mode": "position", "translate": [0, 1, 0]}}}

    def solved(mixed):
        options = dict(weights=weights, tolerance=1e-12, maximum_iterations=1000, mixed_precision=mixed)
        alone = bindpose.deform(BAR, handles, pose, method="reduced-arap", **options)
        instance, = bindpose.crowd(BAR, handles, pose, **options)
        step = bindpose.dynamics(BAR, handles, pose, frames=2, weights=weights, mixed_precision=mixed)[-1]
        for posed in (alone, instance, step):
            assert (posed.report["single_precision_iterations"] > 0) == mixed
        return alone, instance

    for mixed, plain in zip(solved(True), solved(False)):
        assert mixed == pytest.approx(plain, abs=1e-5)


def test_crowd():
    handles = bindpose.handles(bones=BONES)
    x = np.array(BAR[0])[:, 0] / 6
    weights = np.stack([1 - x, x], axis=1)
    poses = [{"handles": {"b2": {"mode": "position", "translate": [0, 0.3 * k, 0]}}} for k in range(4)]
    alone = [bindpose.deform(BAR, handles, pose, method="reduced-arap", weights=weights) for pose in poses]
    posed = bindpose.crowd(BAR, handles, poses, weights=weights)
    assert len(posed) == 4 and bindpose.report(posed[3])["counts"]["instances"] == 4
    for one, other in zip(posed, alone):
        assert one == pytest.approx(other, abs=1e-5)
    # Each frame of a sequence of poses gives one instance. Each instance has its own placement: a translation, or a
    # 3 x 4 or 4 x 4 matrix.
    turn = np.array([[0, -1, 0, 5], [1, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
    placed = bindpose.crowd(BAR, handles, {"frames": poses}, weights=weights,
                            placements=[[1, 2, 3], turn, turn[:3], [0, 0, 0]])
    assert placed[0] == pytest.approx(alone[0] + [1, 2, 3], abs=1e-5)
    for k in (1, 2):
        assert placed[k] == pytest.approx(alone[k] @ turn[:3, :3].T + turn[:3, 3], abs=1e-5)
    assert placed[3] == pytest.approx(alone[3], abs=1e-5)

    data = bindpose.meshes.to_dataset(BAR)
    posed = bindpose.crowd(data, handles, poses, weights=weights)
    assert posed[2].GetNumberOfCells() == data.GetNumberOfCells() and bindpose.report(posed[2])["status"] == "ok"
    together = bindpose.crowd(data, handles, poses, weights=weights, appended=True)
    assert together.GetNumberOfPoints() == 4 * len(BAR[0]) and together.GetPointData().HasArray("Instance")

    for what, sentence in ((dict(placements=[[0, 0, 0]]), "1 entries; expected 4"),
                           (dict(placements=[[0, 0]] * 4), "a placement must be")):
        with pytest.raises(bindpose.InvalidInput, match=sentence):
            bindpose.crowd(BAR, handles, poses, weights=weights, **what)
    with pytest.raises(bindpose.InvalidInput, match="has no instances"):
        bindpose.crowd(BAR, handles, [], weights=weights)
    with pytest.raises(bindpose.InvalidInput, match="'b9', which does not exist"):
        bindpose.crowd(BAR, handles, [{"handles": {"b9": {}}}], weights=weights)


def test_a_handle_outside_warns():
    with pytest.warns(bindpose.BindposeWarning, match="p2"):
        bindpose.weights(BAR, bindpose.handles([[1, 0.5, 0.5], [5, 0.5, 3]]))


def test_not_converged_is_a_warning_with_a_result():
    with pytest.warns(bindpose.NotConvergedWarning):
        w = bindpose.weights(shapes.sphere(32, 16), "auto:6", domain="surface", maximum_iterations=1, tolerance=1e-14)
    assert w.report["status"] == "not_converged" and w.shape[1] == 6


@pytest.mark.parametrize("call, sentence", [
    (lambda: bindpose.winding_number(shapes.cube(), method="guess"), "auto, exact"),
    (lambda: bindpose.winding_number(shapes.cube(), tolerance=0), "tolerance"),
    (lambda: bindpose.contains(shapes.cube(), [[1, 2]]), "#V x 3"),
    (lambda: bindpose.winding_number((np.full((3, 3), np.nan), [[0, 1, 2]]), np.zeros((1, 3))), "finite"),
    (lambda: bindpose.winding_number((np.eye(3), [[0, 1, 5]]), np.zeros((1, 3))), "vertex 5"),
    (lambda: bindpose.winding_number(shapes.cube(), [[1, 2]]), "#V x 3"),
    (lambda: bindpose.tetrahedralize(shapes.flat()), ""),
    (lambda: bindpose.tetrahedralize(vtkPolyData()), "empty"),
    (lambda: bindpose.weights(BAR, bindpose.handles([[1, 0.5, 0.5], [1, 0.5, 0.5]])), "same position"),
    (lambda: bindpose.weights(BAR, "auto:0"), "auto"),
    (lambda: bindpose.weights(BAR, 7), "handles"),
    (lambda: bindpose.weights(BAR, "none.tgf"), "none.tgf"),
    (lambda: bindpose.deform(BAR, bindpose.handles(bones=BONES), {"handles": {}}), "Weights"),
    (lambda: bindpose.deform(BAR, bindpose.handles(bones=BONES), {"handles": {"elbow": {}}},
                             weights=np.full((len(BAR[0]), 2), 0.5)), "elbow"),
    (lambda: bindpose.deform(BAR, bindpose.handles(bones=BONES), {"a": {1, 2}},
                             weights=np.full((len(BAR[0]), 2), 0.5)), "JSON"),
])
def test_errors_are_exceptions(call, sentence):
    with pytest.raises(bindpose.InvalidInput, match=sentence):
        call()


def area_of(vertices, triangles):
    a, b, c = (vertices[triangles[:, k], :2] for k in range(3))
    twice = np.cross(b - a, c - a)
    assert (twice > 0).all()
    return twice.sum() / 2


def test_planar_shape_of_arrays():
    square = [[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1], [1, 2], [2, 3]]
    shape = bindpose.planar_shape(square, edge=0.1)
    assert area_of(*shape[:2]) == pytest.approx(1, abs=1e-14)  # the gap is closed
    assert shape.texture == pytest.approx(shape.vertices[:, :2])
    assert list(shape.original_ids[:5]) == [0, 1, 2, 3, -1]
    assert shape.report["min_angle"] >= 30 - 1e-9 and shape.report["domain"] == "curves"


def test_planar_shape_of_images(tmp_path):
    y, x = np.mgrid[:60, :80]
    inside = np.hypot(x - 30.2, y - 20.7) < 15
    shape = bindpose.planar_shape(inside)
    assert area_of(*shape[:2]) == pytest.approx(np.pi * 225, rel=0.03)
    middle = shape.vertices.mean(axis=0)  # rows of the image count from the top, y from the bottom
    assert middle[:2] == pytest.approx([30.2, 59 - 20.7], abs=1)
    assert shape.texture == pytest.approx((shape.vertices[:, :2] + 0.5) / [80, 60], abs=1e-12)
    pixels = np.zeros((60, 80, 4), np.uint8)
    pixels[..., 3] = 255 * inside
    assert np.array_equal(bindpose.planar_shape(pixels).triangles, shape.triangles)
    whole = bindpose.planar_shape(pixels, rectangle=True)
    assert area_of(*whole[:2]) == pytest.approx(4800)
    assert area_of(*bindpose.planar_shape(pixels[..., :3])[:2]) == pytest.approx(4800)


def test_planar_shape_is_the_programs(tmp_path):
    y, x = np.mgrid[:60, :80]
    pixels = np.full((60, 80, 4), 200, np.uint8)
    pixels[..., 3] = 255 * (np.hypot(x - 40, y - 30) < 25)
    (tmp_path / "disc.png").write_bytes(shapes.png(80, 60, lambda x, y: pixels[y, x]))
    program(tmp_path, "outline", "disc.png", "-o", "disc.vtp")
    theirs = bindpose.read(tmp_path / "disc.vtp")
    ours = bindpose.planar_shape(tmp_path / "disc.png")
    assert isinstance(ours, vtkPolyData)
    assert np.array_equal(points_of(theirs), points_of(ours))
    assert np.array_equal(points_of(ours), bindpose.planar_shape(pixels).vertices)


def test_planar_shape_with_handles_takes_weights():
    handles = bindpose.handles(points=[[0.25, 0.5, 0]], bones=[[[0.5, 0.5, 0], [0.8, 0.6, 0]]])
    square = [[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1], [1, 2], [2, 3], [3, 0]]
    shape = bindpose.planar_shape(square, handles=handles, edge=0.05)
    vertices = shape.report["handles"]
    assert [handle["name"] for handle in vertices] == ["p1", "b1"]
    assert shape.vertices[vertices[0]["vertex"]] == pytest.approx([0.25, 0.5, 0])
    weights = bindpose.weights((shape.vertices, shape.triangles), handles, domain="surface")
    assert weights[vertices[0]["vertex"]] == pytest.approx([1, 0], abs=1e-9)
    assert weights[vertices[1]["vertex"]] == pytest.approx([0, 1], abs=1e-9)
    assert weights.min() >= -1e-6 and weights.max() <= 1 + 1e-6


@pytest.mark.parametrize("value, words", [
    (np.zeros((5, 5)), "transparent"), (np.zeros((0, 5)), "no pixels"), (np.zeros(5), "an image must be"),
    (([[0, 0], [1, 1], [2, 2]], [[0, 1], [1, 2]]), "one line"), (([[0, 0]], [[0, 1, 2]]), "segments"),
    ((3, 4), "segments"), ("nowhere.png", "no such file"), (vtkImageData(), "no pixels"), (vtkPolyData(), "no lines")])
def test_planar_shape_refuses(value, words):
    with pytest.raises(bindpose.InvalidInput, match=words):
        bindpose.planar_shape(value)


@pytest.mark.parametrize("ending", ["png", "jpg", "tif", "bmp"])
def test_planar_shape_refuses_damaged_pictures(tmp_path, ending):
    whole = shapes.png(80, 60, lambda x, y: (x, y, 0, 255))
    for data in (b"", b"text", whole[:150], whole[:60] + b"x" + whole[61:]):
        path = tmp_path / f"broken.{ending}"
        path.write_bytes(data)
        with pytest.raises(bindpose.InvalidInput, match=path.name):
            bindpose.planar_shape(path)
