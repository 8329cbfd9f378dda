"""Test the ParaView plugin inside of ParaView, for tests/paraview.sh: pvbatch in_paraview.py PLUGIN MESH FOLDER, on any
number of MPI ranks.

Each rank computes its part of winding number fields and writes it to FOLDER. Then all other proxies of the plugin are
used. Filters that work by pieces also get points of which each rank has only its own piece (pieces.py). Facts about one
run are asserted here, and facts about several runs in check.py. FOLDER/run.json is written last, so it exists only if all
assertions hold.
"""

import json
import pathlib
import sys

import numpy as np
from paraview import servermanager
from paraview.simple import *  # noqa: F403  LoadPlugin adds the plugin's functions
from vtkmodules.util.numpy_support import vtk_to_numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import pieces  # noqa: E402

FILTERS = (
    "WindingNumberField PlanarShape TetrahedralizeSurface AutomaticHandles FarthestPointHandles BoundedBiharmonicWeights MonotoneWeights "
    "MonotoneSmoothing UnconstrainedWeights TransferWeights BoneEndpointWeights PoseHandles WeightedColors DepthOrder CutAlongBones SkinningDeformation "
    "MovingLeastSquaresWarp ReducedARAP ReducedDynamics FullARAP VariationalSurface"
).split()
SOURCES = "BindposeMeshReader BindposeHandleReader".split()
WRITERS = "BindposeMeshWriter BindposeVDBWriter".split()

# This script runs on every rank. It writes the piece that was requested, the data that arrived, and the number of
# samples that the filter reports as computed.
WRITE_PARTS = """
import json
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline
from vtkmodules.vtkParallelCore import vtkMultiProcessController
rank = vtkMultiProcessController.GetGlobalController().GetLocalProcessId()
image = self.GetInputDataObject(0, 0)
information = self.GetInputInformation(0, 0)
values = vtk_to_numpy(image.GetPointData().GetArray("WindingNumber"))
np.save(f"{folder}/{name}.{rank}.npy", values)
with open(f"{folder}/{name}.{rank}.json", "w") as file:
    json.dump({
        "piece": information.Get(Pipeline.UPDATE_PIECE_NUMBER()),
        "pieces": information.Get(Pipeline.UPDATE_NUMBER_OF_PIECES()),
        "whole": information.Get(Pipeline.WHOLE_EXTENT()),
        "extent": image.GetExtent(),
        "origin": image.GetOrigin(),
        "spacing": image.GetSpacing(),
        "computed": image.GetFieldData().GetArray("Report.counts.queries").GetTuple1(0),
        "method": image.GetFieldData().GetAbstractArray("Report.method").GetValue(0),
    }, file)
"""


def fetch(proxy, port=0):
    """Update a proxy and return one of its outputs, gathered from all ranks."""
    proxy.UpdatePipeline()
    return servermanager.Fetch(proxy, idx=port)


def points_of(data):
    return vtk_to_numpy(data.GetPoints().GetData()).astype(float)


def write_parts(name, field, folder):
    writer = ProgrammableFilter(Input=field, OutputDataSetType="vtkPolyData", CopyArrays=0)
    writer.Script = f"folder = {str(folder)!r}\nname = {name!r}\n{WRITE_PARTS}"
    writer.UpdatePipeline()


def spheres():
    """Return an open sphere and a closed one that crosses it. Both are updated first, as ParaView's window does."""
    open_sphere = Sphere(ThetaResolution=24, PhiResolution=16, EndTheta=300.0)
    other = Sphere(ThetaResolution=17, PhiResolution=13, Center=[0.4, 0.1, -0.05])
    for sphere in (open_sphere, other):
        sphere.UpdatePipeline()
    return AppendGeometry(Input=[open_sphere, other])


