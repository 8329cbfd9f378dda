"""Weights of handles in a volume: how much every point of a figure follows its left hand.

The figure is cut in the middle, because the weights are those of tets and can be seen inside. To see another handle,
choose it in the component menu. The plugin must be loaded before: see filters/paraview/README.md.
"""

import pathlib

from paraview.simple import *  # noqa: F403  LoadDistributedPlugin adds the plugin's functions

if "PoseHandles" not in globals():
    LoadDistributedPlugin("Bindpose", remote=False, ns=globals())
DATA = pathlib.Path(__file__).resolve().parents[1] / "tours" / "data"

view = GetActiveViewOrCreate("RenderView")

figure = BindposeMeshReader(registrationName="Figure", FileName=str(DATA / "figure.off"))
handles = BindposeHandleReader(registrationName="Handles", FileName=str(DATA / "figure.tgf"))
tets = TetrahedralizeSurface(registrationName="Tets", Input=figure)
weights = BoundedBiharmonicWeights(registrationName="Weights", Input=tets, Handles=handles)
half = Clip(registrationName="Half", Input=weights, ClipType="Plane")
half.ClipType.Origin = [0.0, 0.0, 0.0]
half.ClipType.Normal = [0.0, 0.0, 1.0]

ColorBy(Show(half, view), ("POINTS", "Weights", "left_hand"))
handles_display = Show(handles, view)
handles_display.ColorArrayName = [None, ""]
handles_display.PointSize = 12.0
handles_display.RenderPointsAsSpheres = 1
handles_display.LineWidth = 4.0

SetActiveSource(weights)
ResetCamera(view)
Render(view)
