#!/usr/bin/env python3
"""One field for surfaces that are open, cross themselves, or are partly inside out.

The winding number of a point is the sum of all triangles' signed solid angles over 4 pi. For a clean surface the
winding number is 1 or 0. Near missing triangles it decreases smoothly. Where surfaces overlap, it counts them.
Triangles with the wrong orientation are subtracted, unless `orient_patches` flips them. Above are the surfaces, below
slices of their fields in the same colors.

Numbers: the winding number at the center of each shape, and its distance from the expected value. A hole reduces the
winding number by the solid angle of the missing triangles. An inverted patch reduces it by twice the solid angle of the
patch.
"""

import common
import bindpose
import numpy as np

import meshes


def make(options):
    whole = meshes.sphere(3 if options.small else 5)
    x, y, z = meshes.centers(whole).T
    hole = (x > 0.6) | (np.hypot(x + 0.3, y - 0.8) < 0.3) & (z > -0.7) | (np.hypot(x + 0.5, y + 0.6) < 0.3)
    patch = x + y > 0.65
    shapes = {
        "open": meshes.without(whole, hole),
        "crossing": meshes.joined(meshes.moved(whole, [-0.5, 0, 0]), meshes.moved(whole, [0.5, 0, 0])),
        "flipped": meshes.flipped(whole, patch),
    }
    middle = np.zeros((1, 3))
    missing = meshes.plain_winding_number(meshes.without(whole, ~hole), middle)[0]
    turned = meshes.plain_winding_number(meshes.without(whole, ~patch), middle)[0]
    expected = {"open": 1 - missing, "crossing": 2.0, "flipped": 1 - 2 * turned, "turned back": 1.0}

    numbers, surfaces, fields = {}, [], []
    for name in expected:
        orient = name == "turned back"
        shape = shapes["flipped" if orient else name]
        value = bindpose.winding_number(shape, middle, method="exact", orient_patches=orient)
        numbers[f"{name}: winding number at the center"] = float(value[0])
        numbers[f"{name}: error"] = float(abs(value[0] - expected[name]))
        wide = 96 if options.small else 480
        field = bindpose.winding_number(shape, (wide, wide * 3 // 4, 1), orient_patches=orient,
                                        bounds=[-1.9, 1.9, -1.425, 1.425, 0, 0])
        surfaces.append(f"{len(surfaces)}.off")
        fields.append(f"{len(fields)}.vti")
        bindpose.write(shapes["flipped"] if orient else shape, options.scratch / surfaces[-1])
        bindpose.write(field, options.scratch / fields[-1])
    common.render(options, *surfaces, *fields, "--columns", 4, "--azimuth", -20, "--elevation", -8, "--size", "1600x760",
                  "--labels", "pieces missing,two spheres crossing,a cap faces inwards,the same with orient_patches,"
                  "open,crossing,flipped,turned back",
                  "--title", "Surfaces (above) and their winding numbers on a slice (below)")
    return numbers


if __name__ == "__main__":
    common.main(__file__, __doc__, make)