def fields(mesh, folder):
    both = spheres()
    both.UpdatePipeline()  # each rank now has only its piece of the data
    field = WindingNumberField(Input=both, Resolution=40)
    write_parts("spheres", field, folder)
    surface = fetch(field, 1)
    # The open sphere lacks the slice between two meridians. Its open edges are all edges of these two meridians.
    assert surface.GetNumberOfCells() == 16 - 1 + 16 - 1, surface.GetNumberOfCells()
    values = vtk_to_numpy(fetch(Contour(Input=field, ContourBy=["POINTS", "WindingNumber"], Isosurfaces=[0.5]))
                          .GetPointData().GetArray("WindingNumber"))
    assert len(values) > 1000 and np.all(np.abs(values - 0.5) < 1e-6), values

    reader = BindposeMeshReader(FileName=str(mesh))
    reader.UpdatePipeline()
    write_parts("mesh", WindingNumberField(Input=reader, Resolution=48), folder)
    write_parts("exact", WindingNumberField(Input=reader, Resolution=24, Method="Exact"), folder)

    # Evaluate winding numbers at the points of another dataset. Each rank has a part of the points.
    wavelet = Wavelet(WholeExtent=[-6, 6, -6, 6, -6, 6])
    inside = WindingNumberField(Input=Sphere(Radius=5.0, ThetaResolution=60, PhiResolution=60), Points=wavelet,
                                ComputeInside=1, ComputeGradient=1)
    write_parts("points", inside, folder)
    image = fetch(inside)  # Fetch returns only the first part of a distributed image
    radii = np.array([np.linalg.norm(image.GetPoint(i)) for i in range(image.GetNumberOfPoints())])
    flags = vtk_to_numpy(image.GetPointData().GetArray("Inside"))
    clear = np.abs(radii - 5.0) > 0.1
    assert np.array_equal(flags[clear] == 1, radii[clear] < 5.0)
    assert image.GetPointData().GetArray("WindingNumberGradient").GetNumberOfComponents() == 3
    assert image.GetPointData().GetArray("RTData")
    # Without query points, the filter samples a grid again.
    inside.Points = None
    inside.Resolution = 10
    inside.UpdatePipeline()
    assert max(inside.GetDataInformation().DataInformation.GetExtent()) == 9


