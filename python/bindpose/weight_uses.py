"""Transfer weights, use weights for colors and depth, compute endpoint weights, and cut planar meshes along bones."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from numpy.typing import ArrayLike
from vtkmodules.vtkCommonDataModel import vtkPolyData

from . import BindposeFilters as filters
from .errors import InvalidInput
from .handle_sets import to_handles, with_cell_values
from .meshes import Array, is_dataset, point_array, to_dataset, weights_of, with_weights
from .options import with_options
from .parameter_types import Handles, Mesh, Progress
from .running import run


def _inputs(mesh, handles, weights, array_name):
    data = with_weights(to_dataset(mesh), weights, array_name)
    return data, to_handles(handles, data)


@with_options("transfer_weights")
def transfer_weights(target: Mesh, source: Mesh, *, weights: ArrayLike | None = None, array_name: str = "Weights", options,
                     threads: int = 0, progress: Progress = None) -> Any:
    """Transfer weights from one mesh to another, such as from a body to clothes.

    Parameters
    ----------
    target : vtkDataSet or (vertices, elements)
        The mesh that gets the weights.
    source : vtkDataSet or (vertices, elements)
        A dataset with weights, or arrays together with `weights`.
    weights : (#V, #handles) array, optional
        Weights of a source of arrays.
    array_name : str
        Point array of weights.
    {options}
    threads, progress, progress_bar
        See `winding_number`.

    Returns
    -------
    Array or vtkDataSet
        For a target of arrays: (#P, #handles). For a dataset: a copy of the target with the point arrays ``Weights``
        and, for method inpaint, ``Matched`` (1 for points that match the source, else 0).

    Raises
    ------
    InvalidInput
        No weights, or a mesh that has neither triangles nor tets.

    Warns
    -----
    NotConvergedWarning
        The certificate of a column is above the tolerance; the result is kept.
    BindposeWarning
        A connected part of the target has no matched point, or (method nearest) points are far from the source.

    Notes
    -----
    Abdrashitov, Raichstat, Monsen, Hill, "Robust skin weights transfer via weight inpainting", 2023.

    Examples
    --------
    >>> body = ([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]])
    >>> cloth = ([[0, 0, 0.01], [1, 0, 0.01], [1, 1, 0.01], [0, 1, 0.01]], [[0, 1, 2], [0, 2, 3]])
    >>> values = bindpose.transfer_weights(cloth, body, weights=[[1, 0], [0, 1], [0, 1], [1, 0]])
    >>> values.round(6).tolist()
    [[1.0, 0.0], [0.0, 1.0], [0.0, 1.0], [1.0, 0.0]]
    """
    transfer = filters.vtkTransferWeights()
    transfer.SetInputData(0, to_dataset(target))
    transfer.SetInputData(1, with_weights(to_dataset(source), weights, array_name))
    transfer.SetArrayName(array_name)
    options.apply(transfer, "transfer_weights")
    transfer.SetNumberOfThreads(threads)
    report = run(transfer, progress)
    result = transfer.GetOutput()
    return result if is_dataset(target) else weights_of(result, array_name, report)


@with_options("weighted_colors")
def weighted_colors(mesh: Mesh, handles: Handles, colors: ArrayLike | Mapping[str, Sequence[float]] | None = None, *,
                    weights: ArrayLike | None = None, array_name: str = "Weights", options, threads: int = 0,
                    progress: Progress = None) -> Any:
    """Blend the colors of the handles over a mesh by its weights.

    Parameters
    ----------
    mesh : vtkDataSet or (vertices, elements)
        A dataset with weights, or arrays together with `weights`.
    handles : vtkPolyData, str or path-like
        The handles for which the weights were computed.
    colors : (#handles, 3) array or dict, optional
        One color per handle, 0 to 1 (or unsigned bytes), or ``{name: (r, g, b)}``. Default: the handles' cell array
        ``Color``; without it each handle gets a color that differs clearly from the others.
    weights : (#V, #handles) array, optional
        Weights for a mesh of arrays.
    array_name : str
        Point array of weights, for example ``RawWeights``.
    {options}
    threads, progress, progress_bar
        See `winding_number`.

    Returns
    -------
    Array or vtkDataSet
        (#V, 3) colors from 0 to 1 for arrays; for a dataset a copy with the point arrays ``Color`` (bytes for
        display), ``ColorValues`` and ``OutOfGamut``. The report counts the points outside the gamut
        (``counts.out_of_gamut``) and outside the range of the handles' colors (``counts.beyond_handles``).

    Raises
    ------
    InvalidInput
        Weights or colors that do not match.

    Examples
    --------
    >>> square = ([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.5, 0.5, 0]],
    ...           [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])
    >>> ends = bindpose.handles(points=[[0, 0, 0], [1, 0, 0]])
    >>> values = bindpose.weights(square, ends, domain="surface")
    >>> colors = bindpose.weighted_colors(square, ends, {"p1": (1, 0, 0), "p2": (0, 0, 1)}, weights=values)
    >>> colors[:2].round(6).tolist()
    [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]
    """
    data, handle_data = _inputs(mesh, handles, weights, array_name)
    if colors is not None:
        handle_data = with_cell_values(handle_data, "Color", colors, 3)
    painter = filters.vtkWeightedColors()
    painter.SetInputData(0, data)
    painter.SetInputData(1, handle_data)
    painter.SetArrayName(array_name)
    options.apply(painter, "weighted_colors")
    painter.SetNumberOfThreads(threads)
    report = run(painter, progress)
    result = painter.GetOutput()
    return result if is_dataset(mesh) else Array(point_array(result, "ColorValues"), report)


@with_options("endpoint_weights")
def endpoint_weights(mesh: Mesh, handles: Handles, *, options, threads: int = 0, progress: Progress = None) -> Any:
    """Return the position of every point along each bone, from 0 at the head to 1 at the tail.

    Bones that stretch and twist use this position.

    Parameters
    ----------
    mesh : vtkDataSet or (vertices, elements)
        A surface or tets.
    handles : vtkPolyData, str or path-like
        Handles with bones among them.
    {options}
    threads, progress, progress_bar
        See `winding_number`.

    Returns
    -------
    Array or vtkDataSet
        For arrays: (#V, #handles), NaN for handles that are not bones. For a dataset: a copy with the point array
        ``EndpointWeights``, which ``deform(…, method="stbs")`` uses.

    Raises
    ------
    InvalidInput
        No bone; input that `weights` rejects.

    Examples
    --------
    >>> square = ([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.5, 0.5, 0]],
    ...           [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])
    >>> bone = bindpose.handles(bones=[[[0, 0, 0], [1, 0, 0]]])
    >>> bindpose.endpoint_weights(square, bone, method="projection")[:, 0].round(6).tolist()
    [0.0, 1.0, 1.0, 0.0, 0.5]
    """
    data = to_dataset(mesh)
    handle_data = to_handles(handles, data)
    solver = filters.vtkBoneEndpointWeights()
    solver.SetInputData(0, data)
    solver.SetInputData(1, handle_data)
    options.apply(solver, "endpoint_weights")
    solver.SetNumberOfThreads(threads)
    report = run(solver, progress)
    result = solver.GetOutput()
    return result if is_dataset(mesh) else weights_of(result, "EndpointWeights", report)


@with_options("depth_order")
def depth_order(mesh: Mesh, handles: Handles, layers: Sequence[float] | Mapping[str, float] | None = None, *,
                weights: ArrayLike | None = None, array_name: str = "Weights", options, threads: int = 0,
                progress: Progress = None) -> Any:
    """Compute the depth of a planar shape from its handles' layers, for poses that overlap themselves.

    Parameters
    ----------
    mesh : vtkDataSet or (vertices, elements)
        A dataset with weights, usually posed; or arrays together with `weights`.
    handles : vtkPolyData, str or path-like
        The handles for which the weights were computed.
    layers : sequence or dict, optional
        One number per handle; larger is in front. Handles whose name is not in the dict have layer 0. Default: the
        handles' cell array ``Layer``, else all 0.
    weights, array_name
        See `weighted_colors`.
    {options}
    threads, progress, progress_bar
        See `winding_number`.

    Returns
    -------
    Array or vtkDataSet
        (#V,) depths for arrays; for a dataset a copy with the point array ``Depth``.

    Raises
    ------
    InvalidInput
        Weights or layers that do not match.

    Examples
    --------
    >>> square = ([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.5, 0.5, 0]],
    ...           [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])
    >>> ends = bindpose.handles(points=[[0, 0, 0], [1, 0, 0]])
    >>> values = bindpose.weights(square, ends, domain="surface")
    >>> bindpose.depth_order(square, ends, [0, 1], weights=values)[:2].round(6).tolist()
    [0.0, 1.0]
    """
    data, handle_data = _inputs(mesh, handles, weights, array_name)
    if layers is not None:
        handle_data = with_cell_values(handle_data, "Layer", layers, 1)
    order = filters.vtkDepthOrder()
    order.SetInputData(0, data)
    order.SetInputData(1, handle_data)
    order.SetArrayName(array_name)
    options.apply(order, "depth_order")
    order.SetNumberOfThreads(threads)
    report = run(order, progress)
    result = order.GetOutput()
    return result if is_dataset(mesh) else Array(point_array(result, "Depth"), report)


@with_options()
def cut_along_bones(shape: Mesh, handles: Handles, left: ArrayLike | Mapping[str, Sequence[float]] | None = None,
                    right: ArrayLike | Mapping[str, Sequence[float]] | None = None, *,
                    curves: Sequence[int] | Mapping[str, int] | None = None,
                    progress: Progress = None) -> tuple[vtkPolyData, vtkPolyData]:
    """Cut a planar mesh along bones and create a handle for each side: curves with two colors.

    Parameters
    ----------
    shape : vtkPolyData or (vertices, triangles)
        In a plane z = const, with edges along the bones: see `planar_shape` and its `handles`.
    handles : vtkPolyData, str or path-like
        The mesh is cut along the bones. Left and right are as seen from head to tail. All other handles except cage
        elements are added to the result.
    left, right : (#handles, 3) array or dict, optional
        Colors of the bones' sides, one per handle or ``{name: (r, g, b)}``; give both or neither. Default: the
        handles' cell arrays ``LeftColor`` and ``RightColor``.
    curves : sequence of int or dict, optional
        One number per handle: bones with the same number are one curve, with the colors of its first bone. Default:
        the handles' cell array ``Curve``; without it each bone is a curve.
    progress, progress_bar
        See `winding_number`.

    Returns
    -------
    shape, handles : vtkPolyData
        The cut mesh, whose array ``RegionId`` labels each side, and the region handles ``NAME left`` and ``NAME right``
        with their ``Color``. Both can be passed to `weights` (``domain="surface"``) and `weighted_colors`.

    Raises
    ------
    InvalidInput
        A bone that is not a chain of edges of the mesh; the message names it.

    Examples
    --------
    >>> square = ([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.5, 0.5, 0]],
    ...           [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])
    >>> diagonal = bindpose.handles(bones=[[[0, 0, 0], [1, 1, 0]]])
    >>> cut, sides = bindpose.cut_along_bones(square, diagonal, left=[[1, 0, 0]], right=[[0, 0, 1]])
    >>> sides.GetNumberOfCells()
    2
    """
    data = to_dataset(shape)
    handle_data = to_handles(handles, data)
    for array_name, values in (("LeftColor", left), ("RightColor", right)):
        if values is not None:
            handle_data = with_cell_values(handle_data, array_name, values, 3)
    if curves is not None:
        handle_data = with_cell_values(handle_data, "Curve", curves, 1)
    knife = filters.vtkCutAlongBones()
    knife.SetInputData(0, data)
    knife.SetInputData(1, handle_data)
    run(knife, progress)
    return knife.GetOutput(0), knife.GetOutput(1)
