#!/usr/bin/env python3
"""Handle modes from fully to partially prescribed transforms: full, position, free.

A bar is constrained by five points along its middle line. In the first picture, the whole transform of each point is
given, so reduced as-rigid-as-possible has no unknowns and equals linear blend skinning. In the next two pictures, the
three points in the middle first have only a given position, and then are free. In the last picture, the rotations of
the end points are also free. The unknowns are computed so that the bar bends least: the energy decreases whenever more
numbers are free.

Numbers: how many numbers of the transforms are given; the energy; the largest distance of the first result from linear
blend skinning, relative to the diagonal; the largest deviation from given positions.
"""

import common
import bindpose
import numpy as np
from bindpose.meshes import points_of, to_dataset

import posing

PLACES = (0.0, 1.5, 3.0, 4.5, 6.0)


def bent(mode_inside, mode_ends):
    """Return a pose in which handles are lifted along an arch and the two end handles are rotated by 50 degrees."""
    pose = {}
    for k, x in enumerate(PLACES):
        end = k in (0, len(PLACES) - 1)
        lift = 0.0 if end else 0.9 * np.sin(np.pi * x / 6)
        pose[f"p{k + 1}"] = {"mode": mode_ends if end else mode_inside, "translate": [0.45 - 0.15 * x, 0, lift],
                             "rotate": {"axis": [0, 1, 0], "degrees": {0: -50, len(PLACES) - 1: 50}.get(k, 0)}}
    return pose


def make(options):
    mesh = posing.bar(18 if options.small else 42, 3 if options.small else 7)
    handles = bindpose.handles(points=[(x, 0.5, 0.5) for x in PLACES])
    weighted = bindpose.weights(to_dataset(mesh), handles)
    diagonal = np.linalg.norm(np.ptp(mesh[0], axis=0))
    cases = {"all handles full": ("full", "full"), "middle by position": ("position", "full"),
             "middle free": ("free", "full"), "ends by position": ("free", "position")}
    numbers, files, energies, given = {}, [], [], []
    misses = []
    for name, modes in cases.items():
        pose = bent(*modes)
        posed = posing.posed(bindpose.vtkReducedARAP(), weighted, handles, pose, MaximumIterations=5000, Tolerance=1e-9)
        report = bindpose.report(posed)
        energies.append(report["energy"])
        misses.append(report.get("constraint_residual", 0.0))
        given.append(sum({"full": 12, "position": 3, "free": 0}[entry["mode"]] for entry in pose.values()))
        if name == "all handles full":
            skinned = bindpose.deform(weighted, handles, {"handles": pose})
            numbers["all handles full: largest distance from linear blend skinning"] = float(
                np.abs(points_of(posed) - points_of(skinned)).max() / diagonal)
        files.append(f"{name.replace(' ', '-')}.vtu")
        bindpose.write(posed, options.scratch / files[-1])
    numbers["scalar constraints"] = given
    numbers["energies"] = energies
    numbers["largest constraint error in bounding-box diagonals"] = float(max(misses))
    labels = [f"{name}: {count} scalar constraints; energy {energy:.3g}"
              for name, count, energy in zip(cases, given, energies)]
    common.render(options, *files, "--columns", 2, "--size", "1300x850", "--edges", "--up", "z", "--azimuth", -35,
                  "--elevation", 15, "--section", "none", "--labels", ",".join(labels),
                  "--title", "Handle modes: unconstrained rotations and positions are optimized")
    return numbers


if __name__ == "__main__":
    common.main(__file__, __doc__, make)