def deformation():
    """Run the pipeline from a surface to a posed surface. Several ranks compute the same result as one rank."""
    numbers = {}
    surface = Sphere(ThetaResolution=20, PhiResolution=14, EndTheta=320.0)
    surface.UpdatePipeline()
    tets = TetrahedralizeSurface(Input=surface)
    data = fetch(tets)
    numbers["tets"] = data.GetNumberOfCells()
    numbers["method"] = data.GetFieldData().GetAbstractArray("Report.method").GetValue(0)
    assert numbers["method"] == "cdt", "the helper was not found"
    assert numbers["tets"] > 100
    assert {data.GetCellType(i) for i in range(numbers["tets"])} == {10}
    numbers["volume"] = data.GetFieldData().GetArray("Report.volume").GetTuple1(0)
    # A full ball has the volume 0.524. The open sphere lacks a slice of 40 degrees, and the rest has the volume 0.465.
    assert 0.3 < numbers["volume"] < 0.53, numbers["volume"]
    assert fetch(TetrahedralizeSurface(Input=surface, Method="Remeshed", Resolution=10)).GetNumberOfCells() > 100

    handles = FarthestPointHandles(Input=tets, NumberOfHandles=5)
    assert fetch(handles).GetNumberOfCells() == 5
    assert fetch(AutomaticHandles(Input=tets, Method="Points", NumberOfPoints=6)).GetNumberOfCells() == 6
    smooth = {}
    for name in ("BoundedBiharmonicWeights", "MonotoneWeights", "UnconstrainedWeights"):
        smooth[name] = globals()[name](Input=tets, Handles=handles)
        weights = vtk_to_numpy(fetch(smooth[name]).GetPointData().GetArray("Weights"))
        assert weights.shape[1] == 5
        assert np.abs(weights.sum(axis=1) - 1).max() < 1e-9, name
        if name != "UnconstrainedWeights":
            assert weights.min() >= 0 and weights.max() <= 1, name
        numbers[name] = len(weights)
    bound = smooth["BoundedBiharmonicWeights"]
    height = Calculator(Input=tets, ResultArrayName="Height", Function="coordsX + 0.3 * sin(20 * coordsY)")
    smoothing = MonotoneSmoothing(Input=height, Scalars=["POINTS", "Height"], NumberOfExtrema=2)
    assert fetch(smoothing).GetPointData().GetArray("Smoothed").GetNumberOfTuples() == len(weights)
    assert fetch(smoothing, 1).GetNumberOfPoints() == 2

    rest = points_of(fetch(bound))
    skin = TransferWeights(Input=surface, Mesh=bound)
    sphere = points_of(fetch(skin))
    assert np.array_equal(np.unique(sphere, axis=0), np.unique(points_of(fetch(surface)), axis=0))
    inpainted = fetch(TransferWeights(Input=surface, Mesh=bound, Method="Match and inpaint")).GetPointData()
    matched = vtk_to_numpy(inpainted.GetArray("Matched")) == 1
    nearest, filled = (vtk_to_numpy(data.GetArray("Weights")) for data in (fetch(skin).GetPointData(), inpainted))
    assert matched.mean() > 0.5 and np.abs(filled - nearest)[matched].max() < 1e-12
    assert np.abs(filled.sum(axis=1) - 1).max() < 1e-9 and filled.min() >= 0
    posed_handles = PoseHandles(Input=handles)
    posed = {name: globals()[name](Input=bound, Handles=posed_handles)
             for name in ("SkinningDeformation", "ReducedARAP", "FullARAP", "MovingLeastSquaresWarp")}
    skinned = SkinningDeformation(Input=skin, Handles=posed_handles, Method="Dual quaternions")
    for name, proxy in posed.items():
        assert np.abs(points_of(fetch(proxy)) - rest).max() < 1e-12, f"{name}: the rest pose moves"
    shift = np.array([0.25, -1.0, 2.0])
    for mode in ("full", "position"):
        posed_handles.PoseJSON = json.dumps(
            {"handles": {f"p{i}": {"mode": mode, "translate": list(shift)} for i in range(1, 6)}})
        for name, proxy in posed.items():
            assert np.abs(points_of(fetch(proxy)) - rest - shift).max() < 1e-9, f"{name}: no translation ({mode})"
        assert np.abs(points_of(fetch(skinned)) - sphere - shift).max() < 1e-6
    posed_handles.PoseJSON = '{"handles": {"p1": {"translate": [0.1, 0, 0]}}}'
    colors = fetch(WeightedColors(Input=bound, Handles=handles)).GetPointData()
    assert vtk_to_numpy(colors.GetArray("Color")).shape == (len(rest), 3) and colors.GetArray("OutOfGamut").GetRange() == (0, 0)
    assert fetch(DepthOrder(Input=bound, Handles=handles)).GetPointData().GetArray("Depth").GetRange() == (0, 0)
    moved = np.linalg.norm(points_of(fetch(posed["SkinningDeformation"])) - rest, axis=1)
    # The vertex at the handle has the largest displacement. A distant vertex has the smallest
    # displacement.
    assert abs(moved.max() - 0.1) < 1e-12 and moved.min() < 0.05
    return numbers, bound, posed_handles


