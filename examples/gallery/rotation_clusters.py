#!/usr/bin/env python3
"""Number of rotations that a bend needs: about the number of handles, not that of triangles.

A bar of tets has five handles; the transforms of the two end handles are given. The pose is solved with one rotation
for the whole bar, then with one rotation per cluster of vertices with similar weights, and finally with one rotation
per tet. A few rotations per handle give nearly the same result as one rotation per tet, in a fraction of the time.
Colors: the clusters.

Numbers: clusters; microseconds per iteration; the distance from the pose with one rotation per tet, relative to the
diagonal.
"""

import common
import bindpose
import numpy as np
from bindpose.meshes import to_dataset

import posing


def make(options):
    points, tets = posing.bar(24 if options.small else 48, 4 if options.small else 8)
    handles = bindpose.handles(points=[(x, 0.5, 0.5) for x in (0, 1.5, 3, 4.5, 6)])
    weighted = bindpose.weights(to_dataset((points, tets)), handles)
    pose = {"p1": {}, **{f"p{k}": {"mode": "free"} for k in (2, 3, 4)},
            "p5": {"translate": [-2.2, 0.5, 3.2], "rotate": {"axis": [0, 1, 0], "degrees": -100}}}
    counts = (1, 5, 20, 80, len(points))
    times, found, files = [], [], []
    for count in counts:
        posed = posing.posed(bindpose.vtkReducedARAP(), weighted, handles, pose, NumberOfClusters=count,
                             MaximumIterations=5000, Tolerance=1e-8, RotationArrays=True)
        report = bindpose.report(posed)
        times.append(report["microseconds_per_iteration"])
        found.append((posed, report["counts"]["clusters"]))
        files.append(f"clusters-{count}.vtu")
        bindpose.write(posed, options.scratch / files[-1])
    apart = [posing.rms_apart(points, posed, found[-1][0]) for posed, _ in found]
    shown = files[:4]
    labels = [f"{rotations} rotation{'s' * (rotations > 1)}: {away:.1%} from the result with {found[-1][1]}; "
              f"{time:.3g} µs"
              for (_, rotations), away, time in zip(found, apart, times)]
    common.render(options, *shown, "--columns", 2, "--size", "1300x1000", "--color", "rotation-cluster", "--up", "z", "--azimuth", -35,
                  "--elevation", 15, "--section", "none", "--labels", ",".join(labels[:4]),
                  "--title", "Rotation clusters: error and time")
    return {"clusters": [rotations for _, rotations in found], "microseconds per iteration": times,
            "distance from the result with one rotation per tet": apart}


if __name__ == "__main__":
    common.main(__file__, __doc__, make)
