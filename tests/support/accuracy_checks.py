"""The numerical part of weights_accuracy.py: handles, quality of tets, weights carried to points, differences."""

import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy

from result_checks import read_obj, read_tets, read_weights, smallest_dihedral_angles
from separate_parts import farthest_points, largest_leak

NEAR = 0.01  # of the diagonal: vertices farther from the reference tets are not compared
MOST_VERTICES = 20_000
SEED = 7


def write_handles(model, path, count):
    """Write the handles of `--handles auto:N` as .tgf. Returns false if the model has too few vertices."""
    points, triangles = read_obj(model)
    if len(triangles) == 0 or len(np.unique(points[np.unique(triangles)], axis=0)) < count:
        return False
    chosen = points[farthest_points(points, triangles, count)].tolist()
    nodes = "".join("%d %r %r %r p%d\n" % (k, *point, k) for k, point in enumerate(chosen, 1))
    path.write_text(nodes + "#\n", encoding="ascii")
    return True


def chosen_vertices(points, triangles):
    """Ids of the vertices that are compared: all of them, or a seeded sample."""
    used = np.unique(triangles)
    if len(used) <= MOST_VERTICES:
        return used
    return np.sort(np.random.RandomState(SEED).choice(used, MOST_VERTICES, replace=False))


def closest_in(grid, queries):
    """The cell of the grid that is nearest to each query, the nearest point of it, and the distance."""
    locator = vtk.vtkStaticCellLocator()
    locator.SetDataSet(grid)
    locator.BuildLocator()
    generic, cell, sub, squared = vtk.vtkGenericCell(), vtk.reference(0), vtk.reference(0), vtk.reference(0.0)
    cells, places, distances = np.empty(len(queries), int), np.empty((len(queries), 3)), np.empty(len(queries))
    for k, query in enumerate(queries.tolist()):
        locator.FindClosestPoint(query, places[k], generic, cell, sub, squared)
        cells[k], distances[k] = int(cell), float(squared) ** 0.5
    return cells, places, distances


def read_grid(path):
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def connected_parts(grid):
    connectivity = vtk.vtkConnectivityFilter()
    connectivity.SetInputData(grid)
    connectivity.SetExtractionModeToAllRegions()
    connectivity.Update()
    return connectivity.GetNumberOfExtractedRegions()


def tets_quality(model, path):
    """Smallest dihedral angle, numbers of tets and connected parts, fraction of the vertices that are near the tets."""
    points, tets = read_tets(path)
    surface, triangles = read_obj(model)
    queries = surface[chosen_vertices(surface, triangles)]
    grid = read_grid(path)
    _, _, distances = closest_in(grid, queries)
    size = np.linalg.norm(np.ptp(queries, axis=0))
    return {"angle": float(smallest_dihedral_angles(points, tets).min()), "reference tets": len(tets),
            "parts": connected_parts(grid), "covered": float((distances <= NEAR * size).mean())}


def barycentric(points, tets, places):
    """Barycentric coordinates of one place per tet (#T x 4)."""
    origin = points[tets[:, 0]]
    edges = np.stack([points[tets[:, k]] - origin for k in (1, 2, 3)], axis=2)
    rest = np.linalg.solve(edges, (places - origin)[:, :, None])[:, :, 0]
    return np.column_stack([1 - rest.sum(axis=1), rest])


def carried(path, queries):
    """Weights of a .vtu file at the queries, linear in each tet, and the distances of the queries from the tets."""
    grid = read_grid(path)
    points, tets = read_tets(path)
    weights = vtk_to_numpy(grid.GetPointData().GetArray("Weights")).astype(float)
    cells, places, distances = closest_in(grid, queries)
    inside = barycentric(points, tets[cells], places)
    return np.einsum("ij,ijk->ik", inside, weights[tets[cells]]), distances


def difference(surface, reference):
    """How far the weights of a .vtp file are from those of a .vtu file."""
    points, triangles, weights = read_weights(surface)
    chosen = chosen_vertices(points, triangles)
    expected, distances = carried(reference, points[chosen])
    near = distances <= NEAR * np.linalg.norm(np.ptp(points[chosen], axis=0))
    gap = (weights[chosen] - expected)[near]
    return {"rms": float(np.sqrt((gap**2).mean())), "largest": float(np.abs(gap).max()),
            "leak": largest_leak(points, triangles, weights)}
