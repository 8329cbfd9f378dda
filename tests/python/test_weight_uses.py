"""Transfer, colors, depth order and cuts in the Python package, on arrays and datasets: formulas and exceptions."""

import bindpose
import numpy as np
import pytest
import shapes
from bindpose.meshes import add_point_array, point_array, points_of, to_dataset, triangles_of
from vtkmodules.vtkCommonDataModel import vtkPolyData

BAR = shapes.bar()
BONES = [[[0.5, 0.5, 0.5], [3, 0.5, 0.5]], [[3, 0.5, 0.5], [5.5, 0.5, 0.5]]]
X = np.array(BAR[0])[:, 0] / 6
LINEAR = np.stack([1 - X, X], axis=1)


def bar_with_weights():
    mesh = to_dataset(BAR)
    add_point_array(mesh, "Weights", LINEAR, ["b1", "b2"])
    return mesh


def test_weights_are_transferred_to_another_mesh():
    sleeve = shapes.bar(nx=20, ny=3, nz=3)
    points = np.array(sleeve[0])
    points[:, 1:] = 0.5 + 1.05 * (points[:, 1:] - 0.5)
    expected = np.stack([1 - points[:, 0] / 6, points[:, 0] / 6], axis=1)
    for method in ("inpaint", "nearest"):
        values = bindpose.transfer_weights((points, sleeve[1]), BAR, weights=LINEAR, method=method)
        assert isinstance(values, bindpose.Array) and values.shape == (len(points), 2)
        assert values == pytest.approx(expected, abs=1e-9)
        report = bindpose.report(values)
        assert report["transfer"] == ("inpaint" if method == "inpaint" else "barycentric")
    target = to_dataset((points, sleeve[1]))
    result = bindpose.transfer_weights(target, bar_with_weights())
    assert point_array(result, "Matched").min() == 1 and point_array(target, "Matched") is None
    array = result.GetPointData().GetArray("Weights")
    assert [array.GetComponentName(j) for j in range(2)] == ["b1", "b2"]


@pytest.mark.parametrize("options, words", [
    ({"method": "nearest", "maximum_angle": 20}, "maximum_angle is not used by method 'nearest'"),
    ({"maximum_angle": 200}, "maximum_angle must be a number"),
    ({"method": "exact"}, "nearest, inpaint"),
    ({"array_name": "Other"}, "'Other'"),
])
def test_options_of_the_transfer_are_checked(options, words):
    with pytest.raises(bindpose.InvalidInput, match=words):
        bindpose.transfer_weights(BAR, bar_with_weights(), **options)


def test_colors_are_the_weights_sum():
    handles = bindpose.handles(bones=BONES)
    ends = np.array([[0.9, 0.2, 0.0], [0.1, 0.4, 1.0]])
    values = bindpose.weighted_colors(BAR, handles, ends, weights=LINEAR, linear_light=False)
    assert values == pytest.approx(LINEAR @ ends, abs=1e-14)
    report = bindpose.report(values)
    assert report["counts"]["out_of_gamut"] == 0 and report["counts"]["beyond_handles"] == 0
    named = bindpose.weighted_colors(BAR, handles, {"b2": ends[1], "b1": ends[0]}, weights=LINEAR, linear_light=False)
    assert np.array_equal(named, values)

    mesh = bar_with_weights()
    painted = bindpose.weighted_colors(mesh, handles, ends, linear_light=False)
    assert isinstance(painted, vtkPolyData)
    assert np.array_equal(point_array(painted, "ColorValues"), values)
    assert point_array(painted, "Color").dtype == np.uint8
    assert np.abs(point_array(painted, "Color") - 255 * values).max() <= 0.5 + 1e-9
    assert painted.GetPointData().GetScalars().GetName() == "Color"
    assert point_array(mesh, "Color") is None  # the caller's dataset is unchanged


def test_colors_in_light_or_bytes_or_none():
    handles = bindpose.handles(bones=BONES)
    half = np.full((len(X), 2), 0.5)
    gray = bindpose.weighted_colors(BAR, handles, np.array([[0] * 3, [255] * 3], dtype=np.uint8), weights=half)
    assert np.array_equal(np.rint(255 * gray), np.full((len(X), 3), 188))  # half of the light, encoded as an sRGB value
    palette = bindpose.weighted_colors(BAR, handles, weights=LINEAR)
    assert bindpose.report(palette)["colors"] == "categorical"


