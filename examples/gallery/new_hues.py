#!/usr/bin/env python3
"""Unbounded biharmonic color blending produces spurious hues.

Five points of a square have a color each, and weights blend the colors. Unconstrained biharmonic weights (the
thin-plate splines of Finch et al. 2011) go below 0 and above 1: their blend leaves the gamut and contains colors that
no point has. Bounded biharmonic weights stay within the points' colors and are equally smooth; monotone weights also
have no bump between the points. Hatched: out of the gamut.

Numbers: lowest and highest weight; fraction of the square outside the gamut, and the largest violation; fraction where
a primary color is stronger or weaker than at all points, and the largest excess; and, for a bar with a white and two
black handles, the color at two thirds of its length, which must be -1/9 for unconstrained weights.
"""

import common
import bindpose
import numpy as np
from bindpose.meshes import to_dataset, to_vtk_points
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkProbeFilter

import planar

# Five points and their colors. The tests of the kernels use the weights of the same points.
POINTS = [((0.20, 0.20), (0.95, 0.75, 0.10)), ((0.80, 0.20), (0.10, 0.35, 0.75)), ((0.50, 0.50), (0.85, 0.15, 0.20)),
          ((0.25, 0.80), (0.10, 0.55, 0.25)), ((0.80, 0.75), (0.95, 0.90, 0.80))]
METHODS = {"unconstrained": "biharmonic", "bounded": "bounded-biharmonic", "monotone": "monotone"}


def grid(columns, rows, width, height):
    """Return squares cut along the same diagonal."""
    x, y = np.meshgrid(np.linspace(0, width, columns + 1), np.linspace(0, height, rows + 1))
    first = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).ravel()
    right, up = first + 1, first + columns + 1
    triangles = np.concatenate([np.stack([first, right, up + 1], axis=1), np.stack([first, up + 1, up], axis=1)])
    return np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1), triangles


def hatched(mesh, lines=90, steps=700):
    """Return an actor that hatches the area out of the gamut, in a list; empty if there is no such area."""
    along = np.linspace(0.004, 0.996, steps)
    places = np.concatenate([np.stack([along, along + offset, 0 * along], axis=1) for offset in np.linspace(-1, 1, lines)])
    cloud = vtkPolyData()
    cloud.SetPoints(to_vtk_points(places))
    probe = vtkProbeFilter()
    probe.SetInputData(cloud)
    probe.SetSourceData(mesh)
    probe.Update()
    found = probe.GetOutput().GetPointData()
    inside = vtk_to_numpy(found.GetArray("vtkValidPointMask")) > 0
    outside = np.array(vtk_to_numpy(found.GetArray("Gamut"))) > 0.5
    marked = (inside & outside).reshape(lines, steps)
    cells = vtkCellArray()
    for line, step in np.argwhere(marked[:, :-1] & marked[:, 1:]):
        cells.InsertNextCell(2, [int(line * steps + step), int(line * steps + step + 1)])
    stripes = vtkPolyData()
    stripes.SetPoints(to_vtk_points(places + [0, 0, 0.002]))
    stripes.SetLines(cells)
    return [planar.flat_actor(stripes, (0.05, 0.05, 0.05), 1.5)] if cells.GetNumberOfCells() else []


def make(options):
    squares = 40 if options.small else 120
    square = to_dataset(grid(squares, squares, 1.0, 1.0))
    places = np.array([[*place, 0] for place, _color in POINTS])
    colors = [color for _place, color in POINTS]
    handles = bindpose.handles(points=places)
    strip = grid(96, 2, 1.0, 2 / 96)
    across = bindpose.handles(bones=[[[at, 0, 0], [at, 2 / 96, 0]] for at in (0.0, 0.5, 1.0)], parents=[-1] * 3)

    count = square.GetNumberOfPoints()
    numbers = {"points of the mesh": count}
    tiles = []
    for caption, method in METHODS.items():
        weighted = bindpose.weights(square, handles, method=method, domain="surface")
        values = vtk_to_numpy(weighted.GetPointData().GetArray("Weights"))
        colored = bindpose.weighted_colors(weighted, handles, colors, linear_light=False)
        report = bindpose.report(colored)
        outside = report["counts"]["out_of_gamut"] / count
        numbers[f"{caption}: lowest and highest weight"] = [float(values.min()), float(values.max())]
        numbers[f"{caption}: fraction out of the gamut"] = outside
        numbers[f"{caption}: largest distance from the gamut"] = report["largest_gamut_violation"]
        numbers[f"{caption}: fraction outside the range of the points' colors"] = (
            report["counts"]["beyond_handles"] / count)
        numbers[f"{caption}: largest distance from the range of the points' colors"] = report["largest_overshoot"]
        weights = bindpose.weights(strip, across, method=method, domain="surface")
        gray = bindpose.weighted_colors(strip, across, [[1, 1, 1], [0, 0, 0], [0, 0, 0]], weights=weights, linear_light=False,
                                        clamp=False)
        numbers[f"{caption}, black and white bar: gray value at two thirds of the length"] = float(gray[64, 0])
        numbers[f"{caption}, black and white bar: largest distance from the gamut"] = (
            gray.report["largest_gamut_violation"])
        bindpose.meshes.add_point_array(colored, "Gamut", vtk_to_numpy(colored.GetPointData().GetArray("OutOfGamut")).astype(float))
        tiles.append((f"{caption}: {100 * outside:.0f} % out of the gamut",
                      [planar.painted(colored), *hatched(colored), *planar.dots(places, colors, 0.016, 0.01)]))
    window = planar.show(tiles, (-0.02, 1.02, -0.02, 1.02), tile=(560, 560),
                         title="Five colors, blended with three kinds of biharmonic weights")
    common.write_picture(window, options.picture)
    return numbers


if __name__ == "__main__":
    common.main(__file__, __doc__, make)
