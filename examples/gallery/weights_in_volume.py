#!/usr/bin/env python3
"""Weights in a volume keep the properties of the plane: bounds, rows that sum to one, connected territories.

An elephant is filled with tets; points spread over it are handles; the weights are bounded biharmonic weights of the
whole volume. Left: each tet in the color of its strongest handle. Right: one column, with its extrema. Both are cut
open. Each territory is connected, so a pose tears nothing off.

Numbers: tets, handles, seconds, the certificate's relative gap; lowest and highest weight, largest |sum - 1| of a
row; extrema away from handles in all columns; fraction of the tets that are not connected to their handle's
territory.
"""

import time

import common
import bindpose
import numpy as np
from bindpose.meshes import point_array, tets_of


def stray(tets, owner):
    """Return the fraction of tets that are not connected by faces to the largest part of their territory. A territory
    consists of the tets with the same strongest handle."""
    sides = np.sort(np.concatenate([np.delete(tets, k, axis=1) for k in range(4)]), axis=1)
    of_tet = np.tile(np.arange(len(tets)), 4)
    order = np.lexsort(sides.T)
    twin = (sides[order][1:] == sides[order][:-1]).all(axis=1)
    a, b = of_tet[order][1:][twin], of_tet[order][:-1][twin]
    same = owner[a] == owner[b]
    label = np.arange(len(tets))
    # label connected components: each vertex takes the smallest label of its neighbors until no label changes
    while True:
        least = label.copy()
        np.minimum.at(least, a[same], label[b[same]])
        np.minimum.at(least, b[same], label[a[same]])
        least = least[least]
        if (least == label).all():
            break
        label = least
    largest = sum(np.bincount(label[owner == handle]).max() for handle in np.unique(owner))
    return 1 - largest / len(tets)


def make(options):
    surface = common.demo_mesh(options, "elephant.off")
    handles = bindpose.handle_sets.to_handles("auto:8", surface)
    began = time.perf_counter()
    if options.small:
        tets = bindpose.tetrahedralize(surface, method="embed", resolution=20)
    else:
        tets = bindpose.tetrahedralize(surface, handles=handles, interior_edge=0.025)
    filled = time.perf_counter()
    solver = bindpose.vtkBoundedBiharmonicWeights()
    solver.SetInputData(0, tets)
    solver.SetInputData(1, handles)
    solver.Update()
    weighted = solver.GetOutput()
    report = bindpose.report(weighted)
    if report["status"] != "ok":
        raise common.Stop(report["message"])
    solved = time.perf_counter()
    bindpose.write(weighted, options.scratch / "elephant.vtu")
    bindpose.write(handles, options.scratch / "handles.vtp")
    weights, cells = point_array(weighted, "Weights"), tets_of(weighted)
    owner = weights[cells].sum(axis=1).argmax(axis=1)
    numbers = {"tets": len(cells), "handles": weights.shape[1], "seconds to fill": filled - began,
               "seconds to solve": solved - filled, "relative gap": report["relative_gap"],
               "lowest and highest weight": [float(weights.min()), float(weights.max())],
               "largest |row sum - 1|": float(abs(weights.sum(axis=1) - 1).max()),
               "extrema away from handles": sum(handle["interior_extrema"] for handle in report["handles"]),
               "fraction of tets outside the main region of their strongest handle": float(stray(cells, owner))}
    look = ["--section", "0.56", "--handles", "handles.vtp", "--size", "760x700", *VIEW]
    pictures = [options.scratch / "territories.png", options.scratch / "column.png"]
    shown = common.render(options, "elephant.vtu", "--color", "handle", *look, "--labels", "the handle with the largest weight",
                          picture=pictures[0])
    column = common.render(options, "elephant.vtu", "--component", report["handles"][COLUMN]["name"], "--extrema", *look,
                           "--labels", "the weights of one handle", picture=pictures[1])
    numbers["number of tets per strongest handle"] = [its["count"] for its in shown["colors"]]
    numbers["shown handle: number of maxima and minima"] = [
        column["extrema"][0]["maxima"], column["extrema"][0]["minima"]]
    common.side_by_side(options, pictures, 2)
    return numbers


COLUMN = 6
VIEW = ["--azimuth", "-15", "--elevation", "10"]

if __name__ == "__main__":
    common.main(__file__, __doc__, make)
