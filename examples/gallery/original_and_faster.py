#!/usr/bin/env python3
"""Partition of unity as a constraint (original) or by dividing each row by its sum (faster): difference of the weights.

Bounded biharmonic weights of points on a square. Original: all handles form one quadratic program, with a row sum as
constraint at every vertex. Faster: one program per handle, then a division. Left: one column of the original weights.
Middle: the same column of the faster weights. Right: their difference, on the scale of the largest difference of all
weights.

Numbers: largest and rms difference over all weights. For both methods: deviation of the row sums from one (faster:
before the division), relative gap, seconds.
"""

import time

import common
import bindpose
import numpy as np
from bindpose.meshes import add_point_array, point_array, to_dataset

FIVE = [(0.2, 0.2, 0), (0.8, 0.2, 0), (0.5, 0.5, 0), (0.25, 0.8, 0), (0.8, 0.75, 0)]


def square(n):
    x, y = np.meshgrid(np.linspace(0, 1, n + 1), np.linspace(0, 1, n + 1))
    corner = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
    squares = np.stack([corner, corner + 1, corner + n + 2, corner + n + 1], axis=1)
    points = np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1)
    return points, np.concatenate([squares[:, [0, 1, 2]], squares[:, [0, 2, 3]]])


def make(options):
    mesh = square(20 if options.small else 40)
    handles = bindpose.handles(points=FIVE)
    made, seconds, reports = {}, {}, {}
    for partition in ("coupled", "normalize"):
        start = time.perf_counter()
        made[partition] = bindpose.weights(to_dataset(mesh), handles, domain="surface", partition_of_unity=partition)
        seconds[partition] = time.perf_counter() - start
        reports[partition] = bindpose.report(made[partition])
    both = {name: point_array(data, "Weights") for name, data in made.items()}
    difference = both["normalize"] - both["coupled"]
    worst = int(np.abs(difference).max(axis=0).argmax())
    largest = float(np.abs(difference).max())
    files = []
    for partition in ("coupled", "normalize"):
        files.append(f"{partition}.vtp")
        bindpose.write(made[partition], options.scratch / files[-1])
    apart = to_dataset(mesh)
    add_point_array(apart, "Difference", difference[:, worst])
    bindpose.write(apart, options.scratch / "difference.vtp")
    pictures = [options.scratch / "weights.png", options.scratch / "difference.png"]
    common.render(options, *files, "--array", "Weights", "--component", worst, "--handles", write(options, handles),
                  "--size", "1200x640", "--labels", "original,faster", picture=pictures[0])
    common.render(options, "difference.vtp", "--array", "Difference", "--range", f"{-largest},{largest}",
                  "--size", "600x640", "--labels", f"faster minus original: at most {largest:.2g}", picture=pictures[1])
    common.side_by_side(options, pictures, 2)
    return {
        "largest difference": largest,
        "rms difference": float(np.sqrt((difference ** 2).mean())),
        "faster, before the division: largest deviation of a row sum from 1": reports["normalize"]["row_sum_error"],
        "original: largest deviation of a row sum from 1": reports["coupled"]["row_sum_error"],
        "relative gaps": [reports[p]["relative_gap"] for p in ("coupled", "normalize")],
        "seconds of the original and the faster method": [seconds["coupled"], seconds["normalize"]],
    }


def write(options, handles):
    bindpose.write(handles, options.scratch / "handles.vtp")
    return "handles.vtp"


if __name__ == "__main__":
    common.main(__file__, __doc__, make)
