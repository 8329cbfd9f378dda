"""Rigs: a mesh with weights and its handles, bound once and posed many times."""

from __future__ import annotations

import json
import os
import threading
from collections.abc import Mapping, Sequence
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray
from vtkmodules.util import numpy_support
from vtkmodules.vtkCommonCore import vtkIdList, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkDataSet, vtkPolyData

from . import BindposeFilters as filters
from .errors import BindposeWarning, InvalidInput
from .files import read_handles
from .functions import make_poser, pose_text, weights
from .handle_sets import cell_names, handle_cells, to_handles
from .meshes import (
    Array,
    is_dataset,
    like,
    points_of,
    remember_run,
    run_of,
    shallow_copy,
    to_dataset,
    weights_of,
    with_weights,
)
from .options import checked_options, with_options
from .parameter_types import Handles, Mesh, Path, Progress
from .running import check_status, interruptible, report, run, warn


class Rig:
    """A mesh with weights and its handles. `bind` and `read_rig` create rigs.

    A pose method is prepared by the first pose that uses it; all later poses only solve and move the points. If a handle is
    moved at rest, the methods are prepared again, and a warning says that the weights are out of date. Several threads may
    use a rig; their poses are computed one after another.

    Parameters
    ----------
    mesh : vtkDataSet or (vertices, elements)
        A dataset with the point array ``Weights``, one component per handle, or arrays together with `weights`. The rig
        copies the points.
    handles : vtkPolyData, str or path-like
        The handles for which the weights were computed.
    weights : (#V, #handles) array, optional
        Weights for a mesh of arrays.
    animation : dict, optional
        A sequence of poses, as in a pose file.

    Attributes
    ----------
    animation : dict or None
        The sequence of poses in the file of the rig, for `deform`.

    Examples
    --------
    >>> tetrahedron = ([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
    ...                [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    >>> values = [[1, 0], [0, 1], [0.5, 0.5], [0.5, 0.5]]  # weights from another program
    >>> rig = bindpose.Rig(tetrahedron, bindpose.handles(points=[[0, 0, 0], [1, 0, 0]]), weights=values)
    >>> rig.pose({"p1": {"translate": [0, 0, 1]}})[2].tolist()
    [0.0, 1.0, 0.5]
    """

    animation: dict[str, Any] | None

    def __init__(self, mesh: Mesh, handles: Handles, *, weights: ArrayLike | None = None,
                 animation: dict[str, Any] | None = None) -> None:
        data = to_dataset(mesh)
        self._mesh = like(data, with_weights(shallow_copy(data), weights))
        if weights is not None:
            remember_run(self._mesh, getattr(weights, "report", {}))
        if data.GetPoints() is not None:
            points = vtkPoints()
            points.SetDataType(data.GetPoints().GetDataType())  # the default is single precision
            points.DeepCopy(data.GetPoints())
            self._mesh.SetPoints(points)
        self._handles = to_handles(handles, data)
        self.animation = animation
        self._gives_arrays = not is_dataset(mesh)
        self._methods = {}
        # The last two arrays that callers passed as `out`. Key: address of the array's memory; value: the array and a
        # VTK array that uses the same memory.
        self._outputs = {}
        self._last = None  # the filter of the last pose
        self._rest = _rest_points(self._handles)
        self._rest_time = self._handles.GetPoints().GetMTime() if len(self._rest) else 0
        self._warned = False
        self._lock = threading.Lock()

    @property
    def mesh(self) -> Any:
        """The mesh at rest with the point array ``Weights``."""
        return self._mesh

    @property
    def handles(self) -> vtkPolyData:
        """The handle dataset: one cell per handle, and cells of cages and pseudo-edges."""
        return self._handles

    @property
    def weights(self) -> Array:
        """The weights, (#V, #handles), with the handle of each column in ``names``."""
        if self._mesh.GetPointData().GetArray("Weights") is None:
            raise InvalidInput("the mesh of the rig has no point array 'Weights'")
        return weights_of(self._mesh, "Weights", self.report)

    @property
    def report(self) -> dict[str, Any]:
        """The report of the weights: certificates, counts and seconds; see `bindpose.report`."""
        return run_of(self._mesh) or report(self._mesh)

    @property
    def extrema(self) -> dict[str, int]:
        """Dict of handle name to the number of local extrema of its weights away from the handles."""
        return {entry["name"]: entry["interior_extrema"] for entry in self.report.get("handles", [])
                if "interior_extrema" in entry}

    @property
    def number_of_binds(self) -> int:
        """Number of times that pose methods were prepared.

        Each method is prepared once, and again after a bind option or the rest pose has changed.
        """
        return sum(method.filter.GetNumberOfBinds() for method in self._methods.values())

    @property
    def pose_report(self) -> dict[str, Any]:
        """The report of the last pose: status, iterations, energy, seconds per phase."""
        return json.loads(self._last.GetReportJSON()) if self._last else {}

    @property
    def moved_handles(self) -> list[str]:
        """Names of the handles that were moved at rest since the weights were computed."""
        points = self._handles.GetPoints()
        if points and points.GetMTime() == self._rest_time:
            return []
        rest = _rest_points(self._handles)
        if rest.shape != self._rest.shape:
            return [name for name in cell_names(self._handles) if name]
        changed = (rest != self._rest).any(axis=1)
        moved, ids = [], vtkIdList()
        for cell, name in enumerate(cell_names(self._handles)):
            self._handles.GetCellPoints(cell, ids)
            if name and any(changed[ids.GetId(k)] for k in range(ids.GetNumberOfIds())):
                moved.append(name)
        return moved

    @with_options("pose_method", "skinning", "arap", "time_budget", "reduced_arap_bind", "moving_least_squares", "variational")
    def pose(self, pose: Mapping[str, Any] | str | ArrayLike, *, out: NDArray[np.float64] | vtkDataSet | None = None,
             threads: int = 0, **options: Any) -> Any:
        """Return the mesh in a pose.

        The first pose of a method prepares the method and has the same bits as the result of `deform`. As-rigid-as-possible
        methods start each later pose from the last one, so that a drag needs few iterations. Both results satisfy
        `tolerance`, but their bits differ. All other methods always have the bits of `deform`.

        Parameters
        ----------
        pose : dict, str or (#handles, 3, 4) array
            ``{name: {"translate": [x, y, z], "rotate": {"axis": [x, y, z], "degrees": d}, …}}``, or the content of a
            pose file with one pose, as a dict or as text; see `deform`. An array contains one affine map per handle,
            from rest to posed positions, which replaces the handle's pose.
        out : (#V, 3) array of float or vtkDataSet, optional
            Destination: an array, or a dataset from an earlier call. It is returned. The points are written into its
            memory, so repeated poses create no new points. The rig keeps the last two arrays. After an exception the
            contents are undefined.
        threads : int
            0 for all cores; the result does not depend on it.
        {options}

        Returns
        -------
        (#V, 3) array of float or vtkDataSet
            Posed coordinates, or a copy of the mesh at posed points. The copy has no point normals, because those of the
            mesh belong to its rest pose.

        Raises
        ------
        InvalidInput
            An unknown handle, a pose that is not valid, an `out` of a wrong type or size.
        TypeError
            An unknown option.
        KeyboardInterrupt
            After Ctrl-C, which cancels the preparation of a method.

        Warns
        -----
        NotConvergedWarning
            The iterations ended above the tolerance; the result is kept.
        BindposeWarning
            A warning of the method, or weights that are out of date (once per rig).

        Examples
        --------
        >>> tetrahedron = ([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
        ...                [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
        >>> rig = bindpose.bind(tetrahedron, bindpose.handles(points=[[0, 0, 0], [1, 0, 0]]), domain="surface")
        >>> out = rig.pose({})
        >>> for height in (0.5, 1):
        ...     rig.pose({"p1": {"translate": [0, 0, height]}}, out=out)[0].tolist()
        [0.0, 0.0, 0.5]
        [0.0, 0.0, 1.0]
        >>> rig.number_of_binds
        1
        """
        with self._lock:
            method = self._method(options)
            result, points = self._destination(out)
            posed = method.pose(pose, points, threads)
            self._last = method.filter
            if not posed or method.filter.GetStatus() or method.filter.GetNumberOfWarnings():
                check_status(method.filter, self.pose_report)
            if not self._warned and self.moved_handles:
                self._warned = True
                warn(f"these handles were moved since the weights were computed: {', '.join(self.moved_handles)}; "
                     "compute the weights again by bindpose.bind()", BindposeWarning)
            return result

    def save(self, path: Path, *, frames: Sequence[Mapping[str, Any] | vtkDataSet] = (), fps: float | None = None,
             animation: Literal["joints", "morph"] = "joints", maximum_influences: int = 0,
             asset: Path | None = None, overwrite: bool = False) -> dict[str, Any]:
        """Write the rig as a skinned glTF 2.0 file.

        Parameters
        ----------
        path, animation, maximum_influences, asset, overwrite
            See `write_rig`.
        frames : sequence of dict or of vtkDataSet
            The frames of an animation: poses as in `pose`, or results of `deform`. Without frames, the animation of the
            rig is written.
        fps : float, optional
            Frames per second. Default: those of the animation of the rig, else 24.

        Returns
        -------
        dict
            See `write_rig`.

        Examples
        --------
        >>> tetrahedron = ([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
        ...                [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
        >>> rig = bindpose.bind(tetrahedron, bindpose.handles(points=[[0, 0, 0], [1, 0, 0]]), domain="surface")
        >>> rig.save("tetrahedron.glb", frames=[{"p1": {"translate": [0, 0, height]}} for height in (0, 1)])["status"]
        'ok'
        """
        if frames and all(isinstance(frame, Mapping) for frame in frames):
            frames = deform(self._mesh, self._handles, {"frames": [_content(frame) for frame in frames]})
        elif not frames and self.animation:
            frames = deform(self._mesh, self._handles, self.animation)
            fps = fps or self.animation.get("fps")
        return write_rig(self._mesh, self._handles, path, frames=frames, fps=fps or 24.0, animation=animation,
                         maximum_influences=maximum_influences, asset=asset, overwrite=overwrite)

    def _method(self, options):
        """Return the prepared method with these options. Its filter binds again only if a bind option has changed."""
        try:
            name = options.get("method", "lbs")
            method = self._methods.get(name)
        except TypeError:
            name, method = None, None  # the name is not hashable; checked_options() below raises the error
        if method is None or method.given != options:
            checked = checked_options(options, *Rig.pose.option_sets)
            if method is None:
                method = self._methods[checked.method] = _Method(self, checked)
            else:
                method.set_options(checked)
            method.given = dict(options)
        return method

    def _destination(self, out):
        """Return the object for the posed points (`out`, or a new dataset or array), and a VTK array of its points."""
        count = self._mesh.GetNumberOfPoints()
        if out is None and not self._gives_arrays:
            result = like(self._mesh, shallow_copy(self._mesh))
            result.GetPointData().SetNormals(None)
            for k in reversed(range(result.GetFieldData().GetNumberOfArrays())):
                if (result.GetFieldData().GetArrayName(k) or "").startswith("Report."):
                    result.GetFieldData().RemoveArray(k)
            remember_run(result, {})
            points = vtkPoints()
            points.SetDataTypeToDouble()
            points.SetNumberOfPoints(count)
            result.SetPoints(points)
            return result, points.GetData()
        if is_dataset(out):
            points = out.GetPoints() if hasattr(out, "GetPoints") else None
            if points is None or points is self._mesh.GetPoints() or out.GetNumberOfPoints() != count or \
                    not points.GetData().IsA("vtkDoubleArray"):
                raise InvalidInput("out must be a dataset that an earlier call of pose() returned")
            points.Modified()
            return out, points.GetData()
        if out is None:
            out = np.empty((count, 3))
            return out, numpy_support.numpy_to_vtk(out)
        if not isinstance(out, np.ndarray) or out.shape != (count, 3) or out.dtype != np.float64 or \
                not out.flags.c_contiguous or not out.flags.writeable:
            raise InvalidInput(f"out must be a writeable contiguous array {count} x 3 of float64, or a dataset from pose()")
        address = out.ctypes.data
        known = self._outputs.get(address)
        if known is None or known[0] is not out:
            arrays = [self._mesh.GetPoints().GetData(), self._mesh.GetPointData().GetArray("Weights")]
            if any(np.shares_memory(out, numpy_support.vtk_to_numpy(array)) for array in arrays if array is not None):
                raise InvalidInput("out must be an array that shares no memory with the mesh of the rig")
            if len(self._outputs) > 1:
                self._outputs.pop(next(iter(self._outputs)))
            known = self._outputs[address] = (out, numpy_support.numpy_to_vtk(out))
        return known


