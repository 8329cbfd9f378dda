"""Use every proxy of the plugin with its defaults on real data, for tests/paraview.sh: pvbatch proxies.py PLUGIN HELP FOLDER.

HELP is the plugin's compiled help, a .qch file. Each proxy must have a result without an error, an icon if it is in a
menu, a page of the help, and a documentation of itself and of its properties. A proxy that DATA does not contain fails
the test.
"""

import json
import math
import pathlib
import sqlite3
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import plugin  # noqa: E402
from paraview import servermanager, simple  # noqa: E402
from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow  # noqa: E402

FIGURE = pathlib.Path(__file__).resolve().parents[2] / "examples" / "tours" / "data"
# The menu category of each template. Sources have a category of their own.
CATEGORIES = {f"Bindpose {subject}" for subject in ("Inside", "Tets", "Weights", "Pose")} | {"Bindpose"}
FRAMES = 12


class Data:
    """Sources and files for the proxies, made when they are first used."""

    def __init__(self, folder):
        self.folder = folder
        self.made = {}

    def __getattr__(self, name):
        if name not in self.made:
            self.made[name] = getattr(self, "make_" + name)()
        return self.made[name]

    def make_figure(self):
        return simple.BindposeMeshReader(FileName=str(FIGURE / "figure.off"))

    def make_leaf(self):
        return simple.BindposeMeshReader(FileName=str(FIGURE / "leaf.off"))

    def make_handles(self):
        return simple.BindposeHandleReader(FileName=str(FIGURE / "figure.tgf"))

    def make_leaf_handles(self):
        return simple.BindposeHandleReader(FileName=str(FIGURE / "leaf.tgf"))

    def make_weights(self):
        return simple.BoundedBiharmonicWeights(Input=self.figure, Handles=self.handles)

    def make_posed_handles(self):
        return simple.PoseHandles(Input=self.handles, PoseJSON=json.dumps(
            {"version": 2, "handles": {"left_hand": {"translate": [0, 0.2, 0]}}}))

    def make_height(self):
        return simple.Calculator(Input=self.figure, ResultArrayName="Height", Function="coordsY")

    def make_curve(self):
        angles = [2 * math.pi * k / 40 for k in range(40)]
        points = [value for angle in angles for value in (math.cos(angle), math.sin(angle), 0.0)]
        return simple.PolyLineSource(Points=points, Closed=1)

    def make_square(self):
        """A triangle mesh in the plane z = 0 with an edge along the bone of `bar`."""
        return simple.Triangulate(Input=simple.Plane(XResolution=8, YResolution=8))

    def make_bar(self):
        path = self.folder / "bar.tgf"
        path.write_text("1 -0.25 0 0\n2 0.25 0 0\n#\n1 2 1 0 0\n")
        return simple.BindposeHandleReader(FileName=str(path))

    def make_instances(self):
        return simple.PointSource(NumberOfPoints=3, Radius=2.0)

    def make_volume(self):
        return simple.WindingNumberField(Input=self.figure, Resolution=12)

    def make_rig(self):
        path = self.folder / "rig.glb"
        simple.BindposeglTFSkinWriter(Input=self.weights, Handles=self.handles, FileName=str(path)).UpdatePipeline()
        return path

    def make_fixed(self):
        """A surface whose lower half is fixed."""
        return simple.Calculator(Input=self.figure, ResultArrayName="Fixed", Function="coordsY < 0")


