#!/usr/bin/env python3
"""One pose with four energies. The energies differ in the sets of edges that share a rotation.

The ends of a bar of tets are bent toward each other. The sets are the edges of a tet, the edges of all tets at a vertex
(spokes and rims), and the edges that end at a vertex (spokes). The fourth energy is that of the bar's surface; its sets
are the edges of a triangle. With this energy the bar becomes flatter where it bends, because nothing inside resists.
Handles, weights and subspace are always the same. Colors: the distance of each point from its position with the first
energy, relative to the bar's diagonal.

Numbers: the energies; root mean square distances from the result of the first energy, relative to the diagonal; the
largest error of the energies of a unit cube scaled to double size, which must be 3/2 (tets) and 6 (its skin).
"""

import common
import bindpose
import numpy as np
from bindpose.meshes import add_point_array, point_array, points_of, to_dataset

import posing

ENERGIES = {"tetrahedra": "tets", "spokes-and-rims": "tets", "spokes": "tets", "triangles": "skin"}


def energy_of(mesh, energy, linear):
    """Return the energy of a mesh that one handle transforms as a whole."""
    data = to_dataset(mesh)
    add_point_array(data, "Weights", np.ones((len(mesh[0]), 1)), ["p1"])
    handles = bindpose.handles(points=[(0, 0, 0)])
    posed = posing.posed(bindpose.vtkReducedARAP(), data, handles, {"p1": {"scale": linear}},
                         Energy=getattr(bindpose.vtkReducedARAP, energy.upper().replace("-", "_")))
    return bindpose.report(posed)["energy"]


def make(options):
    points, tets = posing.bar(18 if options.small else 42, 3 if options.small else 7)
    triangles = posing.skin_of(tets)
    handles = bindpose.handles(points=[(0, 0.5, 0.5), (3, 0.5, 0.5), (6, 0.5, 0.5)])
    weighted = bindpose.weights(to_dataset((points, tets)), handles)
    skin = to_dataset((points, triangles))
    add_point_array(skin, "Weights", point_array(weighted, "Weights"), ["p1", "p2", "p3"])
    pose = {"p1": {"translate": [0.8, 0, 1.2], "rotate": {"axis": [0, 1, 0], "degrees": 60}}, "p2": {"mode": "free"},
            "p3": {"translate": [-0.8, 0, 1.2], "rotate": {"axis": [0, 1, 0], "degrees": -60}}}
    diagonal, farthest = np.linalg.norm(np.ptp(points, axis=0)), 0.0
    numbers, files, labels, first = {}, [], [], None
    for energy, mesh in ENERGIES.items():
        posed = posing.posed(bindpose.vtkReducedARAP(), weighted if mesh == "tets" else skin, handles, pose,
                             MaximumIterations=5000, Tolerance=1e-9, NumberOfExtraWeights=15,
                             Energy=getattr(bindpose.vtkReducedARAP, energy.upper().replace("-", "_")))
        first = posed if first is None else first
        numbers[f"{energy}: energy"] = bindpose.report(posed)["energy"]
        numbers[f"{energy}: rms distance from the result with tetrahedra"] = posing.rms_apart(points, first, posed)
        apart = np.linalg.norm(points_of(posed) - points_of(first), axis=1) / diagonal
        farthest = max(farthest, apart.max())
        add_point_array(posed, "Apart", apart)
        files.append(f"{energy}.{'vtu' if mesh == 'tets' else 'vtp'}")
        bindpose.write(posed, options.scratch / files[-1])
        labels.append(f"{energy} on {mesh}")
    cube = posing.bar(3, 3, 1.0)
    cube_skin = (cube[0], posing.skin_of(cube[1]))
    errors = []
    for energy, mesh in ENERGIES.items():
        volume = mesh == "tets"
        errors.append(abs(energy_of(cube if volume else cube_skin, energy, 2.0) - (1.5 if volume else 6.0)))
    numbers["cube scaled by 2: largest error of the energy"] = float(max(errors))
    common.render(options, *files, "--columns", 2, "--size", "1300x900", "--edges", "--up", "z", "--azimuth", -35,
                  "--elevation", 15, "--section", "none", "--array", "Apart", "--range",
                  f"0,{farthest:.4f}", "--labels", ",".join(labels),
                  "--title", "One pose and four energies")
    return numbers


if __name__ == "__main__":
    common.main(__file__, __doc__, make)