def test_what_leaves_the_gamut_is_counted():
    handles = bindpose.handles(bones=BONES)
    beyond = np.stack([1.25 - 1.5 * X, 1.5 * X - 0.25], axis=1)
    black_white = [[0, 0, 0], [1, 1, 1]]
    cut = bindpose.weighted_colors(BAR, handles, black_white, weights=beyond)
    kept = bindpose.weighted_colors(BAR, handles, black_white, weights=beyond, clamp=False)
    assert cut.min() == 0 and cut.max() == 1 and kept.min() < 0 and kept.max() > 1
    outside = int(((beyond < 0) | (beyond > 1)).any(axis=1).sum())
    assert outside > 0
    assert bindpose.report(kept)["counts"]["out_of_gamut"] == outside
    assert bindpose.report(kept)["largest_gamut_violation"] == pytest.approx(0.25, abs=1e-12)


def test_depth_is_the_weights_sum_and_moves_points():
    handles = bindpose.handles(bones=BONES)
    depth = bindpose.depth_order(BAR, handles, [0, 3], weights=LINEAR)
    assert depth == pytest.approx(3 * X, abs=1e-14)
    assert np.array_equal(bindpose.depth_order(BAR, handles, {"b2": 3}, weights=LINEAR), depth)
    mesh = bar_with_weights()
    moved = bindpose.depth_order(mesh, handles, [0, 3], scale=0.5, tie=0)
    rest = np.array(BAR[0])
    assert points_of(moved) == pytest.approx(rest + np.outer(1.5 * X, [0, 0, 1]), abs=1e-14)
    still = bindpose.depth_order(mesh, handles, [0, 3], displace=False)
    assert np.array_equal(points_of(still), rest) and np.array_equal(point_array(still, "Depth"), depth)
    equal = bindpose.depth_order(mesh, handles, [2, 2], tie=0)
    assert (point_array(equal, "Depth") == 2).all()


def square(n=8):
    """Return the unit square, divided into n x n cells."""
    at = np.linspace(0, 1, n + 1)
    x, y = np.meshgrid(at, at)
    first = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
    right, up = first + 1, first + n + 1
    return (np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1),
            np.concatenate([np.stack([first, right, up + 1], axis=1), np.stack([first, up + 1, up], axis=1)]))


def test_a_curve_has_two_colors():
    bone = bindpose.handles(bones=[[[0.25, 0.5, 0], [0.75, 0.5, 0]]], names=["curve"])
    mesh, sides = bindpose.cut_along_bones(square(), bone, left=[[1, 0, 0]], right={"curve": (0, 0, 1)})
    assert sides.GetNumberOfCells() == 2 and mesh.GetNumberOfPoints() == 81 + 3
    weighted = bindpose.weights(mesh, sides, domain="surface")
    painted = bindpose.weighted_colors(weighted, sides)
    values, labels = point_array(painted, "ColorValues"), point_array(painted, "RegionId")
    assert (labels == 1).sum() == 3 and (labels == 2).sum() == 3
    assert values[labels == 1] == pytest.approx(np.array([[1, 0, 0]] * 3), abs=1e-12)
    assert values[labels == 2] == pytest.approx(np.array([[0, 0, 1]] * 3), abs=1e-12)
    # The upper part gets the color of the left side, and the lower part gets the color of the right
    # side. No color leaks through the curve.
    centers = points_of(painted)[triangles_of(painted)].mean(axis=1)
    red = values[triangles_of(painted)][:, :, 0].mean(axis=1)
    near = (np.abs(centers[:, 1] - 0.5) < 0.1) & (np.abs(centers[:, 0] - 0.5) < 0.15)
    assert near.sum() > 4
    assert ((red > 0.5) == (centers[:, 1] > 0.5))[near].all()


def test_bones_of_one_curve_share_their_sides():
    corners = np.array([[0.25, 0.25, 0], [0.75, 0.25, 0], [0.75, 0.75, 0], [0.25, 0.75, 0]])
    ring = bindpose.handles(bones=list(zip(corners, np.roll(corners, -1, axis=0))), parents=[-1] * 4)
    inside, outside = [[1, 0.9, 0.2]] * 4, [[0.2, 0.3, 0.6]] * 4
    mesh, sides = bindpose.cut_along_bones(square(), ring, inside, outside, curves=[0, 0, 0, 0])
    assert sides.GetNumberOfCells() == 2 and mesh.GetNumberOfPoints() == 81 + 16
    painted = bindpose.weighted_colors(bindpose.weights(mesh, sides, domain="surface"), sides)
    # A closed curve fills its inside with one color.
    values, places = point_array(painted, "ColorValues"), points_of(painted)
    enclosed = (np.abs(places[:, :2] - 0.5) < 0.25 - 1e-9).all(axis=1)
    assert enclosed.sum() == 9
    assert values[enclosed] == pytest.approx(np.array([inside[0]] * 9), abs=1e-9)


