"""Independent checks of the results of `bindpose weights` and `bindpose tetrahedralize` for an .obj model.

No check uses code of Bindpose: VTK or a parser in this file reads the results, and numpy computes with them. Each check
returns a dict of measured numbers. Its entry "wrong" lists the errors as sentences.
"""

import math
import pathlib
import subprocess

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy

from separate_parts import largest_leak, weld

CERTIFICATE = 1e-6  # a column is certified if its relative gap and residual are at most this large
ROW_SUM = 1e-9
SAMPLES = 1_000_000  # sample points at which the winding number of a refused model is evaluated
LOOKED_AT = 2000  # maximum number of inside points around which more points are sampled
SPECK = 1e-5  # fraction of the bounding box; a volume below this may be missed
EDGES = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)]
THIN = 5.0  # degrees; a tet with a dihedral angle below this is thin


# ---- Models ----------------------------------------------------------------------------------------


def read_obj(path):
    """Return the points (#V x 3) and triangles (#F x 3, fans of the faces) of an .obj file."""
    points, triangles = [], []
    with open(path, encoding="utf-8", errors="replace") as file:
        for line in file:
            words = line.split()
            if words[:1] == ["v"]:
                points.append([float(word) for word in words[1:4]])
            elif words[:1] == ["f"]:
                ids = [int(word.split("/")[0]) for word in words[1:]]
                ids = [i - 1 if i > 0 else len(points) + i for i in ids]
                triangles += [(ids[0], a, b) for a, b in zip(ids[1:-1], ids[2:])]
    return np.array(points, float).reshape(-1, 3), np.array(triangles, int).reshape(-1, 3)


def areas(points, triangles):
    a, b, c = (points[triangles[:, k]] for k in range(3))
    return np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2


def is_flat(points):
    """Return True if all points lie in one plane, within 1e-12 of their extent."""
    spread = np.linalg.svd(points - points.mean(axis=0), full_matrices=False, compute_uv=False)
    return spread[-1] <= 1e-12 * spread[0]


def model_facts(path, handles):
    """Return facts about the model that can justify a refusal to compute weights or tets."""
    points, triangles = read_obj(path)
    used = np.unique(points[np.unique(triangles)], axis=0) if len(triangles) else np.empty((0, 3))
    has_area = len(triangles) > 0 and areas(points, triangles).max() > 0
    return {"triangles": len(triangles), "nothing": not has_area, "too few": len(used) < handles,
            "flat": not has_area or is_flat(used)}


# ---- Weights ---------------------------------------------------------------------------------------


def ears(polygon, points):
    """Return the triangles of a polygon by ear cutting, or a fan if this fails. The ids are those of the polygon."""
    shape, triangles = vtk.vtkPolygon(), vtk.vtkIdList()
    shape.GetPoints().SetDataTypeToDouble()
    shape.GetPoints().SetNumberOfPoints(len(polygon))
    shape.GetPointIds().SetNumberOfIds(len(polygon))
    for k, point in enumerate(polygon):
        shape.GetPointIds().SetId(k, k)
        shape.GetPoints().SetPoint(k, *points[point])
    if shape.Triangulate(triangles) and triangles.GetNumberOfIds() == 3 * (len(polygon) - 2):
        corners = [triangles.GetId(k) for k in range(triangles.GetNumberOfIds())]
        return polygon[np.reshape(corners, (-1, 3))]
    return np.array([(polygon[0], polygon[k], polygon[k + 1]) for k in range(1, len(polygon) - 1)])


def triangles_of(polygons, points):
    """Split polygons into triangles as Bindpose does: triangles and quads become fans, larger polygons are cut by ears.
    vtkTriangleFilter is not used, because it omits quads with two corners at the same place.
    """
    starts, ids = vtk_to_numpy(polygons.GetOffsetsArray()), vtk_to_numpy(polygons.GetConnectivityArray())
    counts = np.diff(starts)
    starts = starts[:-1]
    triangles = [np.empty((0, 3), int)]
    for count in (3, 4):
        first = starts[counts == count]
        triangles += [ids[np.stack([first, first + k, first + k + 1], axis=1)] for k in range(1, count - 1)]
    for larger in np.flatnonzero(counts > 4):
        triangles.append(ears(ids[starts[larger]:starts[larger] + counts[larger]], points))
    return np.concatenate(triangles)


