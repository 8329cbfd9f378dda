"""Reading and writing of files; the file name extension determines the format."""

import json
import os
from typing import NamedTuple, Optional

from vtkmodules.vtkCommonDataModel import vtkPolyData

from .BindposeFilters import (
    vtkGLTFSkinReader,
    vtkGLTFSkinWriter,
    vtkHandleFileReader,
    vtkMeshFileReader,
    vtkMeshFileWriter,
    vtkVDBWriter,
)
from .errors import InvalidInput
from .meshes import to_dataset
from .running import run


class Rig(NamedTuple):
    """A mesh with weights, its handles and its animation.

    Attributes
    ----------
    mesh : vtkPolyData
        With the point array ``Weights``, one component per handle.
    handles : vtkPolyData
        One cell per handle; no cell if the file has no skin.
    pose : dict or None
        The animation as a sequence for `deform`; None if there is none.
    """

    mesh: vtkPolyData
    handles: vtkPolyData
    pose: Optional[dict]


def read(path):
    """Read a mesh or volume.

    Parameters
    ----------
    path : str or path-like
        obj, off, ply, stl, vtp, vtu, vti, vtk, mesh (MEDIT), glb or gltf (with weights; see `read_rig`).

    Returns
    -------
    vtkDataSet
        vtkPolyData for surfaces, vtkUnstructuredGrid for tets, vtkImageData for volumes.

    Raises
    ------
    InvalidInput
        Missing, empty, truncated or invalid file; the message names the file and, for text formats, the line.
    """
    reader = vtkMeshFileReader()
    reader.SetFileName(os.fspath(path))
    run(reader)
    return reader.GetOutput()


def read_handles(path):
    """Read handles.

    Parameters
    ----------
    path : str or path-like
        .tgf (points, then bones), .vtp (a handle dataset), .glb or .gltf (the joints of its skin).

    Returns
    -------
    vtkPolyData
        One cell per handle; see `bindpose.handles`.

    Raises
    ------
    InvalidInput
        As in `read`, and for handles that cannot be used.
    """
    reader = vtkHandleFileReader()
    reader.SetFileName(os.fspath(path))
    run(reader)
    return reader.GetOutput()


def write(mesh, path, *, overwrite=False):
    """Write a mesh, volume or handle dataset, either completely or not at all.

    Parameters
    ----------
    mesh : vtkDataSet or (vertices, elements)
    path : str or path-like
        vtp, vtu, vti, vtk, ply, stl, obj, off, mesh; dmat for the array ``Weights`` alone; glb or gltf without a skin
        (`write_rig` writes a skin); vdb (OpenVDB) for the active scalars of a volume. ``bindpose.vtkVDBWriter`` has
        more options for .vdb files.
    overwrite : bool
        Replace an existing file.

    Raises
    ------
    InvalidInput
        The file exists, cannot be written, or its format cannot store this type of dataset.
    Unavailable
        A .vdb file in a build without OpenVDB; the message names the package.
    """
    path = os.fspath(path)
    ending = os.path.splitext(path)[1].lower()
    writers = {".vdb": vtkVDBWriter, ".glb": vtkGLTFSkinWriter, ".gltf": vtkGLTFSkinWriter}
    writer = writers.get(ending, vtkMeshFileWriter)()
    writer.SetInputData(to_dataset(mesh))
    writer.SetFileName(path)
    writer.SetOverwrite(bool(overwrite))
    run(writer)


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
    pose = json.loads(reader.GetPoseJSON()) if reader.GetPoseJSON() else None
    return Rig(reader.GetOutput(0), reader.GetOutput(1), pose)


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
