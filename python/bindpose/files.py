"""Files in and out; the ending decides."""

import os

from .BindposeFilters import vtkHandleFileReader, vtkMeshFileReader, vtkMeshFileWriter, vtkVDBWriter
from .meshes import to_dataset
from .running import run


def read(path):
    """Read a mesh or volume.

    Parameters
    ----------
    path : str or path-like
        obj, off, ply, stl, vtp, vtu, vti, vtk or mesh (MEDIT).

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
        .tgf (points, then bones) or .vtp (a handle dataset).

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
        vtp, vtu, vti, vtk, ply, stl, obj, off, mesh, or dmat for the array ``Weights`` alone; vdb
        (OpenVDB) for a volume's active scalars. ``bindpose.vtkVDBWriter`` has more choices.
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
    writer = vtkVDBWriter() if path.lower().endswith(".vdb") else vtkMeshFileWriter()
    writer.SetInputData(to_dataset(mesh))
    writer.SetFileName(path)
    writer.SetOverwrite(bool(overwrite))
    run(writer)