def distributed_data(mesh, folder):
    """Run the filters that work by pieces on points of which each rank has its own piece. Save the results, which check.py
    joins."""
    tets = Tetrahedralize(Input=Wavelet(WholeExtent=[0, 6, 0, 6, 0, 6]))
    handles = FarthestPointHandles(Input=tets, NumberOfHandles=5)
    # The first rank computes handles and weights, and all ranks get a copy. Each rank applies the pose to its copy.
    weights = ShareDataset(Input=BoundedBiharmonicWeights(Input=tets, Handles=handles))
    posed = PoseHandles(Input=ShareDataset(Input=handles), PoseJSON=json.dumps(
        {"handles": {"p1": {"rotate": {"axis": [0, 0, 1], "degrees": 50}}, "p2": {"translate": [0.3, -0.2, 0.1]}}}))
    targets = {
        "cloud": pieces.source(pieces.cloud, count=20000, low=[-0.2, -0.2, -0.2], high=[6.2, 6.2, 6.2], snap=True),
        "tube": pieces.source(pieces.tube, rings=31, sides=40),
        "point": pieces.source(pieces.cloud, count=1, low=[0, 0, 0], high=[6, 6, 6]),  # the piece of one rank is empty
    }
    for name, target in targets.items():
        target.UpdatePipeline()
        transferred = TransferWeights(Input=target, Mesh=weights)
        pieces.save_parts(transferred, folder, f"{name}-weights")
        for short, method in (("lbs", "Linear blend"), ("dqs", "Dual quaternions")):
            skinned = SkinningDeformation(Input=transferred, Handles=posed, Method=method)
            pieces.save_parts(skinned, folder, f"{name}-{short}")
    crowd = CrowdDeformation(Input=weights, Handles=posed, Instances=pieces.source(pieces.instances, count=7))
    pieces.save_parts(crowd, folder, "crowd")

    # The method Fast adapts its structure to the number of query points, which are distributed over the ranks. One and
    # two ranks therefore give slightly different values, within the tolerance.
    reader = BindposeMeshReader(FileName=str(mesh))
    bounds = fetch(reader).GetBounds()
    queries = pieces.source(pieces.cloud, count=40000, low=bounds[0::2], high=bounds[1::2])
    pieces.save_parts(WindingNumberField(Input=reader, Points=queries, Method="Exact"), folder, "queries-winding")
    pieces.save_parts(WindingNumberField(Input=reader, Points=queries, Method="Fast"), folder, "queries-fast")


def files(folder, bound):
    """Check readers and writers on one process: the data that is read equals the data that was written."""
    data = fetch(bound)
    SaveData(str(folder / "bound.mesh"), proxy=bound)
    back = fetch(BindposeMeshReader(FileName=str(folder / "bound.mesh")))
    assert np.array_equal(points_of(back), points_of(data))
    assert back.GetNumberOfCells() == data.GetNumberOfCells()
    assert isinstance(OpenDataFile(str(folder / "bound.mesh")), type(BindposeMeshReader()))
    SaveData(str(folder / "weights.dmat"), proxy=bound, ArrayName="Weights")
    rows = len(points_of(data))
    assert (folder / "weights.dmat").read_text().split()[:2] == ["5", str(rows)]
    field = WindingNumberField(Input=Sphere(), Resolution=16)
    SaveData(str(folder / "field.vdb"), proxy=field, Band="Narrow")
    assert (folder / "field.vdb").read_bytes()[:4] == b" BDV"
    (folder / "handles.tgf").write_text("1 0 0 0\n2 1 0 0\n3 0 2 0 tip\n#\n1 2 1\n")
    handles = fetch(OpenDataFile(str(folder / "handles.tgf")))
    names = handles.GetCellData().GetAbstractArray("HandleName")
    assert [names.GetValue(i) for i in range(2)] == ["tip", "b1"]
    (folder / "pose.json").write_text('{"frames": [{"handles": {}}, {"handles": {"tip": {"translate": [0, 0, 3]}}}]}')
    posed = PoseHandles(Input=BindposeHandleReader(FileName=str(folder / "handles.tgf")),
                        FileName=str(folder / "pose.json"), Frame=1)
    assert fetch(posed).GetCellData().GetArray("Transform").GetTuple(0)[11] == 3


