"""Functions that generate surfaces as pairs of arrays (vertices #V x 3, triangles #F x 3). Another function computes
winding numbers by a direct sum of solid angles."""

import numpy as np


def cube(lower=-1.0, upper=1.0):
    """Return twelve triangles, counter-clockwise seen from outside."""
    vertices = [[upper if v >> k & 1 else lower for k in range(3)] for v in range(8)]
    triangles = [[0, 4, 6], [0, 6, 2], [1, 3, 7], [1, 7, 5], [0, 1, 5], [0, 5, 4],
                 [2, 6, 7], [2, 7, 3], [0, 2, 3], [0, 3, 1], [4, 5, 7], [4, 7, 6]]
    return np.array(vertices, dtype=float), np.array(triangles)


def tube(curve, radius, around=24):
    """Return a closed tube of the given radius about a closed plane curve (#C x 3, z = 0)."""
    curve = np.asarray(curve, dtype=float)
    along = np.roll(curve, -1, axis=0) - np.roll(curve, 1, axis=0)
    along /= np.linalg.norm(along, axis=1)[:, None]
    beside = np.stack([along[:, 1], -along[:, 0], 0 * along[:, 0]], axis=1)
    angle = 2 * np.pi * np.arange(around) / around
    ring = np.cos(angle)[None, :, None] * beside[:, None] + np.sin(angle)[None, :, None] * np.array([0.0, 0.0, 1.0])
    vertices = (curve[:, None] + radius * ring).reshape(-1, 3)
    i, j = np.meshgrid(np.arange(len(curve)), np.arange(around), indexing="ij")
    a, b = (i * around + j).ravel(), (i * around + (j + 1) % around).ravel()
    c, d = ((i + 1) % len(curve) * around + j).ravel(), ((i + 1) % len(curve) * around + (j + 1) % around).ravel()
    return vertices, np.vstack([np.stack([a, c, d], axis=1), np.stack([a, d, b], axis=1)])


def circle(radius, count=64):
    """Return a plane curve for `tube`."""
    angle = 2 * np.pi * np.arange(count) / count
    return np.stack([radius * np.cos(angle), radius * np.sin(angle), 0 * angle], axis=1)


def edges_of(triangles):
    """Return the edges of triangles, #E x 2, each once."""
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    return np.unique(np.sort(edges, axis=1), axis=0)


def subdivided(mesh, times):
    """Split each triangle into four at its edge midpoints, `times` times. The surface does not change."""
    vertices, triangles = map(np.asarray, mesh)
    for _ in range(times):
        edges = np.sort(np.vstack([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
        ends, ids = np.unique(edges, axis=0, return_inverse=True)
        m = len(vertices) + ids.reshape(3, -1).T
        vertices = np.vstack([vertices, vertices[ends].mean(axis=1)])
        a, b, c = triangles.T
        triangles = np.vstack([np.stack(t, axis=1) for t in (
            (a, m[:, 0], m[:, 2]), (m[:, 0], b, m[:, 1]), (m[:, 2], m[:, 1], c), (m[:, 0], m[:, 1], m[:, 2]))])
    return vertices, triangles


def sphere(times=3, radius=1.0, center=(0.0, 0.0, 0.0)):
    """Return a sphere of 20 x 4^times triangles: a subdivided icosahedron, projected to the sphere."""
    g = (1 + 5 ** 0.5) / 2
    vertices = np.array([[-1, g, 0], [1, g, 0], [-1, -g, 0], [1, -g, 0], [0, -1, g], [0, 1, g], [0, -1, -g], [0, 1, -g],
                         [g, 0, -1], [g, 0, 1], [-g, 0, -1], [-g, 0, 1]], dtype=float)
    triangles = np.array([[0, 11, 5], [0, 5, 1], [0, 1, 7], [0, 7, 10], [0, 10, 11], [1, 5, 9], [5, 11, 4], [11, 10, 2],
                          [10, 7, 6], [7, 1, 8], [3, 9, 4], [3, 4, 2], [3, 2, 6], [3, 6, 8], [3, 8, 9], [4, 9, 5],
                          [2, 4, 11], [6, 2, 10], [8, 6, 7], [9, 8, 1]])
    vertices, triangles = subdivided((vertices, triangles), times)
    return np.asarray(center) + radius * vertices / np.linalg.norm(vertices, axis=1)[:, None], triangles


def centers(mesh):
    """Return the barycenters of the triangles, #F x 3."""
    return mesh[0][mesh[1]].mean(axis=1)


def moved(mesh, shift):
    return mesh[0] + np.asarray(shift, dtype=float), mesh[1]


def without(mesh, which):
    """Return the triangles where `which` (#F, bool) is false."""
    return mesh[0], mesh[1][~np.asarray(which)]


def flipped(mesh, which=True):
    """Turn over the triangles where `which` is true."""
    return mesh[0], np.where(np.broadcast_to(which, len(mesh[1]))[:, None], mesh[1][:, ::-1], mesh[1])


def joined(*meshes):
    """Return all meshes as one mesh."""
    firsts = np.cumsum([0, *[len(mesh[0]) for mesh in meshes[:-1]]])
    return (np.vstack([mesh[0] for mesh in meshes]),
            np.vstack([mesh[1] + first for mesh, first in zip(meshes, firsts)]))


def triangles_of(surface):
    """Return a vtkPolyData of triangles as arrays."""
    from vtkmodules.util.numpy_support import vtk_to_numpy

    vertices = np.array(vtk_to_numpy(surface.GetPoints().GetData()), dtype=float)
    return vertices, np.array(vtk_to_numpy(surface.GetPolys().GetConnectivityArray())).reshape(-1, 3)


def tet_volumes(tets):
    """Return the volumes of a vtkUnstructuredGrid of tets, #T, in its own order."""
    from bindpose.meshes import points_of, tets_of

    a, b, c, d = np.moveaxis(points_of(tets)[tets_of(tets)], 1, 0)
    return np.einsum("ij,ij->i", b - a, np.cross(c - a, d - a)) / 6


def plain_winding_number(mesh, points):
    """Return the winding number by its definition: the sum of all triangles' signed solid angles / 4 pi, at #P points
    (Van Oosterom and Strackee, 1983). It is the reference for the package's results."""
    values = np.zeros(len(points))
    for number, point in enumerate(np.asarray(points, dtype=float)):
        for first in range(0, len(mesh[1]), 4096):  # process blocks that fit into the cache
            a, b, c = np.moveaxis(mesh[0][mesh[1][first:first + 4096]] - point, 1, 0)
            la, lb, lc = (np.sqrt(np.einsum("ij,ij->i", v, v)) for v in (a, b, c))
            ab, bc, ca = (np.einsum("ij,ij->i", v, w) for v, w in ((a, b), (b, c), (c, a)))
            volume = np.einsum("ij,ij->i", a, np.cross(b, c))
            values[number] += np.arctan2(volume, la * lb * lc + ab * lc + bc * la + ca * lb).sum() / (2 * np.pi)
    return values
