"""Compute smooth surfaces between fixed points."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from . import BindposeFilters as filters
from .errors import InvalidInput
from .meshes import Array, add_point_array, is_dataset, points_of, shallow_copy, to_dataset
from .options import with_options
from .parameter_types import Mesh, Progress
from .running import run

@with_options("variational")
def fair(mesh: Mesh, fixed: ArrayLike | None = None, *, tangents: ArrayLike | None = None,
         parameters: ArrayLike | None = None, load: ArrayLike | None = None, options, threads: int = 0,
         progress: Progress = None) -> Any:
    """Recompute the free points of a surface smoothly between the fixed ones: for holes and blends.

    Each coordinate x solves (-Laplacian)^order x = load by mixed finite elements (Jacobson et al. 2010).

    Parameters
    ----------
    mesh : vtkDataSet or (vertices, triangles)
        A surface. Without `parameters`, the positions of the free points determine cotangents and areas; otherwise
        these positions have no effect.
    fixed : (#V,) array of bool or ids, optional
        The fixed vertices; default: the dataset's point array ``Fixed``.
    tangents : (#V, 3) array, optional
        Derivatives of the position in the outward direction, per unit length of the parameter domain. Sets
        `tangent_source` to "given". Default: the point array ``Tangents``.
    parameters : (#V, 2) or (#V, 3) array, optional
        Positions in the parameter domain; default: the point array ``Parameterization``, or the mesh itself.
    load : (#V, 3) array, optional
        Right side of the equation; default: zero.
    {options}
    threads, progress, progress_bar
        See `winding_number`.

    Returns
    -------
    Array or vtkDataSet
        For arrays: coordinates (#V, 3). For a dataset: a copy with the new coordinates.

    Raises
    ------
    InvalidInput
        A connected component has no fixed points, a triangle of the patch has no area, or an edge has three or more
        triangles.
    Unavailable
        The system is too ill-conditioned for double precision.

    Examples
    --------
    >>> square = ([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.5, 0.5, 0]],
    ...           [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])
    >>> bindpose.fair(square, fixed=[0, 1, 2, 3])[4].round(6).tolist()
    [0.5, 0.5, 0.0]
    """
    data = shallow_copy(to_dataset(mesh))
    vertices = data.GetNumberOfPoints()
    added = []

    def add(name, values, columns):
        values = np.asarray(values, dtype=float)
        if values.shape not in [(vertices, *c) for c in columns]:
            raise InvalidInput(f"{name} has shape {values.shape}, which does not match {vertices} vertices")
        add_point_array(data, name, values)
        added.append(name)

    if fixed is not None:
        fixed = np.asarray(fixed)
        if fixed.dtype.kind in "iu":
            outside = fixed[(fixed < 0) | (fixed >= vertices)]
            if outside.size:
                raise InvalidInput(f"fixed vertex {outside.flat[0]} is out of range: the mesh has {vertices} vertices")
            fixed = np.isin(np.arange(vertices), fixed)
        add("Fixed", fixed, [()])
    if parameters is not None:
        add("Parameterization", parameters, [(2,), (3,)])
    if load is not None:
        add("Load", load, [(3,)])
    surface = filters.vtkVariationalSurface()
    options.apply(surface, "variational")
    if tangents is not None:
        add("Tangents", tangents, [(3,)])
        surface.SetTangentSource(surface.GIVEN)
    surface.FairOn()
    surface.SetInputData(data)
    surface.SetNumberOfThreads(threads)
    report = run(surface, progress)
    result = surface.GetOutput()
    if not is_dataset(mesh):
        return Array(points_of(result), report)
    for name in added:
        result.GetPointData().RemoveArray(name)
    return result
