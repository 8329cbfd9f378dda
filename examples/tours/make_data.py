#!/usr/bin/env python3
"""Create the shapes that the tours open: a little man of balls and capsules, his handles, the winding numbers around
him, his tets, a paper doll in a picture, and a leaf in a tilted plane. They are stored in data/. Run this script again
after a change of the file formats.

usage: make_data.py PROGRAM    (the program bindpose)
"""

import math
import pathlib
import subprocess
import sys

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import VTK_UNSIGNED_CHAR
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersCore import vtkFlyingEdges3D, vtkPolyDataNormals, vtkQuadricDecimation
from vtkmodules.vtkIOImage import vtkPNGWriter

DATA = pathlib.Path(__file__).resolve().parent / "data"

# Start, end, radius; y is up.
LIMBS = [
    ((0, 0.78, 0), (0, 0.86, 0), 0.19),           # head
    ((0, 0.05, 0), (0, 0.42, 0), 0.2),            # trunk
    ((0.12, 0.46, 0), (0.62, 0.34, 0), 0.085),    # arms
    ((-0.12, 0.46, 0), (-0.62, 0.34, 0), 0.085),
    ((0.11, 0, 0), (0.2, -0.62, 0), 0.1),         # legs
    ((-0.11, 0, 0), (-0.2, -0.62, 0), 0.1),
    ((0.2, -0.66, 0), (0.2, -0.66, 0.12), 0.085),  # feet
    ((-0.2, -0.66, 0), (-0.2, -0.66, 0.12), 0.085),
]
POINTS = {"head": (0, 0.84, 0), "left_hand": (0.58, 0.35, 0), "right_hand": (-0.58, 0.35, 0),
          "left_foot": (0.2, -0.62, 0.02), "right_foot": (-0.2, -0.62, 0.02)}
SPINE = ((0, 0.0, 0), (0, 0.45, 0))


def distance(points, limb):
    """Return the distance to a capsule, negative inside."""
    a, b, radius = numpy.array(limb[0], float), numpy.array(limb[1], float), limb[2]
    along = numpy.clip((points - a) @ (b - a) / ((b - a) @ (b - a)), 0, 1)
    return numpy.linalg.norm(points - a - along[:, None] * (b - a), axis=1) - radius


def figure():
    """Return the man's surface: capsules that blend smoothly."""
    spacing, lower, size = 0.05, (-0.85, -0.9, -0.35), (35, 43, 15)
    grid = numpy.stack(numpy.meshgrid(*[numpy.arange(n) for n in size[::-1]], indexing="ij")[::-1], axis=-1).reshape(-1, 3)
    places = grid * spacing + numpy.array(lower)
    near = sum(numpy.exp(-18 * distance(places, limb)) for limb in LIMBS)
    image = vtkImageData()
    image.SetDimensions(*size)
    image.SetSpacing(spacing, spacing, spacing)
    image.SetOrigin(*lower)
    values = numpy_to_vtk(-numpy.log(near), deep=True)
    image.GetPointData().SetScalars(values)
    contour = vtkFlyingEdges3D()
    contour.SetInputData(image)
    contour.SetValue(0, 0.0)
    fewer = vtkQuadricDecimation()
    fewer.SetInputConnection(contour.GetOutputPort())
    fewer.SetTargetReduction(0.55)
    normals = vtkPolyDataNormals()
    normals.SetInputConnection(fewer.GetOutputPort())
    normals.ConsistencyOn()
    normals.AutoOrientNormalsOn()
    normals.SplittingOff()
    normals.Update()
    surface = normals.GetOutput()
    return vtk_to_numpy(surface.GetPoints().GetData()), vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)


def write_off(path, points, triangles):
    lines = [f"OFF\n{len(points)} {len(triangles)} 0"]
    lines += [" ".join(f"{x:.4f}" for x in point) for point in points]
    lines += ["3 " + " ".join(map(str, triangle)) for triangle in triangles]
    path.write_text("\n".join(lines) + "\n")


def write_tgf(path, points, bones):
    lines = [f"{k} {' '.join(f'{x:g}' for x in place)} {name}" for k, (name, place) in enumerate(points.items(), 1)]
    edges = []
    for bone in bones:
        for place in bone:
            lines.append(f"{len(lines) + 1} {' '.join(f'{x:g}' for x in place)}")
        edges.append(f"{len(lines) - 1} {len(lines)} 1 0 0")
    path.write_text("\n".join([*lines, "#", *edges]) + "\n")


