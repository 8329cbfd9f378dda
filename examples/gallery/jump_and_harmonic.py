#!/usr/bin/env python3
"""The winding number jumps by 1 across the surface and is harmonic everywhere else.

Left: the winding number along a line through a closed and an open sphere. Right: two measures of how much the field
deviates from a harmonic function. The first is the mean over a small sphere minus the value at its center. The second
is the discrete Laplacian, which decreases with the square of its step.

Numbers: the largest |jump - 1| over all crossings of the line with triangles, measured 1e-13 before and after each
crossing; the largest violation of the mean value property; the order at which the discrete Laplacian decreases (2); and
the largest difference between the field of two surfaces and the sum of their fields.
"""

import common
import bindpose
import numpy as np
from vtkmodules.vtkChartsCore import vtkChartLegend

import charts
import meshes

START, ALONG = np.array([-2.0, 0.137, 0.0713]), np.array([1.0, 0.0, 0.0])
BESIDE = 1e-13


def field(mesh, points, **options):
    return np.asarray(bindpose.winding_number(mesh, points, method="exact", **options))


def crossings(mesh):
    """Return t and +1 (enters) or -1 (leaves) for intersections of the line START + t ALONG with triangles."""
    a, b, c = np.moveaxis(mesh[0][mesh[1]], 1, 0)
    normal = np.cross(b - a, c - a)
    facing = normal @ ALONG
    some = facing != 0
    a, b, c, normal, facing = a[some], b[some], c[some], normal[some], facing[some]
    t = np.einsum("ij,ij->i", a - START, normal) / facing
    hit = START + t[:, None] * ALONG
    inside = np.ones(len(t), dtype=bool)
    for p, q in ((a, b), (b, c), (c, a)):
        inside &= np.einsum("ij,ij->i", np.cross(q - p, hit - p), normal) > 0
    return t[inside], -np.sign(facing[inside])


def sphere_mean(mesh, middle, radius):
    """Return the mean over a sphere by Gauss-Legendre x trapezoid nodes, exact up to harmonic degree 31."""
    z, weight = np.polynomial.legendre.leggauss(16)
    angle = 2 * np.pi * (np.arange(32) + 0.5) / 32
    ring = np.sqrt(1 - z ** 2)[:, None]
    nodes = np.stack([ring * np.cos(angle), ring * np.sin(angle), np.repeat(z[:, None], 32, axis=1)], axis=-1)
    values = field(mesh, middle + radius * nodes.reshape(-1, 3)).reshape(16, 32)
    return float(weight @ values.mean(axis=1) / 2)


def laplacian(mesh, middle, step):
    around = middle + step * np.vstack([np.eye(3), -np.eye(3), np.zeros((1, 3))])
    values = field(mesh, around)
    return float((values[:6].sum() - 6 * values[6]) / step ** 2)


def make(options):
    closed = meshes.sphere(2 if options.small else 4)
    x, y, z = meshes.centers(closed).T
    opened = meshes.without(closed, (x > 0.3) & (y > 0.35) | (y < -0.75))
    nested = meshes.joined(opened, meshes.sphere(2, 0.4, (0.1, 0.05, 0.02)))

    t = np.linspace(0, 4, 400 if options.small else 4000)
    line = START + t[:, None] * ALONG
    left = charts.Panel("Winding number along a line through the surface", ("position", -2, 2), ("winding number", -0.2, 2.2))
    jumps = []
    for name, mesh, color in (("closed in open", nested, charts.GREEN), ("open", opened, charts.ORANGE),
                               ("closed", closed, charts.BLUE)):
        where, sign = crossings(mesh)
        before, after = (field(mesh, START + (where + side)[:, None] * ALONG) for side in (-BESIDE, BESIDE))
        jumps += list(sign * (after - before))
        # Add samples directly before and after each jump, so that the plot shows a vertical line there.
        at = np.concatenate([t, where - BESIDE, where + BESIDE])
        values = np.concatenate([field(mesh, line), before, after])
        order = np.argsort(at, kind="stable")
        left.line(name, at[order] - 2, values[order], color)

    # A point inside, at a distance of at least 0.3 from all triangles.
    middle = np.array([0.31, 0.12, 0.2])
    radii = [0.2 / 2 ** k for k in range(5)]
    means = [abs(sphere_mean(opened, middle, r) - float(field(opened, [middle])[0])) for r in radii]
    steps = [0.2 / 2 ** k for k in range(6)]
    laplacians = [abs(laplacian(opened, middle, h)) for h in steps]
    right = charts.Panel("Deviation from harmonicity inside the open surface", ("radius or step h", 4e-3, 0.3),
                         ("distance from 0", 1e-18, 10), log=True)
    right.line("discrete Laplacian", steps, laplacians, charts.ORANGE, dots=True)
    right.line("h^2, for comparison", steps, [4 * laplacians[2] * (h / steps[2]) ** 2 for h in steps], (150, 150, 155),
               1.5, dashed=True)
    right.line("mean over a sphere minus value at its center", radii, [max(m, 1e-17) for m in means], charts.BLUE,
               dots=True)
    charts.draw(options.picture, [left, right], legends=[(vtkChartLegend.LEFT, vtkChartLegend.TOP),
                                                         (vtkChartLegend.LEFT, vtkChartLegend.TOP)])
    other = meshes.sphere(2, 0.4, (0.1, 0.05, 0.02))
    linear = np.abs(field(nested, line) - field(opened, line) - field(other, line)).max()
    return {
        "crossings": len(jumps),
        "largest |jump - 1|": float(np.abs(np.array(jumps) - 1).max()),
        "largest violation of the mean value property": float(max(means)),
        "order of the Laplacian": float(np.polyfit(np.log(steps), np.log(laplacians), 1)[0]),
        "two surfaces: largest difference from the sum of their winding numbers": float(linear),
    }


if __name__ == "__main__":
    common.main(__file__, __doc__, make)
