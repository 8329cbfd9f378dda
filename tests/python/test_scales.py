"""Results are invariant to the scale and the position of a shape.

A shape is scaled by powers of two from 2^-332 to 2^332 (about 1e-100 and 1e100), or moved by up to a million diagonals. Its
coordinates are multiples of 2^-20, so that the changed coordinates are exact. Lengths of results are divided by the scale. Where
the numbers of vertices can differ after a shift, only finiteness is checked.
"""

import bindpose
import numpy as np
import pytest
import shapes
from bindpose.meshes import point_array, points_of

SCALES = [2.0 ** k for k in (332, -332, 100, -60)]
SHIFTS = [2.0 ** 12, 2.0 ** 21]
CHANGES = [(scale, 0.0) for scale in SCALES] + [(1.0, shift) for shift in SHIFTS]
NAMES = ["p1", "p2", "b1"]
POSE = {"version": 2, "handles": {"p1": {"translate": [0, 0.5, 0.25]},
                                  "b1": {"rotate": {"axis": [0, 0, 1], "degrees": 30}}}}


def exact(values):
    return np.round(np.array(values, float) * 2 ** 20) / 2 ** 20


def bent_tube(opening=True):
    """Return a bent tube (open at one triangle) as vertices and triangles."""
    around, along = 16, 24
    vertices = []
    for i in range(along):
        for j in range(around):
            u, v = i / (along - 1), 2 * np.pi * j / around
            radius = 0.3 + 0.1 * np.sin(3 * u)
            vertices.append((3 * u + 0.1 * u * u, np.sin(2 * u) + radius * np.cos(v), radius * np.sin(v)))
    faces = [(i * around + j, (i + 1) * around + j, (i + 1) * around + (j + 1) % around) for i in range(along - 1)
             for j in range(around)]
    faces += [(i * around + j, (i + 1) * around + (j + 1) % around, i * around + (j + 1) % around) for i in range(along - 1)
              for j in range(around)]
    for i, center, flip in ((0, len(vertices), False), (along - 1, len(vertices) + 1, True)):
        ring = np.array(vertices[i * around:(i + 1) * around])
        vertices.append(tuple(ring.mean(axis=0)))
        faces += [(center, i * around + j, i * around + (j + 1) % around)[::-1 if flip else 1] for j in range(around)]
    return exact(vertices), np.array(faces[1:] if opening else faces)


VERTICES, FACES = bent_tube()
POSITIONS = exact([[0.2, 0.1, 0.0], [2.8, 0.9, 0.1]])
BONE = exact([[[1.0, 0.9, 0.0], [2.0, 0.8, 0.0]]])


def changed(points, change):
    scale, shift = change
    return points * scale + shift * scale


def restored(points, change):
    scale, shift = change
    return np.asarray(points) / scale - shift


def mesh(change, opening=True):
    vertices, faces = (VERTICES, FACES) if opening else bent_tube(False)
    return changed(vertices, change), faces


def handles(change):
    return bindpose.handles(points=changed(POSITIONS, change), bones=changed(BONE, change))


def pose(change):
    moved = {"version": 2, "handles": {name: dict(entry) for name, entry in POSE["handles"].items()}}
    moved["handles"]["p1"]["translate"] = [change[0] * x for x in POSE["handles"]["p1"]["translate"]]
    return moved


def rest_weights():
    distances = np.stack([np.linalg.norm(VERTICES - p, axis=1) for p in (*POSITIONS, BONE.mean(axis=1)[0])], axis=1)
    weights = 1 / (0.05 + distances ** 2)
    return weights / weights.sum(axis=1, keepdims=True)


def winding_numbers(change):
    queries = exact(np.random.default_rng(1).uniform([-0.5, -0.5, -0.5], [3.5, 1.5, 0.5], (500, 3)))
    return bindpose.winding_number(mesh(change), changed(queries, change))


def grid(change):
    return point_array(bindpose.winding_number(mesh(change), 12), "WindingNumber")


def weights(**options):
    return lambda change: np.asarray(bindpose.weights(mesh(change), handles(change), **options))


