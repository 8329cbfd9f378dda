#!/usr/bin/env python3
"""Clothes get the weights of the body that wears them.

A skirt stands around the legs of a body with automatic bones. If each point of the skirt gets the weights of the nearest
point of the body, the skirt has a patch that follows a hand, and it tears between the legs: neighboring points follow
different legs. Inpainting uses the nearest point only where distance and normal match, and solves for the rest: the
smoothest bounded weights that continue the matched ones. The second row shows the skirt after the left leg is raised.

Numbers for both methods: the largest weight of an arm bone on the skirt (a leak: no arm is connected to the skirt); the
largest difference of the weights along an edge of the skirt; the stretch of its edges in the pose, at the 99th percentile
and at most. For inpainting: the fraction of matched points, the largest relative gap of the certificates, seconds.
"""

import time
import warnings

import common
import bindpose
import numpy as np
from bindpose.meshes import point_array, points_of, to_dataset

CENTER = (-0.02, -0.02)  # of the waist; the body is 1 high, with z up, and its center is the origin


def skirt(around, rows):
    """Return a cone from the waist to below the knees, outward."""
    down = np.linspace(0, 1, rows)[:, None]
    angle = 2 * np.pi * np.arange(around)[None, :] / around
    points = np.stack([CENTER[0] + (0.095 + 0.16 * down) * np.cos(angle), CENTER[1] + (0.085 + 0.12 * down) * np.sin(angle),
                       0.08 - 0.34 * down + 0 * angle], axis=2).reshape(-1, 3)
    row, column = np.meshgrid(np.arange(rows - 1), np.arange(around), indexing="ij")
    a, b = (row * around + column).ravel(), (row * around + (column + 1) % around).ravel()
    return points, np.concatenate([np.stack([a, a + around, b], axis=1), np.stack([b, a + around, b + around], axis=1)])


def edges_of(triangles):
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    return np.unique(np.sort(edges, axis=1), axis=0)


def bones_by_place(handles):
    """Return the names of the arm bones, and of the thigh on the left side of the body (positive x)."""
    points = points_of(handles)
    ends = points[-2 * handles.GetNumberOfLines():].reshape(-1, 2, 3)
    names = [handles.GetCellData().GetAbstractArray("HandleName").GetValue(k) for k in range(handles.GetNumberOfCells())]
    middles = dict(zip(names, ends.mean(axis=1)))
    arms = [name for name, (x, _, z) in middles.items() if abs(x) > 0.08 and z > -0.05]
    thigh = max((name for name, (x, _, z) in middles.items() if x > 0 and -0.3 < z < -0.05),
                key=lambda name: np.linalg.norm(np.subtract(*ends[names.index(name)])))
    return arms, thigh


def make(options):
    body = common.demo_mesh(options, "man.off")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", bindpose.BindposeWarning)  # fingers are finer than the lattice
        handles = bindpose.automatic_handles(body, maximum_bones=20)
        weighted = bindpose.weights(body, handles, embedding_resolution=20 if options.small else 0)
    names = [handles.GetCellData().GetAbstractArray("HandleName").GetValue(k) for k in range(handles.GetNumberOfCells())]
    arms, thigh = bones_by_place(handles)
    pose = {"handles": {thigh: {"rotate": {"axis": [1, 0, 0], "degrees": -45}}}}
    points, triangles = skirt(*((48, 30) if options.small else (120, 75)))
    edges = edges_of(triangles)
    lengths = np.linalg.norm(points[edges[:, 0]] - points[edges[:, 1]], axis=1)
    bindpose.write(weighted, options.scratch / "body.vtp")
    bindpose.write(bindpose.deform(weighted, handles, pose), options.scratch / "body_posed.vtp")
    bindpose.write(handles, options.scratch / "bones.vtp")
    numbers = {"bones": len(names), "arm bones": len(arms)}
    for method in ("nearest", "inpaint"):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", bindpose.BindposeWarning)  # points of the skirt are far from the body
            begun = time.perf_counter()
            result = bindpose.transfer_weights(to_dataset((points, triangles)), weighted, method=method)
            seconds = time.perf_counter() - begun
        values = point_array(result, "Weights")
        posed = bindpose.deform(result, handles, pose)
        moved = points_of(posed)
        stretch = np.linalg.norm(moved[edges[:, 0]] - moved[edges[:, 1]], axis=1) / lengths
        numbers[f"{method}: largest weight of an arm bone"] = float(values[:, [names.index(name) for name in arms]].max())
        numbers[f"{method}: largest difference along an edge"] = float(np.abs(values[edges[:, 0]] - values[edges[:, 1]]).max())
        numbers[f"{method}: stretch of edges, 99 %"] = float(np.percentile(stretch, 99))
        numbers[f"{method}: stretch of edges, largest"] = float(stretch.max())
        if method == "inpaint":
            report = bindpose.report(result)
            numbers["inpaint: matched fraction"] = report["matched_fraction"]
            numbers["inpaint: largest relative gap"] = report["relative_gap"]
            numbers["inpaint: seconds"] = seconds
        bindpose.write(result, options.scratch / f"{method}.vtp")
        bindpose.write(posed, options.scratch / f"{method}_posed.vtp")
    common.render(options, "body.vtp", "nearest.vtp", "inpaint.vtp", "body_posed.vtp", "nearest_posed.vtp", "inpaint_posed.vtp",
                  "--color", "handle", "--columns", 3, "--size", "1500x1300", "--up", "z", "--azimuth", 0, "--elevation", 10,
                  "--labels", "body,nearest point,matched and inpainted,left leg raised,nearest point,matched and inpainted",
                  "--title", "The largest bone at each point of a skirt")
    return numbers


if __name__ == "__main__":
    common.main(__file__, __doc__, make)
