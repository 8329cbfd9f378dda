#!/usr/bin/env python3
"""Write surfaces of one and of four million triangles, closed and open.

`scale_surfaces.py FOLDER MILLIONS` writes closed.ply and open.ply. MILLIONS is 1 or 4. The surface is a camel of the
Debian package libcgal-demo. The script decimates it to 15,625 triangles. Loop subdivision, applied three or four times,
then gives one or four million triangles. The open surface lacks the triangles inside of forty balls. The script
measure_scale.py uses this script.
"""

import pathlib
import sys
import tarfile

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy

from all_surfaces import ARCHIVE, read_off

SOURCE = "camel.off"
BASE = 15_625  # number of triangles before subdivision
LEVELS = {1: 3, 4: 4}  # millions of triangles: number of subdivisions
BALLS = 40
BALL_RADIUS = 0.012  # in bounding-box diagonals
SEED = 27


def as_polydata(points, triangles):
    data, holder, cells = vtk.vtkPolyData(), vtk.vtkPoints(), vtk.vtkCellArray()
    holder.SetData(numpy_to_vtk(np.ascontiguousarray(points, float), deep=True))
    rows = np.column_stack([np.full(len(triangles), 3), triangles]).astype(np.int64)
    cells.SetCells(len(triangles), numpy_to_vtkIdTypeArray(np.ascontiguousarray(rows).ravel(), deep=True))
    data.SetPoints(holder)
    data.SetPolys(cells)
    return data


def points_and_triangles(data):
    return (vtk_to_numpy(data.GetPoints().GetData()).astype(float),
            vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3))


def through(data, step):
    step.SetInputData(data)
    step.Update()
    return step.GetOutput()


def camel(folder, levels):
    """Return a closed camel of BASE * 4^levels triangles."""
    with tarfile.open(ARCHIVE) as archive:
        member = next(name for name in archive.getnames() if name.endswith("/" + SOURCE))
        (folder / SOURCE).write_bytes(archive.extractfile(member).read())
    data = as_polydata(*read_off(folder / SOURCE))
    thinner = vtk.vtkQuadricDecimation()
    thinner.SetTargetReduction(1.0 - BASE / data.GetNumberOfPolys())
    finer = vtk.vtkLoopSubdivisionFilter()
    finer.SetNumberOfSubdivisions(levels)
    return points_and_triangles(through(through(data, thinner), finer))


def with_holes(points, triangles):
    """Remove the triangles whose centers are in one of BALLS balls around points of the surface."""
    radius = BALL_RADIUS * np.linalg.norm(points.max(axis=0) - points.min(axis=0))
    centers = points[triangles].mean(axis=1)
    keep = np.ones(len(triangles), bool)
    for at in np.random.default_rng(SEED).choice(len(points), BALLS, replace=False):
        keep &= np.linalg.norm(centers - points[at], axis=1) > radius
    return points, triangles[keep]


def write(path, points, triangles):
    writer = vtk.vtkPLYWriter()
    writer.SetInputData(as_polydata(points, triangles))
    writer.SetFileName(str(path))
    writer.Write()


def main():
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    points, triangles = camel(folder, LEVELS[int(sys.argv[2])])
    write(folder / "closed.ply", points, triangles)
    write(folder / "open.ply", *with_holes(points, triangles))


if __name__ == "__main__":
    main()