def posed(**options):
    def run(change):
        result = bindpose.deform(mesh(change), handles(change), pose(change), weights=rest_weights(), **options)
        return restored(result, change)
    return run


def tets(**options):
    def run(change):
        result = bindpose.tetrahedralize(mesh(change), **options)
        volume = result.report["volume"] / change[0] ** 3
        return np.append(restored(result.vertices, change).ravel(), volume)
    return run


def handle_positions(**options):
    return lambda change: restored(points_of(bindpose.automatic_handles(mesh(change, False), **options)), change)


def fair(change):
    vertices, faces = mesh(change)
    fixed = (np.arange(len(vertices)) % 5 == 0).astype(int)
    return restored(bindpose.fair((vertices, faces), fixed), change)


def smooth(change):
    data = np.sin(4 * VERTICES[:, 0]) + VERTICES[:, 1]
    return np.asarray(bindpose.monotone_smoothing(mesh(change), data, number_of_extrema=2))


def colors(change):
    return np.asarray(bindpose.weighted_colors(mesh(change), handles(change), {"p1": (1, 0, 0), "p2": (0, 1, 0), "b1": (0, 0, 1)},
                                               weights=rest_weights()))


FUNCTIONS = {
    "winding_number": (winding_numbers, 1e-9, 1e-8),
    "winding_number on a grid": (grid, 1e-9, 1e-8),
    "weights, embedding": (weights(domain="embedding"), 1e-9, 1e-3),
    "weights, volume": (weights(domain="volume"), 1e-6, 1e-2),
    "weights, surface": (weights(domain="surface"), 1e-6, 1e-6),
    "weights, monotone": (weights(domain="surface", method="monotone"), 1e-4, 1e-4),
    "weights, bone heat": (weights(domain="surface", method="bone-heat"), 1e-6, 1e-6),
    "weights, inverse distance": (weights(domain="surface", method="inverse-distance"), 1e-9, 1e-6),
    "deform, lbs": (posed(method="lbs"), 1e-12, 1e-8),
    "deform, dqs": (posed(method="dqs"), 1e-12, 1e-8),
    "deform, reduced-arap": (posed(method="reduced-arap"), 1e-6, 1e-5),
    "deform, full-arap": (posed(method="full-arap"), 1e-6, 1e-5),
    "deform, mls": (posed(method="mls"), 1e-9, 1e-6),
    "tetrahedralize, embed": (tets(method="embed"), 1e-9, None),
    "tetrahedralize, auto": (tets(method="auto"), 1e-9, None),
    "automatic_handles, points": (handle_positions(method="points", number_of_points=5), 1e-9, 1e-6),
    "automatic_handles, skeleton": (handle_positions(method="skeleton"), 1e-9, None),
    "fair": (fair, 1e-6, 1e-5),
    "monotone_smoothing": (smooth, 1e-5, 1e-5),
    "weighted_colors": (colors, 1e-12, 1e-12),
}


@pytest.fixture(scope="module")
def references():
    return {}


@pytest.mark.parametrize("change", CHANGES, ids=str)
@pytest.mark.parametrize("name", FUNCTIONS)
def test_results_are_invariant_to_scale_and_position(references, name, change):
    function, of_scale, of_shift = FUNCTIONS[name]
    if name not in references:
        references[name] = function((1.0, 0.0))
    expected, found = references[name], function(change)
    tolerance = of_scale if change[1] == 0 else of_shift
    assert np.isfinite(found).all()
    if tolerance is None:
        return
    assert found.shape == expected.shape
    assert np.abs(found - expected).max() <= tolerance


@pytest.mark.parametrize("factor, shift, words", [(2.0 ** 345, 0, "1e102"), (2.0 ** -345, 0, "expected 1e-102 to 1e102"),
                                                  (1.0, 2.0 ** 45, "too far from the origin"), (2.0 ** 1022, 0, "1e1[02]")])
@pytest.mark.parametrize("function", [winding_numbers, weights(domain="auto"), posed(method="full-arap"), tets(method="auto"),
                                      handle_positions(method="points", number_of_points=5)])
def test_shapes_out_of_range_are_refused(function, factor, shift, words):
    with pytest.raises(bindpose.InvalidInput, match=words):
        function((factor, shift))
