#!/usr/bin/env python3
"""Twisting: linear blend closes a joint like a candy wrapper; dual quaternions and centers of rotation do not.

A cylinder of tets has a bone in each half. The right bone rotates about its own axis by 90, 120 and 180 degrees, from
left to right. Above is linear blend skinning, in the middle dual quaternions, below centers of rotation. Halfway, both
bones have the weight 1/2: the mean of a ring and the ring rotated by t has the radius cos(t / 2), while blended
rotations keep the radius.

Numbers: the radius of the ring halfway, relative to rest; tets that the pose inverts; the largest stretch.
"""

import warnings

import common
import bindpose
import numpy as np
from bindpose.meshes import points_of, to_dataset

from posing import bar

METHODS = {"lbs": "linear blend", "dqs": "dual quaternions", "cor": "centers of rotation"}
TURNS = (90, 120, 180)
LENGTH = 6


def cylinder(along, across):
    """Return tets of a cylinder of radius 1 about x, from 0 to LENGTH. The numbers of cells, `along` and `across`, must
    be even."""
    points, tets = bar(along, across)
    x, u, v = points[:, 0] * LENGTH / 6, 2 * points[:, 1] - 1, 2 * points[:, 2] - 1
    # Map a square to a disc, so that the border of the square becomes a circle.
    return np.stack([x, u * np.sqrt(1 - v ** 2 / 2), v * np.sqrt(1 - u ** 2 / 2)], axis=1), tets


def weighted_cylinder(small):
    """Return the cylinder with weights, and its handles: two bones along the axis, with a gap in the middle."""
    handles = bindpose.handles(bones=[[(0, 0, 0), (2.5, 0, 0)], [(3.5, 0, 0), (LENGTH, 0, 0)]])
    mesh = to_dataset(cylinder(24, 6) if small else cylinder(36, 8))
    return bindpose.weights(mesh, handles), handles


def make(options):
    # ignore warnings about inverted tets; the result contains their number
    warnings.filterwarnings("ignore", "the pose inverts", bindpose.BindposeWarning)
    weighted, handles = weighted_cylinder(options.small)
    rest = points_of(weighted)
    radius = np.hypot(rest[:, 1], rest[:, 2])
    ring = (np.abs(rest[:, 0] - LENGTH / 2) < 1e-9) & (radius > 0.999)
    numbers, files, labels = {}, [], []
    for method, name in METHODS.items():
        for degrees in TURNS:
            pose = {"handles": {"b2": {"rotate": {"axis": [1, 0, 0], "degrees": degrees}}}}
            posed = bindpose.deform(weighted, handles, pose, method=method)
            report = bindpose.report(posed)
            at = points_of(posed)[ring]
            kept = float(np.hypot(at[:, 1], at[:, 2]).mean())
            numbers[f"{name}, {degrees} degrees: radius at the middle"] = kept
            numbers[f"{name}, {degrees} degrees: inverted tets"] = report["counts"]["inverted_elements"]
            numbers[f"{name}, {degrees} degrees: largest stretch"] = report["largest_stretch"]
            files.append(f"{method}-{degrees}.vtu")
            labels.append(f"{name} at {degrees}°: {kept:.2f}")
            bindpose.write(posed, options.scratch / files[-1])
    common.render(options, *files, "--columns", 3, "--size", "1500x1000", "--edges", "--azimuth", 15, "--elevation", 15,
                  "--section", "none", "--labels", ",".join(labels),
                  "--title", "A twisted cylinder: radius at the middle relative to rest")
    return numbers


if __name__ == "__main__":
    common.main(__file__, __doc__, make)