class _Method:
    """A pose method with its options, prepared for a rig."""

    def __init__(self, rig, options):
        self.filter = _make_deformation(options)
        self.given = {}  # the options as the caller wrote them
        self._source = rig.handles
        self._source_time = 0
        self._handles = None
        self._has_array = False  # whether the last pose was an array
        self._is_prepared = False
        # With these methods even a prepared pose can take seconds to compute, so Ctrl-C must cancel every pose.
        self._is_slow = options.method in ("full-arap", "variational")
        self.filter.SetInputData(0, rig.mesh)

    def set_options(self, options):
        _apply_options(self.filter, options)
        self._is_prepared = False

    def pose(self, pose, points, threads):
        if self._source_time != self._source.GetMTime():
            self._source_time = self._source.GetMTime()
            self._handles = shallow_copy(self._source)
            self._has_array = False
            self._is_prepared = False
            self.filter.SetInputData(1, self._handles)
        self.filter.SetNumberOfThreads(threads)
        if isinstance(pose, (Mapping, str)):
            if self._has_array:
                self._restore_transforms()
            text = _text(pose)
        else:
            self._set_transforms(pose)
            text = ""
        if self._is_prepared and not self._is_slow:
            return self.filter.PosePoints(text, points)
        with interruptible(self.filter):
            self._is_prepared = self.filter.PosePoints(text, points)
        return self._is_prepared

    def pose_dataset(self, posed_handles, threads, progress):
        """Return a posed copy of the rig's mesh with all arrays that the method attaches, and the report."""
        self._source_time = 0  # pose() must connect the handles of the rig again
        self.filter.SetInputData(1, posed_handles)
        self.filter.SetNumberOfThreads(threads)
        pose_report = run(self.filter, progress)
        return shallow_copy(self.filter.GetOutput()), pose_report

    def _restore_transforms(self):
        """Replace the transforms of the last array pose by the transforms of the rig's handle dataset."""
        data = self._handles.GetCellData()
        own = self._source.GetCellData().GetArray("Transform")
        self._has_array = False
        data.RemoveArray("Transform")
        if own is not None:
            data.AddArray(own)

    def _set_transforms(self, values):
        """Set the transforms of all handles from an array pose."""
        try:
            values = np.asarray(values, dtype=float)
        except (TypeError, ValueError):
            values = np.zeros(0)
        cells = handle_cells(self._handles)
        count = len(cells)
        if values.shape not in ((count, 3, 4), (count, 12)):
            raise InvalidInput(f"a pose must be a dict, a text, or an array {count} x 3 x 4 of one affine map per handle")
        maps = np.tile(np.eye(3, 4).ravel(), (self._handles.GetNumberOfCells(), 1))
        maps[cells] = values.reshape(count, 12)
        array = numpy_support.numpy_to_vtk(maps, deep=True)
        array.SetName("Transform")
        self._handles.GetCellData().AddArray(array)
        self._has_array = True


