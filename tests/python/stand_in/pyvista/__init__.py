"""A replacement of PyVista for tests, because Debian 12 has no package of PyVista: its dataset classes, and its registry of
accessors, which finds entry points as PyVista 0.48 does.
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
    """Replace meshio, which reads prisms."""
    with open(path, encoding="utf-8") as file:
        if "Prisms" not in file.read():
            raise ImportError("No module named 'meshio'")
    return UnstructuredGrid()


def handler(group, extension):
    """Return the function that an entry point names, as pyvista.read and save find it."""
    point = next(point for point in importlib.metadata.entry_points(group=group) if point.name == extension)
    return point.load()