def read_weights(path):
    """Return the points (#V x 3), triangles (#F x 3) and weights (#V x #H) of a .vtp file."""
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    surface = reader.GetOutput()
    array = surface.GetPointData().GetArray("Weights")
    if array is None or surface.GetNumberOfPolys() == 0:
        return np.empty((0, 3)), np.empty((0, 3), int), np.empty((0, 0))
    points = vtk_to_numpy(surface.GetPoints().GetData()).astype(float)
    return points, triangles_of(surface.GetPolys(), points), vtk_to_numpy(array).astype(float)


def weights_array_errors(weights, handles):
    if weights.shape[0] == 0 or weights.shape[1] != handles:
        return [f"the file holds weights of shape {weights.shape}, expected {handles} columns"]
    if not np.isfinite(weights).all():
        return [f"{(~np.isfinite(weights)).sum()} weights are not finite"]
    wrong = []
    off = np.abs(weights.sum(axis=1) - 1).max()
    if off > ROW_SUM:
        wrong.append(f"a row's sum differs from one by {off:.1e}")
    if weights.min() < 0 or weights.max() > 1:
        wrong.append(f"weights range from {weights.min():g} to {weights.max():g}")
    return wrong


def certificate_errors(report):
    wrong = [f"{key} is {report.get(key)}, must be at most {CERTIFICATE:g}"
             for key in ("relative_gap", "kkt_residual") if not report.get(key, math.inf) <= CERTIFICATE]
    if not report.get("bounds_violation", math.inf) <= 0:
        wrong.append(f"bounds_violation is {report.get('bounds_violation')}")
    return wrong


def check_weights(path, report, handles):
    points, triangles, weights = read_weights(path)
    wrong = weights_array_errors(weights, handles)
    leak = None if wrong else largest_leak(points, triangles, weights)
    return {"wrong": wrong + certificate_errors(report), "leak": leak}


# ---- Tets ------------------------------------------------------------------------------------------


def read_tets(path):
    """Return the points and tets of a .vtu file."""
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    grid = reader.GetOutput()
    if grid.GetNumberOfCells() == 0:
        return np.empty((0, 3)), np.empty((0, 4), int)
    points = vtk_to_numpy(grid.GetPoints().GetData()).astype(float)
    return points, vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 4)


def write_tets(path, points, tets):
    """Write tets and the points that they use to a .vtu file."""
    used, ids = np.unique(np.asarray(tets, np.int64), return_inverse=True)
    grid, holder, cells = vtk.vtkUnstructuredGrid(), vtk.vtkPoints(), vtk.vtkCellArray()
    holder.SetData(numpy_to_vtk(np.ascontiguousarray(points[used]), deep=True))
    cells.SetData(numpy_to_vtkIdTypeArray(np.arange(0, ids.size + 1, 4), deep=True),
                  numpy_to_vtkIdTypeArray(np.ascontiguousarray(ids.ravel(), np.int64), deep=True))
    grid.SetPoints(holder)
    grid.SetCells(vtk.VTK_TETRA, cells)
    writer = vtk.vtkXMLUnstructuredGridWriter()
    writer.SetFileName(str(path))
    writer.SetInputData(grid)
    writer.Write()


def volumes(points, tets):
    a, b, c, d = (points[tets[:, k]] for k in range(4))
    return np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a) / 6


def smallest_dihedral_angles(points, tets):
    """Return the smallest dihedral angle of each tet in degrees."""
    corners = points[tets]
    smallest = np.full(len(tets), 180.0)
    for a, b in EDGES:
        c, d = (k for k in range(4) if k not in (a, b))
        along = corners[:, b] - corners[:, a]
        one, two = (np.cross(along, corners[:, k] - corners[:, a]) for k in (c, d))
        sine = np.linalg.norm(np.cross(one, two), axis=1)
        cosine = np.einsum("ij,ij->i", one, two)
        smallest = np.minimum(smallest, np.degrees(np.arctan2(sine, cosine)))
    return smallest


def check_tets(path, report):
    points, tets = read_tets(path)
    if len(tets) == 0:
        return {"wrong": ["the file holds no tets"]}
    wrong = []
    sizes, angles = volumes(points, tets), smallest_dihedral_angles(points, tets)
    if not sizes.min() > 0:
        wrong.append(f"{(~(sizes > 0)).sum()} tets have no positive volume (smallest {sizes.min():g})")
    if len(np.unique(np.sort(tets, axis=1), axis=0)) < len(tets):
        wrong.append("a tet occurs twice")
    if not abs(sizes.sum() - report.get("volume", math.nan)) <= 1e-9 * sizes.sum():
        wrong.append(f"the report's volume is {report.get('volume')}, that of the file {sizes.sum():g}")
    return {"wrong": wrong, "tets": len(tets), "min_dihedral": float(angles.min()),
            "below_5": float((angles < THIN).mean())}


