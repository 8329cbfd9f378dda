"""Rigs: a mesh with weights and its handles, bound once and posed many times."""

import json
import os

import numpy as np
from vtkmodules.util import numpy_support
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints

from .BindposeFilters import vtkGLTFSkinReader, vtkGLTFSkinWriter
from .errors import BindposeWarning, InvalidInput
from .files import read_handles
from .functions import make_deformation, weights
from .handle_sets import to_handles
from .meshes import Array, add_point_array, is_dataset, like, point_array, shallow_copy, to_dataset
from .options import checked_options, with_options
from .running import check_status, report, run, warn

class Rig:
    """A mesh with weights and its handles. `bind` and `read_rig` create rigs.

    A pose method is prepared by the first pose that uses it; all later poses only solve and move the points. Changes of
    the handles' pose never repeat the preparation. If a handle is moved at rest, the method is prepared again, and a
    warning says that the weights are out of date.

    Parameters
    ----------
    mesh : vtkDataSet or (vertices, elements)
        A dataset with the point array ``Weights``, one component per handle, or arrays together with `weights`.
    handles : vtkPolyData, str or path-like
        The handles for which the weights were computed.
    weights : (#V, #handles) array, optional
        Weights for a mesh of arrays.
    animation : dict, optional
        A sequence of poses, as in a pose file.

    Attributes
    ----------
    mesh : vtkDataSet
        The mesh at rest with the point array ``Weights``.
    handles : vtkPolyData
        One cell per handle; no cell if the file of the rig has no skin.
    animation : dict or None
        The sequence of poses in the file of the rig, for `deform`.
    """

    def __init__(self, mesh, handles, *, weights=None, animation=None):
        data = to_dataset(mesh)
        if weights is not None:
            data = shallow_copy(data)
            add_point_array(data, "Weights", np.asarray(weights, dtype=float), getattr(weights, "names", ()))
        self.mesh = data
        self.handles = to_handles(handles, data)
        self.animation = animation
        self._gives_arrays = not is_dataset(mesh)
        self._methods = {}
        self._output = (None, None)  # the last array for points, and the same memory as an array of VTK
        self._last = None  # the filter of the last pose
        self._rest = _rest_points(self.handles)
        self._rest_time = self.handles.GetPoints().GetMTime() if len(self._rest) else 0
        self._warned = False

    @property
    def weights(self):
        """The weights, (#V, #handles), with the handle of each column in ``names``."""
        array = self.mesh.GetPointData().GetArray("Weights")
        if array is None:
            raise InvalidInput("the mesh of the rig has no point array 'Weights'")
        names = [array.GetComponentName(j) for j in range(array.GetNumberOfComponents())]
        return Array(point_array(self.mesh, "Weights"), self.report, names)

    @property
    def report(self):
        """The report of the weights: certificates, counts and seconds; see `bindpose.report`."""
        return report(self.mesh)

    @property
    def extrema(self):
        """Dict of handle name to the number of local extrema of its weights away from the handles."""
        return {entry["name"]: entry["interior_extrema"] for entry in self.report.get("handles", [])
                if "interior_extrema" in entry}

    @property
    def number_of_binds(self):
        """Number of times that a pose method was prepared. Poses do not change it, except the first of a method."""
        return sum(method.filter.GetNumberOfBinds() for method in self._methods.values())

    @property
    def pose_report(self):
        """The report of the last pose: status, iterations, energy, seconds per phase."""
        return json.loads(self._last.GetReportJSON()) if self._last else {}

    @property
    def moved_handles(self):
        """Names of the handles that were moved at rest since the weights were computed."""
        points = self.handles.GetPoints()
        if points and points.GetMTime() == self._rest_time:
            return []
        if not points or points.GetNumberOfPoints() != len(self._rest):
            return _names(self.handles)
        changed = (numpy_support.vtk_to_numpy(points.GetData()) != self._rest).any(axis=1)
        if not changed.any():
            return []
        cells = [self.handles.GetCell(i).GetPointIds() for i in range(self.handles.GetNumberOfCells())]
        return [name for name, ids in zip(_names(self.handles), cells)
                if name and any(changed[ids.GetId(k)] for k in range(ids.GetNumberOfIds()))]

    @with_options("pose_method", "skinning", "arap", "time_budget", "reduced_arap_bind", "moving_least_squares", "variational")
    def pose(self, pose, *, out=None, threads=0, **options):
        """Return the mesh in a pose.

        The first pose of a method prepares the method. The result has the same bits as that of `deform`.

        Parameters
        ----------
        pose : dict, str or (#handles, 3, 4) array
            ``{name: {"translate": [x, y, z], "rotate": {"axis": [x, y, z], "degrees": d}, …}}``, or the content of a
            pose file with one pose, as a dict or as text; see `deform`. An array contains one affine map per handle,
            from rest to posed positions, which replaces the handle's pose.
        out : (#V, 3) array of float or vtkDataSet, optional
            Destination: an array, or a dataset from an earlier call. It is returned. Its memory is written directly, so
            that repeated poses allocate nothing.
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

        Warns
        -----
        NotConvergedWarning
            The iterations ended above the tolerance; the result is kept.
        BindposeWarning
            A warning of the method, or weights that are out of date (once per rig).
        """
        key = tuple(options.items())
        method = self._methods.get(key)
        if method is None:
            method = self._methods[key] = _Method(self, checked_options(options, *Rig.pose.option_sets))
        result, points = self._destination(out)
        posed = method.pose(pose, points, threads)
        self._last = method.filter
        if not posed or method.filter.GetStatus() or method.filter.GetNumberOfWarnings():
            check_status(method.filter, self.pose_report)
        if not self._warned and self.moved_handles:
            self._warned = True
            warn(f"these handles were moved since the weights were computed: {', '.join(self.moved_handles)}; "
                 "compute the weights again by bindpose.bind()", BindposeWarning)
        if result is not out and is_dataset(result):
            result.GetPointData().SetNormals(None)
        return result

    def save(self, path, *, frames=(), fps=24.0, animation="joints", maximum_influences=0, overwrite=False):
        """Write the rig as a skinned glTF 2.0 file; see `write_rig`."""
        return write_rig(self.mesh, self.handles, path, frames=frames, fps=fps, animation=animation,
                         maximum_influences=maximum_influences, overwrite=overwrite)

    def _destination(self, out):
        """Return the result of a pose, and the array of VTK for its points."""
        count = self.mesh.GetNumberOfPoints()
        if out is None and not self._gives_arrays:
            out = like(self.mesh, shallow_copy(self.mesh))
            points = vtkPoints()
            points.SetData(vtkDoubleArray())
            out.SetPoints(points)
            return out, points.GetData()
        if is_dataset(out):
            points = out.GetPoints() if hasattr(out, "GetPoints") else None
            if points is None or points is self.mesh.GetPoints() or out.GetNumberOfPoints() != count or \
                    not points.GetData().IsA("vtkDoubleArray"):
                raise InvalidInput("out must be a dataset that an earlier call of pose() returned")
            points.Modified()
            return out, points.GetData()
        if out is None:
            out = np.empty((count, 3))
        elif out is self._output[0]:
            return out, self._output[1]
        elif not isinstance(out, np.ndarray) or out.shape != (count, 3) or out.dtype != np.float64 or \
                not out.flags.c_contiguous or not out.flags.writeable:
            raise InvalidInput(f"out must be a writeable contiguous array {count} x 3 of float64, or a dataset from pose()")
        self._output = (out, numpy_support.numpy_to_vtk(out))
        return self._output