def _make_deformation(options):
    """Return the filter of a method, with the options that the method uses."""
    kind = {"variational": filters.vtkVariationalSurface, "reduced-arap": filters.vtkReducedARAP, "full-arap": filters.vtkFullARAP,
            "mls": filters.vtkMovingLeastSquaresWarp}.get(options.method, filters.vtkSkinningDeformation)
    result = kind()
    _apply_options(result, options)
    return result


def _apply_options(deformation, options):
    """Pass the options of a method to its filter."""
    sets = {"variational": ("variational",), "mls": ("moving_least_squares",), "full-arap": ("arap", "rotation_arrays"),
            "reduced-arap": ("arap", "rotation_arrays", "time_budget", "reduced_arap_bind")}
    options.apply(deformation, *sets.get(options.method, ("pose_method", "skinning")))


def _rest_points(handles):
    points = handles.GetPoints()
    return np.array(numpy_support.vtk_to_numpy(points.GetData())) if points else np.zeros((0, 3))


def _content(pose):
    """Return a pose as a dict with the content of a pose file. `pose` is either this content or a dict of handle name
    to handle pose."""
    return pose if "handles" in pose or "frames" in pose else {"handles": pose}


def _text(pose):
    """Return a pose as the text of a pose file. `pose` is either this text or a dict, as in `_content`."""
    if not isinstance(pose, str):
        return pose_text(_content(pose))
    if not pose.lstrip().startswith("{"):
        raise InvalidInput("a pose as a text must be the content of a pose file; deform() reads files")
    return pose


