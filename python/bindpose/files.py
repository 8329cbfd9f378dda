"""Files in and out; the ending decides."""

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
        With the point array ``Weights``, a component a handle.
    handles : vtkPolyData
        One handle a cell; no cell when the file has no skin.
    pose : dict or None
        The animation as a sequence that `deform` takes, None without one.
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
        Missing, empty, truncated or wrong file; the text names it, and the line where there are lines.
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
        One handle a cell; see `bindpose.handles`.

    Raises
    ------
    InvalidInput
        As `read`, and for handles that cannot be used.
    """
    reader = vtkHandleFileReader()
    reader.SetFileName(os.fspath(path))
    run(reader)
    return reader.GetOutput()


def write(mesh, path, *, overwrite=False):
    """Write a mesh, volume or handle dataset; the file is there whole or not at all.

    Parameters
    ----------
    mesh : vtkDataSet or (vertices, elements)
    path : str or path-like
        vtp, vtu, vti, vtk, ply, stl, obj, off, mesh, or dmat for the array ``Weights`` alone; glb or gltf
        without a skin (`write_rig` has one); vdb (OpenVDB) for a volume's active scalars. ``bindpose.vtkVDBWriter`` has more choices.
    overwrite : bool
        Replace an existing file?

    Raises
    ------
    InvalidInput
        The file exists, cannot be written, or cannot hold this kind of dataset.
    Unavailable
        A .vdb file from a build without OpenVDB; the text names the package.
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
        .glb or .gltf, of `write_rig`, Blender or another program.

    Returns
    -------
    Rig
        Mesh with weights, handles (at rest where the skin was bound; ``Transform`` is how the nodes stand) and
        the animation.

    Raises
    ------
    InvalidInput
        Missing, truncated or broken file; the text names it.
    """
    reader = vtkGLTFSkinReader()
    reader.SetFileName(os.fspath(path))
    run(reader)
    pose = json.loads(reader.GetPoseJSON()) if reader.GetPoseJSON() else None
    return Rig(reader.GetOutput(0), reader.GetOutput(1), pose)


def write_rig(mesh, handles, path, *, frames=(), fps=24.0, animation="joints", influences=0, overwrite=False):
    """Write a mesh with weights and its handles as a skinned glTF 2.0 file, for Blender and game engines.

    Parameters
    ----------
    mesh : vtkDataSet
        With the point array ``Weights``; tets are written as their boundary.
    handles : vtkPolyData, str or path-like
        The handles that the weights were made for; as they are posed, so stand the joints.
    path : str or path-like
        .glb or .gltf.
    frames : sequence of vtkDataSet
        What `deform` made of a sequence of poses, for an animation.
    fps : float
        Frames per second.
    animation : {"joints", "morph"}
        Frames move the joints (linear blends), or each is a morph target (all methods).
    influences : int
        Weights of a vertex that are written, the largest; 0: all.
    overwrite : bool
        Replace an existing file?

    Returns
    -------
    dict
        The writer's report: ``sets`` of four weights, ``dropped_share``, ``pose_error`` and
        ``animation_error`` (how far the file takes a vertex from where it belongs, as a fraction of the
        diagonal), ``file_bytes``, …

    Raises
    ------
    InvalidInput
        Weights or frames that do not fit, an existing file, an unwritable place.
    """
    if animation not in ("joints", "morph"):
        raise InvalidInput(f"animation is 'joints' or 'morph', not {animation!r}")
    if isinstance(handles, (str, os.PathLike)):
        handles = read_handles(handles)
    writer = vtkGLTFSkinWriter()
    writer.SetInputData(0, to_dataset(mesh))
    writer.SetHandlesData(handles)
    for frame in frames:
        writer.AddFrameData(to_dataset(frame))
    writer.SetFramesPerSecond(float(fps))
    writer.SetAnimation(int(animation == "morph"))
    writer.SetMaximumInfluences(int(influences))
    writer.SetFileName(os.fspath(path))
    writer.SetOverwrite(bool(overwrite))
    return run(writer)
