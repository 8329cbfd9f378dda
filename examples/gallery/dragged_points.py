#!/usr/bin/env python3
"""Sources of rotation for points that are only translated: none, pseudo-edges, reduced as-rigid-as-possible.

A strip with four points, which are translated to an arc of 150 degrees without rotations. From left to right: blending
the translations shears the strip; pseudo-edges between neighbors determine the rotation of each point; reduced
as-rigid-as-possible finds the rotations that bend the strip least. Pseudo-edges cost nothing and need no iteration.
They are chords of the arc, and each end point has only one of them, so its rotation is that of this chord.

Numbers: the rotation of each point in degrees, where the arc has -75, -25, 25 and 75; the strip's area, relative to
rest; its largest and smallest stretch; inverted triangles.
"""

import common
import bindpose
import numpy as np
from bindpose.meshes import points_of, to_dataset
from vtkmodules.util.numpy_support import vtk_to_numpy

ARC = 150  # angle of the arc in degrees
LENGTH = 6
WAYS = {"translations": {"method": "lbs", "pseudo_edges": "none"}, "pseudo-edges": {"method": "lbs", "pseudo_edges": "auto"},
        "reduced ARAP": {"method": "reduced-arap"}}


def strip(along, across):
    """Return a rectangle of LENGTH by 1 about the x axis."""
    x, y = np.meshgrid(np.linspace(0, LENGTH, along + 1), np.linspace(-0.5, 0.5, across + 1))
    points = np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1)
    corner = (np.arange(across)[:, None] * (along + 1) + np.arange(along)).ravel()
    squares = np.stack([corner, corner + 1, corner + along + 2, corner + along + 1], axis=1)
    return points, np.concatenate([squares[:, [0, 1, 2]], squares[:, [0, 2, 3]]])


def area(points, triangles):
    a, b, c = (points[triangles[:, k], :2] for k in range(3))
    (x, y), (u, v) = (b - a).T, (c - a).T
    return float((x * v - y * u).sum() / 2)


def turns(posed):
    """Return the rotations of the handles' transforms in degrees."""
    transforms = vtk_to_numpy(posed.GetFieldData().GetArray("HandleTransforms")).reshape(-1, 3, 4)
    return [float(np.degrees(np.arctan2(t[1, 0] - t[0, 1], t[0, 0] + t[1, 1]))) for t in transforms]


def make(options):
    points, triangles = strip(*((48, 8) if options.small else (96, 16)))
    places = np.array([[x, 0, 0] for x in np.linspace(0, LENGTH, 4)])
    handles = bindpose.handles(points=places)
    weighted = bindpose.weights(to_dataset((points, triangles)), handles, domain="surface")
    # Bend the strip to an arc of the same length. The middle of the arc is the middle of the strip.
    angles = np.radians(ARC) * (places[:, 0] / LENGTH - 0.5)
    radius = LENGTH / np.radians(ARC)
    arc = np.stack([LENGTH / 2 + radius * np.sin(angles), radius * (1 - np.cos(angles)), 0 * angles], axis=1)
    pose = {"handles": {f"p{k + 1}": {"mode": "position", "translate": (arc[k] - places[k]).tolist()} for k in range(4)}}
    numbers, files, labels = {}, [], []
    for name, way in WAYS.items():
        posed = bindpose.deform(weighted, handles, pose, stretch_array=True, **way)
        report = bindpose.report(posed)
        share = area(points_of(posed), triangles) / area(points, triangles)
        numbers[f"{name}, degrees"] = turns(posed)
        numbers[f"{name}, area"] = share
        numbers[f"{name}, largest and smallest stretch"] = [report["largest_stretch"], report["smallest_stretch"]]
        numbers[f"{name}, inverted triangles"] = report["counts"]["inverted_elements"]
        files.append(f"{name}.vtp".replace(" ", "-"))
        labels.append(f"{name}: area {share:.2f}")
        bindpose.write(posed, options.scratch / files[-1])
    common.render(options, *files, "--columns", 3, "--size", "1500x480", "--edges", "--array", "Stretch", "--component",
                  "largest", "--range", "1,2", "--labels", ",".join(labels),
                  "--title", "Points dragged to an arc: largest stretch")
    return numbers


if __name__ == "__main__":
    common.main(__file__, __doc__, make)
