#!/usr/bin/env python3
"""A bent elbow: linear blend becomes thin, dual quaternions bulge, centers of rotation have less of both artifacts.

The right half of the cylinder of candy_wrapper.py is bent about the middle by 60 and 120 degrees: linear blend, dual
quaternions and centers of rotation, from left to right. Where both bones have the weight 1/2, linear blend pulls the
skin toward the joint. Dual quaternions rotate everything about the joint, so that points beside it swing outwards. With
centers of rotation, each point has its own center in the middle of its slice, so it keeps its distance from the axis.

Numbers: smallest and largest distance of the skin from the bent axis on the outside of the bend, where both are 1 at
rest; the volume, relative to rest; inverted tets.
"""

import warnings

import common
import bindpose
import numpy as np
from bindpose.meshes import points_of, tets_of

from candy_wrapper import LENGTH, METHODS, weighted_cylinder

BENDS = (60, 120)
JOINT = np.array([LENGTH / 2, 0, 0])


def bend(degrees):
    """Rotate the right bone about the joint. A pose rotates a bone about its head, so the head is translated, too."""
    angle = np.radians(degrees)
    from_joint = np.array([3.5, 0, 0]) - JOINT
    moved = np.array([np.cos(angle), np.sin(angle), 0]) * np.linalg.norm(from_joint)
    return {"handles": {"b2": {"rotate": {"axis": [0, 0, 1], "degrees": degrees},
                               "translate": (moved - from_joint).tolist()}}}


def to_segment(points, start, end):
    along = end - start
    share = np.clip((points - start) @ along / (along @ along), 0, 1)
    return np.linalg.norm(points - start - share[:, None] * along, axis=1)


def volume(points, tets):
    a, b, c, d = (points[tets[:, k]] for k in range(4))
    return float(np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a).sum() / 6)


def make(options):
    # ignore warnings about inverted tets; the result contains their number
    warnings.filterwarnings("ignore", "the pose inverts", bindpose.BindposeWarning)
    weighted, handles = weighted_cylinder(options.small)
    rest, tets = points_of(weighted), tets_of(weighted)
    skin = np.hypot(rest[:, 1], rest[:, 2]) > 0.999
    outside = skin & (rest[:, 1] < -0.999)  # the bend goes toward +y, so -y is the outside
    numbers, files, labels = {}, [], []
    for degrees in BENDS:
        angle = np.radians(degrees)
        tip = JOINT + 3 * np.array([np.cos(angle), np.sin(angle), 0])
        for method, name in METHODS.items():
            posed = bindpose.deform(weighted, handles, bend(degrees), method=method)
            points = points_of(posed)[outside]
            distance = np.minimum(to_segment(points, np.zeros(3), JOINT), to_segment(points, JOINT, tip))
            numbers[f"{degrees} degrees, {name}: smallest distance from the axis"] = float(distance.min())
            numbers[f"{degrees} degrees, {name}: largest distance from the axis"] = float(distance.max())
            numbers[f"{degrees} degrees, {name}: volume relative to rest"] = (
                volume(points_of(posed), tets) / volume(rest, tets))
            numbers[f"{degrees} degrees, {name}: inverted tets"] = bindpose.report(posed)["counts"]["inverted_elements"]
            files.append(f"{method}-{degrees}.vtu")
            labels.append(f"{name}: {distance.min():.2f} to {distance.max():.2f}")
            bindpose.write(posed, options.scratch / files[-1])
    common.render(options, *files, "--columns", 3, "--size", "1500x1000", "--edges", "--elevation", 10, "--section", "none",
                  "--labels", ",".join(labels),
                  "--title", "A bent elbow: distance of the outer side from the axis, relative to rest")
    return numbers


if __name__ == "__main__":
    common.main(__file__, __doc__, make)
