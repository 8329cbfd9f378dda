#!/usr/bin/env python3
"""A hundred elephants, each in its own pose.

One elephant is bound, so all instances share its weights, clusters and projected matrices. A hundred instances form a
square. In each instance the ends of trunk, legs, ears and tail are dragged to individual positions, and the transforms
of all other handles are computed. Then the crowd moves frame by frame, starting from its last poses.

Numbers: triangles of an elephant, handles, clusters; seconds of the bind. For a frame of the whole crowd, the fastest
of twenty on one thread: milliseconds of all solves, and of moving all points; frames per second of both together;
iterations per instance; distance of an instance from the result of vtkReducedARAP for its pose, relative to the
diagonal.
"""

import colorsys

import common
import bindpose
import numpy as np
from bindpose.handle_sets import cell_names
from bindpose.meshes import points_of
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow, vtkTextActor

SIDE = 10
POSITION, FREE = 1, 2


def array_of(name, values):
    array = numpy_to_vtk(np.ascontiguousarray(values, dtype=float), deep=True)
    array.SetName(name)
    return array


def places(size):
    """Return the positions of the instances."""
    column, row = np.meshgrid(np.arange(SIDE), np.arange(SIDE))
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.stack([column.ravel() * 0.72, 0 * row.ravel(), -row.ravel() * 0.8], axis=1) * size,
                                deep=True))
    instances = vtkPolyData()
    instances.SetPoints(points)
    return instances


def tell(instances, names, dragged, size, frame):
    """Return the positions of each instance's dragged handles in a frame; all oscillate differently."""
    rng = np.random.default_rng(1)
    for name in names[:dragged]:
        phase, speed = rng.uniform(0, 2 * np.pi, (SIDE * SIDE, 3)), rng.uniform(0.5, 1.5, (SIDE * SIDE, 3))
        instances.GetPointData().AddArray(array_of(name, 0.07 * size * np.sin(phase + 0.1 * speed * frame)))
    modes = np.where(np.arange(len(names)) < dragged, POSITION, FREE)
    instances.GetPointData().AddArray(array_of("Mode", np.tile(modes, (SIDE * SIDE, 1))))


def draw(options, crowd, labels):
    """Draw all instances, in colors around the color wheel."""
    renderer = vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    for k in range(SIDE * SIDE):
        mapper = vtkPolyDataMapper()
        mapper.SetInputData(crowd.GetPartition(k, 0))
        mapper.ScalarVisibilityOff()
        actor = vtkActor()
        actor.SetMapper(mapper)
        actor.GetProperty().SetColor(colorsys.hsv_to_rgb((0.61 * k) % 1, 0.35, 0.95))
        renderer.AddActor(actor)
    for text, y in labels:
        caption = vtkTextActor()
        caption.SetInput(text)
        caption.GetTextProperty().SetColor(0.1, 0.1, 0.1)
        caption.GetTextProperty().SetFontSize(24)
        caption.GetTextProperty().SetJustificationToCentered()
        caption.SetPosition(750, y)
        renderer.AddViewProp(caption)
    window = vtkRenderWindow()
    window.OffScreenRenderingOn()
    window.SetMultiSamples(4)
    window.SetSize(1500, 1000)
    window.AddRenderer(renderer)
    renderer.ResetCamera()
    renderer.GetActiveCamera().Elevation(36)
    renderer.GetActiveCamera().SetViewAngle(18)
    renderer.ResetCamera()
    renderer.GetActiveCamera().Zoom(1.66)
    renderer.ResetCameraClippingRange()
    common.write_picture(window, options.picture)


def make(options):
    mesh = common.demo_mesh(options, "elephant.off" if options.small else "refined_elephant.off")
    size = float(np.linalg.norm(np.ptp(points_of(mesh), axis=0)))
    handles = bindpose.farthest_point_handles(mesh, 8 if options.small else 20)
    dragged = 4 if options.small else 8
    names = cell_names(handles)
    weighted = bindpose.weights(mesh, handles, domain="embedding")

    instances = places(size)
    crowd = bindpose.vtkCrowdDeformation()
    crowd.SetInputData(0, weighted)
    crowd.SetInputData(1, handles)
    crowd.SetInputData(2, instances)
    crowd.SetSmallestWeight(1e-6)
    crowd.SetMaximumIterations(1000)
    crowd.SetNumberOfThreads(1)
    tell(instances, names, dragged, size, 0)
    bound = bindpose.run(crowd)

    alone = bindpose.vtkReducedARAP()
    poser = vtkPolyData()
    poser.ShallowCopy(handles)
    transforms = np.tile(np.eye(3, 4), (len(names), 1, 1))
    for h, name in enumerate(names[:dragged]):
        transforms[h, :, 3] = instances.GetPointData().GetArray(name).GetTuple3(37)
    poser.GetCellData().AddArray(array_of("Transform", transforms.reshape(-1, 12)))
    poser.GetCellData().AddArray(array_of("Mode", [POSITION if h < dragged else FREE for h in range(len(names))]))
    alone.SetInputData(0, weighted)
    alone.SetInputData(1, poser)
    alone.SetMaximumIterations(1000)
    bindpose.run(alone)
    apart = points_of(crowd.GetOutput().GetPartition(37, 0)) - instances.GetPoint(37) - points_of(
        bindpose.vtkBindposeAlgorithm.GetOutput(alone))

    crowd.SetTolerance(1e-4)
    crowd.SetMaximumIterations(10)
    reports = []
    for frame in range(1, 6 if options.small else 21):
        tell(instances, names, dragged, size, frame)
        crowd.Update()  # an instance that does not converge within ten iterations continues in the next frame
        reports.append(bindpose.report(crowd))
    solve, skin = (1e3 * float(min(report["seconds"][part] for report in reports)) for part in ("solve", "skin"))
    assert crowd.GetNumberOfBinds() == 1
    draw(options, crowd.GetOutput(), [
        (f"A hundred elephants of {mesh.GetNumberOfCells():,} triangles, each in a different pose", 955),
        (f"on one thread {solve:.1f} ms to solve, {skin:.1f} ms to move all points", 920)])
    return {
        "triangles": mesh.GetNumberOfCells(),
        "handles": len(names),
        "clusters": bound["counts"]["clusters"],
        "seconds of the bind": bound["seconds"]["bind"],
        "milliseconds of all solves": solve,
        "milliseconds of moving all points": skin,
        "frames per second": 1e3 / (solve + skin),
        "iterations per instance": float(np.median([report["iterations"] for report in reports])) / SIDE ** 2,
        "largest difference from vtkReducedARAP in bounding-box diagonals": float(abs(apart).max() / size),
    }


if __name__ == "__main__":
    common.main(__file__, __doc__, make)