@with_options("weights_method", "bounded_weights", "weights", "weight_terms", without=("bounds",))
def bind(mesh: Mesh, handles: Handles, *, bounds: tuple[float, float] | Mapping[str, tuple[float, float]] = (0, 1),
         mirror: str | ArrayLike | None = None, threads: int = 0, progress: Progress = None, progress_bar: bool = False,
         **options: Any) -> Rig:
    """Compute weights of a mesh, once, and return a rig that can be posed many times.

    Parameters
    ----------
    mesh, handles, bounds, mirror, threads, progress, progress_bar
        See `weights`.
    {options}

    Returns
    -------
    Rig
        Its poses are arrays if the mesh is a pair of arrays, otherwise datasets.

    Raises
    ------
    InvalidInput, BindposeError
        See `weights`.

    Warns
    -----
    NotConvergedWarning, BindposeWarning
        See `weights`.

    Examples
    --------
    >>> tetrahedron = ([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
    ...                [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    >>> ends = bindpose.handles(points=[[0, 0, 0], [1, 0, 0]])
    >>> rig = bindpose.bind(tetrahedron, ends, domain="surface")
    >>> rig.pose({"p1": {"translate": [0, 0, 1]}})[:2].round(6).tolist()
    [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0]]
    """
    data = to_dataset(mesh)
    handle_data = to_handles(handles, data)
    weighted = weights(data, handle_data, bounds=bounds, mirror=mirror, threads=threads, progress=progress,
                       progress_bar=progress_bar, **options)
    rig = Rig(weighted, handle_data)
    rig._gives_arrays = not is_dataset(mesh)
    return rig


