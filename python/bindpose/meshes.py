"""Conversion between numpy arrays and VTK datasets."""

import contextlib
import sys
from typing import NamedTuple

import numpy as np
from vtkmodules.util import numpy_support
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import (
    VTK_TETRA,
    vtkCellArray,
    vtkDataObject,
    vtkPolyData,
    vtkUnstructuredGrid,
)

from .errors import InvalidInput


class Array(np.ndarray):
    """A numpy array with the report of its computation.

    Attributes
    ----------
    report : dict
        See `bindpose.report`.
    names : list of str
        For weights: the handle names of the columns.
    """

    report: dict
    names: list

    def __new__(cls, values, report=None, names=None):
        array = np.asarray(values).view(cls)
        array.report = report or {}
        array.names = list(names or [])
        return array

    def __array_finalize__(self, source):
        self.report = getattr(source, "report", {})
        self.names = getattr(source, "names", [])


class Tets(NamedTuple):
    """A tet mesh as arrays; ``vertices, tets = result[:2]`` works.

    Attributes
    ----------
    vertices : (#V, 3) array of float
    tets : (#T, 4) array of int
        Vertex ids, positive volume.
    original_ids : (#V,) array of int
        For each vertex, the id of the same vertex in the surface; -1 for new vertices.
    report : dict
        See `bindpose.report`.
    """

    vertices: np.ndarray
    tets: np.ndarray
    original_ids: np.ndarray
    report: dict


class PlanarShape(NamedTuple):
    """A shape in the plane as arrays; ``vertices, triangles = result[:2]`` works.

    Attributes
    ----------
    vertices : (#V, 3) array of float
    triangles : (#F, 3) array of int
        Vertex ids, counter-clockwise.
    texture : (#V, 2) array of float
        Texture coordinates: 0 to 1 over the image, or over the curves' bounds.
    original_ids : (#V,) array of int
        For each vertex, the id of the same point in the curves (or in the image's outline); -1 for new vertices.
    report : dict
        See `bindpose.report`.
    """

    vertices: np.ndarray
    triangles: np.ndarray
    texture: np.ndarray
    original_ids: np.ndarray
    report: dict


def is_dataset(mesh):
    """Report whether the mesh is a VTK dataset (such as PyVista's) rather than arrays."""
    return isinstance(mesh, vtkDataObject)


def to_vtk_points(points):
    """Return (#V, 3) coordinates as vtkPoints of doubles; a copy."""
    try:
        values = np.array(points, dtype=float, order="C", ndmin=2)
    except (TypeError, ValueError) as error:
        raise InvalidInput(f"points must be an array of numbers, #V x 3: {error}") from None
    if values.ndim != 2 or values.shape[1] != 3:
        raise InvalidInput(f"points must be an array #V x 3 (got {' x '.join(map(str, values.shape))})")
    result = vtkPoints()
    result.SetData(numpy_support.numpy_to_vtk(values, deep=True))
    return result


def _to_cells(elements):
    count, size = elements.shape
    cells = vtkCellArray()
    offsets = np.arange(0, count * size + 1, size, dtype=np.int64)
    cells.SetData(
        numpy_support.numpy_to_vtkIdTypeArray(offsets, deep=True),
        numpy_support.numpy_to_vtkIdTypeArray(np.ascontiguousarray(elements, dtype=np.int64).ravel(), deep=True),
    )
    return cells


def to_dataset(mesh):
    """Return a mesh as a VTK dataset.

    Parameters
    ----------
    mesh : vtkDataSet or (vertices, elements)
        Arrays #V x 3 and #F x 3 (triangles) or #T x 4 (tets).
    """
    if is_dataset(mesh):
        return mesh
    try:
        vertices, elements = mesh[0], np.asarray(mesh[1])
    except (TypeError, IndexError, KeyError):
        raise InvalidInput("a mesh must be a VTK dataset or a pair of arrays (vertices, elements)") from None
    if elements.ndim != 2 or elements.shape[1] not in (3, 4) or elements.dtype.kind not in "iu":
        raise InvalidInput("elements must be integers, #F x 3 for triangles or #T x 4 for tets")
    triangles = elements.shape[1] == 3
    data = vtkPolyData() if triangles else vtkUnstructuredGrid()
    data.SetPoints(to_vtk_points(vertices))
    if triangles:
        data.SetPolys(_to_cells(elements))
    else:
        data.SetCells(VTK_TETRA, _to_cells(elements))
    return data


def to_curves(curves):
    """Return points #V x 2 (or x 3) and segments #E x 2 as a vtkPolyData of lines."""
    try:
        points, segments = np.asarray(curves[0], dtype=float), np.asarray(curves[1])
    except (TypeError, ValueError, IndexError, KeyError):
        raise InvalidInput("curves must be a vtkPolyData or a pair of arrays (points, segments)") from None
    if points.ndim == 2 and points.shape[1] == 2:
        points = np.column_stack([points, np.zeros(len(points))])
    if segments.ndim != 2 or segments.shape[1] != 2 or segments.dtype.kind not in "iu":
        raise InvalidInput("segments must be integers, #E x 2")
    data = vtkPolyData()
    data.SetPoints(to_vtk_points(points))
    data.SetLines(_to_cells(segments))
    return data