# The properties of each proxy that a user must set: inputs, file names, placed handles. All other properties keep their
# defaults. "may_be_empty" lists output ports that have no data for these inputs, such as the boundary of a closed
# surface.
DATA = {
    "BindposeMeshReader": lambda data: {"FileName": str(FIGURE / "figure.off")},
    "BindposeHandleReader": lambda data: {"FileName": str(FIGURE / "figure.tgf")},
    "BindposeAssetReader": lambda data: {"FileName": str(data.rig)},
    "BindposeGLTFSkinReader": lambda data: {"FileName": str(data.rig)},
    "PlacedHandles": lambda data: {"HandlesText": "1 0 0 0 hip\n2 0 0.4 0\n3 0 0.8 0\n#\n2 3 1 0 0\n"},
    "WindingNumberField": lambda data: {"Input": data.figure, "may_be_empty": {1}},
    "SurfaceDefects": lambda data: {"Input": simple.AppendGeometry(Input=[data.figure, simple.Sphere(Radius=0.3)])},
    "PlanarShape": lambda data: {"Input": data.curve},
    "TetrahedralizeSurface": lambda data: {"Input": data.figure, "may_be_empty": {1, 2}},
    "AutomaticHandles": lambda data: {"Input": data.figure},
    "FarthestPointHandles": lambda data: {"Input": data.figure},
    "BoundedBiharmonicWeights": lambda data: {"Input": data.figure, "Handles": data.handles, "may_be_empty": {1}},
    "MonotoneWeights": lambda data: {"Input": data.figure, "Handles": data.handles, "may_be_empty": {1}},
    "UnconstrainedWeights": lambda data: {"Input": data.figure, "Handles": data.handles},
    "MonotoneSmoothing": lambda data: {"Input": data.height},
    "BoneEndpointWeights": lambda data: {"Input": data.weights, "Handles": data.handles},
    "TransferWeights": lambda data: {"Input": data.figure, "Mesh": data.weights},
    "ShareDataset": lambda data: {"Input": data.weights},
    "WeightedColors": lambda data: {"Input": data.weights, "Handles": data.handles},
    "DepthOrder": lambda data: {"Input": simple.BoundedBiharmonicWeights(Input=data.leaf, Handles=data.leaf_handles),
                                "Handles": data.leaf_handles},
    "CutAlongBones": lambda data: {"Input": data.square, "Handles": data.bar},
    "PoseHandles": lambda data: {"Input": data.handles},
    "SkinningDeformation": lambda data: {"Input": data.weights, "Handles": data.posed_handles},
    "MovingLeastSquaresWarp": lambda data: {"Input": data.figure, "Handles": data.posed_handles},
    "ReducedARAP": lambda data: {"Input": data.weights, "Handles": data.posed_handles},
    "ReducedDynamics": lambda data: {"Input": data.weights, "Handles": data.posed_handles},
    "CrowdDeformation": lambda data: {"Input": data.weights, "Handles": data.handles, "Instances": data.instances},
    "FullARAP": lambda data: {"Input": data.figure, "Handles": data.posed_handles},
    "VariationalSurface": lambda data: {"Input": data.fixed},
    "BindposeMeshWriter": lambda data: {"Input": data.figure, "FileName": "figure.off"},
    "BindposeVDBWriter": lambda data: {"Input": data.volume, "FileName": "figure.vdb"},
    "BindposeGLTFSkinWriter": lambda data: {"Input": data.weights, "Handles": data.handles, "FileName": "figure.glb"},
}


def check_text(group, name, proxy, smproxy, pages, icons):
    """Check the icon, the documentation and the page of the help."""
    menu = proxy.find("Hints/ShowInMenu")
    in_menu = menu is not None
    assert in_menu == (group == "filters" or name == "PlacedHandles"), f"{name} is {'' if in_menu else 'not '}in a menu"
    if in_menu:
        assert menu.get("category") in CATEGORIES, f"{name}: category {menu.get('category')}"
        assert menu.get("icon") in icons, f"{name} has no icon"
    documentation = smproxy.GetDocumentation()
    assert documentation.GetDescription() and documentation.GetShortHelp() and documentation.GetLongHelp(), name
    for key, prop in plugin.properties_of(smproxy).items():
        text = prop.GetDocumentation()
        assert text and text.GetDescription(), f"{name}.{key} has no documentation"
        assert prop.GetXMLLabel().replace(" ", "") == key, f"{name}.{key} is {prop.GetXMLLabel()} in Python"
    page = f"{group}.{name}.html"
    assert page in pages, f"the help has no page {page}"


