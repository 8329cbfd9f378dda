#!/usr/bin/env python3
"""A wobbling jelly: dynamics in the space of skinning weights.

A block stands on a plate and its foot is fixed. A handle pulls its top sideways and is released after a quarter of a
second, under gravity. The simulation uses two handles, ten eigenmodes and 96 steps of implicit Euler per second.

Numbers: the sideways displacement of the top in each picture, relative to the block's height; number of reversals in
1.75 seconds; the largest kinetic energy in three periods of two thirds of a second, relative to the first; iterations
per step, microseconds per iteration.
"""

import common
import bindpose
import numpy as np
from bindpose.meshes import points_of
from extra_weights import with_regions
from posing import bar

STEP = 1 / 96
FRAMES = 193
HELD = 24  # number of frames during which the handle is constrained
SHOWN = (24, 32, 40, 48, 56, 72, 88, 192)


def block(along, across):
    """Return the bar of the gallery, upright and half as high."""
    points, tets = bar(along, across)
    return points[:, [1, 2, 0]] * [1.5, 1.5, 0.5], tets


def make(options):
    points, tets = block(10 if options.small else 24, 5 if options.small else 12)
    data, handles = with_regions((points, tets), [np.flatnonzero(points[:, 2] == 0)], (0.75, 0.75, 3))
    weighted = bindpose.weights(data, handles)
    drawn = {"handles": {"p2": {"mode": "position", "translate": [1.2, 0, -0.3]}}}
    let_go = {"handles": {"p2": {"mode": "free"}}}
    pose = {"fps": 1 / (HELD * STEP), "frames": [drawn, let_go]}
    frames = bindpose.dynamics(weighted, handles, pose, frames=FRAMES, time_step=STEP, gravity=(0, 0, -9.81),
                               stiffness=3000, damping=0.3, number_of_extra_weights=10, extra_weights_kind="eigenmodes")
    top = int(np.argmin(np.linalg.norm(points - [0.75, 0.75, 3], axis=1)))
    aside = np.array([points_of(frame)[top, 0] - points[top, 0] for frame in frames])
    reports = [bindpose.report(frame) for frame in frames]
    # The kinetic energy is zero when the motion reverses, so use the maximum of each period.
    kinetic = np.array([report.get("kinetic_energy", 0.0) for report in reports])
    largest = [kinetic[first:first + 64].max() for first in (HELD, HELD + 64, FRAMES - 64)]
    swing = np.sign(np.diff(aside[HELD:]))
    files = []
    for k in SHOWN:
        files.append(f"frame-{k:02d}.vtu")
        bindpose.write(frames[k], options.scratch / files[-1])
    common.render(options, *files, "--columns", 4, "--size", "1500x900", "--edges", "--up", "z", "--azimuth", 20,
                  "--elevation", 10, "--section", "none",
                  "--labels", ",".join(f"{k * STEP:.2f} s" for k in SHOWN),
                  "--title", "A bar pulled aside and released after a quarter of a second")
    iterations = [report["iterations"] for report in reports[1:]]
    return {
        "aside": [float(aside[k] / 3) for k in SHOWN],
        "turns": int((swing[1:] != swing[:-1]).sum()),
        "kinetic energy at its peaks": [float(x / largest[0]) for x in largest],
        "iterations per step": float(np.mean(iterations)),
        "microseconds per iteration": float(np.median([r["microseconds_per_iteration"] for r in reports[1:]])),
    }


if __name__ == "__main__":
    common.main(__file__, __doc__, make)
