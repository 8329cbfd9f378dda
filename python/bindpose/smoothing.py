"""Data on a mesh with the extrema that are asked for, and no other."""

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkDataObject

from . import BindposeFilters as filters
from .errors import InvalidInput
from .meshes import Array, add_point_array, is_dataset, point_array, shallow_copy, to_dataset
from .running import run

_DATA = "Data"
_LIST = "GivenExtrema"


def _to_list(maxima, minima, count):
    """An array of 1, -1 and 0 from ids of vertices."""
    result = np.zeros(count, dtype=np.int8)
    for ids, kind, word in ((maxima, 1, "maximum"), (minima, -1, "minimum")):
        ids = np.asarray(() if ids is None else ids)
        if ids.size and ids.dtype.kind not in "iu":
            raise InvalidInput(f"a {word} is the number of a vertex, not {ids.flat[0]!r}")
        ids = ids.astype(np.int64).ravel()
        outside = ids[(ids < 0) | (ids >= count)]
        if outside.size:
            raise InvalidInput(f"{word} {outside[0]} is no vertex: there are {count}")
        both = ids[result[ids] == -kind]
        if both.size:
            raise InvalidInput(f"vertex {both[0]} is listed as maximum and as minimum")
        result[ids] = kind
    return result


def monotone_smoothing(mesh, data=None, *, maxima=None, minima=None, extrema=None, persistence=0.05, count=0,
                       data_weight=1e6, keep_values=False, order=2, guide="unconstrained", rebuilds=1, epsilon=0.0,
                       tolerance=1e-6, maximum_iterations=100, memory_limit=0, threads=0, progress=None):
    """Smooth data on a mesh and leave the extrema that are asked for, no other (topological simplification).

    The result is the smooth function nearest to the data among all whose only local extrema are those listed;
    without a list, the most persistent ones of the data.

    Parameters
    ----------
    mesh : vtkDataSet or (vertices, elements)
        A surface of triangles, or tets.
    data : (#V,) array or str, optional
        Values at the vertices, or the name of a point array of the dataset; default: its active scalars.
    maxima, minima : sequence of int, optional
        Vertices that may be extrema. Every connected part needs both, or none: it becomes constant then.
    extrema : (#V,) array or str, optional
        The same list as an array: above 0 a maximum, below 0 a minimum, 0 neither; or the name of a point array.
    persistence : float
        Without a list: extrema of the data that are more persistent than this share of its range stay.
    count : int
        Without a list: so many of the most persistent ones stay; 0 for `persistence`.
    data_weight : float
        How faithful to be: detail finer than about six times ``data_weight ** (-1 / (2 * order))`` of the mesh's
        size is smoothed away. 0: only the values at the extrema count, which are kept.
    keep_values : bool
        Extrema keep the data's values.
    order : int
        2 for the least bending, 3 (triharmonic) for smoother still.
    guide : str
        ``"unconstrained"``: the result rises as the smooth function without any order does, freed from other
        extrema. ``"harmonic"``: as the harmonic function between the extrema does.
    rebuilds : int
        How often that order is taken anew from the result and solved for again; the energy never rises.
    epsilon : float
        Share of the data's range that each vertex is at least above a lower and below a higher neighbour.
    tolerance : float
        Largest relative gap and residual of the certificate.
    maximum_iterations : int
        At most for a solve.
    memory_limit : int
        MiB that the whole process may hold; 0: as much as the machine has available. What would take more
        is refused before it is begun.
    threads, progress
        See `winding_number`.

    Returns
    -------
    Array or vtkDataSet
        (#V,) values for arrays; for a dataset a copy with the point arrays ``Smoothed`` and ``SmoothedExtrema``
        (the list that was used). The report holds the certificate, the extrema with their persistence
        (``extrema``), and the distance to the data.

    Raises
    ------
    InvalidInput
        Data that are missing, not finite, or not one number a vertex; a list that lacks a maximum or a minimum.
    """
    if order not in (2, 3):
        raise InvalidInput(f"order is 2 or 3, not {order!r}")
    if guide not in ("unconstrained", "harmonic"):
        raise InvalidInput(f"guide is 'unconstrained' or 'harmonic', not {guide!r}")
    dataset = shallow_copy(to_dataset(mesh))
    vertices = dataset.GetNumberOfPoints()
    smoother = filters.vtkMonotoneSmoothing()
    if data is not None:
        name = data
        if not isinstance(data, str):
            values = np.asarray(data, dtype=float)
            if values.shape != (vertices,):
                raise InvalidInput(f"data of shape {values.shape} are not one number for each of {vertices} vertices")
            add_point_array(dataset, _DATA, values)
            name = _DATA
        smoother.SetInputArrayToProcess(0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, name)
    elif not is_dataset(mesh):
        raise InvalidInput("a mesh of arrays needs data, one number a vertex")
    given = maxima is not None or minima is not None
    if given and extrema is not None:
        raise InvalidInput("the extrema are given twice: as maxima and minima, and as an array")
    if given:
        extrema = _to_list(maxima, minima, vertices)
    if isinstance(extrema, str):
        smoother.SetExtremaArrayName(extrema)
    elif extrema is not None:
        kinds = np.sign(np.asarray(extrema, dtype=float))
        if kinds.shape != (vertices,):
            raise InvalidInput(f"a list of shape {kinds.shape} is not one entry for each of {vertices} vertices")
        add_point_array(dataset, _LIST, kinds)
        smoother.SetExtremaArrayName(_LIST)
    else:
        smoother.SetExtremaArrayName("")
    smoother.SetInputData(dataset)
    smoother.SetPersistence(float(persistence))
    smoother.SetNumberOfExtrema(int(count))
    smoother.SetDataWeight(float(data_weight))
    smoother.SetKeepValues(bool(keep_values))
    smoother.SetOrder(order)
    smoother.SetGuide(smoother.HARMONIC if guide == "harmonic" else smoother.UNCONSTRAINED)
    smoother.SetRebuilds(int(rebuilds))
    smoother.SetEpsilon(float(epsilon))
    smoother.SetTolerance(float(tolerance))
    smoother.SetMaximumIterations(int(maximum_iterations))
    smoother.SetMemoryLimit(int(memory_limit))
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