def is_tets(data):
    """Report whether the first cell is a tet; the filters check all other cells."""
    return isinstance(data, vtkUnstructuredGrid) and data.GetNumberOfCells() > 0 and data.GetCellType(0) == VTK_TETRA


def points_of(data):
    """Return the (#V, 3) coordinates of a point set; a copy."""
    return np.array(numpy_support.vtk_to_numpy(data.GetPoints().GetData()), dtype=float)


def triangles_of(data):
    """Return the (#F, 3) vertex ids of a polydata of triangles; a copy."""
    connectivity = numpy_support.vtk_to_numpy(data.GetPolys().GetConnectivityArray())
    return np.array(connectivity, dtype=np.int64).reshape(-1, 3)


def tets_of(data):
    """Return the (#T, 4) vertex ids; a copy."""
    connectivity = numpy_support.vtk_to_numpy(data.GetCells().GetConnectivityArray())
    return np.array(connectivity, dtype=np.int64).reshape(-1, 4)


def point_array(data, name):
    """Return a point array as numpy, by name; a copy, None if absent."""
    array = data.GetPointData().GetArray(name)
    return None if array is None else np.array(numpy_support.vtk_to_numpy(array))


def weights_of(data, name, report):
    """Return a point array of weights as a 2D array (#V, #handles), even for one handle, with the handles' names."""
    array = data.GetPointData().GetArray(name)
    names = [array.GetComponentName(j) for j in range(array.GetNumberOfComponents())]
    return Array(point_array(data, name).reshape(data.GetNumberOfPoints(), len(names)), report, names)


def add_point_array(data, name, values, component_names=()):
    """Attach an array to the dataset's points."""
    array = numpy_support.numpy_to_vtk(np.ascontiguousarray(values), deep=True)
    array.SetName(name)
    for number, component in enumerate(component_names):
        array.SetComponentName(number, component)
    data.GetPointData().AddArray(array)


def shallow_copy(data):
    """Return a new dataset of the same class with the same arrays. Arrays added to it are not added to `data`."""
    copy = data.NewInstance()
    copy.ShallowCopy(data)
    remember_run(copy, run_of(data))
    return copy


def with_weights(data, weights, array_name="Weights"):
    """Return a copy of a dataset with the weights as a point array, or the dataset itself if `weights` is None."""
    if weights is None:
        return data
    copy = shallow_copy(data)
    add_point_array(copy, array_name, np.asarray(weights, dtype=float), getattr(weights, "names", ()))
    return copy


def _wrap_of(kind):
    """Return the function ``wrap`` of the package that defines the class. If this package has no such function, try the
    packages of its base classes. Return None if no package has it."""
    packages = (sys.modules.get(base.__module__.partition(".")[0]) for base in kind.__mro__)
    return next((package.wrap for package in packages if hasattr(package, "wrap")), None)


def like(source, result):
    """Convert a result to the class of the source if this class is a Python subclass of a VTK class, such as
    pyvista.PolyData.

    A result of another type, such as the tets of a surface, is converted by the function ``wrap`` of the package of the
    source's class, if there is one. All datasets in a list or tuple are converted. A result that cannot be converted is
    returned as it is.
    """
    kind = type(source)
    if not is_dataset(source) or kind.__module__.startswith("vtkmodules"):
        return result
    if isinstance(result, (list, tuple)) and not hasattr(result, "_fields"):
        return type(result)(like(source, each) for each in result)
    if not is_dataset(result) or isinstance(result, kind):
        return result
    try:
        if issubclass(kind, type(result)):
            converted = kind()
            converted.ShallowCopy(result)
        else:
            converted = _wrap_of(kind)(result)
    except TypeError:  # the constructor of the class needs arguments, or there is no function wrap
        return result
    remember_run(converted, run_of(result))
    return converted


def remember_run(data, report):
    """Store a filter's whole report with its output. (The report in the field data of the output contains no
    seconds.)"""
    with contextlib.suppress(AttributeError):  # objects of other classes may not allow new attributes
        data._bindpose_run = report  # pylint: disable=protected-access


def run_of(data):
    """Return the report from `remember_run`; empty for data from files and copies by other programs."""
    return getattr(data, "_bindpose_run", {})


def copy_report(source, target):
    """Add the entries of one dataset's report to the report of another dataset; equal keys are replaced."""
    arrays = source.GetFieldData()
    for i in range(arrays.GetNumberOfArrays()):
        array = arrays.GetAbstractArray(i)
        if (array.GetName() or "").startswith("Report."):
            target.GetFieldData().AddArray(array)
    remember_run(target, _merged(run_of(target), run_of(source)))


def _merged(first, second):
    """Merge two reports and their nested dicts. If both have the same key, the value of the second report is used."""
    merged = {**first, **second}
    for key in first.keys() & second.keys():
        if isinstance(first[key], dict) and isinstance(second[key], dict):
            merged[key] = _merged(first[key], second[key])
    return merged
