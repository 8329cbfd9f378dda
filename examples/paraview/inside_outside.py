"""Inside or outside of an unclean scan: a figure whose head is open, and a sphere that crosses its shoulder.

On the left are the defects of the scan, and its winding number on a slice. On the right are the tets of the inside, cut
open: they close the hole and unite both parts. The plugin must be loaded before: see filters/paraview/README.md.
"""

import pathlib

from paraview.simple import *  # noqa: F403  LoadDistributedPlugin adds the plugin's functions

if "PoseHandles" not in globals():
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

# Winding numbers: inside or outside
defects = SurfaceDefects(registrationName="Defects", Input=scan)
field = WindingNumberField(registrationName="Winding Numbers", Input=scan, Resolution=128)
middle = Slice(registrationName="Middle", Input=field, SliceType="Plane")
middle.SliceType.Origin = [0.0, 0.0, 0.0]
middle.SliceType.Normal = [0.0, 0.0, 1.0]

# Tets of the interior
tets = TetrahedralizeSurface(registrationName="Tets", Input=scan)
back_half = Clip(registrationName="Back Half", Input=tets, ClipType="Plane", Crinkleclip=1)
back_half.ClipType.Origin = [0.0, 0.0, 0.0]
back_half.ClipType.Normal = [0.0, 0.0, 1.0]
beside = Transform(registrationName="Beside", Input=back_half)
beside.Transform.Translate = [1.7, 0.0, 0.0]

defects_display = Show(defects, view)
ColorBy(defects_display, ("CELLS", "Defect"))
defects_display.LineWidth = 4.0
ColorBy(Show(middle, view), ("POINTS", "WindingNumber"))
tets_display = Show(beside, view)
tets_display.ColorArrayName = [None, ""]
tets_display.SetRepresentationType("Surface With Edges")

SetActiveSource(field)
ResetCamera(view)
Render(view)
