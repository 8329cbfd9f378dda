"""bindpose.fair: smooth patches between fixed vertices, on arrays and datasets, and exceptions."""

import warnings

import bindpose
import numpy as np
import pytest
from bindpose.meshes import add_point_array, points_of, to_dataset

SQUARES = 12
X, Y = np.meshgrid(np.arange(SQUARES + 1) / SQUARES, np.arange(SQUARES + 1) / SQUARES)
FLAT = np.stack([X.ravel(), Y.ravel(), 0 * X.ravel()], axis=1)
CORNER = (np.arange(SQUARES)[:, None] * (SQUARES + 1) + np.arange(SQUARES)).ravel()
TRIANGLES = np.concatenate([np.stack([CORNER, CORNER + 1, CORNER + SQUARES + 2], axis=1),
                            np.stack([CORNER, CORNER + SQUARES + 2, CORNER + SQUARES + 1], axis=1)])
DEPTH = np.rint(np.minimum(FLAT, 1 - FLAT)[:, :2].min(axis=1) * SQUARES)
FIXED = DEPTH < 3


@pytest.mark.parametrize("order", [1, 2, 3])
def test_polynomials_that_solve_it_are_made_anew(order):
    x, y = FLAT[:, 0] - 0.5, FLAT[:, 1] - 0.5
    z = [x ** 3 - 3 * x * y ** 2, (x ** 2 + y ** 2) * x, (x ** 2 + y ** 2) ** 2 * x][order - 1]
    surface = FLAT + np.outer(z, [0, 0, 1])
    dented = np.where(FIXED[:, None], surface, 0.3)
    made = bindpose.fair((dented, TRIANGLES), FIXED, order=order, parameters=FLAT[:, :2])
    assert np.asarray(made) == pytest.approx(surface, abs=1e-12)
    assert bindpose.report(made)["order"] == order and bindpose.report(made)["condition"] > 1
    by_ids = bindpose.fair((dented, TRIANGLES), np.flatnonzero(FIXED), order=order, parameters=FLAT)
    assert np.array_equal(by_ids, made)


def test_datasets_keep_their_arrays_and_get_none():
    mesh = to_dataset((FLAT, TRIANGLES))
    add_point_array(mesh, "Fixed", 1.0 * FIXED)
    made = bindpose.fair(mesh)
    assert points_of(made) == pytest.approx(FLAT, abs=1e-13)
    other = bindpose.fair(mesh, DEPTH < 4, boundary="curve", load=np.full((len(FLAT), 3), [0, 0, 10.0]), order=1)
    assert [other.GetPointData().GetArrayName(i) for i in range(other.GetPointData().GetNumberOfArrays())] == []
    assert points_of(other)[:, 2].max() > 0.01
    assert mesh.GetPointData().GetArray("Fixed") is not None


def test_tangents_of_an_array_tilt_the_edge():
    up = np.where((DEPTH == 2)[:, None], [0, 0, 1.0], 0)
    made = np.asarray(bindpose.fair((FLAT, TRIANGLES), FIXED, boundary="tangent", tangents=up))
    free = ~FIXED
    # `tangents` are derivatives in the outward direction. Here they point up, so the patch rises toward its boundary.
    # The boundary is at z = 0. Therefore all free vertices of the patch are at z < 0.
    assert made[free, 2].max() < 0
    assert np.array_equal(made[FIXED], FLAT[FIXED])


@pytest.mark.parametrize("words, sentence", [
    ({"order": 4}, "order"), ({"boundary": "edge"}, "boundary"), ({"tangent_source": "steep"}, "tangent_source"),
    ({"fixed": [10 ** 6]}, "1000000"), ({"fixed": FIXED[1:]}, "Fixed"), ({"parameters": FLAT[1:]}, "Parameterization"),
    ({"fixed": np.zeros(len(FLAT), dtype=bool)}, "at least one fixed point"),
])
def test_what_cannot_be_is_refused(words, sentence):
    with pytest.raises(bindpose.InvalidInput, match=sentence):
        bindpose.fair((FLAT, TRIANGLES), **{"fixed": FIXED, **words})


def test_as_a_way_to_deform():
    middle = len(FLAT) // 2
    handles = bindpose.handles(points=[FLAT[middle]])
    mesh = to_dataset((FLAT, TRIANGLES))
    add_point_array(mesh, "Fixed", 1.0 * FIXED)
    for order in (1, 2, 3):
        posed = points_of(bindpose.deform(mesh, handles, {"handles": {"p1": {"translate": [0, 0, 1]}}},
                                          method="variational", order=order))
        assert posed[middle, 2] == pytest.approx(1) and np.array_equal(posed[FIXED], FLAT[FIXED])


def test_whatever_is_asked_of_any_mesh_is_finite_or_refused():
    """Apply fairing to random meshes with random fixed vertices and conditions. The result keeps the fixed vertices, or
    the input is refused with a sentence."""
    random = np.random.default_rng(3)
    good = 0
    for _ in range(120):
        points = FLAT + random.normal(size=FLAT.shape) * 10 ** random.uniform(-6, -1)
        triangles = TRIANGLES[random.random(len(TRIANGLES)) < random.choice([1, 0.8])]
        if random.random() < 0.2:
            triangles = np.vstack([triangles, random.integers(0, len(points), (2, 3))])
        if random.random() < 0.1:
            points[random.integers(len(points))] = points[random.integers(len(points))]
        points *= 10 ** random.uniform(-8, 8)
        fixed = random.random(len(points)) < random.random()
        words = {"order": int(random.integers(1, 4)), "boundary": str(random.choice(["region", "curve", "tangent"]))}
        if random.random() < 0.3:
            words["tangents"] = random.normal(size=points.shape)
        if random.random() < 0.3:
            words["load"] = random.normal(size=points.shape)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", bindpose.BindposeWarning)
            try:
                made = np.asarray(bindpose.fair((points, triangles), fixed, **words))
            except bindpose.BindposeError as error:
                assert str(error).count("\n") == 0
                continue
        assert np.isfinite(made).all() and np.array_equal(made[fixed], points[fixed])
        good += 1
    assert good > 60
