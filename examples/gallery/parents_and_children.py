#!/usr/bin/env python3
"""Children follow their parents.

An arm of three bones, upper arm, forearm and hand: at rest; with the forearm rotated, which the hand follows; the same
pose with the hand in world space, which distorts the skin; with the upper arm stretched, which moves forearm and hand.

Numbers: the distance of the tip of the hand from its expected position, in lengths of the arm; the largest area of a
triangle, divided by its area at rest.
"""

import common
import bindpose
import numpy as np
from bindpose.meshes import points_of, to_dataset

WIDE = 1440
JOINTS = [(0, 0, 0), (2, 0, 0), (4, 0, 0), (5, 0, 0)]
NAMES = ["upper", "fore", "hand"]
DEGREES = 50
STRETCH = 1.5


def arm(around, along):
    """Return points and triangles of a closed round arm along x, about twice as thick at the shoulder as at the tip."""
    turn = np.linspace(0, np.pi, along)
    x = 2.5 - 2.75 * np.cos(turn)
    radius = np.sqrt(np.sin(turn)) * np.linspace(0.55, 0.3, along)
    radius[[0, -1]] = 0
    angle = np.arange(around) * 2 * np.pi / around
    rings = np.stack([np.repeat(x[1:-1], around), np.outer(radius[1:-1], np.cos(angle)).ravel(),
                      np.outer(radius[1:-1], np.sin(angle)).ravel()], axis=1)
    points = np.vstack([rings, [[x[0], 0, 0], [x[-1], 0, 0]]])
    first, last = len(points) - 2, len(points) - 1
    a = (np.arange(along - 3)[:, None] * around + np.arange(around)).ravel()
    b = (np.arange(along - 3)[:, None] * around + (np.arange(around) + 1) % around).ravel()
    ring, after = np.arange(around), (np.arange(around) + 1) % around
    end = (along - 3) * around
    triangles = np.vstack([np.stack([a, b, b + around], axis=1), np.stack([a, b + around, a + around], axis=1),
                           np.stack([np.full(around, first), after, ring], axis=1),
                           np.stack([np.full(around, last), end + ring, end + after], axis=1)])
    return points, triangles


def areas(points, triangles):
    a, b, c = (points[triangles[:, k]] for k in range(3))
    return np.linalg.norm(np.cross(b - a, c - a), axis=1)


def make(options):
    points, triangles = arm(24, 60) if options.small else arm(48, 140)
    bones = bindpose.handles(bones=list(zip(JOINTS[:-1], JOINTS[1:])), names=NAMES)
    weighted = bindpose.weights(to_dataset((points, triangles)), bones, domain="volume")
    turn = {"rotate": {"axis": [0, 0, 1], "degrees": DEGREES}}
    cases = {"at rest": {}, "forearm turned": {"fore": turn},
             "hand fixed in world space": {"fore": turn, "hand": {"space": "world"}},
             "upper arm stretched": {"upper": {"stretch": STRETCH}}}
    numbers, files = {}, []
    tip = int(points[:, 0].argmax())
    c, s = np.cos(np.radians(DEGREES)), np.sin(np.radians(DEGREES))
    moved = np.array([STRETCH * JOINTS[1][0] - JOINTS[1][0], 0, 0])
    rigid = {"at rest": points[tip], "upper arm stretched": points[tip] + moved}
    for name, pose in cases.items():
        posed = bindpose.deform(weighted, bones, {"handles": pose}, method="stbs")
        files.append(f"{name}.vtp".replace(" ", "-"))
        bindpose.write(posed, options.scratch / files[-1])
        found = points_of(posed)
        there = rigid.get(name, JOINTS[1] + np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]) @ (points[tip] - JOINTS[1]))
        error = float(np.linalg.norm(found[tip] - there)) / JOINTS[-1][0]
        numbers[f"{name}: distance of the tip from its expected position in arm lengths"] = error
        numbers[f"{name}: largest triangle"] = float((areas(found, triangles) / areas(points, triangles)).max())
    common.render(options, *files, "--columns", 2, "--size", f"{WIDE}x800",
                  "--labels", ",".join(cases))
    return numbers


if __name__ == "__main__":
    common.main(__file__, __doc__, make)
