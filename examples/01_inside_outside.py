#!/usr/bin/env python3
"""Test whether points are inside or outside of any triangle mesh, with numpy arrays and VTK datasets.

    examples/quickstart.sh                                                # once: installs and builds
    PYTHONPATH=build/lib/python3/dist-packages /usr/bin/python3 examples/01_inside_outside.py [MESH]

The script tests random points against an elephant full of holes (or against MESH). It compares the results with those
of vtkSelectEnclosedPoints, which PyVista's select_enclosed_points calls. Then it shows the other uses of the winding
number. It writes a picture and its numbers to --output, and also runs without a display.

PyVista's meshes are VTK datasets. If a pyvista.PolyData is used in place of `surface`, results are datasets of PyVista,
too.
"""

from __future__ import annotations

import argparse
import json
import os
import pathlib
import shutil
import sys
import time
from typing import Any

import bindpose
import numpy as np
from numpy.typing import NDArray
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkLookupTable, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkImplicitBoolean, vtkPlane, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkAppendPolyData, vtkClipPolyData, vtkGlyph3D, vtkPolyDataNormals, vtkTriangleFilter
from vtkmodules.vtkFiltersGeneral import vtkTransformPolyDataFilter
from vtkmodules.vtkFiltersGeometry import vtkImageDataGeometryFilter
from vtkmodules.vtkFiltersModeling import vtkSelectEnclosedPoints
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkPolyDataMapper,
    vtkProperty,
    vtkRenderer,
    vtkRenderWindow,
    vtkTextActor,
    vtkWindowToImageFilter,
)
import vtkmodules.vtkRenderingFreeType  # noqa: F401  needed to draw texts
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  needed to draw

import quickstart  # quickstart.py, next to this file, finds the demo meshes

Points = NDArray[np.float64]  # #P x 3
Color = tuple[float, float, float]  # red, green, blue from 0 to 1


# ---- Comparison with vtkSelectEnclosedPoints ---------------------------------------------------


def select_enclosed_points(surface: vtkPolyData, points: Points, check: bool) -> NDArray[np.bool_] | None:
    """Return the result of VTK's own filter: (#P,) bool; None if `check` rejects an open surface."""
    cloud = vtkPolyData()
    cloud.SetPoints(vtkPoints())
    for point in points:
        cloud.GetPoints().InsertNextPoint(point)
    selection = vtkSelectEnclosedPoints()
    selection.SetInputData(cloud)
    selection.SetSurfaceData(surface)
    selection.SetCheckSurface(check)
    selection.AddObserver("ErrorEvent", lambda *_: None)
    if check and not selection.IsSurfaceClosed(surface):
        return None  # the check requires a closed surface; otherwise the filter has no result
    selection.Update()
    inside: NDArray[np.bool_] = vtk_to_numpy(selection.GetOutput().GetPointData().GetArray("SelectedPoints")).astype(bool)
    return inside


def compare(title: str, surface: vtkPolyData, points: Points, numbers: dict[str, Any],
            truth: NDArray[np.bool_] | None = None) -> Any:
    """Print one line: the number of points inside (Bindpose, VTK), the number of points with different results, and
    the numbers of errors if the truth is known."""
    ours = bindpose.contains(surface, points)
    theirs = select_enclosed_points(surface, points, check=False)
    assert theirs is not None  # without the check there is always a result
    refused = select_enclosed_points(surface, points, check=True) is None
    numbers[title] = {"inside": int(ours.sum()), "vtk_inside": int(theirs.sum()),
                      "disagree": int((ours != theirs).sum()), "vtk_refuses": refused}
    line = (f"  {title:<16} {ours.sum():>7} {theirs.sum():>7} {(ours != theirs).sum():>9}"
            f"    {'input rejected' if refused else 'input accepted'}")
    if truth is not None:
        numbers[title].update(wrong=int((ours != truth).sum()), vtk_wrong=int((theirs != truth).sum()))
        line += f"    wrong: {(ours != truth).sum()}, VTK {(theirs != truth).sum()}"
    print(line)
    return ours, theirs


