"""Numerical part of weights_accuracy.py: handles, quality of tets, places where tets do not follow the surface,
interpolation of weights at points, and differences between weights.
"""

import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy

from result_checks import (areas, read_obj, read_tets, read_weights, smallest_dihedral_angles, winding_at,
                           write_poly_data, write_tets)
from separate_parts import farthest_points, largest_leak, poly_data, weld

NEAR = 0.01  # in bounding-box diagonals: vertices farther from the reference tets are not compared
MOST_VERTICES = 20_000
SEED = 7
SAMPLES = 20_000  # random points on the surface where films and bridged gaps are looked for
SIDE = 1e-6  # in bounding-box diagonals: distance of the points on both sides of a sample
FACING = 0.8  # smallest absolute cosine between the normals of facing triangles
PLACES = 8  # random points per tet that are tested for being outside of the model
FACETS = [(1, 2, 3), (0, 2, 3), (0, 1, 3), (0, 1, 2)]


def write_handles(model, path, count):
    """Write the handles of `--handles auto:N` as .tgf. Return False if the model has too few vertices."""
    points, triangles = read_obj(model)
    if len(triangles) == 0 or len(np.unique(points[np.unique(triangles)], axis=0)) < count:
        return False
    chosen = points[farthest_points(points, triangles, count)].tolist()
    nodes = "".join("%d %r %r %r p%d\n" % (k, *point, k) for k, point in enumerate(chosen, 1))
    path.write_text(nodes + "#\n", encoding="ascii")
    return True


def chosen_vertices(points, triangles):
    """Return the ids of the vertices to compare: all of them, or a seeded sample."""
    used = np.unique(triangles)
    if len(used) <= MOST_VERTICES:
        return used
    return np.sort(np.random.RandomState(SEED).choice(used, MOST_VERTICES, replace=False))


def locator_of(data):
    locator = vtk.vtkStaticCellLocator()
    locator.SetDataSet(data)
    locator.BuildLocator()
    return locator


def closest_in(grid, queries):
    """Return for each query the nearest cell of the grid, the nearest point on this cell, and the distance."""
    locator = locator_of(grid)
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


def write_without_doubles(model, path):
    """Write an .obj model as .vtp with only one copy of each triangle. Otherwise the winding numbers of coincident copies
    with opposite orientations would cancel.
    """
    points, triangles, _ = weld(*read_obj(model))
    _, first = np.unique(np.sort(triangles, axis=1), axis=0, return_index=True)
    write_poly_data(path, poly_data(points, triangles[np.sort(first)]))


def are_inner(tets):
    """Return True for each tet that shares all four facets with other tets."""
    facets = np.sort(np.concatenate([tets[:, [a, b, c]] for a, b, c in FACETS]), axis=1)
    _, ids, count = np.unique(facets, axis=0, return_inverse=True, return_counts=True)
    return (count[ids.ravel()].reshape(len(FACETS), -1) == 2).all(axis=0)


def open_gaps(program, model, path):
    """Remove from a .vtu file the tets that bridge gaps. A tet bridges a gap if its center is outside of the model, or
    if all its facets are shared and a sampled point in it is outside."""
    single = path.parent / "single.vtp"
    write_without_doubles(model, single)
    points, tets = read_tets(path)
    shares = np.vstack([np.full(4, 0.25), np.random.RandomState(SEED).dirichlet(np.ones(4), PLACES)])
    places = np.einsum("kc,tcd->tkd", shares, points[tets]).reshape(-1, 3)
    winding = np.abs(winding_at(program, single, places, path.parent)).reshape(len(tets), -1)
    outside = winding < 0.5
    bridges = outside[:, 0] | (are_inner(tets) & outside.any(axis=1))
    write_tets(path, points, tets[~bridges])


def unit_normals(points, triangles):
    a, b, c = (points[triangles[:, k]] for k in range(3))
    normals = np.cross(b - a, c - a)
    return normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)


def surface_samples(points, triangles):
    """Return random points on the triangles, uniform by area, and the triangle of each point."""
    random = np.random.RandomState(SEED)
    size = areas(points, triangles)
    owners = random.choice(len(triangles), SAMPLES, p=size / size.sum())
    shares = random.dirichlet(np.ones(3), SAMPLES)
    return np.einsum("kc,kcd->kd", shares, points[triangles[owners]]), owners


