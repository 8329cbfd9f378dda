#!/usr/bin/env python3
"""As holes close, the winding number converges to the indicator function of the inside.

A closed elephant loses 70 % of its triangles at random and gets them back in steps. The field is blurred at first and
becomes sharper until it is 1 inside and 0 outside.

Number: the mean of |winding number - indicator| over a grid, where the indicator is the plain sum of solid angles of
the whole surface. It decreases with every step, to 0.
"""

import common
import bindpose
import numpy as np
from bindpose.meshes import point_array

import meshes

MISSING = (0.7, 0.4, 0.15, 0.05, 0.0)  # fraction of the triangles


def make(options):
    whole = meshes.triangles_of(common.demo_mesh(options, "elephant.off"))
    order = np.random.default_rng(3).permutation(len(whole[1])) / len(whole[1])
    lower, upper = whole[0].min(axis=0), whole[0].max(axis=0)
    box = np.stack([lower - 0.05, upper + 0.05], axis=1)
    points = np.random.default_rng(4).uniform(box[:, 0], box[:, 1], (500 if options.small else 4000, 3))
    indicator = np.rint(meshes.plain_winding_number(whole, points))

    wide, distances, surfaces, fields = (60 if options.small else 300), [], [], []
    flat = box.copy()
    flat[2] = 0.02  # z range of the plane, which cuts body, head and trunk
    for missing in MISSING:
        surface = meshes.without(whole, order < missing)
        values = bindpose.winding_number(surface, points, tolerance=1e-6)
        distances.append(float(np.abs(values - indicator).mean()))
        surfaces.append(f"{missing}.off")
        fields.append(f"{missing}.vti")
        bindpose.write(surface, options.scratch / surfaces[-1])
        bindpose.write(bindpose.winding_number(surface, (wide, wide * 4 // 3, 1), bounds=flat.ravel()),
                       options.scratch / fields[-1])
    labels = [f"{100 * m:.0f} % missing" for m in MISSING] + [f"{d:.2g}" for d in distances]
    common.render(options, *surfaces, *fields, "--columns", len(MISSING), "--azimuth", -14, "--elevation", -8,
                  "--size", "1700x900", "--labels", ",".join(labels),
                  "--title", "Closing holes: mean distance of the winding number from 1 inside and 0 outside")
    return {"fraction missing": list(MISSING), "mean |winding number - indicator|": distances}


if __name__ == "__main__":
    common.main(__file__, __doc__, make)
