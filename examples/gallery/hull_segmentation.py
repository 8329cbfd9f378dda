#!/usr/bin/env python3
"""Segmentation of the convex hull's tets by winding numbers: from an open surface to its inside.

Every triangle of an elephant full of holes becomes a face of tets that fill its convex hull. The winding number of
each tet is nearly 1 inside, nearly 0 outside, and in between near the holes. A graph cut then labels all tets
together, so that the boundary follows the surface and is small across holes.

Numbers: tets of the hull and kept tets; the volume of the kept tets, and the volume in which the winding number is at
least 1/2; the energy of the cut and of the plain threshold at 1/2, as reported and as computed by this script from the
definition; tets whose label the cut has changed.
"""

import common
import bindpose
import numpy as np
from bindpose.meshes import points_of, tets_of
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkDataObject
from vtkmodules.vtkFiltersCore import vtkThreshold

import meshes

SMOOTHNESS, SIGMA, THRESHOLD = 1.0, 0.1, 0.5  # the defaults of vtkTetrahedralizeSurface


def energy(points, tets, winding, inside):
    """Return the energy of a labeling: the costs of all tets, plus the smoothness cost of the facets between inside and
    outside."""
    costs = np.where(inside, np.maximum(1 - winding, 0), np.maximum(winding, 0)).sum()
    sides = np.sort(np.vstack([tets[:, [1, 2, 3]], tets[:, [0, 2, 3]], tets[:, [0, 1, 3]], tets[:, [0, 1, 2]]]), axis=1)
    owner = np.tile(np.arange(len(tets)), 4)
    order = np.lexsort(sides.T[::-1])
    sides, owner = sides[order], owner[order]
    shared = np.flatnonzero((sides[1:] == sides[:-1]).all(axis=1))
    a, b, c = np.moveaxis(points[sides[shared]], 1, 0)
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    i, j = owner[shared], owner[shared + 1]
    smooth = SMOOTHNESS * areas / areas.mean() * np.exp(-(winding[i] - winding[j]) ** 2 / (2 * SIGMA ** 2))
    return costs + smooth[inside[i] != inside[j]].sum()


def make(options):
    surface = common.demo_mesh(options, "elephant-with-holes.off")
    hull = bindpose.tetrahedralize(surface, method="cdt", keep_outside=True)
    report = bindpose.report(hull)
    points, tets = points_of(hull), tets_of(hull)
    winding, label = (vtk_to_numpy(hull.GetCellData().GetArray(name)) for name in ("WindingNumber", "Label"))
    volumes = meshes.tet_volumes(hull)
    inside = label > 0

    keep = vtkThreshold()
    keep.SetInputData(hull)
    keep.SetInputArrayToProcess(0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_CELLS, "Label")
    keep.SetThresholdFunction(vtkThreshold.THRESHOLD_UPPER)
    keep.SetUpperThreshold(0.5)
    keep.Update()
    bindpose.write(surface, options.scratch / "surface.vtp")
    bindpose.write(hull, options.scratch / "hull.vtu")
    bindpose.write(keep.GetOutput(), options.scratch / "kept.vtu")

    cut, threshold = energy(points, tets, winding, inside), energy(points, tets, winding, winding >= THRESHOLD)
    numbers = {
        "triangles": report["counts"]["triangles"],
        "open edges": report["counts"]["boundary_edges"],
        "tets of the hull": len(tets),
        "tets kept": int(inside.sum()),
        "volume of the hull's tets": float(volumes.sum()),
        "volume kept": float(volumes[inside].sum()),
        "volume enclosed by the winding number": report["winding_volume"],
        "energy of the labels by graph cut": report["energy"],
        "energy of the labels by threshold 1/2": report["threshold_energy"],
        "largest relative difference between reported and recomputed energies":
            float(max(abs(cut / report["energy"] - 1), abs(threshold / report["threshold_energy"] - 1))),
        "tets that the cut has changed": report["counts"]["changed_by_cut"],
    }
    view = ["--section", "z=0.06", "--azimuth", -14, "--elevation", -8, "--size", "850x620"]
    pictures = []
    for name, file, words, title in (
            ("a", "surface.vtp", ["--defects"], "The surface and its open edges"),
            ("b", "hull.vtu", ["--color", "winding-number"],
             f"{len(tets)} tets of the hull, colored by winding number"),
            ("c", "hull.vtu", ["--color", "label"], "Labels of the graph cut"),
            ("d", "kept.vtu", ["--color", "winding-number"], f"{inside.sum()} tets kept")):
        only_tets = view if file != "surface.vtp" else view[2:]
        pictures.append(options.scratch / f"{name}.png")
        common.render(options, file, *words, *only_tets, "--title", title, picture=pictures[-1])
    common.side_by_side(options, pictures, columns=2)
    return numbers


if __name__ == "__main__":
    common.main(__file__, __doc__, make)
