"""The program `bindpose`, for what has no function of its own: pictures."""

import json
import os
import pathlib
import shutil
import subprocess
import tempfile

import numpy as np
from vtkmodules.util import numpy_support

from .errors import BindposeWarning, InvalidInput, Unavailable
from .files import write
from .images import read_image
from .meshes import to_dataset
from .options import with_options
from .running import errors_by_status, warn

# build/lib/python3/dist-packages/bindpose and PREFIX/lib/python3/dist-packages/bindpose: bin is beside lib.
_BESIDE = pathlib.Path(__file__).resolve().parents[4] / "bin" / "bindpose"
_EXTENSIONS = {"vtkPolyData": ".vtp", "vtkImageData": ".vti"}


def program_path():
    """Return the path of the program `bindpose` that belongs to this package, or of the one in PATH.

    Raises
    ------
    Unavailable
        There is no such program.
    """
    path = str(_BESIDE) if _BESIDE.exists() else shutil.which("bindpose")
    if path is None:
        raise Unavailable(f"the program 'bindpose' is missing; expected {_BESIDE} or a program in PATH")
    return path


def _as_file(data, folder, name):
    """Return the path of a file with the data; write the file if the data are no path."""
    if isinstance(data, (str, os.PathLike)):
        return os.fspath(data)
    data = to_dataset(data)
    base = next((key for key in _EXTENSIONS if data.IsA(key)), "")
    path = os.path.join(folder, name + _EXTENSIONS.get(base, ".vtu"))
    write(data, path)
    return path


@with_options("render")
def render(*meshes, output=None, handles=None, context=(), minus=None, overwrite=False, options):
    """Make a picture of meshes, tets or volumes without a window.

    Parameters
    ----------
    *meshes : vtkDataSet, (vertices, elements), str or path-like
        One tile per dataset or file.
    output : str or path-like, optional
        A .png file; or .gif, .webm, .mp4 or .apng (by ffmpeg) with the datasets one after another.
    handles : vtkPolyData, str or path-like, optional
        Also draw these handles.
    context : vtkDataSet, file, or a sequence of them
        Also draw these in every tile: surfaces see-through, boundary curves as tubes.
    minus : vtkDataSet, str or path-like, optional
        Show the array minus that of this dataset, which must have as many points.
    overwrite : bool
        Replace an existing file.
    {options}

    Returns
    -------
    (#rows, #columns, 3 or 4) array of uint8, or None
        The picture, first row at the top, if there is no `output`; with `transparent` it has alpha.

    Raises
    ------
    InvalidInput
        Data or options that cannot be drawn, an existing file.
    Unavailable
        There is neither a display nor Xvfb, or no ffmpeg for a moving picture; the message names the package.
    """
    if not meshes:
        raise InvalidInput("render needs at least one mesh")
    several = isinstance(context, (list, tuple)) and not (len(context) == 2 and isinstance(context[0], np.ndarray))
    with tempfile.TemporaryDirectory() as folder:
        words = [_as_file(mesh, folder, f"mesh{k}") for k, mesh in enumerate(meshes)]
        picture = os.path.join(folder, "picture.png") if output is None else os.fspath(output)
        words += ["--output", picture]
        for k, each in enumerate(context if several else [context]):
            words += ["--context", _as_file(each, folder, f"context{k}")]
        for name, data in (("handles", handles), ("minus", minus)):
            if data is not None:
                words += [f"--{name}", _as_file(data, folder, name)]
        words += options.words("render")
        if overwrite:
            words.append("--overwrite")
        report = os.path.join(folder, "report.json")
        done = subprocess.run([program_path(), "render", *words, "--quiet", "--report", report], capture_output=True, text=True,
                              check=False)
        lines = [line.removeprefix("bindpose render: ") for line in done.stderr.splitlines()]
        if done.returncode:
            raise errors_by_status[_status_in(report)](
                lines[-1] if lines else f"the program ended with exit code {done.returncode}")
        for line in lines:
            warn(line, BindposeWarning)
        return None if output is not None else _pixels(picture)


def _status_in(report):
    """Return the status in a report of the program; invalid_input if there is no report, as after an unknown word."""
    try:
        return json.loads(pathlib.Path(report).read_text(encoding="utf-8"))["status"]
    except (OSError, ValueError, KeyError):
        return "invalid_input"


def _pixels(path):
    image = read_image(path)
    columns, rows, _ = image.GetDimensions()
    values = numpy_support.vtk_to_numpy(image.GetPointData().GetScalars())
    return np.array(values.reshape(rows, columns, -1)[::-1])
