#!/usr/bin/env python3
"""Diagnosis of a surface: its components and its open boundary curves.

Six parts in one mesh: a closed tube through itself, a sphere with holes, a sphere with an inward cap, an inside-out
sphere, three pages on one spine, and a duplicated bowl. The second output of vtkWindingNumberField (`bindpose winding
--boundary FILE`) contains each edge at which the directions of the adjacent triangles do not cancel. Each edge has a
multiplicity: 1 at a hole, 2 around the inward cap and the double bowl, 3 along the spine. The output also contains a
table of the parts: triangles, open edges (with multiplicities), volume.

Numbers: the table; the number of points at which the curves do not close (always 0, because a boundary has no
boundary). The last number compares the winding number of the surface with that of a fan of triangles over the curves:
it is the largest distance of their difference from an integer. It is 0 up to round-off, because apart from integers the
field depends only on the curves.
"""

import common
import bindpose
import numpy as np
from bindpose.meshes import points_of, to_dataset
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkCleanPolyData, vtkPolyDataNormals, vtkStripper, vtkTubeFilter
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkPolyDataMapper,
    vtkProperty,
    vtkRenderer,
    vtkRenderWindow,
    vtkTextActor,
)
import vtkmodules.vtkRenderingFreeType  # noqa: F401  needed to draw texts
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  needed to draw

import meshes

OUTSIDE, INSIDE, INK = (0.83, 0.80, 0.76), (0.62, 0.55, 0.80), (0.16, 0.16, 0.18)
COLORS = {1: (0.05, 0.46, 0.32), 2: (0.84, 0.43, 0.16), 3: (0.60, 0.10, 0.35)}
APART = 3.1


def pages(count=8):
    """Return three half discs on one spine, all oriented upwards along it."""
    angle = np.pi * (np.arange(count + 1) / count - 0.5)
    rim = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    parts = []
    for turn in (0.5, 2.1, 3.6):
        x, y = rim.T
        vertices = np.vstack([[[0, 0, 0]], np.stack([x * np.cos(turn), y, x * np.sin(turn)], axis=1)])
        vertices[np.abs(vertices) < 1e-12] = 0  # both ends of the spine get bit-identical coordinates
        parts.append((vertices, np.array([[0, 1 + i, 2 + i] for i in range(count)])))
    return meshes.joined(*parts)


def unclean(times):
    """Return the parts next to each other, and their names."""
    ball = meshes.sphere(times)
    x, y, z = meshes.centers(ball).T
    bowl = meshes.without(ball, y > 0.1)
    turn = np.arange(120) * 2 * np.pi / 120
    eight = np.stack([np.cos(turn), 0.7 * np.sin(2 * turn), 0 * turn], axis=1)
    parts = {
        "closed": meshes.tube(0.85 * eight, 0.25, 16),
        "holes": meshes.without(ball, (np.hypot(x - 0.3, y - 0.4) < 0.35) | (np.hypot(x + 0.4, y + 0.3) < 0.3)),
        "a cap inwards": meshes.flipped(ball, 0.5 * x + y + z > 0.75),
        "inside out": meshes.flipped(ball),
        "three pages": pages(),
        "there twice": meshes.joined(bowl, bowl),
    }
    return meshes.joined(*(meshes.moved(part, (APART * k, 0, 0)) for k, part in enumerate(parts.values()))), list(parts)


def actor_of(source, color):
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(color)
    return actor


def tubes_of(points, lines, radius):
    data = vtkPolyData()
    data.SetPoints(points)
    cells = vtkCellArray()
    for a, b in lines:
        cells.InsertNextCell(2, (a, b))
    data.SetLines(cells)
    clean, strips, tubes = vtkCleanPolyData(), vtkStripper(), vtkTubeFilter()
    clean.SetInputData(data)
    clean.ConvertLinesToPointsOff()
    strips.SetInputConnection(clean.GetOutputPort())
    strips.JoinContiguousSegmentsOn()
    tubes.SetInputConnection(strips.GetOutputPort())
    tubes.SetRadius(radius)
    tubes.SetNumberOfSides(12)
    tubes.CappingOn()
    return tubes


def text(words, x, y, size, color=INK, bold=False):
    actor = vtkTextActor()
    actor.SetInput(words)
    actor.GetPositionCoordinate().SetCoordinateSystemToNormalizedViewport()
    actor.SetPosition(x, y)
    style = actor.GetTextProperty()
    style.SetFontSize(size)
    style.SetColor(color)
    style.SetBold(bold)
    style.SetJustificationToCentered()
    style.SetVerticalJustificationToTop()
    style.SetLineSpacing(1.3)
    return actor


