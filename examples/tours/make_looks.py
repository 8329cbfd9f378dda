#!/usr/bin/env python3
"""Create the pictures of viewer/window.md that compare VTK's default look with the window's light and dark looks: the
same mesh from the same camera.

usage: make_looks.py PROGRAM    (the program bindpose; needs VTK's Python and a display, for instance xvfb-run)
"""

import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow, vtkWindowToImageFilter
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  draws

TOURS = pathlib.Path(__file__).resolve().parent
ROOT = TOURS.parent.parent
sys.path.insert(0, str(TOURS.parent))
import quickstart  # noqa: E402  the demo mesh

PICTURES = ROOT / "viewer" / "pictures"
SIZE = [540, 460]


def read_off(path):
    numbers = iter(path.read_text().split()[1:])
    points, triangles = vtkPoints(), vtkCellArray()
    point_count, cell_count, _ = (int(next(numbers)) for _ in range(3))
    for _ in range(point_count):
        points.InsertNextPoint(*[float(next(numbers)) for _ in range(3)])
    for _ in range(cell_count):
        corners = [int(next(numbers)) for _ in range(int(next(numbers)))]
        triangles.InsertNextCell(len(corners), corners)
    surface = vtkPolyData()
    surface.SetPoints(points)
    surface.SetPolys(triangles)
    return surface


def default_look(surface, camera, path):
    """Render with VTK's default settings."""
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(surface)
    actor = vtkActor()
    actor.SetMapper(mapper)
    renderer = vtkRenderer()
    renderer.AddActor(actor)
    window = vtkRenderWindow()
    window.OffScreenRenderingOn()
    window.SetSize(*SIZE)
    window.AddRenderer(renderer)
    renderer.GetActiveCamera().SetPosition(*camera["camera.position"])
    renderer.GetActiveCamera().SetFocalPoint(*camera["camera.focus"])
    renderer.ResetCameraClippingRange()
    grab = vtkWindowToImageFilter()
    grab.SetInput(window)
    writer = vtkPNGWriter()
    writer.SetInputConnection(grab.GetOutputPort())
    writer.SetFileName(str(path))
    writer.Write()


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    program = pathlib.Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)
        mesh = quickstart.demo_mesh(scratch / "meshes")
        for look in ("light", "dark"):
            tour = {"tour": {"schema": 1, "name": "look", "view": SIZE, "seconds": 60},
                    "steps": [{"action": f"view.appearance.{look}"}, {"open": str(mesh)}, {"wait": "idle"},
                              {"action": "view.whole_shape"}, {"screenshot": f"look_{look}", "of": "view"}]}
            (scratch / "look.json").write_text(json.dumps(tour))
            subprocess.run([program, "view", "--play", scratch / "look.json", "--screenshot-dir", scratch / look],
                           check=True)
            shutil.copy(scratch / look / f"look_{look}.png", PICTURES)
        record = json.loads((scratch / "light" / "tour.json").read_text())
        default_look(read_off(mesh), record["screenshots"]["look_light"]["values"], PICTURES / "look_vtk.png")


if __name__ == "__main__":
    main()
