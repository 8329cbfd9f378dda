"""Inside or outside of an unclean scan: a figure whose head is open, and a sphere that crosses its shoulder.

Shown are the defects of the scan, its winding number on a slice, and the surface where the winding number is 0.5, which
closes the hole and unites both parts. The plugin must be loaded before: see filters/paraview/README.md.
"""

import pathlib

from paraview.simple import *  # noqa: F403  LoadDistributedPlugin adds the plugin's functions

LoadDistributedPlugin("Bindpose", remote=False, ns=globals())
DATA = pathlib.Path(__file__).resolve().parents[1] / "tours" / "data"

view = GetActiveViewOrCreate("RenderView")

# The scan
figure = BindposeMeshReader(registrationName="Figure", FileName=str(DATA / "figure.off"))
open_figure = Clip(registrationName="Open Figure", Input=figure, ClipType="Plane")
open_figure.ClipType.Origin = [0.0, 0.9, 0.0]
open_figure.ClipType.Normal = [0.0, 1.0, 0.0]
sphere = Sphere(registrationName="Sphere", Center=[0.3, 0.4, 0.0], Radius=0.2, ThetaResolution=24, PhiResolution=24)
scan = AppendDatasets(registrationName="Scan", Input=[open_figure, sphere])

# Inside or outside
defects = SurfaceDefects(registrationName="Defects", Input=scan)
field = WindingNumberField(registrationName="Winding Numbers", Input=scan, Resolution=64)
inside = Contour(registrationName="Boundary of the Inside", Input=field, ContourBy=["POINTS", "WindingNumber"], Isosurfaces=[0.5])
middle = Slice(registrationName="Middle", Input=field, SliceType="Plane")
middle.SliceType.Origin = [0.0, 0.0, 0.0]
middle.SliceType.Normal = [0.0, 0.0, 1.0]

defects_display = Show(defects, view)
ColorBy(defects_display, ("CELLS", "Defect"))
defects_display.LineWidth = 3.0
ColorBy(Show(middle, view), ("POINTS", "WindingNumber"))
inside_display = Show(inside, view)
inside_display.ColorArrayName = [None, ""]
inside_display.Opacity = 0.3

SetActiveSource(field)
ResetCamera(view)
Render(view)
