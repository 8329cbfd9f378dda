"""A posed rig: a figure with five points and a bone, in a pose that the mouse can change.

Pose Handles is the active source. Its panel shows the handles in the view; drag one of them. The weights are computed
once. The plugin must be loaded before: see filters/paraview/README.md.
"""

import json
import pathlib

from paraview.simple import *  # noqa: F403  LoadDistributedPlugin adds the plugin's functions

if "PoseHandles" not in globals():
    LoadDistributedPlugin("Bindpose", remote=False, ns=globals())
DATA = pathlib.Path(__file__).resolve().parents[1] / "tours" / "data"
POSE = {
    "version": 2,
    "handles": {
        "head": {"rotate": {"axis": [0, 0, 1], "degrees": 20}},
        "left_hand": {"translate": [-0.1, 0.4, 0.0]},
        "right_hand": {"translate": [0.15, -0.3, 0.1]},
        "left_foot": {"translate": [0.1, 0.1, 0.0]},
    },
}

view = GetActiveViewOrCreate("RenderView")

figure = BindposeMeshReader(registrationName="Figure", FileName=str(DATA / "figure.off"))
handles = BindposeHandleReader(registrationName="Handles", FileName=str(DATA / "figure.tgf"))
weights = BoundedBiharmonicWeights(registrationName="Weights", Input=figure, Handles=handles)
pose = PoseHandles(registrationName="Pose", Input=handles, PoseJSON=json.dumps(POSE))
posed = ReducedARAP(registrationName="Posed Figure", Input=weights, Handles=pose)

posed_display = Show(posed, view)
posed_display.ColorArrayName = [None, ""]
figure_display = Show(figure, view)
figure_display.ColorArrayName = [None, ""]
figure_display.Opacity = 0.2

SetActiveSource(pose)
ResetCamera(view)
Render(view)
