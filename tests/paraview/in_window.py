"""Runs inside of ParaView's window for tests/paraview/window.py: paraview --script=in_window.py.

The script loads the plugin, builds a pipeline or loads a state, and then answers requests: window.py writes Python
expressions to a file, and a timer of the view evaluates them here. The mouse and the keys come from window.py.

Environment: BINDPOSE_PLUGIN, BINDPOSE_FOLDER (for requests and answers), BINDPOSE_STATE (a state to load; empty: build the
pipeline), BINDPOSE_SUBDIVISIONS (of the surface, 0 to 3).
"""

import json
import os
import pathlib
import traceback

import numpy as np
from paraview import simple, smtrace
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonSystem import vtkTimerLog

FOLDER = pathlib.Path(os.environ["BINDPOSE_FOLDER"])
DATA = pathlib.Path(os.environ["BINDPOSE_DATA"])
DRAG_EVENT = "Bindpose: apply a drag"
answered = 0


def source(name):
    """Return a registered source by its name in the pipeline browser."""
    found = simple.FindSource(name)
    assert found, f"no source {name} among {[key[0] for key in simple.GetSources()]}"
    return found


def output(name):
    """Return the updated output of a source. Fetch() of ParaView 5.11 is not used: after it, the window takes no keys."""
    proxy = source(name)
    proxy.UpdatePipeline()
    return proxy.GetClientSideObject().GetOutputDataObject(0)


def names():
    return sorted(key[0] for key in simple.GetSources())


def build():
    """Build a pipeline from the figure to its posed surface, with Pose Handles as the active source."""
    view = simple.GetActiveViewOrCreate("RenderView")
    figure = simple.BindposeMeshReader(registrationName="figure", FileName=str(DATA / "figure.off"))
    handles = simple.BindposeHandleReader(registrationName="handles", FileName=str(DATA / "figure.tgf"))
    weights = simple.BoundedBiharmonicWeights(registrationName="weights", Input=figure, Handles=handles)
    subdivisions = int(os.environ["BINDPOSE_SUBDIVISIONS"])
    if subdivisions:
        fine = simple.LoopSubdivision(registrationName="fine", Input=figure, NumberofSubdivisions=subdivisions)
        weights = simple.TransferWeights(registrationName="fine weights", Input=fine, Mesh=weights)
    pose = simple.PoseHandles(registrationName="pose", Input=handles)
    # Without a warm start, the bent surface depends on the pose only, and not on the motions of the drag.
    bent = simple.ReducedARAP(registrationName="bent", Input=weights, Handles=pose, WarmStart=0)
    simple.Show(bent, view)
    simple.ResetCamera(view)
    simple.SetActiveSource(pose)
    simple.Render(view)


def start():
    simple.LoadPlugin(os.environ["BINDPOSE_PLUGIN"], remote=False, ns=vars(simple))
    vtkTimerLog.SetMaxEntries(100_000)
    state = os.environ["BINDPOSE_STATE"]
    if state == "none":
        simple.GetActiveViewOrCreate("RenderView")
    elif state:
        simple.LoadState(state)
        simple.SetActiveSource(source("pose"))
        simple.Render()
    else:
        build()
    interactor = view_interactor()
    interactor.AddObserver("TimerEvent", answer)
    interactor.CreateRepeatingTimer(50)


def view_interactor():
    return simple.GetActiveViewOrCreate("RenderView").GetInteractor()


def answer(*_):
    """Answer a new request."""
    global answered
    try:
        request = json.loads((FOLDER / "request.json").read_text())
    except (FileNotFoundError, ValueError):
        return
    if request["id"] <= answered:
        return
    answered = request["id"]
    try:
        result = {"id": answered, "value": eval(request["code"], globals())}
    except Exception:  # the error belongs to the request, and window.py raises it
        result = {"id": answered, "error": traceback.format_exc()}
    path = FOLDER / "answer.new"
    path.write_text(json.dumps(result))
    path.replace(FOLDER / "answer.json")


# ---- Requests --------------------------------------------------------------------------------------


def pixel(position):
    """Return the pixel of a world position in the view, from the lower left corner."""
    renderer = simple.GetActiveView().GetRenderer()
    renderer.SetWorldPoint(*position, 1.0)
    renderer.WorldToDisplay()
    return renderer.GetDisplayPoint()[:2]


def mouse():
    """Return the pixel of the last mouse event, and the size of the view."""
    interactor = view_interactor()
    return [*interactor.GetEventPosition(), *interactor.GetSize()]


def handle_position(name):
    """Return the posed position of a handle, from the output of Pose Handles."""
    data = output("pose")
    cell_names = data.GetCellData().GetAbstractArray("HandleName")
    cell = next(k for k in range(data.GetNumberOfCells()) if cell_names.GetValue(k) == name)
    rest = data.GetPoint(data.GetCell(cell).GetPointId(0))
    transform = np.array(data.GetCellData().GetArray("Transform").GetTuple(cell)).reshape(3, 4)
    return (transform @ [*rest, 1.0]).tolist()


def pose_text():
    return str(source("pose").SMProxy.GetProperty("PoseJSON").GetElement(0))


def placed_text():
    return str(source("placed").SMProxy.GetProperty("HandlesText").GetElement(0))


def save_points(path):
    np.save(path, vtk_to_numpy(output("bent").GetPoints().GetData()))
    return True


def save_state(path):
    simple.SaveState(path)
    return True


def start_trace():
    smtrace.start_trace()
    return True


def stop_trace():
    return smtrace.stop_trace()


def binds():
    """Return how often the bent surface was bound."""
    return int(output("bent").GetFieldData().GetArray("Report.binds").GetTuple1(0))


def drag_milliseconds():
    """Return the time before drawing of each motion of all drags."""
    begun, times = None, []
    for event in range(vtkTimerLog.GetNumberOfEvents()):
        if vtkTimerLog.GetEventString(event) == DRAG_EVENT:
            if begun is None:
                begun = vtkTimerLog.GetEventWallTime(event)
            else:
                times.append(1000 * (vtkTimerLog.GetEventWallTime(event) - begun))
                begun = None
    return times


def delete(name):
    simple.Delete(source(name))
    return names()


def add_placed():
    """Add Placed Handles in front of the figure, and show the figure."""
    placed = simple.PlacedHandles(registrationName="placed")
    simple.Show(source("figure"))
    if "bent" in names():
        simple.Hide(source("bent"))
    simple.SetActiveSource(placed)
    simple.Render()
    return True


def show_figure():
    """Make the figure the only source, shown and active."""
    figure = simple.BindposeMeshReader(registrationName="figure", FileName=str(DATA / "figure.off"))
    simple.Show(figure)
    simple.ResetCamera()
    simple.SetActiveSource(figure)
    simple.Render()
    return names()


def picture(path):
    """Save a picture of the view, as the last request of a window: after SaveScreenshot(), the window takes no keys."""
    simple.SaveScreenshot(path, simple.GetActiveView())
    return True


start()