class _Method:
    """A pose method with its options, prepared for a rig."""

    def __init__(self, rig, options):
        self.filter = make_deformation(options)
        self.handles = shallow_copy(rig.handles)
        self.filter.SetInputData(0, rig.mesh)
        self.filter.SetInputData(1, self.handles)
        self._given = rig.handles.GetCellData().GetArray("Transform")
        self._transforms = None  # the array of a pose that was passed as an array

    def pose(self, pose, points, threads):
        self.filter.SetNumberOfThreads(threads)
        if isinstance(pose, (dict, str)):
            if self._transforms is not None:
                self._set_transforms(None)
            return self.filter.PosePoints(pose if isinstance(pose, str) else _pose_text(pose), points)
        self._set_transforms(pose)
        return self.filter.PosePoints("", points)

    def _set_transforms(self, values):
        """Set the transforms of all handles; None: those of the rig."""
        data = self.handles.GetCellData()
        if values is None:
            self._transforms = None
            data.RemoveArray("Transform")
            if self._given is not None:
                data.AddArray(self._given)
            return
        values = np.asarray(values, dtype=float)
        count = self.handles.GetNumberOfCells()
        if values.shape not in ((count, 3, 4), (count, 12)):
            raise InvalidInput(f"a pose as an array must be {count} x 3 x 4, one affine map per handle "
                               f"(got {' x '.join(map(str, values.shape))})")
        self._transforms = numpy_support.numpy_to_vtk(np.ascontiguousarray(values.reshape(count, 12)), deep=True)
        self._transforms.SetName("Transform")
        data.AddArray(self._transforms)


