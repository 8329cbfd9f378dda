"""Handles from arrays, files and surfaces."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import ArrayLike
from vtkmodules.util import numpy_support
from vtkmodules.vtkCommonCore import vtkIdTypeArray, vtkIntArray, vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

from .BindposeFilters import vtkAutomaticHandles, vtkFarthestPointHandles
from .errors import InvalidInput
from .files import read_handles
from .meshes import is_dataset, shallow_copy, to_dataset, to_vtk_points
from .options import with_options
from .parameter_types import Mesh, Progress
from .running import run


def handles(points: ArrayLike | None = None, bones: ArrayLike | None = None, names: Sequence[str] | None = None,
            parents: Sequence[int] | None = None, pseudo_edges: ArrayLike | None = None) -> vtkPolyData:
    """Create a handle dataset from arrays.

    Parameters
    ----------
    points : (#P, 3) array of float, optional
        Point handles.
    bones : (#B, 2, 3) array of float, optional
        Head and tail of each bone.
    names : sequence of str, optional
        Names of the points, then of the bones. Default: p1, p2, …, b1, b2, …
    parents : sequence of int, optional
        One entry for each point, then for each bone: the index of the parent in this sequence of handles, or -1.
        Default: if the head of a bone is the tail of another bone, that other bone is the parent.
    pseudo_edges : (#E, 2) array of int, optional
        Pairs of point indices. A pseudo-edge between two points determines how these points rotate if they are dragged
        (see `deform`).

    Returns
    -------
    vtkPolyData
        One cell per handle, in the order of the columns of the weights: points, then bones, with the cell arrays
        ``HandleName``, ``HandleKind`` and ``Parent``; then pseudo-edges, which have no column.

    Raises
    ------
    InvalidInput
        Arrays of a wrong shape, too many or too few names.

    Examples
    --------
    >>> arm = bindpose.handles(bones=[[[0, 0, 0], [1, 0, 0]], [[1, 0, 0], [2, 0, 0]]], names=["upper", "lower"])
    >>> arm.GetNumberOfCells()
    2
    """
    points = np.zeros((0, 3)) if points is None else np.array(points, dtype=float, ndmin=2)
    bones = np.zeros((0, 2, 3)) if bones is None else np.array(bones, dtype=float, ndmin=3)
    if points.ndim != 2 or points.shape[1] != 3:
        raise InvalidInput("points must be an array #P x 3")
    if bones.ndim != 3 or bones.shape[1:] != (2, 3):
        raise InvalidInput("bones must be an array #B x 2 x 3, head and tail per bone")
    count = len(points) + len(bones)
    if count == 0:
        raise InvalidInput("no handle is given: expected at least one point or bone")
    edges = np.zeros((0, 2), dtype=int) if pseudo_edges is None else np.array(pseudo_edges, ndmin=2)
    if edges.shape[1:] != (2,) or edges.dtype.kind not in "iu" or (len(edges) and (
            edges.min() < 0 or edges.max() >= len(points) or (edges[:, 0] == edges[:, 1]).any())):
        raise InvalidInput("pseudo_edges must be an array #E x 2 of ids of two different points per edge")
    if names is None:
        names = [f"p{i + 1}" for i in range(len(points))] + [f"b{i + 1}" for i in range(len(bones))]
    if parents is None:
        parents = [-1] * len(points) + [_parent(bones, i, len(points)) for i in range(len(bones))]
    if len(names) != count or len(parents) != count:
        raise InvalidInput(
            f"names and parents must have {count} entries, one per handle (got {len(names)} names and {len(parents)} parents)")
    for i, name in enumerate(names):
        if str(name) == "":
            raise InvalidInput(f"names[{i}] is empty; every handle must have a name")

    data = vtkPolyData()
    data.SetPoints(to_vtk_points(np.concatenate([points, bones.reshape(-1, 3)])))
    vertices, lines = vtkCellArray(), vtkCellArray()
    for i in range(len(points)):
        vertices.InsertNextCell(1, [i])
    for i in range(len(bones)):
        head = len(points) + 2 * i
        lines.InsertNextCell(2, [head, head + 1])
    for a, b in edges:
        lines.InsertNextCell(2, [int(a), int(b)])
    data.SetVerts(vertices)
    data.SetLines(lines)
    kinds = [0] * len(points) + [1] * len(bones) + [-2] * len(edges)
    names = [*names, *[""] * len(edges)]
    parents = [*parents, *[-1] * len(edges)]
    columns = ((vtkStringArray(), "HandleName", map(str, names)), (vtkIntArray(), "HandleKind", kinds),
               (vtkIdTypeArray(), "Parent", map(int, parents)))
    for array, name, values in columns:
        array.SetName(name)
        for value in values:
            array.InsertNextValue(value)
        data.GetCellData().AddArray(array)
    return data


def _parent(bones, bone, first):
    for other, (_head, tail) in enumerate(bones):
        if other != bone and np.array_equal(tail, bones[bone][0]):
            return first + other
    return -1


@with_options()
def farthest_point_handles(surface: Mesh, count: int = 8) -> vtkPolyData:
    """Spread point handles p1, p2, … evenly over a surface; the first handles are at tips of the shape.

    Parameters
    ----------
    surface : vtkDataSet or (vertices, triangles)
    count : int

    Returns
    -------
    vtkPolyData
        A handle dataset.

    Examples
    --------
    >>> tetrahedron = ([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
    ...                [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    >>> bindpose.farthest_point_handles(tetrahedron, 3).GetNumberOfCells()
    3
    """
    spread = vtkFarthestPointHandles()
    spread.SetInputData(to_dataset(surface))
    spread.SetNumberOfHandles(int(count))
    run(spread)
    return spread.GetOutput()


@with_options("automatic_handles")
def automatic_handles(mesh: Mesh, *, options, threads: int = 0, progress: Progress = None) -> vtkPolyData:
    """Create handles automatically: bones along the shape's curve skeleton, or points spread over it.

    Parameters
    ----------
    mesh : vtkDataSet or (vertices, triangles)
        A surface, clean or not, or tets, whose boundary is used.
    {options}
    threads, progress, progress_bar
        See `winding_number`.

    Returns
    -------
    vtkPolyData
        A handle dataset for `weights`; `report` returns the details of the computation.

    Raises
    ------
    InvalidInput
        For bones: the surface is flat or encloses nothing. For points: there are more points than vertices.
    Unavailable
        The helper program is missing, or an unclean surface is too thin to be filled.

    Examples
    --------
    >>> tetrahedron = ([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
    ...                [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    >>> bindpose.automatic_handles(tetrahedron, method="points", number_of_points=2).GetNumberOfCells()
    2
    """
    maker = vtkAutomaticHandles()
    maker.SetInputData(to_dataset(mesh))
    options.apply(maker, "automatic_handles")
    maker.SetNumberOfThreads(threads)
    run(maker, progress)
    return maker.GetOutput()


def to_handles(value, surface):
    """Return handles from a handle argument: a dataset, a file, "auto[:N]" or "skeleton[:N]"."""
    if is_dataset(value):
        return value
    word, colon, count = value.partition(":") if isinstance(value, str) else ("", "", "")
    if word in ("auto", "skeleton"):
        if colon and (not count.isdigit() or int(count) < 1):
            raise InvalidInput(f"handles {word}:N needs an integer N of at least 1 (got {value!r})")
        if word == "skeleton":
            return automatic_handles(surface, maximum_bones=int(count or 0))
        return farthest_point_handles(surface, int(count or 8))
    if isinstance(value, (str, os.PathLike)):
        return read_handles(value)
    raise InvalidInput("handles must be a handle dataset (see bindpose.handles), a file, 'auto:N' or 'skeleton:N'")


def cell_names(handles):
    """Return the values of the array HandleName; empty if there is no such array."""
    array = handles.GetCellData().GetAbstractArray("HandleName")
    return [array.GetValue(i) for i in range(array.GetNumberOfValues())] if array else []


def handle_cells(handles):
    """Return the ids of the cells that are handles. (The other cells are cage elements and pseudo-edges.)"""
    kinds = handles.GetCellData().GetArray("HandleKind")
    count = handles.GetNumberOfCells()
    return [i for i in range(count) if kinds is None or kinds.GetTuple1(i) >= 0]


def with_cell_values(handles, array_name, values, components, missing=None):
    """Return a copy of the handle dataset with a value for each cell: a sequence, or {name: value}.

    ``missing`` is the value of handles whose name is not in the dict. If ``missing`` is None, the value is 0 for arrays
    of one component; for arrays of several components, a missing name is an error.
    """
    count = handles.GetNumberOfCells()
    shape = (count, components) if components > 1 else (count,)
    if isinstance(values, Mapping):
        names = cell_names(handles)
        unknown = [name for name in values if name not in names]
        if unknown:
            raise InvalidInput(f"unknown handle {unknown[0]!r}")
        filled = np.zeros(shape)
        if missing is not None:
            filled[:] = missing
        for name, value in values.items():
            try:
                filled[names.index(name)] = value
            except (TypeError, ValueError):
                raise InvalidInput(f"{array_name} of handle {name!r} must be {components} numbers (got {value!r})") from None
        if missing is None and components > 1 and len(values) < count:
            missing = next(name for name in names if name not in values)
            raise InvalidInput(f"{array_name} is missing for handle {missing!r}")
        values = filled
    values = np.asarray(values)
    if values.shape != shape or values.dtype.kind not in "iufb":
        raise InvalidInput(f"{array_name} must be an array of numbers {' x '.join(map(str, shape))}, one row per handle")
    if values.dtype != np.uint8:
        values = values.astype(float)
    copy = shallow_copy(handles)
    array = numpy_support.numpy_to_vtk(np.ascontiguousarray(values), deep=True)
    array.SetName(array_name)
    copy.GetCellData().AddArray(array)
    return copy
