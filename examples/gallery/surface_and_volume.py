#!/usr/bin/env python3
"""The same handles and transforms with the energy of the surface and of the volume.

A bar is bent by 180 degrees and twisted by 170. Left: the energy of its surface. Right: the energy of its tets. The
handles, their weights and the number of unknowns are the same; only the precomputed matrix differs. The surface
flattens where it bends, as a hose does; the volume preserves its cross-section better.

Numbers: the energies; the area of the cross-section at the middle of the bar, relative to rest; the smallest area of a
cross-section along the bar; the volume, relative to rest; the root mean square distance between the results of both
energies, relative to the diagonal.
"""

import common
import bindpose
import numpy as np
from bindpose.meshes import add_point_array, point_array, points_of, to_dataset

import posing


POSES = {"bent": {"translate": [-6, 0, 3.82], "rotate": {"axis": [0, 1, 0], "degrees": -180}},
         "twisted": {"translate": [0, 0.9924, -0.0868], "rotate": {"axis": [1, 0, 0], "degrees": 170}}}


def section_areas(points, across):
    """Return the areas of the bar's cross-sections, as polygons of their rims."""
    side = np.arange(across + 1)
    zero, last = 0 * side, 0 * side + across
    rim = np.concatenate([np.stack(pair, axis=1) for pair in ((side[:-1], zero[:-1]), (last[:-1], side[:-1]),
                                                              (side[:0:-1], last[1:]), (zero[1:], side[:0:-1]))])
    ids = rim[:, 0] * (across + 1) + rim[:, 1]
    rims = points.reshape(-1, (across + 1) ** 2, 3)[:, ids]
    rims = rims - rims.mean(axis=1, keepdims=True)
    return np.linalg.norm(np.cross(rims, np.roll(rims, -1, axis=1)).sum(axis=1), axis=1) / 2


def volume(points, triangles):
    a, b, c = (points[triangles[:, k]] for k in range(3))
    return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6)


def make(options):
    along, across = (18, 4) if options.small else (48, 8)
    points, tets = posing.bar(along, across)
    triangles = posing.skin_of(tets)
    handles = bindpose.handles(bones=[[(x, 0, 0.5), (x, 1, 0.5)] for x in (0, 6)])
    weighted = bindpose.weights(to_dataset((points, tets)), handles)
    skin = to_dataset((points, triangles))
    names = ["b1", "b2"]
    add_point_array(skin, "Weights", point_array(weighted, "Weights"), names)
    rest_areas = section_areas(points, across)
    numbers, files, labels = {}, [], []
    for move, pose in POSES.items():
        posed = {}
        for name, mesh in (("surface", skin), ("volume", weighted)):
            posed[name] = posing.posed(bindpose.vtkReducedARAP(), mesh, handles, {"b2": pose}, MaximumIterations=5000,
                                       NumberOfExtraWeights=15, Tolerance=1e-8)
            moved = points_of(posed[name])
            share = section_areas(moved, across) / rest_areas
            numbers[f"{move}, {name}: energy"] = bindpose.report(posed[name])["energy"]
            numbers[f"{move}, {name}: cross-section at the middle"] = float(share[along // 2])
            numbers[f"{move}, {name}: smallest cross-section"] = float(share.min())
            numbers[f"{move}, {name}: volume"] = volume(moved, triangles) / volume(points, triangles)
            files.append(f"{move}-{name}.vtp")
            bindpose.write(to_dataset((moved - moved.mean(axis=0), triangles)), options.scratch / files[-1])
            labels.append(f"{move} ({name} energy): middle section keeps {share[along // 2]:.0%} of its area")
        numbers[f"{move}: difference"] = posing.rms_apart(points, posed["surface"], posed["volume"])
    common.render(options, *files, "--columns", 2, "--size", "1300x900", "--edges", "--up", "z", "--azimuth", -35,
                  "--elevation", 15, "--labels", ",".join(labels),
                  "--title", "Surface energy and volume energy in the same subspace")
    return numbers


if __name__ == "__main__":
    common.main(__file__, __doc__, make)