def use(group, name, data):
    """Create a proxy with its defaults and check its result."""
    words = DATA[name](data)
    label = servermanager.ProxyManager().GetPrototypeProxy(group, name).GetXMLLabel()
    make = getattr(simple, label.replace(" ", ""))
    may_be_empty = words.pop("may_be_empty", set())
    for source in words.values():
        if hasattr(source, "UpdatePipeline"):
            source.UpdatePipeline()  # as in the window; the default arrays are chosen from the updated input
    if group == "writers":
        path = data.folder / words.pop("FileName")
        path.unlink(missing_ok=True)
        make(**words, FileName=str(path)).UpdatePipeline()
        assert path.stat().st_size > 100, f"{name} wrote {path.stat().st_size} bytes"
        return
    proxy = make(**words)
    proxy.UpdatePipeline()
    for port in range(proxy.SMProxy.GetNumberOfOutputPorts()):
        result = proxy.GetClientSideObject().GetOutputDataObject(port)  # Fetch() cannot copy the collection of a crowd
        arrays = result.GetFieldData()
        status = arrays.GetAbstractArray("Report.status") if arrays else None
        message = arrays.GetAbstractArray("Report.message") if arrays else None
        assert not status or status.GetValue(0) == "ok", f"{name}: {message.GetValue(0) if message else status.GetValue(0)}"
        empty = not result.IsA("vtkCompositeDataSet") and result.GetNumberOfCells() + result.GetNumberOfPoints() == 0
        assert not empty or port in may_be_empty, f"{name}: output {port} is empty"


def refinement(triangles, wanted):
    """Return how often each triangle must be divided into four for the wanted number of triangles."""
    count = 0
    while triangles * 4 ** (count + 1) <= 1.5 * wanted:
        count += 1
    return count


def time_drags(data):
    """Drag a handle of a mesh with 99,456 triangles. Return the median time per motion in milliseconds, and the
    number of triangles.

    A motion sets the pose and updates the pipeline, as the panel of Pose Handles does before it draws.
    """
    figure = data.figure
    figure.UpdatePipeline()
    count = figure.GetDataInformation().GetNumberOfCells()
    subdivided = simple.LoopSubdivision(Input=figure, NumberofSubdivisions=refinement(count, 86_000))
    fine = simple.TransferWeights(Input=subdivided, Mesh=data.weights)
    pose = simple.PoseHandles(Input=data.handles)
    bent = simple.ReducedARAP(Input=fine, Handles=pose)
    bent.UpdatePipeline()
    times = []
    for frame in range(FRAMES):
        start = time.perf_counter()
        pose.PoseJSON = json.dumps({"version": 2, "handles": {"left_hand": {"translate": [0, 0.02 * frame, 0]}}})
        bent.UpdatePipeline()
        times.append(1000 * (time.perf_counter() - start))
    return sorted(times)[len(times) // 2], bent.GetDataInformation().GetNumberOfCells()


def use_all(data, errors, pages, icons):
    """Use every proxy of the plugin. Return their number."""
    used = 0
    for group, name, element in plugin.proxies():
        assert name in DATA, f"{name} is a new proxy: tell in DATA of tests/paraview/proxies.py how it is used"
        before = len(errors.GetOutput())
        check_text(group, name, element, servermanager.ProxyManager().NewProxy(group, name), pages, icons)
        use(group, name, data)
        text = errors.GetOutput()[before:]
        assert "ERROR" not in text, f"{name}: {text}"
        used += 1
    unknown = set(DATA) - {name for _, name, _ in plugin.proxies()}
    assert not unknown, f"{unknown} are no proxies"
    return used


def main():
    library, help_file, folder = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
    folder.mkdir(parents=True, exist_ok=True)
    simple.LoadPlugin(library, remote=False, ns=vars(simple))
    with sqlite3.connect(f"file:{help_file}?mode=ro", uri=True) as database:
        pages = {row[0] for row in database.execute("SELECT Name FROM FileNameTable")}
    pages = {pathlib.PurePosixPath(page).name for page in pages}
    icons = plugin.icons()
    data = Data(folder)
    errors = vtkStringOutputWindow()
    vtkOutputWindow.SetInstance(errors)
    try:
        used = use_all(data, errors, pages, icons)
    finally:
        vtkOutputWindow.SetInstance(None)  # pvbatch writes exceptions to this window
    milliseconds, cells = time_drags(data)
    assert milliseconds <= plugin.DRAG_LIMIT, f"a motion of a drag takes {milliseconds:.1f} ms"
    (folder / "proxies.json").write_text(json.dumps({"used": used, "milliseconds": milliseconds, "cells": cells}))
    print(f"{used} proxies used with their defaults: icon, help, documentation, result without errors")
    print(f"a motion of a drag on {cells} triangles takes {milliseconds:.1f} ms before drawing")


if __name__ == "__main__":
    main()