# ---- Refusals --------------------------------------------------------------------------------------


def sample_points(points, count):
    """Return a low-discrepancy sequence that fills the bounding box of the points."""
    lower, size = points.min(axis=0), np.ptp(points, axis=0)
    step = np.array([0.8191725133961645, 0.6710436067037893, 0.5497004779019703])
    return lower + size * np.modf(0.31 + np.arange(1, count + 1)[:, None] * step)[0]


def write_poly_data(path, data):
    writer = vtk.vtkXMLPolyDataWriter()
    writer.SetFileName(str(path))
    writer.SetInputData(data)
    writer.SetCompressorTypeToNone()
    writer.Write()


def write_points(path, points):
    data, holder = vtk.vtkPolyData(), vtk.vtkPoints()
    holder.SetData(numpy_to_vtk(np.ascontiguousarray(points), deep=True))
    data.SetPoints(holder)
    write_poly_data(path, data)


def enclosed_fraction(program, model, folder):
    """Return the fraction of the bounding box where the winding number is at least 0.5, or at most -0.5 if that
    fraction is larger.

    Triangles are loose if at least nine of ten edges belong to only one triangle. For loose triangles, tiny volumes are
    ignored. To detect tiny volumes, up to LOOKED_AT points inside are examined. Around each of them, six points are
    sampled along the axes, at a distance of 1/1000 of the bounding-box diagonal. The result is 0 if fewer than half of
    the examined points have all six points inside.
    """
    points, triangles = read_obj(model)
    surface = points[np.unique(triangles)]
    samples = sample_points(surface, SAMPLES)
    winding = winding_at(program, model, samples, folder)
    winding = winding if (winding >= 0.5).sum() >= (winding <= -0.5).sum() else -winding
    inside = samples[winding >= 0.5]
    if len(inside) == 0 or not are_loose(points, triangles):
        return len(inside) / SAMPLES
    centers = inside[:: len(inside) // LOOKED_AT + 1]
    around = np.vstack([np.eye(3), -np.eye(3)]) * np.linalg.norm(np.ptp(surface, axis=0)) / 1000
    near = np.abs(winding_at(program, model, (centers[:, None] + around).reshape(-1, 3), folder))
    surrounded = (near.reshape(-1, 6) >= 0.5).all(axis=1).mean()
    return len(inside) / SAMPLES if surrounded >= 0.5 else 0.0


def are_loose(points, triangles):
    """Return True if at least nine of ten edges belong to one triangle only."""
    _, joined, _ = weld(points, triangles)
    edges = np.sort(np.vstack([joined[:, [0, 1]], joined[:, [1, 2]], joined[:, [2, 0]]]), axis=1)
    _, count = np.unique(edges, axis=0, return_counts=True)
    return (count == 1).mean() >= 0.9


def winding_at(program, model, places, folder):
    """Return the winding numbers of a model at the given points, after its patches are oriented consistently."""
    write_points(folder / "samples.vtp", places)
    subprocess.run([program, "winding", model, "--points", folder / "samples.vtp", "--orient-patches",
                    "-o", folder / "winding.vtp", "--overwrite", "--quiet"], check=True, timeout=600)
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(str(folder / "winding.vtp"))
    reader.Update()
    return vtk_to_numpy(reader.GetOutput().GetPointData().GetArray("WindingNumber"))


def check_refusal(verb, program, model, message, handles):
    """Check that a refusal is justified: weights need a surface with an area, and tets need an enclosed volume."""
    if not message or "\n" in message:
        return {"wrong": ["a refusal must be one line"]}
    facts = model_facts(model, handles)
    if facts["nothing"] or facts["too few" if verb == "weights" else "flat"]:
        return {"wrong": []}
    if verb == "weights":
        return {"wrong": [f"refused, but the model has {facts['triangles']} triangles"]}
    share = enclosed_fraction(program, model, pathlib.Path(model).parent)
    return {"wrong": [f"refused, but {100 * share:.2g} % of its box is enclosed"] if share > SPECK else []}
