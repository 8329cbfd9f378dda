"""Many posed instances of a mesh."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet

from . import BindposeFilters as filters
from .errors import InvalidInput
from .functions import make_poser, posed_handles
from .meshes import Array, copy_report, is_dataset, points_of, shallow_copy
from .options import with_options
from .parameter_types import Handles, Mesh, Path, Progress
from .running import run


def _placement(place):
    """Return a placement (a translation, a 3x4 or a 4x4 matrix) as a 3x4 array."""
    place = np.asarray(place, dtype=float)
    if place.shape == (3,):
        return np.column_stack([np.eye(3), place])
    if place.shape in ((3, 4), (4, 4)):
        return place[:3]
    raise InvalidInput(f"a placement must be a translation, a 3x4 or a 4x4 matrix (got an array of shape {place.shape})")


@with_options("arap", "reduced_arap_bind")
def crowd(mesh: Mesh, handles: Handles, poses: Mapping[str, Any] | Path | Sequence[Mapping[str, Any] | Path], *,
          placements: Sequence[Any] | None = None, weights: ArrayLike | None = None, appended: bool = False, options,
          threads: int = 0, progress: Progress = None) -> Any:
    """Bend many instances of a mesh, each to its own pose, by reduced as-rigid-as-possible deformation.

    The mesh is bound once. Each instance takes the time of its own iterations and the memory of its points in single
    precision.

    Parameters
    ----------
    mesh, handles, weights
        See `deform`.
    poses : list of poses, or one pose
        Dicts or files, see `deform`: one instance per pose, or per frame of ``{"frames": [...]}``.
    placements : sequence, optional
        Position of each instance: translations, 3x4 or 4x4 matrices, applied to the posed mesh.
    appended : bool
        For a dataset: return all instances in one dataset, with the point array ``Instance``.
    {options}
    threads, progress, progress_bar
        See `winding_number`.

    Returns
    -------
    list of Array or of vtkDataSet, or vtkDataSet
        One result per instance, of the type that `deform` returns; the datasets share cells and arrays. With
        `appended`, one dataset.

    Raises
    ------
    InvalidInput
        As in `deform`; the message names the instance. Also, the numbers of placements and poses differ.

    Notes
    -----
    For a moving crowd keep a ``vtkCrowdDeformation``: it is bound once, and each instance starts from its last pose.

    Examples
    --------
    >>> tetrahedron = ([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
    ...                [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    >>> ends = bindpose.handles(points=[[0, 0, 0], [1, 0, 0]])
    >>> values = bindpose.weights(tetrahedron, ends, domain="surface")
    >>> poses = [{"handles": {"p1": {"translate": [0, 0, height]}}} for height in (0, 1)]
    >>> instances = bindpose.crowd(tetrahedron, ends, poses, weights=values, placements=[[0, 0, 0], [5, 0, 0]])
    >>> [len(points) for points in instances]
    [4, 4]
    """
    data, posed = posed_handles(mesh, handles, {"handles": {}}, weights)
    rest = posed.GetInputDataObject(0, 0)
    instances = vtkMultiBlockDataSet()
    for pose in [poses] if isinstance(poses, (Mapping, str, os.PathLike)) else poses:
        poser = make_poser(rest, pose)
        run(poser)
        for frame in range(poser.GetNumberOfFrames()):
            poser.SetFrame(frame)
            run(poser)
            instances.SetBlock(instances.GetNumberOfBlocks(), shallow_copy(poser.GetOutput()))
    count = instances.GetNumberOfBlocks()
    if placements is not None:
        if len(placements) != count:
            raise InvalidInput(f"placements has {len(placements)} entries; expected {count}, one per instance")
        for k, place in enumerate(placements):
            array = numpy_to_vtk(np.ascontiguousarray(_placement(place).reshape(1, 12)), deep=True)
            array.SetName("Placement")
            instances.GetBlock(k).GetFieldData().AddArray(array)
    bender = filters.vtkCrowdDeformation()
    options.apply(bender, "arap", "reduced_arap_bind")
    bender.SetOutputType(bender.APPENDED if appended and is_dataset(mesh) else bender.COLLECTION)
    bender.SetNumberOfThreads(threads)
    bender.SetInputData(0, data)
    bender.SetInputData(1, rest)
    bender.SetInputData(2, instances)
    report = run(bender, progress)
    result = bender.GetOutput()
    if appended and is_dataset(mesh):
        return result
    posed = [result.GetPartition(k, 0) for k in range(count)]
    if not is_dataset(mesh):
        return [Array(points_of(one), report) for one in posed]
    for one in posed:
        copy_report(result, one)
    return posed
