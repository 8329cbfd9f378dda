#!/usr/bin/env python3
"""Extrema of weights distort small features; monotone weights preserve them.

A plate has two antennas and three points, none on an antenna; the point in the middle is pulled. Along an antenna,
weights continue with the slope that they have on the plate: unconstrained weights rise above 1, bounded weights rise to
at most 1. The tip of the antenna is then an extremum and moves more than the foot, so the antenna stretches. If only
handles may be extrema, weights cannot change along a dead end: monotone weights are nearly constant there, and the
antenna keeps its shape.

Numbers: weight of the middle point at the foot and the tip of the left antenna; displacement of the tip relative to
the foot, as a fraction of the pull; the largest stretch of an antenna's edge; extrema of the middle column away from
handles.
"""

import common
import bindpose
import numpy as np

import planar

ANTENNAS = ((1.15, 1.27), (1.73, 1.85))  # x ranges of the antennas
PLACES = {"left": (0.25, 0.5), "middle": (1.5, 0.35), "right": (2.75, 0.5)}
PULL = np.array([0.0, 0.55, 0.0])
METHODS = {"unconstrained": "biharmonic", "bounded": "bounded-biharmonic", "monotone": "monotone"}


def antenna_plate(step):
    """Return a plate 3 wide and 1 high, with two antennas 0.8 high on top."""
    columns, rows = round(3 / step), round(1.8 / step)
    x, y = np.meshgrid(np.linspace(0, 3, columns + 1), np.linspace(0, 1.8, rows + 1))
    points = np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1)
    first = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).ravel()
    right, up = first + 1, first + columns + 1
    squares = np.stack([first, right, up + 1, up], axis=1)
    middle = points[squares].mean(axis=1)
    kept = middle[:, 1] < 1
    for low, high in ANTENNAS:
        kept |= (middle[:, 0] > low) & (middle[:, 0] < high)
    a, b, c, d = squares[kept].T
    triangles = np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])
    used, renumbered = np.unique(triangles, return_inverse=True)
    return points[used], renumbered.reshape(-1, 3)


def make(options):
    mesh = antenna_plate(0.06 if options.small else 0.03)
    points, triangles = mesh
    shape = bindpose.meshes.to_dataset(mesh)
    at = np.array([[*place, 0] for place in PLACES.values()])
    handles = bindpose.handles(points=at, names=list(PLACES))
    pose = {"handles": {"middle": {"translate": [*PULL]}}}
    moved = at + [PULL * (name == "middle") for name in PLACES]

    def nearest(x, y):
        return int(np.argmin(np.hypot(points[:, 0] - x, points[:, 1] - y)))

    low, high = ANTENNAS[0]
    foot, tip = nearest((low + high) / 2, 1.0), nearest((low + high) / 2, 1.8)
    edges = np.unique(np.sort(np.concatenate([triangles[:, [k, (k + 1) % 3]] for k in range(3)]), axis=1), axis=0)
    edges = edges[(points[edges][:, :, 1] >= 1 - 1e-9).all(axis=1)]
    edges = edges[abs(np.diff(points[edges][:, :, 1], axis=1)).ravel() > 1e-9]
    lengths = np.linalg.norm(points[edges[:, 0]] - points[edges[:, 1]], axis=1)

    scale = ((0, (0.96, 0.95, 0.90)), (0.35, (0.56, 0.76, 0.70)), (1, (0.16, 0.20, 0.50)))
    numbers, tiles = {}, [("rest shape; red: the handle that is dragged up",
                           [planar.flat_actor(shape, (0.87, 0.86, 0.82)), *planar.edges(shape, shape), *dots(at)])]
    for caption, method in METHODS.items():
        weighted = bindpose.weights(shape, handles, method=method, domain="surface")
        column = bindpose.meshes.point_array(weighted, "Weights")[:, 1]
        posed = bindpose.deform(weighted, handles, pose)
        places = bindpose.meshes.points_of(posed)
        stretch = np.linalg.norm(places[edges[:, 0]] - places[edges[:, 1]], axis=1) / lengths - 1
        its = bindpose.report(weighted)["handles"][1]["interior_extrema"]
        numbers[f"{caption}: weight of the middle handle at the antenna's foot and tip"] = [
            float(column[foot]), float(column[tip])]
        ahead = places[tip] - places[foot] - points[tip] + points[foot]
        numbers[f"{caption}: displacement of tip minus foot, relative to that of the handle"] = float(
            ahead[1] / PULL[1])
        numbers[f"{caption}: largest stretch of an antenna's edge"] = float(abs(stretch).max())
        numbers[f"{caption}: extrema away from handles"] = int(its)
        tiles.append((f"{caption}: weight {column[tip]:.2f} at the tip, {its} extrema",
                      [planar.bands(posed, np.clip(column, 0, 1), scale, 20), *planar.edges(posed, shape), *dots(moved)]))
    window = planar.show(tiles, (-0.08, 3.08, -0.1, 2.62), tile=(460, 400),
                         title="Small features and the weights of the red handle")
    common.write_picture(window, options.picture)
    return numbers


def dots(places):
    return planar.dots(places, [(0.75, 0.75, 0.75), (0.95, 0.35, 0.2), (0.75, 0.75, 0.75)], 0.055)


if __name__ == "__main__":
    common.main(__file__, __doc__, make)
