#!/usr/bin/env python3
"""Painted rigidity: in painted areas weights hardly vary and the shape hardly stretches.

Three points pull a bar apart and up. Two blocks of the bar are painted, from top to bottom with the value 0 (not
painted), 0.1 and 1. Weights of points blend translations, so a part with constant weights moves as one.

Numbers: the largest stretch of a painted triangle's edges, which decreases with 1 / the painted value; the same stretch
with both blocks as rigid sets, where it is only round-off; the largest relative gap of a certificate of the weights.
"""

import common
import bindpose
import numpy as np
from bindpose.meshes import add_point_array, to_dataset

import meshes

PAINT = (0, 0.1, 1, 10, 100)
SHOWN = (0, 0.1, 1)


def grid(across, up):
    """Return a bar of 4 by 1, two triangles per square."""
    x, y = np.meshgrid(np.linspace(0, 4, across + 1), np.linspace(0, 1, up + 1))
    points = np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1)
    corner = (np.arange(up)[:, None] * (across + 1) + np.arange(across)).ravel()
    squares = np.stack([corner, corner + 1, corner + across + 2, corner + across + 1], axis=1)
    return points, np.concatenate([squares[:, [0, 1, 2]], squares[:, [0, 2, 3]]])


def largest_stretch(before, after, triangles, inside):
    """Return the largest stretch of the edges of triangles all of whose corners are painted."""
    chosen = triangles[inside[triangles].all(axis=1)]
    worst = 0.0
    for a, b in ((0, 1), (1, 2), (2, 0)):
        lengths = [np.linalg.norm(p[chosen[:, a]] - p[chosen[:, b]], axis=1) for p in (before, after)]
        worst = max(worst, float(np.abs(lengths[1] / lengths[0] - 1).max()))
    return worst


def make(options):
    points, triangles = mesh = grid(*((48, 12) if options.small else (120, 30)))
    blocks = [np.abs(points[:, 0] - center) < 0.45 for center in (1.0, 3.0)]
    painted = blocks[0] | blocks[1]
    handles = bindpose.handles(points=[(0.1, 0.5, 0), (2, 0.5, 0), (3.9, 0.5, 0)])
    pose = {"handles": {"p2": {"translate": [0, 0.7, 0]}, "p3": {"translate": [0.6, 0, 0]}}}

    def bend(**terms):
        weighted = bindpose.weights(to_dataset(mesh), handles, domain="surface", **terms)
        posed = bindpose.deform(weighted, handles, pose)
        gap = max(bindpose.report(weighted)["handles"][i]["relative_gap"] for i in range(3))
        return posed, largest_stretch(points, meshes.triangles_of(posed)[0], triangles, painted), gap

    stretches, gaps, files = [], [], []
    for paint in PAINT:
        posed, stretch, gap = bend(rigidity=paint * painted)
        stretches.append(stretch)
        gaps.append(gap)
        if paint in SHOWN:
            add_point_array(posed, "Painted", painted.astype(float))
            files.append(f"{paint}.vtp")
            bindpose.write(posed, options.scratch / files[-1])
    _, exact, gap = bend(rigid_set=blocks[0] + 2 * blocks[1])
    labels = [f"painted rigidity {paint}: largest stretch {100 * stretches[PAINT.index(paint)]:.2g} %"
              for paint in SHOWN]
    common.render(options, *files, "--array", "Painted", "--edges", "--columns", 1, "--size", "1200x1250",
                  "--labels", ",".join(labels), "--title", "Rigidity painted on two blocks of a bar")
    return {"painted rigidity": list(PAINT), "largest stretch where painted": stretches,
            "largest stretch where painted, with rigid sets": exact, "largest relative gap": max(*gaps, gap)}


if __name__ == "__main__":
    common.main(__file__, __doc__, make)
