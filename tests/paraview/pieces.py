"""Datasets of which each rank makes and saves only its own piece, for tests of the ParaView plugin on several ranks.

source() and save_parts() create a programmable source and a programmable filter. ParaView executes their scripts on
every rank, and the scripts call the other functions of this module. A point has the same coordinates and the same number
in the array Id on any number of ranks.
"""

import pathlib

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline
from vtkmodules.vtkParallelCore import vtkMultiProcessController

FOLDER = str(pathlib.Path(__file__).resolve().parent)
# Multiples of these numbers modulo 1 cover a square evenly (Roberts, "The Unreasonable Effectiveness of Quasirandom
# Sequences", 2018).
STEPS = 0.7548776662466927, 0.5698402909980532


# ---- Proxies -----------------------------------------------------------------------------------


def call(function, **arguments):
    """Return a script that calls a function of this module with the programmable filter and `arguments`."""
    return f"import pieces\npieces.{function.__name__}(self, **{arguments!r})"


def source(function, **arguments):
    """Return a source whose pieces are made by one of the functions below."""
    from paraview.simple import ProgrammableSource  # only the process that runs the test has proxies

    return ProgrammableSource(OutputDataSetType="vtkPolyData", PythonPath=FOLDER,
                              ScriptRequestInformation=call(announce), Script=call(function, **arguments))


def save_parts(proxy, folder, name):
    """Save the piece of each rank to FOLDER/NAME.RANK.npz."""
    from paraview.simple import ProgrammableFilter

    ProgrammableFilter(Input=proxy, OutputDataSetType="vtkPolyData", CopyArrays=0, PythonPath=FOLDER,
                       Script=call(save, folder=str(folder), name=name)).UpdatePipeline()


# ---- Functions that are executed on every rank ----------------------------------------------------


def announce(algorithm):
    """Declare that a source makes pieces. Without this, VTK executes it for the first piece only."""
    algorithm.GetOutputInformation(0).Set(vtkAlgorithm.CAN_HANDLE_PIECE_REQUEST(), 1)


def requested(algorithm, count):
    """Return the range of the indices 0 to `count` that belongs to the requested piece of a source."""
    information = algorithm.GetOutputInformation(0)
    piece = information.Get(Pipeline.UPDATE_PIECE_NUMBER())
    pieces = information.Get(Pipeline.UPDATE_NUMBER_OF_PIECES())
    return count * piece // pieces, count * (piece + 1) // pieces


def scattered(ids, count):
    """Return one point of the unit cube for each id. The points of a range of consecutive ids are in one slab, because
    the points of a piece of real data are near each other, too."""
    return np.column_stack([(ids + 0.5) / count, ids * STEPS[0] % 1.0, ids * STEPS[1] % 1.0])


def fill(algorithm, points, ids, **arrays):
    """Write points, their ids and further point arrays to the output of a source."""
    data = algorithm.GetOutputDataObject(0)
    at = vtkPoints()
    at.SetData(numpy_to_vtk(np.ascontiguousarray(points), deep=1))
    data.SetPoints(at)
    for name, values in {"Id": ids, **arrays}.items():
        array = numpy_to_vtk(np.ascontiguousarray(values), deep=1)
        array.SetName(name)
        data.GetPointData().AddArray(array)
    return data


def cloud(algorithm, count, low, high, snap=False):
    """Make points that are scattered over a box. With `snap`, every tenth point has integer coordinates, like the vertices
    of a grid."""
    first, end = requested(algorithm, count)
    ids = np.arange(first, end)
    points = low + scattered(ids, count) * (np.array(high) - low)
    if snap:
        points[ids % 10 == 0] = np.rint(points[ids % 10 == 0])
    fill(algorithm, points, ids)


def tube(algorithm, rings, sides):
    """Make triangles of a tube along x inside the cube from 0 to 6. A piece consists of whole strips between rings. Two
    adjacent pieces share a ring."""
    first, end = requested(algorithm, rings - 1)
    ids = np.arange(first * sides, (end + 1) * sides if end > first else first * sides)
    ring, side = np.divmod(ids, sides)
    angles = np.arange(sides) * (2.0 * np.pi / sides)
    normals = np.column_stack([np.zeros(sides), np.cos(angles), np.sin(angles)])[side]
    points = np.array([0.5, 3.0, 3.0]) + 1.5 * normals
    points[:, 0] += ring * (5.0 / (rings - 1))
    data = fill(algorithm, points, ids)
    directions = numpy_to_vtk(normals, deep=1)
    directions.SetName("Normals")
    data.GetPointData().SetNormals(directions)

    corner = np.arange((end - first) * sides)
    neighbor = corner - corner % sides + (corner + 1) % sides
    triangles = np.concatenate([np.column_stack([corner, neighbor, corner + sides]),
                                np.column_stack([neighbor, neighbor + sides, corner + sides])])
    cells = vtkCellArray()
    cells.SetData(3, numpy_to_vtkIdTypeArray(triangles.ravel(), deep=1))
    data.SetPolys(cells)


def instances(algorithm, count, frame=0):
    """Make the instances of a crowd: placements on a line, and translations of two handles that change with the frame."""
    first, end = requested(algorithm, count)
    ids = np.arange(first, end)
    places = np.column_stack([10.0 * ids, 0.0 * ids, 0.0 * ids])
    moved = scattered(ids, count) - 0.5
    fill(algorithm, places, ids, p1=moved * (1.0 + 0.1 * frame), p2=moved[:, ::-1] * (1.0 - 0.1 * frame))


def leaves(data):
    """Return the datasets of a composite, or the dataset itself."""
    if not data.IsA("vtkCompositeDataSet"):
        return [data]
    found = []
    iterator = data.NewIterator()
    iterator.UnRegister(None)
    iterator.InitTraversal()
    while not iterator.IsDoneWithTraversal():
        found.append(iterator.GetCurrentDataObject())
        iterator.GoToNextItem()
    return found


def points_of(data):
    return vtk_to_numpy(data.GetPoints().GetData()) if data.GetPoints() else np.zeros((0, 3))


def save(algorithm, folder, name):
    """Save the points and point arrays of a dataset, or the points of all datasets of a composite."""
    data = algorithm.GetInputDataObject(0, 0)
    information = algorithm.GetInputInformation(0, 0)
    status = data.GetFieldData().GetAbstractArray("Report.status")
    piece = (Pipeline.UPDATE_PIECE_NUMBER(), Pipeline.UPDATE_NUMBER_OF_PIECES())
    saved = {"status": status.GetValue(0) if status else "", "piece": [information.Get(key) for key in piece]}
    if data.IsA("vtkCompositeDataSet"):
        points = [points_of(leaf) for leaf in leaves(data)]
        saved["points"] = np.stack(points) if points else np.zeros((0, 0, 3))
    else:
        saved["points"] = points_of(data)
        arrays = data.GetPointData()
        for i in range(arrays.GetNumberOfArrays()):
            saved[arrays.GetArrayName(i)] = vtk_to_numpy(arrays.GetArray(i))
    rank = vtkMultiProcessController.GetGlobalController().GetLocalProcessId()
    np.savez(f"{folder}/{name}.{rank}.npz", **saved)
