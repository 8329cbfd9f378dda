"""Images: files and numpy arrays as VTK images."""

import os
import zlib

import numpy as np
from vtkmodules.util import numpy_support
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkBMPReader, vtkJPEGReader, vtkPNGReader, vtkTIFFReader

from .errors import InvalidInput

_READERS = {"png": vtkPNGReader, "jpg": vtkJPEGReader, "jpeg": vtkJPEGReader, "tif": vtkTIFFReader,
            "tiff": vtkTIFFReader, "bmp": vtkBMPReader}


def is_image_file(path):
    """Report whether the file name extension is that of an image."""
    return os.fspath(path).lower().rpartition(".")[2] in _READERS


def _is_whole_png(path):
    """Report whether a png file has all chunks and valid checksums and pixels; VTK's reader crashes on others."""
    with open(path, "rb") as file:
        data = file.read()
    at, kind, pixels = 8, b"", zlib.decompressobj()
    while kind != b"IEND":
        length, kind = int.from_bytes(data[at:at + 4], "big"), data[at + 4:at + 8]
        body, check = data[at + 8:at + 8 + length], data[at + 8 + length:at + 12 + length]
        if len(check) < 4 or zlib.crc32(kind + body) != int.from_bytes(check, "big"):
            return False
        try:
            if kind == b"IDAT":
                pixels.decompress(body)
        except zlib.error:
            return False
        at += 12 + length
    return pixels.eof


def read_image(path):
    """Return a png, jpg, tif or bmp file as vtkImageData."""
    path = os.fspath(path)
    if not os.path.isfile(path):
        raise InvalidInput(f"{path} cannot be read: there is no such file")
    reader = _READERS[path.lower().rpartition(".")[2]]()
    caught = []
    reader.AddObserver("ErrorEvent", lambda *_: caught.append(True))
    if reader.CanReadFile(path) and (not isinstance(reader, vtkPNGReader) or _is_whole_png(path)):
        reader.SetFileName(path)
        reader.Update()
        if not caught and not reader.GetErrorCode() and reader.GetOutput().GetNumberOfPoints():
            return reader.GetOutput()
    raise InvalidInput(f"{path} cannot be read: the file is damaged or does not have the format of its extension")


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
