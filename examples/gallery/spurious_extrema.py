#!/usr/bin/env python3
"""Spurious extrema: unconstrained, bounded and monotone weights.

A square has five point handles; the picture shows the weights of one of them. Unconstrained weights have minima and
maxima away from handles, so moving a handle also moves distant parts. Here, bounds remove the extrema of the thin-plate
energy, but not the extrema of the next smoother energy (triharmonic). Triharmonic weights oscillate within the bounds,
and their extrema jump when a handle moves a little. Monotone weights (Jacobson, Weinkauf, Sorkine 2012) have no such
extrema with either energy. Only certified weights count: the script stops if a column misses the tolerance (finer
squares than these 40 x 40 need more than the default number of iterations for the bounded triharmonic energy).

Numbers: extrema away from handles of all five columns, with a persistence above 1e-3 of the column's range, counted by
the program's picture and by the filter's certificate; the certificate's relative gap; lowest and highest value. For the
last number, the handle of the shown column is moved by the width of one grid square: the largest distance of an
extremum of this column from the nearest extremum before the move, as a fraction of the side of the whole square.
"""

import common
import bindpose
import numpy as np
from bindpose.meshes import points_of, to_dataset
from new_hues import POINTS, grid
from vtkmodules.util.numpy_support import vtk_to_numpy

SHOWN = 3  # index of the handle whose weights are shown: the upper left point
SQUARES = 40  # number of squares per row; the handles are vertices of this grid


def filters():
    """Return name and filter: three types of weights for two energies."""
    made = {}
    for order, energy in ((2, "biharmonic"), (3, "triharmonic")):
        free = bindpose.vtkUnconstrainedWeights()
        free.SetMethod("biharmonic" if order == 2 else "triharmonic")
        bounded, monotone = bindpose.vtkBoundedBiharmonicWeights(), bindpose.vtkMonotoneWeights()
        bounded.SetOrder(order)
        monotone.SetOrder(order)
        made.update({f"unconstrained {energy}": free, f"bounded {energy}": bounded, f"monotone {energy}": monotone})
    return made


def solved(solver, square, places):
    solver.SetInputData(0, square)
    solver.SetInputData(1, bindpose.handles(points=places))
    solver.SetKeepRaw(True)
    solver.Update()
    report = bindpose.report(solver.GetOutput())
    if report["status"] != "ok":
        raise common.Stop(report["message"])
    return solver.GetOutput()


def extrema_of(solver):
    """Return the positions of the shown column's extrema."""
    found = solver.GetOutput(1)
    if not found.GetNumberOfPoints():
        return np.zeros((0, 3))
    return points_of(found)[vtk_to_numpy(found.GetPointData().GetArray("Handle")) == SHOWN]


def make(options):
    square = to_dataset(grid(SQUARES, SQUARES, 1.0, 1.0))
    places = np.array([[*place, 0] for place, _color in POINTS])
    moved = places.copy()
    moved[SHOWN, 0] += 1 / SQUARES
    bindpose.write(bindpose.handles(points=places), options.scratch / "handles.vtp")
    numbers, files, labels = {}, [], []
    for name, solver in filters().items():
        mesh = solved(solver, square, places)
        raw = vtk_to_numpy(mesh.GetPointData().GetArray("RawWeights"))
        before = extrema_of(solver)
        counted = vtk_to_numpy(mesh.GetFieldData().GetArray("WeightsInteriorExtrema"))
        numbers[f"{name}: number of extrema per handle"] = counted.astype(int).tolist()
        numbers[f"{name}: relative gap"] = bindpose.report(mesh)["relative_gap"]
        numbers[f"{name}: lowest and highest weight"] = [float(raw.min()), float(raw.max())]
        files.append(f"{len(files)}.vtp")
        # `bindpose render` draws the array Weights by default, so store the raw weights in it
        bindpose.meshes.add_point_array(mesh, "Weights", raw.copy(), [f"p{j + 1}" for j in range(len(places))])
        bindpose.write(mesh, options.scratch / files[-1])
        after = (solved(solver, square, moved), extrema_of(solver))[1]
        if len(before) and len(after):
            distances = np.linalg.norm(after[:, None] - before[None], axis=2)
            numbers[f"{name}: largest jump of an extremum when its handle moves"] = float(distances.min(axis=1).max())
        labels.append(f"{name.split()[0]}: {len(before) or 'no'} extrema")
    shown = common.render(options, *files, "--component", SHOWN, "--extrema", "--columns", 3,
                          "--labels", ",".join(labels), "--handles", "handles.vtp", "--size", "1500x1060", "--range", "-0.55,1.55",
                          "--title", "Weights of one handle and their extrema away from handles: "
                          "biharmonic above, triharmonic below")
    for name, its in zip(filters(), shown["extrema"]):
        numbers[f"{name}: number of maxima and minima in the picture"] = [its["maxima"], its["minima"]]
    return numbers


if __name__ == "__main__":
    common.main(__file__, __doc__, make)
