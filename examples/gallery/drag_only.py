#!/usr/bin/env python3
"""Handles that are only translated: reduced as-rigid-as-possible finds the rotations.

Seven points constrain a cat; paw, head and tail are dragged, the others are fixed. No rotations are given. With linear
blend skinning, translated points do not rotate anything, so limbs are sheared. Reduced as-rigid-as-possible gets only
positions and computes the rotations.

Numbers: the stretch or compression, as its mean over the area and as the value that a hundredth of the area exceeds. It
is defined per triangle as max(s1, 1 / s2) - 1, where s1 >= s2 are the singular values of the deformation gradient.
Further numbers: the computed rotation at each dragged point, in degrees; the largest deviation from the positions,
relative to the diagonal; iterations of the solve, and microseconds per iteration.
"""

import common
import bindpose
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

import planar
import posing

POINTS = {"belly": (0.50, 0.30), "head": (0.50, 0.76), "paw": (0.13, 0.80), "elbow": (0.75, 0.50),
          "left foot": (0.37, 0.08), "right foot": (0.61, 0.08), "tail": (0.82, 0.46)}
DRAGGED = {"paw": (0.02, -0.30), "head": (0.10, -0.02), "tail": (0.06, 0.14)}


def stretches(rest, posed, triangles):
    """Return the stretch or compression of each triangle, and its area at rest."""
    def sides(points):
        a, b, c = (points[triangles[:, k]] for k in range(3))
        return np.stack([b - a, c - a], axis=2)
    values = np.linalg.svd(sides(posed) @ np.linalg.inv(sides(rest)), compute_uv=False)
    return np.maximum(values[:, 0], 1 / np.maximum(values[:, 1], 1e-9)) - 1, abs(np.linalg.det(sides(rest))) / 2


def make(options):
    size = 256 if options.small else 1024
    pixels = planar.cat(size)
    at = np.array([[*place, 0] for place in POINTS.values()]) * size - [0.5, 0.5, 0]
    handles = bindpose.handles(points=at, names=list(POINTS))
    picture = planar.write_png(pixels, options.scratch / "cat.png")
    shape = bindpose.planar_shape(picture, handles=handles)
    weighted = bindpose.weights(shape, handles, domain="surface")
    rest, triangles = planar.points_of(shape), planar.triangles_of(shape)
    pose = {name: {"mode": "position", "translate": [float(x * size) for x in DRAGGED.get(name, (0, 0))] + [0]} for name in POINTS}
    skinned = bindpose.deform(weighted, handles, {"handles": {
        name: {"translate": entry["translate"]} for name, entry in pose.items()}})
    found = posing.posed(bindpose.vtkReducedARAP(), weighted, handles, pose, MaximumIterations=5000, Tolerance=1e-8)
    transforms = vtk_to_numpy(found.GetFieldData().GetArray("HandleTransforms")).reshape(-1, 3, 4)
    numbers, texture = {}, planar.to_texture(pixels)
    moved = at + np.array([pose[name]["translate"] for name in POINTS])
    tiles = [("at rest", [planar.textured(shape, texture), *planar.handle_actors(handles, 0.012 * size)])]
    for name, caption, posed in (("skinned", "linear blend: translations only", skinned), ("found", "rotations are optimized", found)):
        stretch, area = stretches(rest, planar.points_of(posed), triangles)
        worst_first = np.argsort(-stretch)
        covered = np.cumsum(area[worst_first]) / area.sum()
        numbers[f"{name}: mean stretch"] = float((stretch * area).sum() / area.sum())
        numbers[f"{name}: 99th percentile of the stretch"] = float(stretch[worst_first[np.searchsorted(covered, 0.01)]])
        tiles.append((f"{caption}: stretch {numbers[f'{name}: mean stretch']:.0%}", [
            planar.textured(posed, texture), *planar.handle_actors(planar.posed_points(handles, moved), 0.012 * size)]))
    for name in DRAGGED:
        turn = transforms[list(POINTS).index(name)]
        numbers[f"{name}: computed rotation in degrees"] = float(
            np.degrees(np.arctan2(turn[1, 0] - turn[0, 1], turn[0, 0] + turn[1, 1])))
    report = bindpose.report(found)
    numbers["largest position error in bounding-box diagonals"] = report["constraint_residual"]
    numbers["iterations"] = report["iterations"]
    numbers["microseconds per iteration"] = report["microseconds_per_iteration"]
    box = (-0.06 * size, 1.06 * size, -0.03 * size, 1.03 * size)
    common.write_picture(planar.show(tiles, box, title="Dragged points without given rotations"), options.picture)
    return numbers


if __name__ == "__main__":
    common.main(__file__, __doc__, make)
