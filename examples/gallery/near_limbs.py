#!/usr/bin/env python3
"""Shape-aware weights do not leak across gaps.

A hand has fingers that are near but not connected. Points at the wrist and the fingertips constrain it, and one
fingertip is pulled sideways. Moving least squares (Schaefer et al. 2006) and inverse distances measure through the
gap, so the neighboring fingers move too; bounded biharmonic weights measure through the hand. Colors: the
displacement of each point, relative to that of the fingertip.

Numbers: displacement of the neighboring finger halfway up, relative to that of the pulled fingertip. For the slit
square of the literature, whose result is known: the weight of a point on one side of the slit, at a probe on the other
side.
"""

import common
import bindpose
import numpy as np

import planar

# Start, end, and radii at both ends of each finger; the drawing is 1 wide and 1 high.
FINGERS = {"thumb": ((0.34, 0.32), (0.13, 0.50), 0.055, 0.042), "index": ((0.37, 0.52), (0.35, 0.84), 0.046, 0.040),
           "middle": ((0.475, 0.53), (0.475, 0.91), 0.047, 0.041), "ring": ((0.58, 0.52), (0.60, 0.85), 0.046, 0.040),
           "little": ((0.675, 0.47), (0.715, 0.74), 0.042, 0.036)}
PALM = [((0.43, 0.34), (0.60, 0.34), 0.13, 0.13), ((0.52, 0.04), (0.52, 0.30), 0.10, 0.12),
        ((0.42, 0.44), (0.62, 0.43), 0.09, 0.09)]
PULLED, NEIGHBOR = "index", "middle"
PULL = np.array([-0.17, -0.10, 0.0])
SKIN, GAP = (245, 205, 170), (200, 140, 100)


def hand(size):
    """Return the hand as size x size x 4 bytes, with rings that show its deformation."""
    x, y = planar.pixel_centers(size)
    limbs = [*FINGERS.values(), *PALM]
    distance = np.min([planar.capsule(x, y, *limb) for limb in limbs], axis=0)
    rings = np.abs(y * 22 % 1 - 0.5) < 0.11
    color = np.where(rings[..., None], GAP, SKIN).astype(float)
    rim = np.clip(0.5 + (distance + 0.007) * size, 0, 1)[..., None]
    color = (1 - rim) * color + rim * np.array((110, 60, 40))
    alpha = np.clip(0.5 - distance * size, 0, 1)[..., None] * 255
    return np.rint(np.concatenate([color, alpha], axis=2)).astype(np.uint8)


def slit_square(n):
    """Return a grid of the unit square without (0.4, 0.6) x (0.3, 1], as in the literature."""
    at = np.linspace(0, 1, n + 1)
    x, y = np.meshgrid(at, at)
    first = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
    right, up = first + 1, first + n + 1
    triangles = np.concatenate([np.stack([first, right, up + 1], axis=1), np.stack([first, up + 1, up], axis=1)])
    points = np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1)
    middle = points[triangles].mean(axis=1)
    triangles = triangles[~((middle[:, 0] > 0.4) & (middle[:, 0] < 0.6) & (middle[:, 1] > 0.3))]
    used, renumbered = np.unique(triangles, return_inverse=True)
    return points[used], renumbered.reshape(-1, 3)


def make(options):
    size = 256 if options.small else 1024
    pixels = hand(size)
    picture = planar.write_png(pixels, options.scratch / "hand.png")
    places = {"wrist": (0.52, 0.03), **{name: finger[1] for name, finger in FINGERS.items()}}
    at = np.array([[*place, 0] for place in places.values()]) * size - [0.5, 0.5, 0]
    handles = bindpose.handles(points=at, names=list(places))
    shape = bindpose.planar_shape(picture, handles=handles, edge=0.03 if options.small else 0.015)
    rest = planar.points_of(shape)
    pose = {"handles": {PULLED: {"translate": [*(PULL * size)]}}}

    ways = {"moving least squares": bindpose.deform(shape, handles, pose, method="mls")}
    for caption, method in (("inverse distance", "inverse-distance"), ("bounded biharmonic", "bounded-biharmonic")):
        weighted = bindpose.weights(shape, handles, method=method, domain="surface")
        ways[caption] = bindpose.deform(weighted, handles, pose)

    # Select the vertices around the middle of the neighboring finger.
    start, end = (np.array(place) * size for place in FINGERS[NEIGHBOR][:2])
    halfway = np.linalg.norm(rest - (start + end) / 2, axis=1) < 0.05 * size
    triangles = planar.triangles_of(shape)
    numbers = {}
    texture = planar.to_texture(pixels)
    radius = 0.018 * size
    colors = [(0.75, 0.75, 0.75) if name != PULLED else (0.95, 0.35, 0.2) for name in places]
    moved = at + np.array([PULL * size * (name == PULLED) for name in places])
    tiles = [("rest shape; red: the fingertip that is dragged",
              [planar.textured(shape, texture), *planar.dots(at, colors, radius)])]
    scale = ((0, (1.0, 1.0, 1.0)), (0.02, (0.95, 0.93, 0.86)), (0.35, (0.98, 0.72, 0.35)), (1, (0.75, 0.12, 0.12)))
    for caption, posed in ways.items():
        share = np.linalg.norm(planar.points_of(posed) - rest, axis=1) / np.linalg.norm(PULL * size)
        numbers[f"{caption}: displacement of the neighboring finger relative to the dragged one"] = float(
            share[halfway].mean())
        numbers[f"{caption}: flipped triangles"] = int((planar.signed_areas(planar.points_of(posed), triangles) <= 0).sum())
        tiles.append((f"{caption}: {100 * share[halfway].mean():.0f} %",
                      [planar.bands(posed, np.clip(share, 0, 1), scale, 20),
                       *planar.edges(posed, shape, width=2.5), *planar.dots(moved, colors, radius)]))
    window = planar.show(tiles, (-0.04 * size, 0.84 * size, -0.07 * size, 1.0 * size), tile=(480, 580),
                         title="Displacement relative to that of the dragged fingertip; "
                               "percentages: halfway up the middle finger")
    common.write_picture(window, options.picture)

    slit = slit_square(60)
    two = bindpose.handles(points=[[0.3, 0.9, 0], [0.8, 0.9, 0]])
    probe = int(np.argmin(np.linalg.norm(slit[0] - [0.65, 0.9, 0], axis=1)))
    for method in ("bounded-biharmonic", "monotone", "inverse-distance"):
        weights = bindpose.weights(slit, two, method=method, domain="surface")
        numbers[f"slit square, {method}: weight across the slit"] = float(weights[probe, 0])
    return numbers


if __name__ == "__main__":
    common.main(__file__, __doc__, make)
