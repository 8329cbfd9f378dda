"""Measure the work of each rank, for scaling_table.py: pvbatch --sym scaling.py PLUGIN MESH FOLDER.

With --sym, every rank runs this script and measures itself. FOLDER/sizes.json contains the sizes of the data. Each rank
writes its measurements to FOLDER/RANK.json: one row per stage, summed over the calls of the stage.

A stage is the update of one filter whose inputs are up to date. All ranks start it at the same time. Before and after a
stage, ranks wait by sleeping, not in MPI: a rank that waits in MPI is busy, and slows down the other ranks on the same
core. Only stages in which ranks exchange data contain waiting in MPI.
"""

import json
import pathlib
import re
import resource
import sys
import time

from paraview.simple import *  # noqa: F403  LoadPlugin adds the plugin's functions
from vtkmodules.vtkParallelCore import vtkMultiProcessController

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import pieces  # noqa: E402

FIELDS = ("calls", "points", "processor_seconds", "user_seconds", "system_seconds", "wall_seconds", "bytes_sent",
          "memory_bytes")


def memory(name):
    """Return a value of /proc/self/status in bytes: VmRSS is the memory in use, VmHWM its peak."""
    text = pathlib.Path("/proc/self/status").read_text()
    return 1024 * int(re.search(rf"^{name}:\s*(\d+) kB", text, re.MULTILINE)[1])


def reset_peak_memory():
    pathlib.Path("/proc/self/clear_refs").write_text("5")


class Meter:
    """Measurements of one rank."""

    def __init__(self, folder):
        self.controller = vtkMultiProcessController.GetGlobalController()
        self.folder = folder
        self.waits = 0
        self.rows = {}

    def wait_for_all(self):
        """Wait until every rank has called this method and created its file for this call."""
        self.waits += 1
        ranks = range(self.controller.GetNumberOfProcesses())
        files = [self.folder / f"{rank}.{self.waits}.waits" for rank in ranks]
        files[self.controller.GetLocalProcessId()].touch()
        while not all(file.exists() for file in files):
            time.sleep(0.002)

    def update(self, stage, proxy):
        """Update a proxy on all ranks at the same time, and add the work of this rank to the row of the stage."""
        self.wait_for_all()
        reset_peak_memory()
        resident = memory("VmRSS")
        usage = resource.getrusage(resource.RUSAGE_SELF)
        processor, wall = time.process_time(), time.perf_counter()
        proxy.UpdatePipeline()
        processor, wall = time.process_time() - processor, time.perf_counter() - wall
        used = resource.getrusage(resource.RUSAGE_SELF)
        grown = memory("VmHWM") - resident
        self.wait_for_all()

        data = proxy.GetClientSideObject().GetOutputDataObject(0)
        status = data.GetFieldData().GetAbstractArray("Report.status")
        assert status is None or status.GetValue(0) == "ok", f"{stage}: {status.GetValue(0)}"
        row = self.rows.setdefault(stage, dict.fromkeys(FIELDS, 0))
        row["calls"] += 1
        row["points"] = len(pieces.leaves(data)) if data.IsA("vtkCompositeDataSet") else data.GetNumberOfPoints()
        row["processor_seconds"] += processor
        row["user_seconds"] += used.ru_utime - usage.ru_utime
        row["system_seconds"] += used.ru_stime - usage.ru_stime
        row["wall_seconds"] += wall
        if proxy.GetXMLName() == "ShareDataset" and self.controller.GetLocalProcessId() == 0:
            # Every rank reports the bytes that all ranks together have sent, so only one rank adds them to its row.
            row["bytes_sent"] += int(data.GetFieldData().GetArray("Report.bytes_sent").GetTuple1(0))
        row["memory_bytes"] = max(row["memory_bytes"], grown)


def winding_numbers(meter, mesh, sizes):
    surface = ShareDataset(Input=BindposeMeshReader(FileName=str(mesh)))
    meter.update("surface, shared", surface)
    grid = WindingNumberField(Input=surface, Method="Fast", TargetNumberOfSamples=sizes["voxels"], NumberOfThreads=1)
    meter.update("winding numbers on a grid", grid)
    Delete(grid)
    del grid
    surface.GetClientSideObject().UpdatePiece(0, 1, 0)  # UpdatePipeline() gives the surface to the first rank only
    bounds = surface.GetClientSideObject().GetOutputDataObject(0).GetBounds()
    queries = pieces.source(pieces.cloud, count=sizes["queries"], low=bounds[0::2], high=bounds[1::2])
    queries.UpdatePipeline()
    field = WindingNumberField(Input=surface, Points=queries, Method="Fast", NumberOfThreads=1)
    meter.update("winding numbers at points", field)
    for proxy in (field, queries):
        Delete(proxy)


def weights_and_poses(meter, sizes):
    side = sizes["grid_side"]
    tets = Tetrahedralize(Input=Wavelet(WholeExtent=[0, side, 0, side, 0, side]))
    handles = FarthestPointHandles(Input=tets, NumberOfHandles=8)
    handles.UpdatePipeline()
    bound = BoundedBiharmonicWeights(Input=tets, Handles=handles, NumberOfThreads=1)
    meter.update("weights, solved once", bound)
    weights = ShareDataset(Input=bound)
    meter.update("weights, shared", weights)

    target = pieces.source(pieces.cloud, count=sizes["vertices"], low=[0, 0, 0], high=[side, side, side])
    target.UpdatePipeline()
    transferred = TransferWeights(Input=target, Mesh=weights, NumberOfThreads=1)
    meter.update("transfer of weights", transferred)

    shared_handles = ShareDataset(Input=handles)
    meter.update("handles, shared", shared_handles)
    posed = PoseHandles(Input=shared_handles)  # each rank applies the pose to its copy of the handles
    skinned = SkinningDeformation(Input=transferred, Handles=posed, Method="Linear blend", NumberOfThreads=1)
    for k in range(1 + sizes["poses"]):
        posed.PoseJSON = json.dumps({"handles": {"p1": {"rotate": {"axis": [0, 0, 1], "degrees": 5 + k}}}})
        meter.update("skinning, bind and first pose" if k == 0 else "skinning, one pose", skinned)
    Delete(skinned)
    del skinned

    instances = pieces.source(pieces.instances, count=sizes["instances"])
    crowd = CrowdDeformation(Input=weights, Handles=posed, Instances=instances, NumberOfThreads=1)
    for k in range(1 + sizes["frames"]):
        instances.Script = pieces.call(pieces.instances, count=sizes["instances"], frame=k)
        instances.UpdatePipeline()
        meter.update("crowd, bind and first frame" if k == 0 else "crowd, one frame", crowd)


def main():
    plugin, mesh, folder = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
    sizes = json.loads((folder / "sizes.json").read_text())
    LoadPlugin(plugin, remote=False, ns=globals())
    meter = Meter(folder)
    winding_numbers(meter, mesh, sizes)
    weights_and_poses(meter, sizes)
    rank = meter.controller.GetLocalProcessId()
    (folder / f"{rank}.json").write_text(json.dumps(
        {"ranks": meter.controller.GetNumberOfProcesses(), "stages": meter.rows,
         "peak_bytes": 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss}))


if __name__ == "__main__":
    # Programmable sources execute their scripts in __main__, and replace max, sum and abs there. Therefore the
    # measurement runs in another module.
    import scaling

    scaling.main()
