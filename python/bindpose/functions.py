"""The stages of the pipeline as functions."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from vtkmodules.vtkCommonDataModel import vtkDataSet, vtkPolyData

from . import BindposeFilters as filters
from .errors import InvalidInput
from .files import read
from .handle_sets import to_handles, with_cell_values
from .images import is_image_file, read_image, to_image
from .meshes import (
    Array,
    PlanarShape,
    Tets,
    add_point_array,
    copy_report,
    is_dataset,
    is_tets,
    point_array,
    points_of,
    shallow_copy,
    tets_of,
    to_curves,
    to_dataset,
    to_vtk_points,
    triangles_of,
    weights_of,
    with_weights,
)
from .options import with_options
from .parameter_types import Handles, Mesh, Path, Progress
from .running import report as report_of
from .running import run


@with_options("winding_number", without=("winding_threshold",))
def winding_number(surface: Mesh, points_or_grid: vtkDataSet | ArrayLike | None = None, *, options, threads: int = 0,
                   progress: Progress = None) -> Any:
    """Return the winding number of a surface: 1 inside, 0 outside, in between where it is open.

    Parameters
    ----------
    surface : vtkDataSet or (vertices, triangles)
        A dataset without polygons is a curve in a plane (lines), or samples of a surface (points with normals, and
        areas in a point array ``Area``).
    points_or_grid : optional
        Where to evaluate: an array of points (#P, 3); a VTK dataset, whose points are used; the number of samples along
        the longest side of a grid of cubic voxels; or three numbers, the dimensions of a grid. Default: 64 samples.
    {options}
    threads : int
        0 for all cores; the result does not depend on it.
    progress : callable, optional
        See `bindpose.run`.
    progress_bar : bool
        Draw a bar on the standard error.

    Returns
    -------
    Array, vtkImageData or vtkDataSet
        For an array of points: (#P,) values, or with `compute_gradient` a pair of (#P,) values and (#P, 3) gradients.
        For a grid: a vtkImageData. For a dataset: a copy of it. Images and datasets have the point arrays
        ``WindingNumber``, ``OnSurface`` (1 where a triangle touches the point) and, with `compute_gradient`,
        ``WindingNumberGradient``.

    Raises
    ------
    InvalidInput
        Not a surface, coordinates that are not finite, vertex ids out of range.

    See Also
    --------
    contains : Whether points are inside, as booleans.

    Notes
    -----
    Jacobson, Kavan, Sorkine-Hornung, "Robust inside-outside segmentation using generalized winding
    numbers", 2013.

    Examples
    --------
    >>> tetrahedron = ([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
    ...                [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    >>> bindpose.winding_number(tetrahedron, [[0.1, 0.1, 0.1], [2, 2, 2]]).round(6).tolist()
    [1.0, 0.0]
    """
    field = filters.vtkWindingNumberField()
    field.SetInputData(0, to_dataset(surface))
    options.apply(field, "winding_number")
    field.SetNumberOfThreads(threads)
    as_array = False
    if points_or_grid is None:
        pass
    elif is_dataset(points_or_grid):
        field.SetInputData(1, points_or_grid)
    elif np.ndim(points_or_grid) == 0:
        field.SetResolution(int(points_or_grid))
    elif np.ndim(points_or_grid) == 1 and np.shape(points_or_grid) == (3,) and all(
            isinstance(n, (int, np.integer)) for n in points_or_grid):
        field.SetDimensions(*map(int, points_or_grid))
    else:
        cloud = vtkPolyData()
        cloud.SetPoints(to_vtk_points(points_or_grid))
        field.SetInputData(1, cloud)
        as_array = True
    report = run(field, progress)
    result = field.GetOutput()
    if not as_array:
        return result
    values = Array(point_array(result, "WindingNumber"), report)
    if options.compute_gradient:
        return values, Array(point_array(result, "WindingNumberGradient"), report)
    return values


@with_options("winding_number", only=("method", "tolerance", "orient_patches", "winding_threshold"))
def contains(surface: Mesh, points: vtkDataSet | ArrayLike, *, options, threads: int = 0,
             progress: Progress = None) -> Array:
    """Report whether points are inside of a surface, clean or not.

    Parameters
    ----------
    surface : vtkDataSet or (vertices, triangles)
    points : (#P, 3) array or vtkDataSet
    {options}
    threads, progress, progress_bar
        See `winding_number`.

    Returns
    -------
    Array of bool
        (#P,). Points whose coordinates are not finite are not inside.

    Raises
    ------
    InvalidInput
        See `winding_number`.

    Examples
    --------
    >>> tetrahedron = ([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
    ...                [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    >>> bindpose.contains(tetrahedron, [[0.1, 0.1, 0.1], [2, 2, 2]])
    Array([ True, False])
    """
    values = winding_number(surface, points if is_dataset(points) else np.atleast_2d(points), method=options.method,
                            tolerance=options.tolerance, orient_patches=options.orient_patches, threads=threads,
                            progress=progress)
    if is_dataset(values):
        values = Array(point_array(values, "WindingNumber"), report_of(values))
    return Array(np.asarray(values) >= options.winding_threshold, values.report)


@with_options()
def defects(surface: Mesh, *, threads: int = 0, progress: Progress = None) -> vtkPolyData:
    """Locate the defects of a surface: open and non-manifold edges, duplicates, intersections and more.

    Parameters
    ----------
    surface : vtkDataSet or (vertices, triangles)
    threads, progress, progress_bar
        See `winding_number`.

    Returns
    -------
    vtkPolyData
        One cell per defect, with the cell arrays ``Defect`` (see `vtkSurfaceDefects`), ``DefectName``,
        ``OriginalCellIds``, ``CrossedCellIds``, ``Component`` and ``InwardComponent``, and the point array
        ``OriginalPointIds``. The report has the number of each defect and ``closed``.

    Raises
    ------
    InvalidInput
        Not a surface, coordinates that are not finite, vertex ids out of range.

    Examples
    --------
    >>> triangle = ([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    >>> bindpose.report(bindpose.defects(triangle))["counts"]["boundary_edges"]
    3
    """
    finder = filters.vtkSurfaceDefects()
    finder.SetInputData(0, to_dataset(surface))
    finder.SetNumberOfThreads(threads)
    run(finder, progress)
    return finder.GetOutput()


@with_options("tetrahedralize")
def tetrahedralize(surface: Mesh, *, handles: Handles | None = None, options, threads: int = 0,
                   progress: Progress = None) -> Any:
    """Fill the inside of a surface, clean or not, with tets.

    Parameters
    ----------
    surface : vtkDataSet or (vertices, triangles)
    handles : vtkPolyData, str or path-like, optional
        Handle dataset or file. With the methods cdt and wrap, handle points inside the surface become vertices of the
        tets, and vertices are added along bones and cages.
    {options}
    threads, progress, progress_bar
        See `winding_number`.

    Returns
    -------
    Tets or vtkUnstructuredGrid
        Arrays for arrays. A dataset has the point array ``OriginalPointIds`` and the cell arrays ``WindingNumber``,
        ``Label`` (1 inside, 2 inside although the winding number is below the threshold, 0 outside, -1 outside although
        the winding number is not below the threshold) and ``MinDihedralAngle`` (degrees).

    Raises
    ------
    InvalidInput
        Not a surface, or one that encloses nothing; `keep_outside` with another method than cdt.
    Unavailable
        The meshing program is missing; the message names the packages or the download address.

    Examples
    --------
    >>> tetrahedron = ([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
    ...                [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    >>> result = bindpose.tetrahedralize(tetrahedron, method="cdt")
    >>> result.vertices.shape[1], result.tets.shape[1]
    (3, 4)
    >>> result.report["status"]
    'ok'
    """
    data = to_dataset(surface)
    filler = filters.vtkTetrahedralizeSurface()
    filler.SetInputData(0, data)
    if handles is not None:
        filler.SetInputData(1, to_handles(handles, data))
    options.apply(filler, "tetrahedralize")
    filler.SetNumberOfThreads(threads)
    report = run(filler, progress)
    result = filler.GetOutput()
    if is_dataset(surface):
        return result
    return Tets(points_of(result), tets_of(result), point_array(result, "OriginalPointIds"), report)


@with_options("planar_shape")
def planar_shape(image_or_curves: vtkDataSet | ArrayLike | Path, *, handles: Handles | None = None, options,
                 threads: int = 0, progress: Progress = None) -> Any:
    """Return the shape of an image, or the region that planar curves enclose, as quality triangles.

    Parameters
    ----------
    image_or_curves : vtkImageData, vtkPolyData, array, pair of arrays, str or path-like
        An image is a dataset, a png, jpg, tif or bmp file, or an array whose first row is at the top. The array has the
        shape #rows x #columns for alpha alone (0 to 1, bool, or unsigned integers), or #rows x #columns x 4 with alpha
        as the last component. The shape is the part where alpha is at least 0.5; without alpha it is the whole image.
        Curves are a dataset or mesh file with lines or polygons in a plane z = const, or arrays (points #V x 2 or x 3,
        segments #E x 2), counter-clockwise around the inside.
    handles : vtkPolyData, str or path-like, optional
        Handle dataset or file: points become points of the mesh, bones become chains of edges.
    {options}
    threads, progress, progress_bar
        See `winding_number`.

    Returns
    -------
    PlanarShape or vtkPolyData
        Arrays for arrays. A dataset has the point arrays ``TCoords`` (texture coordinates) and ``OriginalPointIds``
        and the cell array ``WindingNumber``.

    Raises
    ------
    InvalidInput
        An image that is transparent everywhere, curves that enclose nothing or are not in a plane.
    Unavailable
        The meshing program is missing; the message names the packages.

    See Also
    --------
    tetrahedralize : Fill the inside of a surface with tets.

    Examples
    --------
    >>> corners, edges = [[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1], [1, 2], [2, 3], [3, 0]]
    >>> shape = bindpose.planar_shape((corners, edges))
    >>> float(shape.vertices.max()), shape.triangles.shape[1]
    (1.0, 3)
    """
    data, as_arrays = image_or_curves, False
    if isinstance(data, (str, os.PathLike)):
        data = read_image(data) if is_image_file(data) else read(data)
    elif isinstance(data, np.ndarray):
        data, as_arrays = to_image(data), True
    elif not is_dataset(data):
        data, as_arrays = to_curves(data), True
    if not data.IsA("vtkImageData") and not data.IsA("vtkPolyData"):
        raise InvalidInput(f"expected an image or curves (got a {data.GetClassName()})")
    shaper = filters.vtkPlanarShape()
    shaper.SetInputData(0, data)
    if handles is not None:
        shaper.SetInputData(1, to_handles(handles, data))
    options.apply(shaper, "planar_shape")
    shaper.SetNumberOfThreads(threads)
    report = run(shaper, progress)
    result = shaper.GetOutput()
    if not as_arrays:
        return result
    return PlanarShape(points_of(result), triangles_of(result), point_array(result, "TCoords"),
                       point_array(result, "OriginalPointIds"), report)


def _make_weights(method):
    if method == "bounded-biharmonic":
        return filters.vtkBoundedBiharmonicWeights()
    if method == "monotone":
        return filters.vtkMonotoneWeights()
    result = filters.vtkUnconstrainedWeights()
    result.SetMethod(method)
    return result


def _set_arrays(solver, data, options, mirror):
    """Set the array options of a solver. Return a copy of the mesh; arrays that the caller passed as values are added
    to it."""
    named = shallow_copy(data)
    if isinstance(mirror, str) and mirror in ("x", "y", "z"):
        low, high = np.reshape(data.GetBounds(), (3, 2)).T
        solver.SetMirrorNormal(*(float(mirror == axis) for axis in "xyz"))
        solver.SetMirrorOrigin(*(0.5 * (low + high)))
        mirror = None
    given = list(options.arrays())
    if mirror is not None:
        given.append(({"name": "mirror", "setter": "SetMirrorArrayName", "array": "SymmetricPoint", "integers": True}, mirror))
    for option, values in given:
        if isinstance(values, str):
            if data.GetPointData().GetArray(values) is None:
                raise InvalidInput(f"{option['name']}: the mesh has no point array {values!r}")
            getattr(solver, option["setter"])(values)
            continue
        values = np.asarray(values, dtype=np.int64 if option["integers"] else float)
        if len(values) != data.GetNumberOfPoints():
            raise InvalidInput(f"{option['name']} has {len(values)} rows; expected {data.GetNumberOfPoints()}, one per point")
        add_point_array(named, option["array"], values)
    return named


@with_options("weights_method", "bounded_weights", "weights", "weight_terms", without=("bounds",))
def weights(mesh: Mesh, handles: Handles, *, bounds: tuple[float, float] | Mapping[str, tuple[float, float]] = (0, 1),
            mirror: str | ArrayLike | None = None, options, threads: int = 0, progress: Progress = None) -> Any:
    """Compute smooth weights, one function per handle, at the mesh's own points.

    Parameters
    ----------
    mesh : vtkDataSet or (vertices, elements)
        A surface or tets.
    handles : vtkPolyData, str or path-like
        A handle dataset (see `bindpose.handles`), a .tgf or .vtp file, "auto:N" for N points
        spread over the surface, or "skeleton:N" for at most N bones in it (`automatic_handles`).
    bounds : (float, float) or dict of handle name to (float, float)
        Smallest and largest weight, either for all handles or per handle. The range must include 0 to 1. Without a
        dict, the cell array ``WeightBounds`` of the handles is used, if it exists.
    mirror : {"x", "y", "z"}, str or array_like (#V,) of int, optional
        Handles that are mirror images get mirrored weights. "x", "y" and "z" mean the plane through the middle of the
        bounding box, perpendicular to this axis. Otherwise, an array (or the name of a point array) that contains the
        id of the mirror image of each point; -1: none.
    {options}
    threads, progress, progress_bar
        See `winding_number`.

    Returns
    -------
    Array or vtkDataSet
        For arrays: (#V, #handles), with the handle of each column in ``names``. For a dataset: a copy of the mesh with
        the point array ``Weights``, one component per handle. Rows sum to one.

    Raises
    ------
    InvalidInput
        A mesh or handles that cannot be used; the message names the first cause.
    BindposeError
        Not enough memory; the message states the needed and available amounts.

    Warns
    -----
    NotConvergedWarning
        A column's certificate is above the tolerance; the result is kept.
    BindposeWarning
        A handle is outside, the domain that ``auto`` chose failed and a lattice was used instead, or the weights of
        two lattices differ.

    Notes
    -----
    Jacobson, Baran, Popović, Sorkine, "Bounded biharmonic weights for real-time deformation", 2011;
    Jacobson, Weinkauf, Sorkine, "Smooth shape-aware functions with controlled extrema", 2012.

    Examples
    --------
    >>> tetrahedron = ([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
    ...                [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    >>> ends = bindpose.handles(points=[[0, 0, 0], [1, 0, 0]])
    >>> values = bindpose.weights(tetrahedron, ends, domain="surface")
    >>> values.names
    ['p1', 'p2']
    >>> values[:2].round(6).tolist()
    [[1.0, 0.0], [0.0, 1.0]]
    """
    data = to_dataset(mesh)
    handle_data = to_handles(handles, data)
    if is_tets(data) and options.domain == "surface":
        raise InvalidInput("domain 'surface' needs a surface, but the mesh contains tets")
    solver = _make_weights(options.method)
    if options.method in ("bounded-biharmonic", "monotone"):
        options.apply(solver, "bounded_weights", "weight_terms")
    elif mirror is not None or isinstance(bounds, Mapping) or tuple(bounds) != (0, 1):
        raise InvalidInput(f"mirror and bounds are not used by method {options.method!r} "
                           "(used by bounded-biharmonic and monotone)")
    options.apply(solver, "weights")
    solver.SetInputData(1, handle_data)
    if isinstance(bounds, Mapping):
        handle_data = with_cell_values(handle_data, "WeightBounds", bounds, 2, missing=(np.nan, np.nan))
        solver.SetInputData(1, handle_data)
    else:
        solver.SetBounds(*map(float, bounds))
    solver.SetInputData(0, _set_arrays(solver, data, options, mirror))
    solver.SetNumberOfThreads(threads)
    report = run(solver, progress)
    result = solver.GetOutput()
    # The solver may have added points at handles, so transfer the weights to the points of the input.
    if is_tets(data) or options.domain == "surface":
        transfer = filters.vtkTransferWeights()
        transfer.SetInputData(0, data)
        transfer.SetInputData(1, result)
        transfer.SetNumberOfThreads(threads)
        report = {**run(transfer), **report}
        result = transfer.GetOutput()
    result = shallow_copy(result)
    copy_report(solver.GetOutput(), result)
    if is_dataset(mesh):
        return result
    return weights_of(result, "Weights", report)


def posed_handles(mesh, handles, pose, weights):
    """Return two values: the mesh as a dataset with its weights, and the filter that poses the handles."""
    data = with_weights(to_dataset(mesh), weights)
    return data, make_poser(to_handles(handles, data), pose)


def pose_text(pose):
    """Return a pose as the text of a pose file. The pose may contain numbers and arrays of numpy."""
    def plain(value):
        if isinstance(value, (np.ndarray, np.generic)):
            return value.tolist()
        raise TypeError(f"{type(value).__name__} is not allowed in a pose")

    if isinstance(pose, Mapping):
        pose = {"version": 2, **pose}
    try:
        return json.dumps(pose, default=plain)
    except (TypeError, ValueError) as error:
        raise InvalidInput(f"the pose must be a JSON object: {error}") from None


def make_poser(handles, pose):
    """Return the filter that poses a handle dataset."""
    poser = filters.vtkPoseHandles()
    poser.SetInputData(0, handles)
    if isinstance(pose, (str, os.PathLike)):
        poser.SetFileName(os.fspath(pose))
    else:
        poser.SetPoseJSON(pose_text(pose))
    return poser


@with_options("dynamics", "arap", "reduced_arap_bind", "rotation_arrays", without=("maximum_iterations", "tolerance"))
def dynamics(mesh: Mesh, handles: Handles, pose: Mapping[str, Any] | Path, *, frames: int,
             weights: ArrayLike | None = None, options, threads: int = 0, progress: Progress = None) -> list[Any]:
    """Move a mesh as a body with mass: parts that handles do not constrain swing and fall.

    Parameters
    ----------
    mesh, handles, weights
        See `deform`.
    pose : dict, str or path-like
        See `deform`. A sequence prescribes the motion at the times of its frames. A pose with expressions in ``t``
        prescribes the motion at all times. Any other pose is constant. A handle that changes to mode ``free`` stops
        constraining the body.
    frames : int
        Number of time steps to return; the first is the pose at time 0 without velocity.
    {options}
    threads, progress, progress_bar
        See `winding_number`.

    Returns
    -------
    list of Array or of vtkDataSet
        One result per step, of the type that `deform` returns.

    Raises
    ------
    InvalidInput
        Weights that do not match, an invalid pose, numbers out of range.

    Examples
    --------
    >>> tetrahedron = ([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
    ...                [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    >>> ends = bindpose.handles(points=[[0, 0, 0], [1, 0, 0]])
    >>> values = bindpose.weights(tetrahedron, ends, domain="surface")
    >>> released = {"handles": {"p2": {"mode": "free"}}}
    >>> steps = bindpose.dynamics(tetrahedron, ends, released, frames=3, weights=values)
    >>> len(steps), steps[2].shape
    (3, (4, 3))
    """
    data, poser = posed_handles(mesh, handles, pose, weights)
    body = filters.vtkReducedDynamics()
    options.apply(body, "arap", "reduced_arap_bind", "dynamics", "rotation_arrays")
    body.SetInputData(0, data)
    body.SetInputConnection(1, poser.GetOutputPort())
    body.SetNumberOfThreads(threads)
    run(poser)
    results = []
    for frame in range(frames):
        body.SetStep(frame)
        report = run(body, progress)
        posed = body.GetOutput()
        results.append(shallow_copy(posed) if is_dataset(mesh) else Array(points_of(posed), report))
    return results
