#!/usr/bin/env python3
"""Winding numbers of overlapping closed surfaces: how many times is a point inside?

Three spheres overlap pairwise and all together, and one tube passes through itself. Parity-based inside tests report
that the overlap of two spheres is outside; the winding number counts 2 and 3.

Numbers: the largest distance of a value from an integer; whether the value at every point equals the number of spheres
that contain the point, computed from the planes of the faces; the difference between the tube's values and the plain
sum of solid angles.
"""

import common
import bindpose
import numpy as np
from bindpose.meshes import point_array

import meshes


def spheres_around(spheres, points):
    """Return how many of these convex polyhedra contain each point."""
    count = np.zeros(len(points), dtype=int)
    for vertices, triangles in spheres:
        a, b, c = np.moveaxis(vertices[triangles], 1, 0)
        normals = np.cross(b - a, c - a)
        count += (points @ normals.T < np.einsum("ij,ij->i", a, normals)).all(axis=1)
    return count


def make(options):
    turn = 2 * np.pi * (np.arange(3) / 3 + 0.25)
    spheres = [meshes.sphere(2 if options.small else 4, 1.0, (0.62 * np.cos(t), 0.62 * np.sin(t), 0.0)) for t in turn]
    t = 2 * np.pi * np.arange(240) / 240
    trefoil = np.stack([np.sin(t) + 2 * np.sin(2 * t), np.cos(t) - 2 * np.cos(2 * t), 0 * t], axis=1)
    shapes = [meshes.joined(*spheres), meshes.tube(0.56 * trefoil, 0.3)]

    numbers, fields = {}, []
    for shape, name in zip(shapes, ("spheres", "tube")):
        reach = 1.1 * np.abs(shape[0][:, :2]).max()
        wide = 64 if options.small else 480
        # Sample at z = 0.0123. In the plane of symmetry z = 0, some samples would be on edges of the surface.
        field = bindpose.winding_number(shape, (wide, wide, 1), bounds=[-reach, reach, -reach, reach, 0.0123, 0.0123])
        random = np.random.default_rng(7).uniform(-reach, reach, (500 if options.small else 5000, 3))
        random[:, 2] *= 0.3
        values = bindpose.winding_number(shape, random)
        numbers[f"{name}: values"] = sorted({int(v) for v in np.rint(values)})
        numbers[f"{name}: largest distance of a winding number from an integer"] = float(max(
            np.abs(values - np.rint(values)).max(), distance_off_surface(field)))
        if name == "spheres":
            numbers["spheres: points with a wrong winding number"] = int(
                (spheres_around(spheres, random) != values).sum())
        else:
            some = random[:50]
            numbers["tube: error"] = float(np.abs(meshes.plain_winding_number(shape, some) - values[:50]).max())
        fields.append(f"{name}.vti")
        bindpose.write(field, options.scratch / fields[-1])
        bindpose.write(shape, options.scratch / f"{name}.off")
    common.render(options, "spheres.off", fields[0], "tube.off", fields[1], "--columns", 4, "--range", "0,3",
                  "--azimuth", -20, "--elevation", -10, "--size", "1600x640",
                  "--labels", "three closed spheres,winding number 0 to 3,one closed tube,winding number 2 at the self-crossing",
                  "--title", "Winding numbers of overlapping solids")
    return numbers


def distance_off_surface(field):
    """Return the largest distance from an integer among the samples that no triangle touches."""
    values = point_array(field, "WindingNumber")[point_array(field, "OnSurface") == 0]
    return np.abs(values - np.rint(values)).max()


if __name__ == "__main__":
    common.main(__file__, __doc__, make)