def middles_of_gaps(points, triangles, normals, starts, rays):
    """Cast a ray from each start. If the first triangle that the ray hits faces the ray (see FACING),
    return the midpoint between the start and the hit, and the index of the start."""
    locator = locator_of(poly_data(points, triangles))
    hit, parametric = [0.0] * 3, [0.0] * 3
    along, sub, cell = vtk.reference(0.0), vtk.reference(0), vtk.reference(0)
    middles, owners = [], []
    for k, (start, ray) in enumerate(zip(starts, rays)):
        found = locator.IntersectWithLine(start, start + ray, 0.0, along, hit, parametric, sub, cell)
        if found and abs(normals[int(cell)] @ ray) >= FACING * np.linalg.norm(ray):
            middles.append((start + hit) / 2)
            owners.append(k)
    return np.array(middles).reshape(-1, 3), np.array(owners, int)


def surface_without_tets(program, model, path, reach):
    """Return two fractions of the surface's area where the tets do not follow the surface. "films" is the fraction with
    the outside on both sides. "bridged" is the fraction where tets bridge a gap between two
    facing triangles that is at most `reach` bounding-box diagonals wide."""
    single = path.parent / "single.vtp"
    write_without_doubles(model, single)
    points, triangles, _ = weld(*read_obj(model))
    places, owners = surface_samples(points, triangles)
    normals = unit_normals(points, triangles)
    diagonals = np.linalg.norm(np.ptp(points, axis=0)) * np.vstack([normals[owners], -normals[owners]])
    sides = np.tile(places, (2, 1)) + SIDE * diagonals
    middles, starts = middles_of_gaps(points, triangles, normals, sides, reach * diagonals)
    winding = winding_at(program, single, np.vstack([sides, middles]), path.parent)
    if (winding <= -0.5).sum() > (winding >= 0.5).sum():  # all patches are inside out
        winding = -winding
    outside = winding < 0.5
    locator = locator_of(read_grid(path))
    bridged = {start % SAMPLES for start, middle, out in zip(starts, middles, outside[2 * SAMPLES:])
               if out and locator.FindCell(middle) >= 0}
    return {"films": float((outside[:SAMPLES] & outside[SAMPLES:2 * SAMPLES]).mean()), "bridged": len(bridged) / SAMPLES}


def connected_parts(grid):
    connectivity = vtk.vtkConnectivityFilter()
    connectivity.SetInputData(grid)
    connectivity.SetExtractionModeToAllRegions()
    connectivity.Update()
    return connectivity.GetNumberOfExtractedRegions()


def tets_quality(model, path):
    """Return the smallest dihedral angle, the numbers of tets and of connected parts, and the fraction of the vertices
    that are near the tets.
    """
    points, tets = read_tets(path)
    surface, triangles = read_obj(model)
    queries = surface[chosen_vertices(surface, triangles)]
    grid = read_grid(path)
    _, _, distances = closest_in(grid, queries)
    size = np.linalg.norm(np.ptp(queries, axis=0))
    return {"angle": float(smallest_dihedral_angles(points, tets).min()), "reference tets": len(tets),
            "parts": connected_parts(grid), "covered": float((distances <= NEAR * size).mean())}


def barycentric(points, tets, places):
    """Return the barycentric coordinates of one point per tet (#T x 4)."""
    origin = points[tets[:, 0]]
    edges = np.stack([points[tets[:, k]] - origin for k in (1, 2, 3)], axis=2)
    rest = np.linalg.solve(edges, (places - origin)[:, :, None])[:, :, 0]
    return np.column_stack([1 - rest.sum(axis=1), rest])


def carried(path, queries):
    """Interpolate the weights of a .vtu file linearly at the query points. Also return the distances of the query
    points from the tets.
    """
    grid = read_grid(path)
    points, tets = read_tets(path)
    weights = vtk_to_numpy(grid.GetPointData().GetArray("Weights")).astype(float)
    cells, places, distances = closest_in(grid, queries)
    inside = barycentric(points, tets[cells], places)
    return np.einsum("ij,ijk->ik", inside, weights[tets[cells]]), distances


def rms(gap):
    return float(np.sqrt((gap**2).mean()))


def difference(surface, reference, coarse):
    """Compare the weights of a surface (.vtp file) with those of the reference (.vtu file). Also compare the reference
    with the coarse reference."""
    points, triangles, weights = read_weights(surface)
    chosen = chosen_vertices(points, triangles)
    expected, distances = carried(reference, points[chosen])
    roughly, coarse_distances = carried(coarse, points[chosen])
    near = np.maximum(distances, coarse_distances) <= NEAR * np.linalg.norm(np.ptp(points[chosen], axis=0))
    gap = (weights[chosen] - expected)[near]
    return {"rms": rms(gap), "largest": float(np.abs(gap).max()), "references": rms((roughly - expected)[near]),
            "leak": largest_leak(points, triangles, weights)}
