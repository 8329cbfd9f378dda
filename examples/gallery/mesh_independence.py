#!/usr/bin/env python3
"""Weights depend on the shape, not on its mesh.

One square with five points has two meshes: the right half of the second mesh is four times finer. The biharmonic energy
of the graph of vertices (L'L, without areas) treats the fine half as a larger area and therefore gives different
weights. The energy of the shape, with each vertex's area (Jacobson, Tosun, Sorkine, Zorin 2010), hardly changes. Right:
the difference.

Numbers: largest and rms difference over the common vertices; and, for a bar with a handle at each end, the weight of
the far handle at a quarter of the length, which must be 0.15625 for any mesh.
"""

import common
import bindpose
import numpy as np
from bindpose.meshes import to_dataset
from new_hues import POINTS

METHODS = {"graph": "graph-biharmonic", "areas": "biharmonic"}
MESHES = {"even": "even mesh", "fine": "mesh with a finer right half"}


def grid_at(x, y):
    """Return rectangles between the given coordinates, cut along the same diagonal."""
    columns, rows = len(x) - 1, len(y) - 1
    first = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).ravel()
    right, up = first + 1, first + columns + 1
    triangles = np.concatenate([np.stack([first, right, up + 1], axis=1), np.stack([first, up + 1, up], axis=1)])
    x, y = np.meshgrid(x, y)
    return np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1), triangles


def unequal(count, times):
    """Return 0 to 1 in `count` steps; each step of the second half is divided into `times` smaller ones."""
    half = np.linspace(0, 0.5, count // 2 + 1)
    return np.concatenate([half[:-1], 0.5 + np.linspace(0, 0.5, times * count // 2 + 1)])


def make(options):
    count = 20 if options.small else 40
    even, uneven = np.linspace(0, 1, count + 1), unequal(count, 4)
    rows = even
    meshes = {"even": grid_at(even, rows), "fine": grid_at(uneven, rows)}
    common_vertices = {name: np.concatenate([row * len(x) + np.array([np.argmin(abs(x - at)) for at in even])
                                             for row in range(len(rows))])
                       for name, x in (("even", even), ("fine", uneven))}
    handles = bindpose.handles(points=[[*place, 0] for place, _color in POINTS])
    bindpose.write(handles, options.scratch / "handles.vtp")
    numbers = {f"triangles, {MESHES[name]}": len(mesh[1]) for name, mesh in meshes.items()}
    for method, word in METHODS.items():
        found = {}
        for name, mesh in meshes.items():
            weighted = bindpose.weights(to_dataset(mesh), handles, method=word, domain="surface")
            bindpose.write(weighted, options.scratch / f"{method}-{name}.vtp")
            found[name] = bindpose.meshes.point_array(weighted, "Weights")
        difference = found["fine"][common_vertices["fine"]] - found["even"]
        numbers[f"{method}: largest difference"] = float(abs(difference).max())
        numbers[f"{method}: rms difference"] = float(np.sqrt((difference ** 2).mean()))
        # Write both results at the common vertices of the two meshes, because `bindpose render --minus` subtracts them
        # vertex by vertex.
        for file, values in ((f"{method}-a.vtp", found["fine"][common_vertices["fine"]]),
                             (f"{method}-b.vtp", found["even"])):
            mesh = to_dataset(meshes["even"])
            bindpose.meshes.add_point_array(mesh, "Weights", values, [f"p{j + 1}" for j in range(len(POINTS))])
            bindpose.write(mesh, options.scratch / file)
    pictures = []
    height = 500
    for method in METHODS:
        left, right = options.scratch / f"{method}-left.png", options.scratch / f"{method}-right.png"
        common.render(options, f"{method}-even.vtp", f"{method}-fine.vtp", "--component", "p3", "--handles", "handles.vtp",
                      "--edges", "--columns", 2, "--size", f"1000x{height}", "--range", "-0.3,1.1",
                      "--labels", ",".join(f"{method}: {name}" for name in MESHES.values()), picture=left)
        largest = numbers[f"{method}: largest difference"]
        shown = common.render(options, f"{method}-a.vtp", "--minus", f"{method}-b.vtp", "--component", "p3", "--handles",
                              "handles.vtp", "--edges", "--size", f"600x{height}", "--range", "-0.3,0.3",
                              "--labels", f"{method}: difference between both meshes (rms "
                              f"{100 * numbers[f'{method}: rms difference']:.2g} %)", picture=right)
        assert shown["difference"]["largest"] <= largest + 1e-12
        pictures += [left, right]
    common.side_by_side(options, pictures, 2)

    for name, x in (("even", even), ("fine", uneven)):
        bar = grid_at(x, np.array([0, 0.5, 1]) / count)
        ends = bindpose.handles(bones=[[[at, 0, 0], [at, 1 / count, 0]] for at in (0.0, 1.0)], parents=[-1] * 2)
        for method, word in METHODS.items():
            weights = bindpose.weights(bar, ends, method=word, domain="surface")
            numbers[f"{method}: weight at a quarter of a bar, {MESHES[name]}"] = float(
                weights[np.argmin(abs(x - 0.25)), 1])
    return numbers


if __name__ == "__main__":
    common.main(__file__, __doc__, make)
