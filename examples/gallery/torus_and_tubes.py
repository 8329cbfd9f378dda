#!/usr/bin/env python3
"""A piece of a torus, recomputed between its ends: from rings of the torus, or from straight tubes.

A quarter of a torus is removed and solved for, coordinate by coordinate, on a straight tube as parameter domain: with
order 1, 2 and 3 from left to right. Above, the rings at its ends are those of the torus itself. In the middle the patch
begins at straight tubes. Below, the domain is only half as long, so the same rings give weaker tangents, but the tube
stays rounder. The membrane becomes narrow in the middle. The plate continues the tangents. Order 3 also continues the
curvature, and is nearest to the torus if the rings at its ends are those of the torus.

Numbers, by order: the largest distance of the patch's vertices from the torus, relative to its tube's radius; the
smallest radius of the patch's rings, likewise; the angle between the patch's middle line and the tube at its end, in
degrees.
"""

import common
import bindpose
import numpy as np
from bindpose.meshes import to_dataset

ORDERS = (1, 2, 3)
RADIUS, TUBE, TURN = 1.0, 0.4, np.pi / 2


def tube(along, around):
    """Return the triangles of a tube of `along` rings with `around` vertices. Every second ring is rotated by half a
    step."""
    triangles = []
    for i in range(along - 1):
        a = i * around + np.arange(around)
        b = i * around + (np.arange(around) + 1) % around
        c, d = a + around, b + around
        for half in ([(a, c, d), (a, d, b)] if i % 2 else [(a, c, b), (b, c, d)]):
            triangles.append(np.stack(half, axis=1))
    return np.concatenate(triangles)


def make(options):
    around = 24 if options.small else 40
    step = 2 * np.pi * TUBE / around
    patch = round(TURN * RADIUS / step)
    band = 12 if options.small else 20
    along = patch + 1 + 2 * band
    length = TURN * RADIUS
    # s is the position of each vertex along the axis of the tube. The patch is from s = 0 to s = `length`.
    s = np.repeat((np.arange(along) - band) * length / patch, around)
    phi = (2 * np.pi * (np.arange(around)[None] + 0.5 * (np.arange(along) % 2)[:, None]) / around).ravel()
    triangles = tube(along, around)
    across, up = TUBE * np.cos(phi), TUBE * np.sin(phi)
    domain = np.stack([s, across, up], axis=1)

    def place(angle, beyond):
        """Return positions at this angle on the torus, moved by the distance `beyond` along the tangent."""
        return np.stack([-(RADIUS + across) * np.cos(angle) + beyond * np.sin(angle),
                         (RADIUS + across) * np.sin(angle) + beyond * np.cos(angle), up], axis=1)

    torus = place(s / RADIUS, 0 * s)
    on_patch = np.clip(s, 0, length)
    straight = place(on_patch / RADIUS, s - on_patch)
    fixed = (s < 1e-9) | (s > length - 1e-9)
    short = domain * [1 / 2, 1, 1]
    cases = {"torus rings": (torus, domain), "straight tubes": (straight, domain),
             "half the domain": (straight, short)}
    numbers, files, labels = {}, [], []
    for name, (ends, parameters) in cases.items():
        apart, narrowest, kinks = [], [], []
        for order in ORDERS:
            rest = np.where(fixed[:, None], ends, torus)
            posed = np.asarray(bindpose.fair((rest, triangles), fixed, order=order, parameters=parameters))
            rings = posed.reshape(along, around, 3)
            free = slice(band + 1, along - band - 1)
            middle = rings.mean(axis=1)
            flat = np.hypot(posed[:, 0], posed[:, 1])
            distance = abs(np.hypot(flat - RADIUS, posed[:, 2]) - TUBE)[~fixed]
            apart.append(float(distance.max() / TUBE))
            narrowest.append(float(np.linalg.norm(rings - middle[:, None], axis=2)[free].min() / TUBE))
            ahead = middle[band + 1] - middle[band]
            kinks.append(float(np.degrees(np.arccos(np.clip(ahead[1] / np.linalg.norm(ahead), -1, 1)))))
            data = to_dataset((posed, triangles))
            bindpose.meshes.add_point_array(data, "Free", 1.0 - fixed)
            files.append(f"{name.replace(' ', '-')}-{order}.vtp")
            bindpose.write(data, options.scratch / files[-1])
            labels.append(f"{name}: order {order}")
        numbers[f"{name}: largest distance from the torus"] = apart
        numbers[f"{name}: smallest radius"] = narrowest
        numbers[f"{name}: kink at the end of the patch in degrees"] = kinks
    common.render(options, *files, "--columns", 3, "--size", "1350x1250", "--array", "Free", "--range", "0,1", "--edges",
                  "--up", "z", "--azimuth", 0, "--elevation", 60, "--labels", ",".join(labels), "--zoom", 0.95,
                  "--title", "A missing quarter of a torus, reconstructed with orders 1 to 3")
    return numbers


if __name__ == "__main__":
    common.main(__file__, __doc__, make)
