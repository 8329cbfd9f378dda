#!/usr/bin/env python3
"""As rigid as possible, every vertex on its own or in the space of smooth weights.

A bump, a bend and a twist, from left to right; above with reduced as-rigid-as-possible and 15 extra weights, below with
full. They minimise the same energy under the same handles: full has more freedom and gets lower, reduced takes
microseconds an iteration, whatever the mesh.

Numbers, reduced and full: the energy; iterations and microseconds each; the sharpest fold between neighbouring
triangles, in degrees; the root mean square of the vertices' differences, of the shape's diagonal.
"""

import itertools
import json

import common
import bindpose
import numpy as np
from bindpose.meshes import points_of, to_dataset

METHODS = {"reduced": bindpose.vtkReducedARAP, "full": bindpose.vtkFullARAP}
EXTRA_WEIGHTS = 15
MIDDLE = np.array([3, 0.5, 0.5])


def plane(count):
    """A square of 5 by 5, as large as the bar and where it is."""
    x, y = np.meshgrid(np.linspace(-1, 1, count + 1), np.linspace(-1, 1, count + 1))
    points = np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1) * 2.5 + MIDDLE
    corner = (np.arange(count)[:, None] * (count + 1) + np.arange(count)).ravel()
    squares = np.stack([corner, corner + 1, corner + count + 2, corner + count + 1], axis=1)
    return points, np.concatenate([squares[:, [0, 1, 2]], squares[:, [0, 2, 3]]])


def bar(along, across):
    """A bar of 6 by 1 by 1, six tets a cell."""
    shape = (along + 1, across + 1, across + 1)
    i = np.stack(np.meshgrid(*map(np.arange, shape), indexing="ij"), axis=-1).reshape(-1, 3)
    cells = i[(i < np.array(shape) - 1).all(axis=1)]
    tets = []
    for order, turned in zip(itertools.permutations(range(3)), (0, 1, 1, 0, 0, 1)):
        corners = [cells]
        for axis in order:
            corners.append(corners[-1] + np.eye(3, dtype=int)[axis])
        ids = np.stack([np.ravel_multi_index(c.T, shape) for c in corners], axis=1)
        tets.append(ids[:, [1, 0, 2, 3]] if turned else ids)
    return i * [6 / along, 1 / across, 1 / across], np.concatenate(tets)


def sharpest_fold(points, triangles):
    """Degrees between the normals of triangles that share an edge."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    normals = np.cross(b - a, c - a)
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    edges = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    order = np.lexsort((edges[:, 1], edges[:, 0]))
    owner = order % len(triangles)
    pairs = (edges[order[1:]] == edges[order[:-1]]).all(axis=1)
    cosines = (normals[owner[1:][pairs]] * normals[owner[:-1][pairs]]).sum(axis=1)
    return float(np.degrees(np.arccos(np.clip(cosines.min(), -1, 1))))


def bend(method, mesh, handles, pose):
    """The posed mesh from scratch."""
    poser = bindpose.vtkPoseHandles()
    poser.SetInputData(handles)
    poser.SetPoseJSON(json.dumps({"handles": pose}))
    bender = METHODS[method]()
    if method == "reduced":
        bender.SetNumberOfExtraWeights(EXTRA_WEIGHTS)
    bender.SetMaximumIterations(5000)
    bender.SetInputData(0, mesh)
    bender.SetInputConnection(1, poser.GetOutputPort())
    bender.Update()
    return bender.GetOutput()


def make(options):
    small = options.small
    square, box = plane(16 if small else 48), bar(18 if small else 48, 4 if small else 8)
    # From two opposite corners: a bone whose head is another's tail would have that one as parent.
    corners = {c: 2.5 * np.array([*c, 0]) + MIDDLE for c in itertools.product((-1, 1), repeat=2)}
    rim = [(corners[k, k], corners[c]) for k in (-1, 1) for c in ((-1, 1), (1, -1))]
    on_plane = bindpose.handles(points=[MIDDLE], bones=rim)
    ends = bindpose.handles(bones=[[(x, 0, 0.5), (x, 1, 0.5)] for x in (0, 6)])
    cases = {
        "bump": (square, on_plane, {"p1": {"translate": [0, 0, 1.75]}}),
        "bend": (box, ends, {"b2": {"translate": [-2, 0, 2.5], "rotate": {"axis": [0, 1, 0], "degrees": -90}}}),
        "twist": (box, ends, {"b2": {"translate": [0, 0.5, -0.5], "rotate": {"axis": [1, 0, 0], "degrees": 90}}}),
    }
    numbers, files = {}, {method: [] for method in METHODS}
    for name, (mesh, handles, pose) in cases.items():
        surface = name == "bump"
        weighted = bindpose.weights(to_dataset(mesh), handles, domain="surface" if surface else "auto")
        posed = {}
        for method in METHODS:
            posed[method] = bend(method, weighted, handles, pose)
            report = bindpose.report(posed[method])
            files[method].append(f"{name}-{method}.{'vtp' if surface else 'vtu'}")
            bindpose.write(posed[method], options.scratch / files[method][-1])
            numbers[f"{name}, {method}, energy"] = report["energy"]
            numbers[f"{name}, {method}, iterations"] = report["iterations"]
            numbers[f"{name}, {method}, microseconds"] = report["microseconds_per_iteration"]
            if surface:
                numbers[f"{name}, {method}, sharpest fold"] = sharpest_fold(points_of(posed[method]), mesh[1])
        apart = points_of(posed["reduced"]) - points_of(posed["full"])
        diagonal = np.linalg.norm(np.ptp(mesh[0], axis=0))
        numbers[f"{name}, apart"] = float(np.sqrt((apart ** 2).sum(axis=1).mean()) / diagonal)
    labels = [f"{name}: {method} {numbers[f'{name}, {method}, energy']:.3g}"
              for method in METHODS for name in cases]
    common.render(options, *files["reduced"], *files["full"], "--columns", 3, "--size", "1500x900", "--edges",
                  "--up", "z", "--azimuth", 20, "--elevation", 20, "--section", "none",
                  "--labels", ",".join(labels),
                  "--title", "As rigid as possible, reduced above and full below, with energies")
    return numbers


if __name__ == "__main__":
    common.main(__file__, __doc__, make)