def _rest_points(handles):
    points = handles.GetPoints()
    return np.array(numpy_support.vtk_to_numpy(points.GetData())) if points else np.zeros((0, 3))


def _names(handles):
    array = handles.GetCellData().GetAbstractArray("HandleName")
    return [array.GetValue(i) for i in range(array.GetNumberOfValues())] if array else []


def _plain(value):
    """Return a number or an array of numpy as json can write it."""
    if isinstance(value, (np.ndarray, np.generic)):
        return value.tolist()
    raise TypeError(f"{type(value).__name__} is not allowed in a pose")


def _pose_text(pose):
    """Return the text of a pose file, from its content or from a dict of handle names."""
    content = {"version": 2, **pose} if "handles" in pose or "frames" in pose else {"version": 2, "handles": pose}
    try:
        return json.dumps(content, default=_plain)
    except (TypeError, ValueError) as error:
        raise InvalidInput(f"the pose must be a JSON object: {error}") from None


@with_options("weights_method", "bounded_weights", "weights", "weight_terms", without=("bounds",))
def bind(mesh, handles, *, bounds=(0, 1), mirror=None, threads=0, progress=None, progress_bar=False, **options):
    """Compute weights of a mesh, once, and return a rig that can be posed many times.

    Parameters
    ----------
    mesh, handles, bounds, mirror, threads, progress, progress_bar
        See `weights`.
    {options}

    Returns
    -------
    Rig
        It returns arrays from poses if the mesh is a pair of arrays, otherwise datasets.

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
    >>> rig = bindpose.bind(surface, bindpose.handles(bones=[[[0, 0, 0], [1, 0, 0]]]))   # doctest: +SKIP
    >>> posed = rig.pose({"b1": {"rotate": {"axis": [0, 0, 1], "degrees": 30}}})          # doctest: +SKIP
    """
    data = to_dataset(mesh)
    handle_data = to_handles(handles, data)
    weighted = weights(data, handle_data, bounds=bounds, mirror=mirror, threads=threads, progress=progress,
                       progress_bar=progress_bar, **options)
    rig = Rig(weighted, handle_data)
    rig._gives_arrays = not is_dataset(mesh)
    return rig


def read_rig(path):
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
    """
    reader = vtkGLTFSkinReader()
    reader.SetFileName(os.fspath(path))
    run(reader)
    animation = json.loads(reader.GetPoseJSON()) if reader.GetPoseJSON() else None
    return Rig(reader.GetOutput(0), reader.GetOutput(1), animation=animation)


def write_rig(mesh, handles, path, *, frames=(), fps=24.0, animation="joints", maximum_influences=0, overwrite=False):
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
    overwrite : bool
        Replace an existing file.

    Returns
    -------
    dict
        The writer's report: ``sets`` (number of sets of four weights), ``dropped_share``, ``pose_error`` and
        ``animation_error`` (both: largest distance of a vertex in the file from its correct position, as a fraction of
        the diagonal), ``file_bytes``, …

    Raises
    ------
    InvalidInput
        Weights or frames that do not match, an existing file, an output path that cannot be written.
    """
    if animation not in ("joints", "morph"):
        raise InvalidInput(f"animation must be 'joints' or 'morph' (got {animation!r})")
    if isinstance(handles, (str, os.PathLike)):
        handles = read_handles(handles)
    writer = vtkGLTFSkinWriter()
    writer.SetInputData(0, to_dataset(mesh))
    writer.SetHandlesData(handles)
    for frame in frames:
        writer.AddFrameData(to_dataset(frame))
    writer.SetFramesPerSecond(float(fps))
    writer.SetAnimation(int(animation == "morph"))
    writer.SetMaximumInfluences(int(maximum_influences))
    writer.SetFileName(os.fspath(path))
    writer.SetOverwrite(bool(overwrite))
    return run(writer)
