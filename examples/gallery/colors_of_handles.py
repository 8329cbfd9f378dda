#!/usr/bin/env python3
"""Colors blended by the weights that bend a shape.

Each bone of a cat has a color; a point's color is the sum of its weights times the handles' colors. If the colors are
blended in linear light, saturated colors stay bright where they meet; if they are blended as sRGB values, they darken.
On the right is a drawing by curves with a color on each side (diffusion curves): the mesh is cut along the curves, and
each side is a separate handle.

Numbers, for colors blended as light and as sRGB values: points out of the gamut, and points outside the range of the
handles' colors (both 0 for bounded weights); the difference between a handle's color and the blended color on the
handle; the color halfway between red and green. For the drawing: the difference from each side's color along the
curves, which shows that no color leaks through.
"""

import common
import bindpose
import numpy as np
from bindpose.meshes import points_of, to_curves, to_vtk_points
from vtkmodules.util.numpy_support import vtk_to_numpy

import planar

COLORS = {"body": (0.98, 0.80, 0.25), "head": (0.95, 0.30, 0.20), "arm": (0.20, 0.70, 0.25), "hand": (0.15, 0.35, 0.90),
           "other arm": (0.55, 0.20, 0.75), "left leg": (0.10, 0.75, 0.75), "right leg": (0.90, 0.25, 0.60),
           "tail": (0.15, 0.55, 0.20), "tip": (0.85, 0.90, 0.20)}


def along(points, closed=False):
    """Return bones from point to point."""
    ends = list(zip(points, [*points[1:], points[0]] if closed else points[1:]))
    return [[[*a, 0.0], [*b, 0.0]] for a, b in ends]


def mix(a, b, share):
    return tuple((1 - share) * np.array(a) + share * np.array(b))


def drawing(few):
    """Return bones and the colors of their sides: a sun and two ridges, on the unit square."""
    bones, left, right = [], [], []
    turns = 8 if few else 16
    angle = 2 * np.pi * np.arange(turns) / turns
    sun = np.stack([0.66 + 0.13 * np.cos(angle), 0.70 + 0.13 * np.sin(angle)], axis=1)
    bones += along([tuple(p) for p in sun], closed=True)  # counter-clockwise, so that the left side is inside
    left += [(1.0, 0.93, 0.45)] * turns
    right += [mix((0.98, 0.55, 0.25), (0.97, 0.78, 0.45), 0.5 + 0.5 * np.sin(a)) for a in angle]
    steps = 5 if few else 10
    for heights, above, below in (
            (lambda x: 0.43 + 0.10 * np.sin(5.2 * x + 0.4), ((0.80, 0.35, 0.50), (0.99, 0.70, 0.35)), ((0.25, 0.25, 0.50), (0.35, 0.28, 0.55))),
            (lambda x: 0.20 + 0.07 * np.sin(4.0 * x + 2.9), ((0.55, 0.50, 0.70), (0.62, 0.52, 0.62)), ((0.08, 0.30, 0.20), (0.20, 0.42, 0.15)))):
        x = np.linspace(0.0, 1.0, steps + 1)
        bones += along([(float(u), float(heights(u))) for u in x])
        left += [mix(*above, k / (steps - 1)) for k in range(steps)]
        right += [mix(*below, k / (steps - 1)) for k in range(steps)]
    return np.array(bones), np.array(left), np.array(right)


