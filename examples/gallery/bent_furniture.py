#!/usr/bin/env python3
"""Bending real furniture models: loose parts, open and crossing surfaces, duplicate triangles.

Four models of the Debian package sweethome3d-furniture (from BlendSwap, CC0) are bound unchanged, with points spread
over them as handles. Every handle moves with the bend of the whole piece.

Numbers, for each piece: triangles; open edges, edges of three triangles or more, pairs of crossing triangles, and
duplicate triangles; the largest relative gap of a certificate; and the largest gap after the bend, relative to the
diagonal. A gap is the distance between two vertices of different components that were nearer than 1/500 of the diagonal
before the bend.
"""

import math
import pathlib
import warnings
import zipfile

import common
import bindpose
import numpy as np
from bindpose.meshes import point_array, points_of, to_vtk_points
from vtkmodules.vtkCommonCore import vtkIdList
from vtkmodules.vtkCommonDataModel import vtkStaticPointLocator
from vtkmodules.vtkFiltersCore import vtkPolyDataConnectivityFilter, vtkCleanPolyData

PACKAGE = "sweethome3d-furniture"
ARCHIVE = pathlib.Path("/usr/share/sweethome3d/furniture/BlendSwap-CC-0.sh3f")
PIECES = {"antiqueChair": 45, "fireExtinguisher": 60, "spiralStaircase": 60, "outdoorLamp": 70}  # bend in degrees
HANDLES = 24
DEFECTS = ("boundary_edges", "nonmanifold_edges", "self_intersections", "duplicate_triangles")


def piece(options, name):
    """Return a model of the package as a vtkPolyData, with height 1 and on the floor."""
    with zipfile.ZipFile(ARCHIVE) as archive:
        (member,) = [entry for entry in archive.namelist() if entry.endswith(f"/{name}.obj")]
        path = options.scratch / f"{name}.obj"
        path.write_bytes(archive.read(member))
    mesh = bindpose.read(path)
    points = points_of(mesh)
    lower, upper = points.min(axis=0), points.max(axis=0)
    middle = (lower + upper) / 2
    mesh.SetPoints(to_vtk_points((points - [middle[0], lower[1], middle[2]]) / (upper[1] - lower[1])))
    return mesh


def bend(points, box, degrees):
    """Bend points of a piece about z, from the floor up. Return their positions and rotation angles."""
    (left, floor, _), (right, top, _) = box
    angle = math.radians(degrees) * (points[:, 1] - floor) / (top - floor)
    middle, radius = (left + right) / 2, (top - floor) / math.radians(degrees)
    bent = points.copy()
    bent[:, 0] = middle + radius - (radius - (points[:, 0] - middle)) * np.cos(angle)
    bent[:, 1] = floor + (radius - (points[:, 0] - middle)) * np.sin(angle)
    return bent, -np.degrees(angle)


def pose_of(handles, box, degrees):
    places = points_of(handles)
    bent, turned = bend(places, box, degrees)
    names = handles.GetCellData().GetAbstractArray("HandleName")
    return {"handles": {names.GetValue(k): {"translate": (bent[k] - places[k]).tolist(),
                                            "rotate": {"axis": [0, 0, 1], "degrees": float(turned[k])}}
                        for k in range(len(places))}}


def touching(mesh, points):
    """Return pairs of vertices of different components that are nearer than 1/500 of the diagonal."""
    clean = vtkCleanPolyData()
    clean.SetInputData(mesh)
    clean.PointMergingOn()
    clean.SetTolerance(0.0)
    parts = vtkPolyDataConnectivityFilter()
    parts.SetInputConnection(clean.GetOutputPort())
    parts.SetExtractionModeToAllRegions()
    parts.ColorRegionsOn()
    parts.Update()
    welded = parts.GetOutput()
    region = point_array(welded, "RegionId")
    locator = vtkStaticPointLocator()
    locator.SetDataSet(welded)
    locator.BuildLocator()
    own = np.array([region[locator.FindClosestPoint(point)] for point in points.tolist()])
    locator.SetDataSet(mesh)
    locator.BuildLocator()
    near, found = vtkIdList(), []
    reach = np.linalg.norm(np.ptp(points, axis=0)) / 500
    for k, point in enumerate(points.tolist()):
        locator.FindPointsWithinRadius(reach, point, near)
        found += [(k, near.GetId(i)) for i in range(near.GetNumberOfIds()) if own[near.GetId(i)] > own[k]]
    return np.array(found, dtype=int).reshape(-1, 2)


def make(options):
    if not ARCHIVE.exists():
        raise common.Stop(f"there is no {ARCHIVE}; install the Debian package {PACKAGE}")
    numbers, files = {}, []
    for name, degrees in PIECES.items():
        mesh = piece(options, name)
        points = points_of(mesh)
        box = points.min(axis=0), points.max(axis=0)
        handles = bindpose.automatic_handles(mesh, method="points", number_of_points=HANDLES // (2 if options.small else 1),
                                              place_inside=False, distance="straight")
        with warnings.catch_warnings():
            # ignore warnings about surface defects; the result contains their number
            warnings.simplefilter("ignore", bindpose.BindposeWarning)
            weighted = bindpose.weights(mesh, handles, domain="auto")
        report = bindpose.report(weighted)
        posed = bindpose.deform(weighted, handles, pose_of(handles, box, degrees))
        pairs, bent = touching(mesh, points), points_of(posed)
        apart = np.linalg.norm(bent[pairs[:, 0]] - bent[pairs[:, 1]], axis=1).max(initial=0.0)
        numbers[f"{name}: triangles"] = report["counts"]["triangles"]
        numbers[f"{name}: defects"] = [report["counts"].get(defect, 0) for defect in DEFECTS]
        numbers[f"{name}: largest relative gap of the weights"] = report["relative_gap"]
        numbers[f"{name}: largest gap between parts that touched"] = float(apart / np.linalg.norm(box[1] - box[0]))
        for kind, data in (("rest", mesh), ("bent", posed)):
            files.append(f"{name}-{kind}.vtp")
            bindpose.write(data, options.scratch / files[-1])
    common.render(options, *files[::2], *files[1::2], "--columns", 4, "--size", "1400x900", "--up", "y", "--azimuth", 20,
                  "--elevation", 10, "--labels", ",".join([*PIECES, *["bent"] * len(PIECES)]),
                  "--title", "Furniture models with surface defects")
    return numbers


if __name__ == "__main__":
    common.main(__file__, __doc__, make)