@with_options("pose_method", "skinning", "arap", "time_budget", "reduced_arap_bind", "moving_least_squares", "variational",
              "pose", "rotation_arrays")
def deform(mesh: Mesh, handles: Handles, pose: Mapping[str, Any] | Path, *, weights: ArrayLike | None = None,
           times: Sequence[float] | None = None, options, threads: int = 0, progress: Progress = None) -> Any:
    """Bend a mesh with weights to a pose, or to a sequence of poses.

    Parameters
    ----------
    mesh : vtkDataSet or (vertices, elements)
        A dataset with the point array ``Weights``, or arrays together with `weights`. ``full-arap``, ``mls`` and
        ``variational`` need no weights.
    handles : vtkPolyData, str or path-like
        The handles for which the weights were computed.
    pose : dict, str or path-like
        ``{"handles": {name: {"translate": [x, y, z], "rotate": {"axis": [x, y, z], "degrees": d}, …}}}`` or
        ``{"frames": [pose, …], "fps": n}``, as a dict or as a .json file. Numbers may be expressions in ``t``.
        Alternatives are a .dmat file of libigl, and a .glb, .gltf, .bvh, .fbx or .dae file with a motion, whose joints
        are matched to the handles by name. A handle follows its parent unless its entry has ``"space": "world"``; in a
        .json file this requires ``"version": 2``.
    weights : (#V, #handles) array, optional
        Weights for a mesh of arrays.
    times : sequence of floats, optional
        Times in seconds at which a pose with expressions is evaluated; default: 0.
    {options}
    threads, progress, progress_bar
        See `winding_number`.

    Returns
    -------
    Array or vtkDataSet, or a list of them
        For arrays: posed coordinates (#V, 3). For a dataset: a posed copy. For a sequence: a list with one entry per
        frame.

    Raises
    ------
    InvalidInput
        Weights that do not match, an unknown handle in the pose, an invalid pose.

    Examples
    --------
    >>> tetrahedron = ([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
    ...                [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    >>> ends = bindpose.handles(points=[[0, 0, 0], [1, 0, 0]])
    >>> values = bindpose.weights(tetrahedron, ends, domain="surface")
    >>> raised = {"handles": {"p1": {"translate": [0, 0, 1]}}}
    >>> bindpose.deform(tetrahedron, ends, raised, weights=values)[:2].round(6).tolist()
    [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0]]
    """
    rig = Rig(mesh, handles, weights=weights)
    poser = make_poser(rig.handles, pose)
    method = _Method(rig, options)
    options.apply(method.filter, "pose")
    run(poser)
    results = []
    for frame in range(poser.GetNumberOfFrames() if times is None else len(times)):
        if times is None:
            poser.SetFrame(frame)
        else:
            poser.SetTime(times[frame])
        run(poser)
        posed, pose_report = method.pose_dataset(poser.GetOutput(), threads, progress)
        results.append(posed if is_dataset(mesh) else Array(points_of(posed), pose_report))
    return results if times is not None or poser.GetSequence() else results[0]


