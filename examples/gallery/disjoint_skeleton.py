#!/usr/bin/env python3
"""Bones without a hierarchy: a few transforms are given, the others are computed.

The cat's nine bones are not connected and have no parents. The feet are fixed. The hand and the tip of the tail have
given transforms. Body, head, both arms and the tail are free. With linear blend skinning the free bones do not move,
and the arm stretches like rubber. Reduced as-rigid-as-possible computes transforms for the free bones that preserve the
shape, with 15 extra weights for bends between the bones.

Numbers: free bones; distance between the arm's end and the hand's start, which coincide at rest, relative to the
picture's size, for skinning and for reduced as-rigid-as-possible; triangles turned over; the computed rotation of the
arm, in degrees; the smallest and largest length of the computed bones, relative to rest; iterations of the solve, and
microseconds per iteration.
"""

import warnings

import common
import bindpose
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

import planar
import posing

FREE = ("body", "head", "arm", "other arm", "tail")
# displacements of hand and tip, as fractions of the image size
HAND, TIP = np.array([-0.02, -0.24]), np.array([0.05, -0.05])


def make(options):
    size = 256 if options.small else 1024
    pixels = planar.cat(size)
    handles = planar.bones_of(size)
    picture = planar.write_png(pixels, options.scratch / "cat.png")
    shape = bindpose.planar_shape(picture, handles=handles)
    weighted = bindpose.weights(shape, handles, domain="surface")
    names = list(planar.BONES)
    # ends of the bones, indexed by bone, end and coordinate
    ends = np.array([[planar.BONES[name][k] for k in (0, 1)] for name in names]) * size - 0.5
    pose = {name: {"mode": "free"} for name in FREE}
    pose["hand"] = {"translate": [*(HAND * size), 0], "rotate": {"axis": [0, 0, 1], "degrees": 60}}
    pose["tip"] = {"translate": [*(TIP * size), 0], "rotate": {"axis": [0, 0, 1], "degrees": -45}}

    results, numbers = {}, {"free bones": len(FREE)}
    with warnings.catch_warnings():
        # skinning warns that handles in mode free are treated as the identity
        warnings.simplefilter("ignore", bindpose.BindposeWarning)
        results["skinned"] = bindpose.deform(weighted, handles, {"handles": pose})
    found = posing.posed(bindpose.vtkReducedARAP(), weighted, handles, pose, NumberOfExtraWeights=15,
                         MaximumIterations=5000, Tolerance=1e-8)
    results["found"] = found
    report = bindpose.report(found)
    transforms = vtk_to_numpy(found.GetFieldData().GetArray("HandleTransforms")).reshape(-1, 3, 4)
    plain = np.tile(np.eye(3, 4), (len(names), 1, 1))
    for name in ("hand", "tip"):
        plain[names.index(name)] = transforms[names.index(name)]
    tiles = [("at rest: disconnected bones", [planar.textured(shape, planar.to_texture(pixels)),
                                                       *planar.handle_actors(handles, 0.011 * size)])]
    lengths = []
    for key, used, caption in (("skinned", plain, "skinned: free bones do not move"), ("found", transforms, "free bones are optimized")):
        moved = np.einsum("bij,bej->bei", used[:, :2, :2], ends) + used[:, None, :2, 3]
        numbers[f"{key}: gap between arm and hand"] = float(
            np.linalg.norm(moved[names.index("arm"), 1] - moved[names.index("hand"), 0]) / size)
        lengths = np.linalg.norm(moved[:, 1] - moved[:, 0], axis=1) / np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
        at = np.zeros((2 * len(names), 3))
        at[:, :2] = moved.reshape(-1, 2)
        areas = planar.signed_areas(planar.points_of(results[key]), planar.triangles_of(shape))
        numbers[f"{key}: flipped triangles"] = int((areas <= 0).sum())
        tiles.append((caption, [planar.textured(results[key], planar.to_texture(pixels)),
                                *planar.handle_actors(planar.posed_points(handles, at), 0.011 * size)]))
    arm = transforms[names.index("arm")]
    numbers["rotation of the arm in degrees"] = float(
        np.degrees(np.arctan2(arm[1, 0] - arm[0, 1], arm[0, 0] + arm[1, 1])))
    numbers["bones' lengths"] = [float(lengths.min()), float(lengths.max())]
    numbers["iterations"] = report["iterations"]
    numbers["microseconds per iteration"] = report["microseconds_per_iteration"]
    box = (-0.06 * size, 1.06 * size, -0.03 * size, 1.03 * size)
    common.write_picture(planar.show(tiles, box, title="A skeleton without joints"), options.picture)
    return numbers


if __name__ == "__main__":
    common.main(__file__, __doc__, make)
