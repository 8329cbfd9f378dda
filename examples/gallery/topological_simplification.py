#!/usr/bin/env python3
"""Smoothing of noisy data with prescribed extrema.

Two hills, two hollows and noise, at the vertices of a square: hundreds of local extrema. Monotone smoothing
(Jacobson, Weinkauf, Sorkine 2012) finds the smooth function nearest to the data among all functions that have only
the given extrema: here the four most persistent ones of the data, and one maximum and one minimum chosen by the user.

Numbers: extrema with a persistence above 1e-3 of the range, counted by the program's picture. For the results also
the certificate's relative gap, the rms distance to the data without noise relative to their range (and that of the
noise itself), and whether every listed vertex is no lower or no higher than all of its neighbors.
"""

import common
import bindpose
import numpy as np
from bindpose.meshes import add_point_array, to_dataset
from meshes import edges_of
from new_hues import grid

HILLS = ((0.25, 0.3, 1.0), (0.7, 0.65, 0.8), (0.75, 0.2, -0.7), (0.25, 0.75, -0.5))  # position and height of each hill
NOISE = 0.1  # root mean square of the noise


def noise(squares):
    """Return random numbers with mean 0 and rms NOISE, blurred over a few vertices."""
    values = np.random.default_rng(1).standard_normal((squares + 1, squares + 1))
    for axis in (0, 1):
        values = np.apply_along_axis(np.convolve, axis, values, [1, 2, 1], "same")
    values -= values.mean()
    return NOISE * values.ravel() / np.sqrt(np.mean(values ** 2))


def are_extrema(values, listed, pairs):
    """Report whether each listed maximum is no lower, and each minimum no higher, than its neighbors."""
    both = np.concatenate([pairs, pairs[:, ::-1]])
    return all((e["kind"] == "maximum" and (values[both[both[:, 0] == e["vertex"], 1]] <= values[e["vertex"]]).all())
               or (e["kind"] == "minimum" and (values[both[both[:, 0] == e["vertex"], 1]] >= values[e["vertex"]]).all())
               for e in listed)


def make(options):
    squares = 40 if options.small else 80
    vertices, triangles = map(np.asarray, grid(squares, squares, 1.0, 1.0))
    x, y = vertices[:, 0], vertices[:, 1]
    smooth = sum(height * np.exp(-30 * ((x - a) ** 2 + (y - b) ** 2)) for a, b, height in HILLS)
    data = smooth + noise(squares)
    numbers = {"noise: rms": float(np.sqrt(np.mean((data - smooth) ** 2)) / np.ptp(smooth))}
    nearest = [int(np.argmin((x - a) ** 2 + (y - b) ** 2)) for a, b, _height in HILLS]
    square = vertices, triangles
    results = {"four most persistent extrema": bindpose.monotone_smoothing(square, data, number_of_extrema=4),
               "one maximum and one minimum": bindpose.monotone_smoothing(square, data, maxima=nearest[:1],
                                                                          minima=nearest[2:3])}
    files = []
    for values in (data, *results.values()):
        files.append(f"{len(files)}.vtp")
        mesh = to_dataset((vertices, triangles))
        add_point_array(mesh, "Height", np.asarray(values))
        bindpose.write(mesh, options.scratch / files[-1])
    span = f"{data.min():.2f},{data.max():.2f}"
    shown = common.render(options, *files, "--array", "Height", "--extrema", "--columns", 3, "--size", "1500x600",
                          "--range", span, "--labels", "noisy data,the four most persistent extrema,one maximum and one minimum",
                          "--title", "Data on a square, with all local extrema")
    for name, its in zip(("noisy data", *results), shown["extrema"]):
        numbers[f"{name}: number of maxima and minima in the picture"] = [its["maxima"], its["minima"]]
    for name, values in results.items():
        report = bindpose.report(values)
        numbers[f"{name}: relative gap"] = report["relative_gap"]
        numbers[f"{name}: rms distance to the data without noise"] = float(np.sqrt(np.mean((values - smooth) ** 2)) / np.ptp(smooth))
        numbers[f"{name}: all listed vertices are extrema"] = are_extrema(values, report["extrema"], edges_of(triangles))
    return numbers


if __name__ == "__main__":
    common.main(__file__, __doc__, make)
