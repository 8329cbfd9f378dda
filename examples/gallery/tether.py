#!/usr/bin/env python3
"""A mesh of disconnected parts, held together by weights.

A string of balls, each a closed surface, has weights from one volume around all of them. Reduced as-rigid-as-possible
moves the balls together although no edge joins them, because neighboring balls have similar weights. Full
as-rigid-as-possible on the same mesh moves only the balls that a handle constrains.

Numbers: parts; the smallest and largest distance between the centers of neighboring balls, relative to rest, for the
reduced and the full method. For two copies of the string at the same position, with the same weights: the largest
difference between their posed points, relative to the diagonal.
"""

import warnings

import common
import bindpose
import numpy as np
from bindpose.meshes import add_point_array, point_array, points_of, to_dataset

import meshes
import posing

BALLS, RADIUS, STEP = 9, 0.5, 0.95


def make(options):
    balls = [meshes.sphere(2 if options.small else 3, RADIUS, (k * STEP, 0, 0)) for k in range(BALLS)]
    each = len(balls[0][0])
    mesh = meshes.joined(*balls)
    # Create one volume that contains all balls: a bar.
    points, tets = posing.bar(*((20, 4) if options.small else (40, 8)), length=BALLS * STEP + 0.4)
    points = points * [1, 1.3, 1.3] - [STEP / 2 + 0.2, 0.65, 0.65]
    last = (BALLS - 1) * STEP
    handles = bindpose.handles(points=[(0, 0, 0), (last / 2, 0, 0), (last, 0, 0)])
    inside = bindpose.weights(to_dataset((points, tets)), handles)
    transfer = bindpose.vtkTransferWeights()
    transfer.SetInputData(0, to_dataset(mesh))
    transfer.SetInputData(1, inside)
    bindpose.run(transfer)
    weighted = transfer.GetOutput()
    pose = {"p1": {"translate": [0.6, 0, 1.2], "rotate": {"axis": [0, 1, 0], "degrees": 50}},
            "p2": {"mode": "position", "translate": [0, 0, -0.6]},
            "p3": {"translate": [-0.6, 0, 1.2], "rotate": {"axis": [0, 1, 0], "degrees": -50}}}
    numbers = {"parts": BALLS}
    files = ["rest.vtp"]
    bindpose.write(to_dataset(mesh), options.scratch / files[0])
    for name, bender, extra in (("reduced", bindpose.vtkReducedARAP(), {"NumberOfExtraWeights": 15}),
                                ("full", bindpose.vtkFullARAP(), {})):
        with warnings.catch_warnings():
            # ignore two kinds of warnings: a component has no handle; a handle is not on the mesh
            warnings.simplefilter("ignore", bindpose.BindposeWarning)
            posed = posing.posed(bender, weighted, handles, pose, MaximumIterations=2000, **extra)
        centers = points_of(posed).reshape(BALLS, each, 3).mean(axis=1)
        gaps = np.linalg.norm(np.diff(centers, axis=0), axis=1) / STEP
        numbers[f"{name}: distances of neighbors"] = [float(gaps.min()), float(gaps.max())]
        files.append(f"{name}.vtp")
        bindpose.write(to_dataset((points_of(posed), mesh[1])), options.scratch / files[-1])
    # Create a mesh of two copies of the balls, at the same positions.
    twice = to_dataset(meshes.joined(mesh, mesh))
    row = np.asarray(point_array(weighted, "Weights"))
    add_point_array(twice, "Weights", np.vstack([row, row]), ["p1", "p2", "p3"])
    both = points_of(posing.posed(bindpose.vtkReducedARAP(), twice, handles, pose, MaximumIterations=200))
    diagonal = np.linalg.norm(np.ptp(mesh[0], axis=0))
    numbers["largest difference between two copies of the mesh"] = float(
        np.abs(both[:len(mesh[0])] - both[len(mesh[0]):]).max() / diagonal)
    common.render(options, *files, "--columns", 1, "--size", "1100x1250", "--up", "z", "--azimuth", -35, "--elevation", 15,
                  "--labels", "at rest: nine balls,reduced: weights keep them together,full: they separate",
                  "--title", "Disconnected parts")
    return numbers


if __name__ == "__main__":
    common.main(__file__, __doc__, make)