def draw(path, surface, boundary, lines, multiplicity, columns):
    """Draw the surface, its curves colored by multiplicity, and below each part a column of texts."""
    renderer = vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    normals = vtkPolyDataNormals()
    normals.SetInputData(surface)
    normals.ConsistencyOff()
    normals.SplittingOff()
    skin = actor_of(normals, OUTSIDE)
    back = vtkProperty()
    back.SetColor(INSIDE)
    skin.SetBackfaceProperty(back)
    for side in (skin.GetProperty(), back):
        side.SetInterpolationToFlat()
        side.SetAmbient(0.25)
        side.SetDiffuse(0.8)
    renderer.AddActor(skin)
    for times, color in COLORS.items():
        renderer.AddActor(actor_of(tubes_of(boundary.GetPoints(), lines[multiplicity == times], 0.035), color))
        renderer.AddActor2D(text(f"counts {times} times" if times > 1 else "counts once", 0.36 + 0.14 * (times - 1), 0.885,
                                 24, color, True))
    renderer.AddActor2D(text("Parts of an unclean mesh and their open edges  (violet: back faces)",
                             0.5, 0.97, 28, INK, True))
    count = len(columns)
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    middle = APART * (count - 1) / 2
    camera.SetPosition(middle, 4.0, 20.0)
    camera.SetFocalPoint(middle, -0.75, 0)
    size = 1900, 640
    camera.SetParallelScale(0.5 * APART * count * size[1] / size[0])
    renderer.ResetCameraClippingRange()
    for k, (name, rows) in enumerate(columns):
        at = (k + 0.5) / count
        renderer.AddActor2D(text(name, at, 0.29, 24, INK, True))
        renderer.AddActor2D(text("\n".join(rows), at, 0.23, 21))
    window = vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetSize(*size)
    window.SetMultiSamples(8)
    window.AddRenderer(renderer)
    common.write_picture(window, path)


def make(options):
    mesh, names = unclean(2 if options.small else 4)
    field = bindpose.vtkWindingNumberField()
    field.SetInputData(to_dataset(mesh))
    random = np.random.default_rng(5)
    reach = mesh[0].min(axis=0) - 1, mesh[0].max(axis=0) + 1
    probes = random.uniform(*reach, (200, 3))
    cloud = vtkPolyData()
    cloud.SetPoints(to_dataset((probes, [[0, 0, 0]])).GetPoints())
    field.SetInputData(1, cloud)
    field.SetMethodToExact()
    report = bindpose.run(field)
    boundary = field.GetBoundaryOutput()
    multiplicity = np.array(vtk_to_numpy(boundary.GetCellData().GetArray("Multiplicity")))
    component = np.array(vtk_to_numpy(boundary.GetCellData().GetArray("Component")))
    lines = np.array(vtk_to_numpy(boundary.GetLines().GetConnectivityArray())).reshape(-1, 2)
    table = {key: np.array(vtk_to_numpy(boundary.GetFieldData().GetArray(f"Component{key}")))
             for key in ("Triangles", "OpenEdges", "Volume")}

    columns, numbers = [], {"parts": report["counts"]["components"]}
    for k, name in enumerate(names):
        times, edges = np.unique(multiplicity[component == k], return_counts=True)
        row = [int(table["Triangles"][k]), int(table["OpenEdges"][k]), float(table["Volume"][k])]
        counted = " + ".join(f"{e} x {t}" if t > 1 else str(e) for e, t in zip(edges, times)) or "no"
        volume = round(row[2], 3) + 0.0  # avoids -0
        columns.append((name, [f"{row[0]:,} triangles", f"{counted} open edges", f"volume {volume:.3f}"]))
        numbers[f"{name}: triangles, open edges, volume"] = row
        numbers[f"{name}: multiplicities"] = times.tolist()

    # Check that incoming and outgoing edges cancel at every point. Compare coordinates instead of ids, because several
    # points may have the same position.
    points = points_of(boundary)
    _, same = np.unique(points, axis=0, return_inverse=True)
    ends = np.bincount(same[lines[:, 1]], multiplicity, same.max() + 1)
    starts = np.bincount(same[lines[:, 0]], multiplicity, same.max() + 1)
    numbers["points where curves do not close"] = int((ends != starts).sum())
    fan = (np.vstack([points, points.mean(axis=0)]), np.repeat(
        np.column_stack([np.full(len(lines), len(points)), lines]), multiplicity, axis=0))
    values = np.array(vtk_to_numpy(field.GetOutput().GetPointData().GetArray("WindingNumber")))
    rest = values - meshes.plain_winding_number(fan, probes)
    numbers["surface minus fan: largest distance of the winding number from an integer"] = float(
        np.abs(rest - np.rint(rest)).max())
    draw(options.picture, to_dataset(mesh), boundary, lines, multiplicity, columns)
    return numbers


if __name__ == "__main__":
    common.main(__file__, __doc__, make)
