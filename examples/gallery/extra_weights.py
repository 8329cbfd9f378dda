#!/usr/bin/env python3
"""Effect of extra weights: none, 15 bumps, 15 skinning eigenmodes.

Only the end faces of a bar are moved. Above, it is bent into an S; below, it is compressed. With more extra weights,
the bar can deform in more ways and stretches less.

Numbers: the energy without extra weights, with 15 of each type, and with every vertex as an unknown. (In the
compression, the bar with every vertex as an unknown buckles into a worse minimum than with smooth weights.) For the
compression also the energies with 0 to 15 extra weights of each type.
"""

import json

import common
import bindpose
import numpy as np
from bindpose.meshes import add_point_array, to_dataset
from posing import bar
from vtkmodules.util.numpy_support import numpy_to_vtk

KINDS = {"no extra weights": (0, "bumps"), "15 bumps": (15, "bumps"), "15 eigenmodes": (15, "eigenmodes")}
POSES = {
    "S": {"p2": {"translate": [0, 0, 2.2]}},
    "squeeze": {"p2": {"translate": [-1.2, 0, 0.3]}},
}


def with_regions(mesh, places, *others):
    """Return the mesh with region labels, and its handles p1, p2, …: one region per entry of `places` (an array of
    point ids), then one point handle per position in `others`."""
    points, _ = mesh
    data = to_dataset(mesh)
    labels = np.zeros(len(points))
    for k, place in enumerate(places):
        labels[place] = k + 1
    add_point_array(data, "RegionId", labels)
    handles = bindpose.handles(points=[points[place].mean(axis=0) for place in places] + list(others))
    for name, value in (("HandleKind", 3), ("RegionId", None)):
        values = [value or k + 1 for k in range(len(places))] + [0] * len(others)
        array = numpy_to_vtk(np.array(values, dtype=np.int64 if value is None else np.int32), deep=True)
        array.SetName(name)
        handles.GetCellData().AddArray(array)
    return data, handles


def bend(mesh, handles, pose, count, kind):
    """Return the posed mesh, solved without a warm start."""
    poser = bindpose.vtkPoseHandles()
    poser.SetInputData(handles)
    poser.SetPoseJSON(json.dumps({"handles": pose}))
    bender = bindpose.vtkReducedARAP()
    bender.SetNumberOfExtraWeights(count)
    bender.SetExtraWeightsKind(bender.EIGENMODES if kind == "eigenmodes" else bender.BUMPS)
    bender.SetNumberOfClusters(60)
    bender.SetMaximumIterations(5000)
    bender.SetInputData(0, mesh)
    bender.SetInputConnection(1, poser.GetOutputPort())
    bindpose.run(bender)
    return bender.GetOutput()


def make(options):
    box = bar(18 if options.small else 48, 4 if options.small else 8)
    data, handles = with_regions(box, [np.flatnonzero(box[0][:, 0] == x) for x in (0, 6)])
    weighted = bindpose.weights(data, handles)
    numbers, files, labels = {}, [], []
    for name, pose in POSES.items():
        for title, (count, kind) in KINDS.items():
            posed = bend(weighted, handles, pose, count, kind)
            energy = bindpose.report(posed)["energy"]
            numbers[f"{name}, {title}, energy"] = energy
            files.append(f"{name}-{len(files)}.vtu")
            labels.append(f"{title}: {energy:.3g}")
            bindpose.write(posed, options.scratch / files[-1])
        full = bindpose.report(bindpose.deform(weighted, handles, {"handles": pose}, method="full-arap",
                                               maximum_iterations=5000))
        numbers[f"{name}, full ARAP (every vertex is an unknown), energy"] = full["energy"]
    for kind in ("bumps", "eigenmodes"):
        numbers[f"squeeze, 0 3 6 10 15 {kind}"] = [
            bindpose.report(bend(weighted, handles, POSES["squeeze"], count, kind))["energy"]
            for count in (0, 3, 6, 10, 15)]
    common.render(options, *files, "--columns", 3, "--size", "1500x800", "--edges", "--up", "z", "--azimuth", 15,
                  "--elevation", 10, "--section", "none", "--labels", ",".join(labels),
                  "--title", "Two handles with extra weights: energies")
    return numbers


if __name__ == "__main__":
    common.main(__file__, __doc__, make)
