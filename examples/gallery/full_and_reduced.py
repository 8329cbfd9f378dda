#!/usr/bin/env python3
"""As-rigid-as-possible deformation with every vertex as an unknown, and in the space of smooth weights.

A bump, a bend by 120° and a twist by 135°, from left to right; above with reduced as-rigid-as-possible and 15 extra
weights, below with full. Both minimize the same energy with the same handles. The full method has more freedom and
reaches a lower energy; the reduced method takes microseconds per iteration for any mesh.

Numbers, reduced and full: the energy; iterations and microseconds per iteration (the least of three); the sharpest
fold between neighboring triangles, in degrees; the root mean square difference of the vertices, relative to the
shape's diagonal.
"""

import itertools

import common
import bindpose
import numpy as np
from bindpose.meshes import points_of, to_dataset

import posing

METHODS = {"reduced": bindpose.vtkReducedARAP, "full": bindpose.vtkFullARAP}
EXTRA_WEIGHTS = 15
MIDDLE = np.array([3, 0.5, 0.5])


def bend(method, mesh, handles, pose):
    """Return the posed mesh, solved without a warm start."""
    extra = {"NumberOfExtraWeights": EXTRA_WEIGHTS} if method == "reduced" else {}
    return posing.posed(METHODS[method](), mesh, handles, pose, MaximumIterations=5000, **extra)


def make(options):
    small = options.small
    square, box = posing.plane(16 if small else 48, 5.0, MIDDLE), posing.bar(18 if small else 48, 4 if small else 8)
    # A bone becomes a child of another bone if its head is at the tail of the other bone. To avoid this, the four heads
    # are at two opposite corners, and the four tails are at the other two corners.
    corners = {c: 2.5 * np.array([*c, 0]) + MIDDLE for c in itertools.product((-1, 1), repeat=2)}
    rim = [(corners[k, k], corners[c]) for k in (-1, 1) for c in ((-1, 1), (1, -1))]
    on_plane = bindpose.handles(points=[MIDDLE], bones=rim)
    ends = bindpose.handles(bones=[[(x, 0, 0.5), (x, 1, 0.5)] for x in (0, 6)])
    cases = {
        "bump": (square, on_plane, {"p1": {"translate": [0, 0, 1.75]}}),
        "bend": (box, ends, {"b2": {"translate": [-3.52, 0, 4.3], "rotate": {"axis": [0, 1, 0], "degrees": -120}}}),
        "twist": (box, ends, {"b2": {"translate": [0, 0.854, -0.354], "rotate": {"axis": [1, 0, 0], "degrees": 135}}}),
    }
    numbers, files = {}, {method: [] for method in METHODS}
    for name, (mesh, handles, pose) in cases.items():
        surface = name == "bump"
        weighted = bindpose.weights(to_dataset(mesh), handles, domain="surface" if surface else "auto")
        posed = {}
        for method in METHODS:
            tries = [bend(method, weighted, handles, pose) for _ in range(3)]
            posed[method] = tries[0]
            report = bindpose.report(posed[method])
            files[method].append(f"{name}-{method}.{'vtp' if surface else 'vtu'}")
            bindpose.write(posed[method], options.scratch / files[method][-1])
            numbers[f"{name}, {method}, energy"] = report["energy"]
            numbers[f"{name}, {method}, iterations"] = report["iterations"]
            numbers[f"{name}, {method}, microseconds per iteration"] = min(
                bindpose.report(each)["microseconds_per_iteration"] for each in tries)
            if surface:
                numbers[f"{name}, {method}, largest angle between adjacent normals in degrees"] = posing.sharpest_fold(
                    points_of(posed[method]), mesh[1])
        numbers[f"{name}, difference"] = posing.rms_apart(mesh[0], posed["reduced"], posed["full"])
    labels = [f"{name}: {method} {numbers[f'{name}, {method}, energy']:.3g}"
              for method in METHODS for name in cases]
    common.render(options, *files["reduced"], *files["full"], "--columns", 3, "--size", "1500x900", "--edges",
                  "--up", "z", "--azimuth", -35, "--elevation", 20, "--section", "none",
                  "--labels", ",".join(labels),
                  "--title", "As-rigid-as-possible energies, reduced above and full below")
    return numbers


if __name__ == "__main__":
    common.main(__file__, __doc__, make)
