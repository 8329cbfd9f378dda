"""Smooth data on a mesh so that only the requested extrema remain."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from vtkmodules.vtkCommonDataModel import vtkDataObject

from . import BindposeFilters as filters
from .errors import InvalidInput
from .meshes import Array, add_point_array, is_dataset, point_array, shallow_copy, to_dataset
from .options import with_options
from .parameter_types import Mesh, Progress
from .running import run

_DATA = "Data"
_LIST = "GivenExtrema"


def _to_list(maxima, minima, count):
    """Return one value per vertex: 1 for the listed maxima, -1 for the listed minima, otherwise 0."""
    result = np.zeros(count, dtype=np.int8)
    for ids, kind, word in ((maxima, 1, "maximum"), (minima, -1, "minimum")):
        ids = np.asarray(() if ids is None else ids)
        if ids.size and ids.dtype.kind not in "iu":
            raise InvalidInput(f"a {word} must be a vertex id (got {ids.flat[0]!r})")
        ids = ids.astype(np.int64).ravel()
        outside = ids[(ids < 0) | (ids >= count)]
        if outside.size:
            raise InvalidInput(f"{word} {outside[0]} is out of range: the mesh has {count} vertices")
        both = ids[result[ids] == -kind]
        if both.size:
            raise InvalidInput(f"vertex {both[0]} is listed both as maximum and as minimum")
        result[ids] = kind
    return result


@with_options("monotone_smoothing")
def monotone_smoothing(mesh: Mesh, data: str | ArrayLike | None = None, *, maxima: Sequence[int] | None = None,
                       minima: Sequence[int] | None = None, options, threads: int = 0,
                       progress: Progress = None) -> Any:
    """Smooth data on a mesh and keep only the requested extrema (topological simplification).

    The result is the smooth function nearest to the data among all functions whose only local extrema are the listed
    ones. Without a list, the most persistent extrema of the data are used.

    Parameters
    ----------
    mesh : vtkDataSet or (vertices, elements)
        A surface of triangles, or tets.
    data : (#V,) array or str, optional
        Values at the vertices, or the name of a point array of the dataset; default: its active scalars.
    maxima, minima : sequence of int, optional
        Vertices that may be extrema. A connected component needs at least one maximum and one minimum, or no extrema at
        all. Without extrema, it becomes constant.
    {options}
    threads, progress, progress_bar
        See `winding_number`.

    Returns
    -------
    Array or vtkDataSet
        (#V,) values for arrays; for a dataset a copy with the point arrays ``Smoothed`` and ``SmoothedExtrema`` (the
        list that was used). The report contains the certificate, the extrema with their persistence (``extrema``),
        and the distance to the data.

    Raises
    ------
    InvalidInput
        Data that are missing, not finite, or not one number per vertex; a list without a maximum or a minimum.

    Examples
    --------
    >>> square = ([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.5, 0.5, 0]],
    ...           [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])
    >>> smooth = bindpose.monotone_smoothing(square, [0, 1, 2, 1, 9], maxima=[2], minima=[0])
    >>> bool(smooth[2] >= smooth[4] >= smooth[0])
    True
    """
    dataset = shallow_copy(to_dataset(mesh))
    vertices = dataset.GetNumberOfPoints()
    smoother = filters.vtkMonotoneSmoothing()
    if data is not None:
        name = data
        if not isinstance(data, str):
            values = np.asarray(data, dtype=float)
            if values.shape != (vertices,):
                raise InvalidInput(f"data has shape {values.shape}; expected one number for each of the {vertices} vertices")
            add_point_array(dataset, _DATA, values)
            name = _DATA
        smoother.SetInputArrayToProcess(0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, name)
    elif not is_dataset(mesh):
        raise InvalidInput("data is required for a mesh given as arrays: one number per vertex")
    extrema = options.extrema
    given = maxima is not None or minima is not None
    if given and extrema is not None:
        raise InvalidInput("extrema cannot be combined with maxima or minima")
    if given:
        extrema = _to_list(maxima, minima, vertices)
    if isinstance(extrema, str):
        smoother.SetExtremaArrayName(extrema)
    elif extrema is not None:
        kinds = np.sign(np.asarray(extrema, dtype=float))
        if kinds.shape != (vertices,):
            raise InvalidInput(f"extrema has shape {kinds.shape}; expected one entry for each of the {vertices} vertices")
        add_point_array(dataset, _LIST, kinds)
        smoother.SetExtremaArrayName(_LIST)
    else:
        smoother.SetExtremaArrayName("")
    smoother.SetInputData(dataset)
    options.apply(smoother, "monotone_smoothing")
    smoother.SetNumberOfThreads(threads)
    report = run(smoother, progress)
    result = smoother.GetOutput()
    if not is_dataset(mesh):
        return Array(point_array(result, "Smoothed"), report)
    if not isinstance(data, str) and data is not None:
        result.GetPointData().RemoveArray(_DATA)
    if extrema is not None and not isinstance(extrema, str):
        result.GetPointData().RemoveArray(_LIST)
    return result