@pytest.mark.parametrize("call, words", [
    (lambda h: bindpose.weighted_colors(BAR, h, [[0, 0, 0]], weights=LINEAR), "2 x 3"),
    (lambda h: bindpose.weighted_colors(BAR, h, {"b1": (0, 0, 0)}, weights=LINEAR), "'b2'"),
    (lambda h: bindpose.weighted_colors(BAR, h, {"b1": (0, 0, 0), "b3": (0, 0, 0)}, weights=LINEAR), "'b3'"),
    (lambda h: bindpose.weighted_colors(BAR, h, {"b1": "red", "b2": (0, 0, 0)}, weights=LINEAR), "'red'"),
    (lambda h: bindpose.weighted_colors(BAR, h, [[0, 0, 0], [0, 0, 255]], weights=LINEAR), "unsigned"),
    (lambda h: bindpose.weighted_colors(BAR, h, weights=LINEAR[:, :1]), "1 components"),
    (lambda h: bindpose.weighted_colors(BAR, h), "'Weights'"),
    (lambda h: bindpose.depth_order(BAR, h, [1], weights=LINEAR), "Layer"),
    (lambda h: bindpose.depth_order(BAR, h, [1, float("nan")], weights=LINEAR), "'b2'"),
    (lambda h: bindpose.depth_order(BAR, h, scale=-1, weights=LINEAR), "scale"),
    (lambda h: bindpose.cut_along_bones(BAR, h), "plane"),
    (lambda h: bindpose.cut_along_bones(square(), h), "'b1'"),
    (lambda h: bindpose.cut_along_bones(square(), h, left=[[0, 0, 0]] * 2), "both"),
    (lambda h: bindpose.deform(BAR, h, {"handles": {}}, method="mls", exponent=0.5), "exponent"),
])
def test_what_is_wrong_is_one_sentence(call, words):
    with pytest.raises(bindpose.InvalidInput, match=words):
        call(bindpose.handles(bones=BONES))


def test_moving_least_squares_needs_no_weights():
    handles = bindpose.handles(points=[[0, 0, 0], [6, 0, 0], [3, 1, 1]])
    turn = {"rotate": {"axis": [0, 0, 1], "degrees": 90}}
    # Each handle rotates by 90 degrees about its own position. The translations move p2 and p3 to where a rotation of
    # the whole bar about p1 would move them.
    pose = {"handles": {"p1": turn, "p2": {**turn, "translate": [-6, 6, 0]}, "p3": {**turn, "translate": [-4, 2, 0]}}}
    posed = bindpose.deform(BAR, handles, pose, method="mls")
    rest = np.array(BAR[0])
    assert posed == pytest.approx(np.stack([-rest[:, 1], rest[:, 0], rest[:, 2]], axis=1), abs=1e-12)
    assert posed.report["method"] == "mls"


@pytest.mark.parametrize("method", ["projection", "joints", "bounded"])
def test_endpoint_weights(method):
    n = 8
    points = np.array([[i / n, j / n, 0] for j in range(n + 1) for i in range(n + 1)])
    corners = [(j * (n + 1) + i, j * (n + 1) + i + 1, (j + 1) * (n + 1) + i + 1, (j + 1) * (n + 1) + i)
               for j in range(n) for i in range(n)]
    square = points, np.array([t for a, b, c, d in corners for t in ((a, b, c), (a, c, d))])
    arm = bindpose.handles(points=[[0.25, 0, 0]], bones=[[[0, 0.5, 0], [1, 0.5, 0]]], names=["p", "arm"])
    e = bindpose.endpoint_weights(square, arm, method=method)
    assert e.shape == (len(points), 2) and e.names == ["p", "arm"] and np.isnan(e[:, 0]).all()
    assert (e[:, 1] >= 0).all() and (e[:, 1] <= 1).all()
    middle = points[:, 1] == 0.5
    ends = e[middle, 1][[0, -1]]
    assert np.allclose(ends, [0, 1], atol=1e-12)
    assert np.allclose(e[:, 1] + e[:, 1].reshape(n + 1, n + 1)[:, ::-1].ravel(), 1, atol=0.05), "heads and tails are alike"
    posed = bindpose.deform(square, arm, {"handles": {"arm": {"tail": [2, 0.5, 0]}}}, method="stbs",
                            weights=np.tile([0.0, 1.0], (len(points), 1)))
    assert np.allclose(posed[:, 0], 2 * points[:, 0])
    with pytest.raises(bindpose.InvalidInput, match="no bone"):
        bindpose.endpoint_weights(square, bindpose.handles(points=[[0, 0, 0]]), method=method)
