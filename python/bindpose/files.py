"""Reading and writing of meshes, volumes and handles; the file name extension determines the format."""

from __future__ import annotations

import os
from typing import NamedTuple

from vtkmodules.vtkCommonDataModel import vtkDataSet, vtkPolyData

from .BindposeFilters import (
    vtkAssetReader,
    vtkGLTFSkinWriter,
    vtkHandleFileReader,
    vtkMeshFileReader,
    vtkMeshFileWriter,
    vtkVDBWriter,
)
from .errors import InvalidInput
from .meshes import to_dataset
from .parameter_types import Mesh, Path
from .running import run


def read(path: Path) -> vtkDataSet:
    """Read a mesh or volume.

    Parameters
    ----------
    path : str or path-like
        obj, off, ply, stl, vtp, vtu, vti, vtk, mesh (MEDIT), glb or gltf (with weights; see `read_rig`).

    Returns
    -------
    vtkDataSet
        A vtkPolyData for surfaces, a vtkUnstructuredGrid for tets, a vtkImageData for volumes.

    Raises
    ------
    InvalidInput
        Missing, empty, truncated or invalid file; the message names the file and, for text formats, the line.

    Examples
    --------
    >>> surface = bindpose.read("elephant.off")  # doctest: +SKIP
    """
    reader = vtkMeshFileReader()
    reader.SetFileName(os.fspath(path))
    run(reader)
    return reader.GetOutput()


class Asset(NamedTuple):
    """The meshes and joints of a file that can get a new rig."""

    mesh: vtkPolyData
    handles: vtkPolyData


def read_asset(path: Path) -> Asset:
    """Read the triangles of all meshes of a glTF, OBJ, PLY, FBX, Collada, 3DS or 3MF file, for a new rig.

    Parameters
    ----------
    path : str or path-like
        .glb, .gltf, .obj with its .mtl files and pictures, .ply, .fbx, .dae, .3ds or .3mf.

    Returns
    -------
    Asset
        ``mesh``: the meshes of the default scene, in scene coordinates. ``handles``: the joints of their skins. `Rig.save`
        and `write_rig` with the parameter ``asset`` write a copy of the file with new weights. The copy keeps materials,
        textures, cameras, animations and everything else. If the rig has the handles of the asset, the copy also keeps
        the joints, and their animations move the meshes.

    Raises
    ------
    InvalidInput
        Missing, truncated or invalid file, or a file without triangles; the message names it.

    Examples
    --------
    >>> tetrahedron = ([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
    ...                [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    >>> bindpose.write(tetrahedron, "asset.glb")
    >>> mesh = bindpose.read_asset("asset.glb").mesh
    >>> rig = bindpose.bind(mesh, bindpose.handles(points=[[0, 0, 0], [1, 0, 0]]), domain="surface")
    >>> rig.save("rigged.glb", asset="asset.glb", maximum_influences=4)["counts"]["joints"]
    2
    """
    reader = vtkAssetReader()
    reader.SetFileName(os.fspath(path))
    run(reader)
    return Asset(reader.GetOutputDataObject(0), reader.GetOutputDataObject(1))


def read_handles(path: Path) -> vtkPolyData:
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

    Examples
    --------
    >>> handles = bindpose.read_handles("elephant.tgf")  # doctest: +SKIP
    """
    reader = vtkHandleFileReader()
    reader.SetFileName(os.fspath(path))
    run(reader)
    return reader.GetOutput()


def write(mesh: Mesh, path: Path, *, overwrite: bool = False) -> None:
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

    Examples
    --------
    >>> tetrahedron = ([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
    ...                [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    >>> bindpose.write(tetrahedron, "tetrahedron.ply")
    >>> bindpose.read("tetrahedron.ply").GetNumberOfPoints()
    4
    """
    path = os.fspath(path)
    ending = os.path.splitext(path)[1].lower()
    writers = {".vdb": vtkVDBWriter, ".glb": vtkGLTFSkinWriter, ".gltf": vtkGLTFSkinWriter}
    writer = writers.get(ending, vtkMeshFileWriter)()
    writer.SetInputData(to_dataset(mesh))
    writer.SetFileName(path)
    writer.SetOverwrite(bool(overwrite))
    run(writer)