def shifted(surface: vtkPolyData, x: float, y: float, z: float) -> vtkPolyData:
    transform = vtkTransform()
    transform.Translate(x, y, z)
    mover = vtkTransformPolyDataFilter()
    mover.SetInputData(surface)
    mover.SetTransform(transform)
    mover.Update()
    return mover.GetOutput()


def joined(*surfaces: vtkPolyData) -> vtkPolyData:
    append = vtkAppendPolyData()
    for surface in surfaces:
        append.AddInputData(surface)
    append.Update()
    return append.GetOutput()


# ---- The picture -------------------------------------------------------------------------------


def winding_colors() -> vtkLookupTable:
    """Return a color map: blue outside, orange inside, white in between; violet below 0, brown above 1."""
    table = vtkLookupTable()
    table.SetNumberOfTableValues(300)
    table.SetTableRange(-1, 2)
    stops = [-1, -0.02, -0.0199, 0, 0.5, 1, 1.0199, 1.02, 2]
    colors = np.array([[0.20, 0.10, 0.45], [0.52, 0.47, 0.77], [0.44, 0.65, 0.82], [0.44, 0.65, 0.82], [0.98, 0.97, 0.95],
                        [0.90, 0.58, 0.36], [0.90, 0.58, 0.36], [0.72, 0.33, 0.17], [0.36, 0.08, 0.05]])
    for i in range(300):
        value = -1 + 3 * (i + 0.5) / 300
        table.SetTableValue(i, *(np.interp(value, stops, colors[:, k]) for k in range(3)), 1)
    return table


def actor_of(source: Any, color: Color | None = None, table: vtkLookupTable | None = None) -> vtkActor:
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    mapper.SetScalarVisibility(table is not None)
    if table is not None:
        mapper.SetLookupTable(table)
        mapper.UseLookupTableScalarRangeOn()
    actor = vtkActor()
    actor.SetMapper(mapper)
    if color:
        actor.GetProperty().SetColor(color)
    return actor


def balls(points: Points, radius: float, color: Color) -> vtkActor:
    cloud = vtkPolyData()
    cloud.SetPoints(vtkPoints())
    for point in points:
        cloud.GetPoints().InsertNextPoint(point)
    ball = vtkSphereSource()
    ball.SetRadius(radius)
    ball.SetThetaResolution(16)
    ball.SetPhiResolution(12)
    glyphs = vtkGlyph3D()
    glyphs.SetInputData(cloud)
    glyphs.SetSourceConnection(ball.GetOutputPort())
    glyphs.ScalingOff()
    glyphs.OrientOff()
    return actor_of(glyphs, color)


def note(words: str, place: tuple[float, float], color: Color = (0.16, 0.16, 0.18),
         bold: bool = False) -> vtkTextActor:
    text = vtkTextActor()
    text.SetInput(words)
    text.GetPositionCoordinate().SetCoordinateSystemToNormalizedViewport()
    text.SetPosition(*place)
    text.GetTextProperty().SetFontSize(26)
    text.GetTextProperty().SetBold(bold)
    text.GetTextProperty().SetColor(color)
    text.GetTextProperty().SetJustificationToCentered()
    return text


def legend(table: vtkLookupTable) -> vtkScalarBarActor:
    bar = vtkScalarBarActor()
    bar.SetLookupTable(table)
    bar.SetNumberOfLabels(4)
    bar.SetLabelFormat("%.0f")
    bar.UnconstrainedFontSizeOn()
    bar.SetPosition(0.03, 0.33)
    bar.SetWidth(0.07)
    bar.SetHeight(0.36)
    text = bar.GetLabelTextProperty()
    text.SetFontSize(24)
    text.SetColor(0.16, 0.16, 0.18)
    text.ItalicOff()
    text.BoldOff()
    text.ShadowOff()
    return bar