def make(options):
    size = 256 if options.small else 1024
    handles = planar.bones_of(size)
    picture = planar.write_png(planar.cat(size), options.scratch / "cat.png")
    cat = bindpose.planar_shape(picture, handles=handles)
    weighted = bindpose.weights(cat, handles, domain="surface")
    names = list(planar.BONES)
    light = bindpose.weighted_colors(weighted, handles, COLORS)
    plain = bindpose.weighted_colors(weighted, handles, COLORS, linear_light=False)
    array = vtk_to_numpy(weighted.GetPointData().GetArray("Weights"))
    on = array.max(axis=1) == 1
    colors = np.array([COLORS[name] for name in names])
    values = vtk_to_numpy(light.GetPointData().GetArray("ColorValues"))
    reports = [bindpose.report(mesh) for mesh in (light, plain)]

    pair = bindpose.handles(points=[[0, 0, 0], [1, 0, 0]])
    half = {caption: bindpose.weighted_colors(([[0.5, 0, 0], [1, 0, 0], [1, 1, 0]], [[0, 1, 2]]), pair, [[1, 0, 0], [0, 1, 0]],
                                              weights=np.full((3, 2), 0.5), linear_light=caption == "light")
            for caption in ("light", "numbers")}

    bones, left, right = drawing(options.small)
    curves = bindpose.handles(bones=bones, parents=[-1] * len(bones))
    corners = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], dtype=float)
    # Find the points on the left and right sides of the square at which the ridges end.
    ends = bones.reshape(-1, 3)[:, :2]
    on_left, on_right = (np.unique(ends[np.abs(ends[:, 0] - x) < 1e-12], axis=0) for x in (0.0, 1.0))
    outline = np.concatenate([corners[:2], on_right[np.argsort(on_right[:, 1])], corners[2:], on_left[np.argsort(-on_left[:, 1])]])
    loop = np.stack([np.arange(len(outline)), np.roll(np.arange(len(outline)), -1)], axis=1)
    shape = bindpose.planar_shape(to_curves((outline, loop)), handles=curves, edge=0.05 if options.small else 0.025)
    cut, sides = bindpose.cut_along_bones(shape, curves, left, right)
    drawn = bindpose.weighted_colors(bindpose.weights(cut, sides, domain="surface"), sides)
    labels = vtk_to_numpy(drawn.GetPointData().GetArray("RegionId"))
    painted = vtk_to_numpy(drawn.GetPointData().GetArray("ColorValues"))
    wanted = np.stack([left, right], axis=1).reshape(-1, 3)
    leak = np.abs(painted[labels > 0] - wanted[labels[labels > 0] - 1]).max()

    box = (-0.02, 1.02, -0.02, 1.02)
    unit = np.array([1 / size, 1 / size, 1])
    window = planar.show(
        [("one color per bone, blended in linear light", [planar.painted(scaled(light, unit)), *planar.edges(scaled(light, unit), cat),
                                                       *planar.handle_actors(scaled(handles, unit), 0.009)]),
         ("blended in sRGB", [planar.painted(scaled(plain, unit)), *planar.edges(scaled(plain, unit), cat)]),
         (f"{len(bones)} bones with one color per side", [planar.painted(drawn)])],
        box, tile=(560, 560), title="Colors of handles blended by weights")
    common.write_picture(window, options.picture)
    return {
        "handles": len(names),
        "points out of the gamut": [report["counts"]["out_of_gamut"] for report in reports],
        "points outside the range of the handles' colors": [report["counts"]["beyond_handles"] for report in reports],
        "on a handle: largest difference from the handle's color": float(
            np.abs(values[on] - colors[array[on].argmax(axis=1)]).max()),
        "mean of red and green in linear light": [float(value) for value in half["light"][0]],
        "mean of red and green in sRGB": [float(value) for value in half["numbers"][0]],
        "curves": len(bones),
        "points doubled by the cut": bindpose.report(cut)["counts"]["doubled_vertices"],
        "on a side of a curve: largest difference from the side's color": float(leak),
        "drawing: points out of the gamut": bindpose.report(drawn)["counts"]["out_of_gamut"],
    }


def scaled(data, factors):
    """Return a copy with scaled points."""
    copy = data.NewInstance()
    copy.ShallowCopy(data)
    copy.SetPoints(to_vtk_points(points_of(data) * factors))
    return copy


if __name__ == "__main__":
    common.main(__file__, __doc__, make)