def bad_input(folder, bound, posed_handles):
    """Check that each bad input gives one sentence in the log and an empty output. Return the sentences, which check.py
    looks up in the log."""
    (folder / "broken.off").write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n")
    (folder / "plain.vtp").unlink(missing_ok=True)
    lines = Line()
    cases = {
        "missing.off": BindposeMeshReader(FileName=str(folder / "missing.off")),
        "broken.off": BindposeMeshReader(FileName=str(folder / "broken.off")),
        "missing.tgf": BindposeHandleReader(FileName=str(folder / "missing.tgf")),
        "no triangles": TetrahedralizeSurface(Input=lines),
        "mesh has none": BoundedBiharmonicWeights(Input=lines, Handles=posed_handles),
        "no array": SkinningDeformation(Input=Sphere(), Handles=posed_handles),
        "grid": WindingNumberField(Input=Sphere(), Dimensions=[5, 0, 5]),
        "pose": PoseHandles(Input=posed_handles, PoseJSON='{"handles": {"nobody": {}}}'),
        "energy": ReducedARAP(Input=bound, Handles=posed_handles, Energy="Triangles"),
        "tolerance": BoundedBiharmonicWeights(Input=bound, Handles=posed_handles, Tolerance=2.0),
    }
    sentences = {}
    for name, proxy in cases.items():
        data = fetch(proxy)
        arrays = data.GetFieldData()
        assert data.GetNumberOfPoints() == 0 and data.GetNumberOfCells() == 0, name
        assert arrays.GetAbstractArray("Report.status").GetValue(0) == "invalid_input", name
        sentences[name] = arrays.GetAbstractArray("Report.message").GetValue(0)
        assert len(sentences[name]) > 10, name
    # If a source fails, its consumers fail. They work again after the source is repaired.
    reader = cases["missing.off"]
    (folder / "missing.off").write_text("OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n")
    reader.FileName = str(folder / "broken.off")
    tets = TetrahedralizeSurface(Input=reader, Bare=1)
    assert fetch(tets).GetNumberOfCells() == 0
    reader.FileName = str(folder / "missing.off")
    assert fetch(tets).GetNumberOfCells() == 1
    return sentences


CATEGORIES = [f"Bindpose {subject}" for subject in ("Inside", "Tets", "Weights", "Pose")]


def panels():
    """Return the properties of each proxy and the printed state of its object after ParaView has set the defaults of
    the XML. Check that all properties are documented and have their C++ names in Python."""
    found = {}
    for group, names in (("filters", FILTERS), ("sources", SOURCES), ("writers", WRITERS)):
        for name in names:
            proxy = servermanager.ProxyManager().NewProxy(group, name)
            assert proxy.GetDocumentation().GetDescription(), name
            if group == "filters":
                menu = proxy.GetHints().FindNestedElementByName("ShowInMenu")
                assert menu.GetAttribute("category") in CATEGORIES, name
            properties = []
            iterator = proxy.NewPropertyIterator()
            iterator.Begin()
            while not iterator.IsAtEnd():
                key, label = iterator.GetKey(), iterator.GetProperty().GetXMLLabel()
                text = iterator.GetProperty().GetDocumentation()
                assert text and text.GetDescription(), f"{name}.{key} has no documentation"
                assert label.replace(" ", "") == key, f"{name}.{key} is {label} in Python"
                properties.append(key)
                iterator.Next()
            proxy.UpdateVTKObjects()
            ports = [proxy.GetOutputPortName(i) for i in range(proxy.GetNumberOfOutputPorts())]
            assert group != "writers" or not ports
            assert all(ports) and not any(port.startswith("Output") for port in ports), ports
            client = proxy.GetClientSideObject()
            found[client.GetClassName()] = {"properties": properties, "printed": str(client)}
    return found


def main():
    plugin, mesh, folder = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
    LoadPlugin(plugin, remote=False, ns=globals())
    ranks = servermanager.vtkProcessModule.GetProcessModule().GetNumberOfLocalPartitions()
    fields(mesh, folder)
    numbers, bound, posed_handles = deformation()
    distributed_data(mesh, folder)
    run = {"ranks": ranks, "numbers": numbers}
    if ranks == 1:
        both = spheres()
        SaveData(str(folder / "spheres.vtp"), proxy=both)
        files(folder, bound)
        run["panels"] = panels()
        run["sentences"] = bad_input(folder, bound, posed_handles)
    (folder / "run.json").write_text(json.dumps(run))


if __name__ == "__main__":
    # Programmable filters execute their scripts in __main__, and replace max, sum and abs there. Therefore the tests
    # run in another module.
    import in_paraview

    in_paraview.main()
