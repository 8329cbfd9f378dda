#!/usr/bin/env python3
"""Clothes get the weights of the body that wears them.

A skirt stands around the legs of a body with automatic bones. If each point of the skirt gets the weights of the nearest
point of the body, the skirt has a patch that follows a hand, and it tears between the legs: neighboring points follow
different legs. Inpainting uses the nearest point only where distance and normal match, and solves for the rest: the
smoothest bounded weights that continue the matched ones. The second row shows the skirt after the left leg is raised.

Numbers for both methods: the largest weight of an arm bone on the skirt (a leak: no arm is connected to the skirt); the
largest difference of the weights along an edge of the skirt; the stretch of its edges in the pose, at the 99th percentile
and at most. For inpainting: the fraction of matched points, the largest relative gap of the certificates, seconds.
"""

import common
import numpy as np
import worn_shapes

CENTER = (-0.02, -0.02)  # of the waist; the body is 1 high, with z up, and its center is the origin


def skirt(around, rows):
    """Return a cone from the waist to below the knees, outward."""
    down = np.linspace(0, 1, rows)[:, None]
    angle = 2 * np.pi * np.arange(around)[None, :] / around
    points = np.stack([CENTER[0] + (0.095 + 0.16 * down) * np.cos(angle), CENTER[1] + (0.085 + 0.12 * down) * np.sin(angle),
                       0.08 - 0.34 * down + 0 * angle], axis=2).reshape(-1, 3)
    row, column = np.meshgrid(np.arange(rows - 1), np.arange(around), indexing="ij")
    a, b = (row * around + column).ravel(), (row * around + (column + 1) % around).ravel()
    return points, np.concatenate([np.stack([a, a + around, b], axis=1), np.stack([b, a + around, b + around], axis=1)])


def bones_by_position(ends, names):
    """Return the names of the arm bones, and of the thigh on the left side of the body (positive x)."""
    middles = dict(zip(names, ends.mean(axis=1)))
    arms = [name for name, (x, _, z) in middles.items() if abs(x) > 0.08 and z > -0.05]
    thigh = max((name for name, (x, _, z) in middles.items() if x > 0 and -0.3 < z < -0.05),
                key=lambda name: np.linalg.norm(np.subtract(*ends[names.index(name)])))
    return arms, thigh


def make(options):
    weighted, handles, names = worn_shapes.body_with_bones(options)
    arms, thigh = bones_by_position(worn_shapes.ends_of(handles), names)
    arm_columns = [names.index(name) for name in arms]
    pose = {"handles": {thigh: {"rotate": {"axis": [1, 0, 0], "degrees": -45}}}}
    shape = skirt(*((48, 30) if options.small else (120, 75)))
    numbers = {"bones": len(names), "arm bones": len(arms)}
    numbers.update(worn_shapes.compare_methods(
        options, shape, weighted, handles, pose,
        lambda weights: {"largest weight of an arm bone": weights[:, arm_columns].max()}))
    worn_shapes.render_methods(options, "left leg raised", "The largest bone at each point of a skirt")
    return numbers


if __name__ == "__main__":
    common.main(__file__, __doc__, make)
