#!/usr/bin/env python3
"""Measure what a pose costs in Python beyond the kernel's own solve and skinning: `Rig.pose` into a reused array, and
`deform`, which prepares the method at every call.

Times are medians in milliseconds. The machine must be quiet.
usage: PYTHONPATH=build/lib/python3/dist-packages /usr/bin/python3 examples/benchmarks/python_poses.py [--poses 1000]
"""

from __future__ import annotations

import argparse
import statistics
import time
from typing import Any, Literal

import bindpose
import numpy as np
from numpy.typing import NDArray

METHODS: tuple[Literal["lbs", "dqs", "stbs", "cor", "reduced-arap"], ...] = ("lbs", "dqs", "stbs", "cor", "reduced-arap")


def sphere(rings: int) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Return points and triangles of a sphere of `rings` rings of 2 `rings` points each."""
    around = 2 * rings
    polar, azimuth = np.meshgrid(np.pi * np.arange(1, rings + 1) / (rings + 1), 2 * np.pi * np.arange(around) / around,
                                 indexing="ij")
    inner = np.stack([np.sin(polar) * np.cos(azimuth), np.sin(polar) * np.sin(azimuth), np.cos(polar)], -1).reshape(-1, 3)
    points = np.concatenate([[[0, 0, 1]], inner, [[0, 0, -1]]])
    last, k = len(points) - 1, np.arange(around)
    following = (k + 1) % around
    parts = [np.stack([0 * k, 1 + k, 1 + following], -1),
             np.stack([0 * k + last, last - around + following, last - around + k], -1)]
    for i in range(rings - 1):
        a, b = 1 + i * around + k, 1 + i * around + following
        parts += [np.stack([a, a + around, b], -1), np.stack([b, a + around, b + around], -1)]
    return points, np.concatenate(parts)


def poses(rig: bindpose.Rig, count: int) -> list[dict[str, Any]]:
    """Return poses of a drag: one handle moves, all others stay."""
    name = rig.weights.names[0]
    return [{name: {"translate": [0.3 * k / count, 0, 0], "rotate": {"axis": [0, 0, 1], "degrees": 60 * k / count}}}
            for k in range(count)]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--poses", type=int, default=1000, help="number of poses for each row (default: 1000)")
    parser.add_argument("--handles", type=int, default=20, help="number of point handles (default: 20)")
    options = parser.parse_args()
    print("| triangles | method | pose ms | kernel ms | overhead µs | binds | deform ms |")
    print("|--:|---|--:|--:|--:|--:|--:|")
    for rings in (55, 147):
        mesh = sphere(rings)
        rig = bindpose.bind(mesh, f"auto:{options.handles}", domain="surface", stage="preview")
        values = rig.weights
        for method in METHODS:
            out = rig.pose({}, method=method)
            before = rig.number_of_binds
            wall, kernel = [], []
            for pose in poses(rig, options.poses):
                start = time.perf_counter()
                rig.pose(pose, method=method, out=out)
                wall.append(time.perf_counter() - start)
                seconds = rig.pose_report["seconds"]
                kernel.append(seconds.get("solve", 0) + seconds.get("skin", 0))
            over = statistics.median(a - b for a, b in zip(wall, kernel))
            once = []
            for pose in poses(rig, 5):
                start = time.perf_counter()
                bindpose.deform(mesh, rig.handles, {"handles": pose}, weights=values, method=method)
                once.append(time.perf_counter() - start)
            print(f"| {len(mesh[1])} | {method} | {1e3 * statistics.median(wall):.3f} | {1e3 * statistics.median(kernel):.3f} | "
                  f"{1e6 * over:.0f} | {rig.number_of_binds - before} | {1e3 * statistics.median(once):.1f} |", flush=True)


if __name__ == "__main__":
    main()
