"""Images: files and numpy arrays as VTK images."""

import os

import numpy as np
from vtkmodules.util import numpy_support
from vtkmodules.vtkCommonDataModel import vtkImageData

from .BindposeFilters import vtkPictureFileReader
from .errors import InvalidInput
from .running import run


def is_image_file(path):
    """Report whether the file name extension is that of an image."""
    return os.fspath(path).lower().rpartition(".")[2] in vtkPictureFileReader.GetFileExtensions().split()


def read_image(path):
    """Return a png, jpg, tif or bmp file as vtkImageData."""
    reader = vtkPictureFileReader()
    reader.SetFileName(os.fspath(path))
    run(reader)
    return reader.GetOutput()


def to_image(pixels):
    """Return an array as vtkImageData; its first row is at the top.

    The values are numbers or bool. An array of the shape #rows x #columns contains only alpha. An array of the shape
    #rows x #columns x n contains, per pixel, gray (n = 1); gray, alpha (2); red, green, blue (3); or red, green, blue,
    alpha (4).
    """
    pixels = np.asarray(pixels)
    if pixels.ndim not in (2, 3) or pixels.dtype.kind not in "buif" or (pixels.ndim == 3 and not 1 <= pixels.shape[2] <= 4):
        raise InvalidInput("an image must be an array of numbers: rows x columns (alpha only) or rows x columns x 1 to 4 channels")
    if pixels.size == 0:
        raise InvalidInput("the image has no pixels")
    if pixels.dtype == bool:
        pixels = pixels.astype(float)
    rows, columns = pixels.shape[:2]
    values = np.ascontiguousarray(pixels[::-1]).reshape(rows * columns, -1)
    array = numpy_support.numpy_to_vtk(values, deep=True)
    array.SetName("Alpha" if pixels.ndim == 2 else "Pixels")
    image = vtkImageData()
    image.SetDimensions(columns, rows, 1)
    image.GetPointData().SetScalars(array)
    return image
