#!/usr/bin/env python3
"""Handles that are moved by formulas: a wave through a worm.

An expression in the time t moves five points along a bar up and down, each a little later than the previous one.
Reduced as-rigid-as-possible computes everything else. The pose is an ordinary file with strings in place of numbers.

Numbers: the largest deviation from the formulas over all times, relative to the bar's length; the smallest volume,
relative to rest.
"""

import common
import bindpose
import numpy as np
from bindpose.meshes import points_of, to_dataset
from posing import bar

TIMES = [0, 0.15, 0.3, 0.45, 0.6, 0.75]


def volume(points, tets):
    a, b, c, d = (points[tets[:, k]] for k in range(4))
    return float((np.cross(b - a, c - a) * (d - a)).sum() / 6)


def make(options):
    points, tets = bar(24 if options.small else 48, 4 if options.small else 8)
    places = np.array([(x, 0.5, 0.5) for x in (0.5, 1.75, 3, 4.25, 5.5)])
    handles = bindpose.handles(points=places)
    weighted = bindpose.weights(to_dataset((points, tets)), handles)
    pose = {"handles": {f"p{k + 1}": {
        "mode": "position",
        "translate": ["0.25 * cos(7 * t) - 0.25" if k == 0 else 0, 0, f"0.7 * sin(7 * t - {1.5 * k}) * min(1, 5 * t)"],
    } for k in range(5)}}
    posed = bindpose.deform(weighted, handles, pose, method="reduced-arap", times=TIMES, maximum_iterations=2000,
                            number_of_extra_weights=15, extra_weights_kind="eigenmodes")
    vertices = [int(np.argmin(np.linalg.norm(points_of(weighted) - place, axis=1))) for place in places]
    misses, files = [], []
    for t, mesh in zip(TIMES, posed):
        for k, vertex in enumerate(vertices):
            wanted = np.array([0.25 * np.cos(7 * t) - 0.25 if k == 0 else 0, 0,
                               0.7 * np.sin(7 * t - 1.5 * k) * min(1, 5 * t)])
            there = points_of(weighted)[vertex] + wanted
            misses.append(np.linalg.norm(points_of(mesh)[vertex] - there) / 6)
        files.append(f"wave-{len(files)}.vtu")
        bindpose.write(mesh, options.scratch / files[-1])
    volumes = [volume(points_of(mesh), bindpose.meshes.tets_of(mesh)) for mesh in posed]
    common.render(options, *files, "--columns", 2, "--size", "1500x900", "--edges", "--up", "z", "--azimuth", 15,
                  "--elevation", 10, "--section", "none", "--labels", ",".join(f"t = {t:g}" for t in TIMES),
                  "--title", "Heights of handles k = 0 to 4: 0.7 sin(7 t - 1.5 k) min(1, 5 t)")
    return {"largest error": float(max(misses)), "least volume": min(volumes) / volume(points, tets)}


if __name__ == "__main__":
    common.main(__file__, __doc__, make)