def paper_doll(path):
    """Draw the man from the front as a paper cut-out: a picture with alpha."""
    pixels = 256
    y, x = numpy.mgrid[0:pixels, 0:pixels]
    places = numpy.stack([(x.ravel() + 0.5) / pixels * 2.1 - 1.05, (y.ravel() + 0.5) / pixels * 2.1 - 1.0,
                          numpy.zeros(pixels * pixels)], axis=1)
    flat = [((*a[:2], 0), (*b[:2], 0.0001), radius) for a, b, radius in LIMBS]
    apart = -numpy.log(sum(numpy.exp(-18 * distance(places, limb)) for limb in flat)) / 18
    picture = numpy.zeros((pixels * pixels, 4), numpy.uint8)
    inside = apart < 0
    picture[inside] = (201, 138, 82, 255)
    picture[inside & (apart > -0.03)] = (122, 74, 38, 255)  # a rim
    stripes = inside & (numpy.abs(places[:, 1] - 0.25) < 0.2) & (numpy.sin(50 * places[:, 1]) > 0) & (numpy.abs(places[:, 0]) < 0.22)
    picture[stripes & (apart < -0.03)] = (60, 110, 160, 255)
    for eye in (-0.07, 0.07):
        picture[numpy.hypot(places[:, 0] - eye, places[:, 1] - 0.88) < 0.025] = (40, 28, 20, 255)
    mouth = numpy.hypot(places[:, 0], places[:, 1] - 0.83)
    picture[(numpy.abs(mouth - 0.09) < 0.014) & (places[:, 1] < 0.79)] = (40, 28, 20, 255)
    image = vtkImageData()
    image.SetDimensions(pixels, pixels, 1)
    image.GetPointData().SetScalars(numpy_to_vtk(picture, deep=True, array_type=VTK_UNSIGNED_CHAR))
    writer = vtkPNGWriter()
    writer.SetFileName(str(path))
    writer.SetInputData(image)
    writer.Write()
    # Convert to pixels of the picture, which are the unit of the shape.
    def pixel(place):
        return ((place[0] + 1.05) / 2.1 * pixels - 0.5, (place[1] + 1.0) / 2.1 * pixels - 0.5, 0)
    write_tgf(path.with_suffix(".tgf"), {name: tuple(round(v) for v in pixel(place)) for name, place in POINTS.items()},
              [tuple(tuple(round(v) for v in pixel(place)) for place in SPINE)])


def leaf(folder):
    """Create a flat shape that is not parallel to any coordinate plane, exact to twelve digits."""
    along, across = 25, 9
    u, v = numpy.meshgrid(numpy.linspace(-1, 1, along), numpy.linspace(-1, 1, across), indexing="ij")
    flat = numpy.stack([u, (0.05 + 0.4 * (1 - u**2)) * v + 0.12 * u**2, 0 * u], axis=-1).reshape(-1, 3)
    axis, angle = numpy.array([1, 0.4, 0.2]) / numpy.linalg.norm([1, 0.4, 0.2]), math.radians(35)
    cross = numpy.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    turn = numpy.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross
    points = flat @ turn.T
    triangles = []
    for i in range(along - 1):
        for j in range(across - 1):
            a, b, c, d = i * across + j, (i + 1) * across + j, (i + 1) * across + j + 1, i * across + j + 1
            triangles += [(a, b, c), (a, c, d)]
    lines = [f"OFF\n{len(points)} {len(triangles)} 0"]
    lines += [" ".join(f"{x:.12f}" for x in point) for point in points]
    lines += ["3 " + " ".join(map(str, triangle)) for triangle in triangles]
    (folder / "leaf.off").write_text("\n".join(lines) + "\n")
    middle = across // 2
    places = {"stalk": points[middle], "middle": points[along // 2 * across + middle], "tip": points[(along - 1) * across + middle]}
    lines = [f"{k} {' '.join(f'{x:.12f}' for x in place)} {name}" for k, (name, place) in enumerate(places.items(), 1)]
    (folder / "leaf.tgf").write_text("\n".join([*lines, "#"]) + "\n")


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    program = pathlib.Path(sys.argv[1]).resolve()
    DATA.mkdir(exist_ok=True)
    points, triangles = figure()
    assert numpy.isfinite(points).all() and math.isfinite(points.max())
    write_off(DATA / "figure.off", points, triangles)
    write_tgf(DATA / "figure.tgf", POINTS, [SPINE])
    paper_doll(DATA / "doll.png")
    leaf(DATA)
    for words in (["winding", "figure.off", "--resolution", "72", "--output-precision", "single", "-o", "figure_winding.vti"],
                  ["tetrahedralize", "figure.off", "--method", "cdt", "--interior-edge", "0.06", "-o", "figure_tets.vtu"],
                  ["weights", "figure.off", "--handles", "figure.tgf", "--keep-raw", "-o", "figure_weights.vtp"],
                  ["info", "figure.off"]):
        subprocess.run([program, *words, "--overwrite", "--quiet"], cwd=DATA, check=True)


if __name__ == "__main__":
    main()
