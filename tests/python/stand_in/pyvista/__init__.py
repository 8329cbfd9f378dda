"""Replacement of PyVista for tests, because Debian 12 has no package of PyVista. It contains the dataset classes, and
the registry of accessors, which finds entry points as PyVista 0.48 does.
"""

import importlib
import importlib.metadata

from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData, vtkUnstructuredGrid


class DataSet:
    """The base class of all datasets."""

    def __getattr__(self, name):
        for point in importlib.metadata.entry_points(group="pyvista.accessors"):
            if point.name == name:
                importlib.import_module(point.value)
                return getattr(self, name)
        raise AttributeError(name)


class PolyData(DataSet, vtkPolyData):
    pass


class UnstructuredGrid(DataSet, vtkUnstructuredGrid):
    pass


class ImageData(DataSet, vtkImageData):
    pass


def wrap(data):
    result = {"vtkPolyData": PolyData, "vtkUnstructuredGrid": UnstructuredGrid, "vtkImageData": ImageData}[data.GetClassName()]()
    result.ShallowCopy(data)
    return result


def register_dataset_accessor(name, target):
    def register(accessor):
        setattr(target, name, property(accessor))
        return accessor

    return register


def read_meshio(path):
    """Replace pyvista.read_meshio(). Like meshio, it can read prisms, which Bindpose cannot."""
    with open(path, encoding="utf-8") as file:
        if "Prisms" not in file.read():
            raise ImportError("No module named 'meshio'")
    return UnstructuredGrid()


def handler(group, extension):
    """Return the function of an entry point. The functions read and save of PyVista find it in the same way."""
    point = next(point for point in importlib.metadata.entry_points(group=group) if point.name == extension)
    return point.load()