def field_on(surface: vtkPolyData, box: Any, table: vtkLookupTable) -> Any:
    """Return an actor that shows the winding number on a flat box (x0, x1, y0, y1, z0, z1), except where it is nearly
    0."""
    samples = [1 if a == b else max(2, round(500 * (b - a) / max(box[1] - box[0], box[3] - box[2], box[5] - box[4])))
               for a, b in zip(box[::2], box[1::2])]
    image = bindpose.winding_number(surface, samples, bounds=box)  # a grid one sample thick
    magnitude = numpy_to_vtk(np.abs(vtk_to_numpy(image.GetPointData().GetScalars())), deep=True)
    magnitude.SetName("Magnitude")
    image.GetPointData().AddArray(magnitude)
    flat, shown = vtkImageDataGeometryFilter(), vtkClipPolyData()
    flat.SetInputData(image)
    shown.SetInputConnection(flat.GetOutputPort())
    shown.SetInputArrayToProcess(0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, "Magnitude")
    shown.SetValue(0.04)
    actor = actor_of(shown, table=table)
    actor.GetProperty().LightingOff()
    return actor


def write_picture(path: pathlib.Path, surface: vtkPolyData, points: Points, ours: NDArray[np.bool_],
                  theirs: Any) -> None:
    """Draw, on the left, the surface with a corner cut out and the winding number on the two cut planes. Draw, on the
    right, the points with their results."""
    x0, x1, y0, y1, z0, z1 = surface.GetBounds()
    size = float(np.linalg.norm([x1 - x0, y1 - y0, z1 - z0]))
    pad = 0.05 * size
    x, z = x0 + 0.55 * (x1 - x0), z0 + 0.45 * (z1 - z0)
    corner = vtkImplicitBoolean()
    corner.SetOperationTypeToIntersection()
    for normal in ((1, 0, 0), (0, 0, -1)):
        plane = vtkPlane()
        plane.SetOrigin(x, 0, z)
        plane.SetNormal(normal)
        corner.AddFunction(plane)
    normals, rest = vtkPolyDataNormals(), vtkClipPolyData()
    normals.SetInputData(surface)
    normals.ConsistencyOff()
    normals.SplittingOff()
    rest.SetInputConnection(normals.GetOutputPort())
    rest.SetClipFunction(corner)
    table = winding_colors()
    solid, glass = actor_of(rest, (0.83, 0.80, 0.76)), actor_of(normals, (0.83, 0.80, 0.76))
    inner = vtkProperty()
    inner.SetColor(0.55, 0.51, 0.48)
    solid.SetBackfaceProperty(inner)
    for side in (solid.GetProperty(), inner):
        side.SetAmbient(0.25)
        side.SetDiffuse(0.8)
    glass.GetProperty().SetOpacity(0.22)
    # The field is drawn on the two planes that cut the corner off. Shift these planes slightly, so that the cut edges
    # of the surface are drawn in front of the field.
    hair = 1e-4 * size
    cuts = [field_on(surface, [x0 - pad, x, y0 - pad, y1 + pad, z - hair, z - hair], table),
            field_on(surface, [x + hair, x + hair, y0 - pad, y1 + pad, z, z1 + pad], table)]
    wrong = ours != theirs
    answers = [balls(points[ours & ~wrong], 0.005 * size, (0.90, 0.50, 0.20)),
               balls(points[wrong], 0.007 * size, (0.12, 0.12, 0.14))]

    window = vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetSize(1800, 960)
    window.SetMultiSamples(0)
    window.SetAlphaBitPlanes(1)
    left = [solid, *cuts, legend(table), note("Winding number", (0.5, 0.94), bold=True),
            note("one corner is cut away; the cuts show |winding number| > 0.04", (0.5, 0.03))]
    right = [glass, *answers, note("Inside", (0.5, 0.94), bold=True),
             note("black: vtkSelectEnclosedPoints gives a different result", (0.5, 0.03))]
    for number, actors in enumerate((left, right)):
        renderer = vtkRenderer()
        renderer.SetViewport(0.5 * number, 0, 0.5 * (number + 1), 1)
        renderer.SetBackground(1, 1, 1)
        renderer.SetUseDepthPeeling(True)
        renderer.SetMaximumNumberOfPeels(6)
        renderer.SetOcclusionRatio(0)
        renderer.UseFXAAOn()
        for actor in actors:
            renderer.AddViewProp(actor)
        camera = renderer.GetActiveCamera()
        camera.SetPosition(-0.5, 0.25, 1)
        camera.SetFocalPoint(0, 0, 0)
        renderer.ResetCamera(x0 - pad, x1 + pad, y0 - pad, y1 + pad, z0, z1)
        camera.Zoom(1.25)
        renderer.ResetCameraClippingRange()
        window.AddRenderer(renderer)
    window.Render()
    picture = vtkWindowToImageFilter()
    picture.SetInput(window)
    picture.ReadFrontBufferOff()
    writer = vtkPNGWriter()
    writer.SetFileName(str(path))
    writer.SetInputConnection(picture.GetOutputPort())
    writer.Write()
    if writer.GetErrorCode():
        raise OSError(f"cannot write {path}")


