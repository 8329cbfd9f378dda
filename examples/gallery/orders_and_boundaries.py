#!/usr/bin/env python3
"""Smoothness of a patch, by its order and boundary condition.

The middle of a disc is lifted. The patch between the rim and the middle is, from left to right, a membrane (Laplacian =
0), a thin plate (squared Laplacian = 0) and a surface of order 3. First row: the rim and the middle are fixed regions.
The patch continues their position, with order 2 also their slope, and with order 3 also their curvature. Second row:
the middle is a ring of single points, with a patch on both sides. Third row: only the positions of the edges are fixed,
so all orders give the membrane. Last row: the tangents at the rim are given as well, down at 45°, which a membrane
cannot satisfy.

Numbers, by order: the patch's slope and curvature at the rim, computed from the patch's outermost rings of vertices.
The expected values are 0 beside a flat region, and a slope of -1 for the given tangents. For the surfaces of the third
row, also the largest difference from the membrane.
"""

import warnings

import common
import bindpose
import numpy as np
from bindpose.meshes import to_dataset

ORDERS = (1, 2, 3)
INNER, OUTER, HEIGHT = 0.25, 1.0, 0.6


def disc(rings):
    """Return points, triangles and the radius of each point: the unit disc with a band of three rings around it. All
    rings have the same number of vertices."""
    around = 6 * rings
    radii = np.arange(1, rings + 4) / rings
    angle = 2 * np.pi * (np.arange(around)[None] + 0.5 * (np.arange(len(radii)) % 2)[:, None]) / around
    points = np.stack([radii[:, None] * np.cos(angle), radii[:, None] * np.sin(angle), 0 * angle], axis=-1).reshape(-1, 3)
    triangles = [[len(points), j, (j + 1) % around] for j in range(around)]
    for ring in range(len(radii) - 1):
        a = ring * around + np.arange(around)
        b = ring * around + (np.arange(around) + 1) % around
        c, d = a + around, b + around
        halves = [(a, c, d), (a, d, b)] if ring % 2 else [(a, c, b), (b, c, d)]
        for half in halves:
            triangles += np.stack(half, axis=1).tolist()
    points = np.vstack([points, [0, 0, 0]])
    return points, np.array(triangles), np.hypot(points[:, 0], points[:, 1])


def make(options):
    rings = 12 if options.small else 24
    points, triangles, radius = disc(rings)
    step = 1 / rings
    lifted = points + np.outer(radius <= INNER + 1e-9, [0, 0, HEIGHT])
    inside = radius < OUTER - 1e-9
    profile = [abs(radius - OUTER + k * step) < 1e-9 for k in range(4)]  # the rim and the rings of vertices before it
    ring = abs(radius - INNER) < 1e-9
    outer_ring = abs(radius - OUTER) < 1e-9
    outwards = points / np.maximum(radius, 1e-9)[:, None]
    tangents = np.where(outer_ring[:, None], outwards + [0, 0, -1], 0)
    beyond = ~inside & ~outer_ring
    cases = {
        "region": dict(fixed=~inside | (radius <= INNER + 1e-9)),
        "ring inside": dict(fixed=~inside | ring),
        "curve": dict(fixed=~inside | (radius <= INNER + 1e-9), boundary="curve"),
        "tangents": dict(fixed=~inside | (radius <= INNER + 1e-9), boundary="tangent", tangent_source="given"),
    }
    numbers, files, labels = {}, [], []
    for name, settings in cases.items():
        slopes, curvatures, heights = [], [], []
        for order in ORDERS:
            mesh = (lifted, triangles)
            words = dict(settings)
            if name == "tangents":
                # Prescribe horizontal tangents at the edge of the plateau. Remove the band beyond the rim, because it
                # would hide the effect of the tangents.
                words["tangents"] = tangents + np.where(ring[:, None], -outwards, 0)
                mesh = (lifted, triangles[~beyond[triangles].any(axis=1)])
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", bindpose.BindposeWarning)  # ignore warnings about weak boundary conditions
                posed = np.asarray(bindpose.fair(mesh, order=order, parameters=points, **words))
            z = [posed[ring_of, 2].mean() for ring_of in profile]
            heights.append(posed[:, 2])
            slopes.append(float((3 * z[0] - 4 * z[1] + z[2]) / (2 * step)))
            curvatures.append(float((2 * z[0] - 5 * z[1] + 4 * z[2] - z[3]) / step ** 2))
            data = to_dataset((posed, mesh[1]))
            files.append(f"{name.replace(' ', '-')}-{order}.vtp")
            bindpose.write(data, options.scratch / files[-1])
            labels.append(f"{name}: order {order}")
        numbers[f"{name}: slope at the rim"] = slopes
        numbers[f"{name}: curvature at the rim"] = curvatures
        if name == "curve":
            numbers["curve: largest difference from the membrane"] = float(max(abs(h - heights[0]).max() for h in heights))
    numbers["distance of rings"] = step
    common.render(options, *files, "--columns", 3, "--size", "1500x1300", "--edges", "--up", "z", "--azimuth", 20,
                  "--elevation", 12, "--labels", ",".join(labels), "--zoom", 0.95,
                  "--title", "A lifted disc: orders 1 to 3 and constraints at its edges")
    return numbers


if __name__ == "__main__":
    common.main(__file__, __doc__, make)