def read_rig(path: Path) -> Rig:
    """Read a skinned mesh from a glTF 2.0 file.

    Parameters
    ----------
    path : str or path-like
        .glb or .gltf, from `write_rig`, Blender or another program.

    Returns
    -------
    Rig
        Mesh with weights, handles and animation. The rest pose of the handles is the bind pose; their array
        ``Transform`` contains the transforms of the file's nodes.

    Raises
    ------
    InvalidInput
        Missing, truncated or invalid file; the message names it.

    Examples
    --------
    >>> tetrahedron = ([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
    ...                [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    >>> ends = bindpose.handles(points=[[0, 0, 0], [1, 0, 0]])
    >>> report = bindpose.bind(tetrahedron, ends, domain="surface").save("rig.glb")
    >>> bindpose.read_rig("rig.glb").weights.names
    ['p1', 'p2']
    """
    reader = filters.vtkGLTFSkinReader()
    reader.SetFileName(os.fspath(path))
    run(reader)
    animation = json.loads(reader.GetPoseJSON()) if reader.GetPoseJSON() else None
    return Rig(reader.GetOutput(0), reader.GetOutput(1), animation=animation)


def write_rig(mesh: Mesh, handles: Handles, path: Path, *, frames: Sequence[vtkDataSet] = (), fps: float = 24.0,
              animation: Literal["joints", "morph"] = "joints", maximum_influences: int = 0,
              asset: Path | None = None, overwrite: bool = False) -> dict[str, Any]:
    """Write a mesh with weights and its handles as a skinned glTF 2.0 file, for Blender and game engines.

    Parameters
    ----------
    mesh : vtkDataSet
        With the point array ``Weights``; tets are written as their boundary.
    handles : vtkPolyData, str or path-like
        The handles for which the weights were computed; their pose is the pose of the joints.
    path : str or path-like
        .glb or .gltf.
    frames : sequence of vtkDataSet
        Results of `deform` for a sequence of poses, for an animation.
    fps : float
        Frames per second.
    animation : {"joints", "morph"}
        Frames are stored as transforms of the joints (linear blends), or as morph targets (all methods).
    maximum_influences : int
        Maximum number of weights per vertex that are written; the largest weights are kept. 0: all.
    asset : str or path-like, optional
        File from which `mesh` was read by `read_asset`: a copy of it gets the skin and keeps everything else.
        Default: the file contains only the mesh.
    overwrite : bool
        Replace an existing file.

    Returns
    -------
    dict
        The writer's report: ``sets`` (number of sets of four weights), ``dropped_share``, ``pose_error`` and
        ``animation_error`` (both: largest distance of a vertex in the file from its correct position, as a fraction of
        the diagonal), ``file_bytes``, ``losses`` (motions of the asset that the new skin replaces), …

    Raises
    ------
    InvalidInput
        Weights, frames or an asset that do not match, an existing file, an output path that cannot be written.

    Examples
    --------
    >>> tetrahedron = ([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
    ...                [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    >>> ends = bindpose.handles(points=[[0, 0, 0], [1, 0, 0]])
    >>> rig = bindpose.bind(tetrahedron, ends, domain="surface")
    >>> bindpose.write_rig(rig.mesh, ends, "tetrahedron.glb")["sets"]
    1
    """
    if animation not in ("joints", "morph"):
        raise InvalidInput(f"animation must be 'joints' or 'morph' (got {animation!r})")
    if isinstance(handles, (str, os.PathLike)):
        handles = read_handles(handles)
    writer = filters.vtkGLTFSkinWriter()
    writer.SetInputData(0, to_dataset(mesh))
    writer.SetHandlesData(handles)
    for frame in frames:
        writer.AddFrameData(to_dataset(frame))
    writer.SetFramesPerSecond(float(fps))
    writer.SetAnimation(int(animation == "morph"))
    writer.SetMaximumInfluences(int(maximum_influences))
    if asset is not None:
        writer.SetAssetFileName(os.fspath(asset))
    writer.SetFileName(os.fspath(path))
    writer.SetOverwrite(bool(overwrite))
    return run(writer)