# ---- The examples ------------------------------------------------------------------------------


def main(options: argparse.Namespace) -> dict[str, Any]:
    numbers: dict[str, Any] = {}
    demo = options.mesh is None
    mesh = options.mesh or quickstart.demo_mesh(options.output / "meshes")
    # a vtkPolyData; a pair of arrays (vertices #V x 3, triangles #F x 3) is also accepted
    surface = bindpose.read(mesh)
    if not surface.IsA("vtkPolyData"):
        raise bindpose.InvalidInput(f"{mesh} contains a {surface.GetClassName()}; expected a vtkPolyData")
    bounds = np.reshape(surface.GetBounds(), (3, 2))
    random = np.random.default_rng(1)
    lower, upper = bounds.T
    points = random.uniform(lower, upper, (1000 if options.small else 20000, 3))

    # First the boolean result, then the winding number.
    inside = bindpose.contains(surface, points)
    values = bindpose.winding_number(surface, points)
    counts = values.report["counts"]
    print(f"{pathlib.Path(mesh).name}: {counts['triangles']} triangles, {counts['open_edges']} open edges")
    print(f"{inside.sum()} of {len(points)} points are inside; winding numbers from {values.min():.2f} to {values.max():.2f};")
    print(f"method {values.report['method']}: {values.report['method_reason']}\n")

    # Compare with VTK's own filter on the same points. The demo mesh also exists in a version without holes. An exact
    # test with this closed version gives the correct result.
    print(f"  {'surface':<16} {'inside':>7} {'by VTK':>7} {'disagree':>9}    vtkSelectEnclosedPoints")
    closed = bindpose.read(quickstart.demo_mesh(options.output / "meshes", "elephant.off")) if demo else None
    truth = bindpose.contains(closed, points, method="exact") if demo else None
    ours, theirs = compare("as it is", surface, points, numbers, truth)
    length = float(bounds[0, 1] - bounds[0, 0])
    pair = joined(closed if demo else surface, shifted(closed if demo else surface, 0.15 * length, 0, 0))
    either = None
    if truth is not None:
        either = truth | bindpose.contains(closed, points - [0.15 * length, 0, 0], method="exact")
    compare("crossing a copy", pair, points, numbers, either)
    if demo:
        compare("without holes", closed, points, numbers, truth)

    # The error of the fast method is guaranteed to be smaller than the parameter `tolerance`.
    few = points[:1000]
    exact = bindpose.winding_number(surface, few, method="exact")
    print(f"\n  exact: {1e6 * exact.report['seconds']['evaluate'] / len(few):8.2f} µs per point ({exact.report['method']})")
    numbers["tolerance"] = {}
    for tolerance in (1e-2, 1e-4, 1e-6):
        fast = bindpose.winding_number(surface, few, method="fast", tolerance=tolerance)
        numbers["tolerance"][str(tolerance)] = float(np.abs(fast - exact).max())
        print(f"  within {tolerance:.0e}: {1e6 * fast.report['seconds']['evaluate'] / len(few):8.2f} µs per point, "
              f"maximum error {np.abs(fast - exact).max():.1e}")

    # Compare the gradient with finite differences of the field.
    _, gradient = bindpose.winding_number(surface, few, compute_gradient=True, method="exact")
    step = 1e-5 * length
    beside = [bindpose.winding_number(surface, few + s * step * np.eye(3)[0], method="exact") for s in (-1, 1)]
    slope = (beside[1] - beside[0]) / (2 * step)
    smooth = np.abs(beside[1] - beside[0]) < 0.5  # exclude points with a jump between the two samples
    error = np.median(np.abs(slope - gradient[:, 0])[smooth] / (1e-9 + np.abs(gradient[smooth, 0])))
    numbers["gradient"] = float(error)
    print(f"\n  gradient: median relative difference from finite differences {error:.1e}")

    # The result can also be a grid, a vtkImageData. For any other vtkDataSet the field is evaluated at its points.
    start = time.perf_counter()
    grid = bindpose.winding_number(surface, 32 if options.small else 128)  # number of samples along the longest side
    report = bindpose.report(grid)
    numbers["winding_volume"] = report["winding_volume"]
    print(f"  grid {' x '.join(map(str, grid.GetDimensions()))}: {time.perf_counter() - start:.2f} s, "
          f"enclosed volume {report['winding_volume']:.4g}")
    # winding number of the surface at its own vertices: about 1/2
    at_vertices = bindpose.winding_number(surface, surface)
    print(f"  mean winding number at the surface's own vertices: "
          f"{vtk_to_numpy(at_vertices.GetPointData().GetArray('WindingNumber')).mean():.3f}")

    # Triangles with the wrong orientation have a negative winding number. Their contribution is subtracted, unless they
    # are flipped first.
    cut = vtkTriangleFilter()  # triangulates polygons, if any
    cut.SetInputData(surface)
    cut.PassVertsOff()
    cut.PassLinesOff()
    cut.Update()
    vertices = vtk_to_numpy(cut.GetOutput().GetPoints().GetData()).astype(float)
    triangles = np.array(vtk_to_numpy(cut.GetOutput().GetPolys().GetConnectivityArray())).reshape(-1, 3)
    some = random.random(len(triangles)) < 0.1
    triangles[some] = triangles[some, ::-1]
    for orient in (False, True):
        answer = bindpose.contains((vertices, triangles), points, orient_patches=orient)
        numbers[f"flipped, orient_patches={orient}"] = int((answer != inside).sum())
        print(f"  a tenth of the triangles flipped, orient_patches={orient}: {(answer != inside).sum()} answers change")

    # The second output of the VTK class is the open boundary of the surface. The class can be used in any pipeline.
    field = bindpose.vtkWindingNumberField()
    field.SetInputData(surface)
    field.SetDimensions(2, 2, 2)
    bindpose.run(field)  # like Update(), but raises an exception on failure
    boundary = field.GetBoundaryOutput()
    numbers["boundary_lines"] = boundary.GetNumberOfLines()
    numbers["open_edges"] = counts["open_edges"]
    print(f"  open along {boundary.GetNumberOfLines()} edges")

    picture = options.output / "inside_outside.png"
    write_picture(picture, surface, points, ours, theirs)
    print(f"\npicture: {picture}")
    return numbers


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh", nargs="?", help="off, obj, ply, stl, vtp (default: elephant-with-holes.off of libcgal-demo)")
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("gallery-output"), help="(default: gallery-output)")
    parser.add_argument("--small", action="store_true", help="fewer points")
    return parser.parse_args()


if __name__ == "__main__":
    given = arguments()
    if not os.environ.get("DISPLAY"):  # without a display VTK would end the process
        if not shutil.which("xvfb-run"):
            print("01_inside_outside.py: there is no display; install the Debian package xvfb", file=sys.stderr)
            sys.exit(2)
        os.execvp("xvfb-run", ["xvfb-run", "-a", "-s", "-screen 0 1280x1024x24 -noreset", sys.executable, *sys.argv])
    try:
        given.output.mkdir(parents=True, exist_ok=True)
        result = main(given)
        (given.output / "inside_outside.json").write_text(json.dumps(result, indent=2) + "\n")
    except (bindpose.BindposeError, quickstart.Stop, OSError) as error:
        print(f"01_inside_outside.py: {error}", file=sys.stderr)
        sys.exit(2)
