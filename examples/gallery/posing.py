"""A plane and a bar to bend, and filters that pose them without a warm start."""

import itertools
import json

import bindpose
import numpy as np
from bindpose.meshes import points_of


def plane(count, size=2.0, middle=(0.0, 0.0, 0.0)):
    """Return a square in z = 0, count by count squares of two triangles."""
    x, y = np.meshgrid(np.linspace(-1, 1, count + 1), np.linspace(-1, 1, count + 1))
    points = np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1) * size / 2 + np.asarray(middle, dtype=float)
    corner = (np.arange(count)[:, None] * (count + 1) + np.arange(count)).ravel()
    squares = np.stack([corner, corner + 1, corner + count + 2, corner + count + 1], axis=1)
    return points, np.concatenate([squares[:, [0, 1, 2]], squares[:, [0, 2, 3]]])


def bar(along, across, length=6.0):
    """Return a bar of length by 1 by 1, six tets per cell."""
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
    return i * [length / along, 1 / across, 1 / across], np.concatenate(tets)


def skin_of(tets):
    """Return the triangles of the boundary of tets (#T x 4), outwards, with the tets' vertex ids."""
    facets = np.concatenate([tets[:, [0, 2, 1]], tets[:, [0, 1, 3]], tets[:, [1, 2, 3]], tets[:, [0, 3, 2]]])
    _, first, count = np.unique(np.sort(facets, axis=1), axis=0, return_index=True, return_counts=True)
    return facets[first[count == 1]]


def posed(bender, mesh, handles, pose, **settings):
    """Pose a mesh (with weights) by a filter without a warm start; settings are the filter's parameters."""
    poser = bindpose.vtkPoseHandles()
    poser.SetInputData(handles)
    poser.SetPoseJSON(json.dumps({"handles": pose}))
    for name, value in settings.items():
        getattr(bender, f"Set{name}")(value)
    bender.SetInputData(0, mesh)
    bender.SetInputConnection(1, poser.GetOutputPort())
    bindpose.run(bender)
    return bender.GetOutput()


def sharpest_fold(points, triangles):
    """Return the largest angle in degrees between the normals of triangles that share an edge."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    normals = np.cross(b - a, c - a)
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    edges = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    order = np.lexsort((edges[:, 1], edges[:, 0]))
    owner = order % len(triangles)
    pairs = (edges[order[1:]] == edges[order[:-1]]).all(axis=1)
    cosines = (normals[owner[1:][pairs]] * normals[owner[:-1][pairs]]).sum(axis=1)
    return float(np.degrees(np.arccos(np.clip(cosines.min(), -1, 1))))


def rms_apart(rest, one, other):
    """Return the rms distance between the points of two posed meshes, as a fraction of the diagonal of `rest`."""
    apart = points_of(one) - points_of(other)
    return float(np.sqrt((apart ** 2).sum(axis=1).mean()) / np.linalg.norm(np.ptp(rest, axis=0)))
