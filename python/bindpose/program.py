"""Draw pictures with the program `bindpose`."""

from __future__ import annotations

import json
import os
import pathlib
import shutil
import subprocess
import tempfile
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from vtkmodules.util import numpy_support

from .errors import BindposeError, BindposeWarning, InvalidInput, Unavailable
from .files import write
from .images import read_image
from .meshes import is_dataset, to_dataset
from .options import with_options
from .parameter_types import Drawable, Handles, Path
from .running import errors_by_status, warn
from .version import PROGRAM

_EXTENSIONS = {"vtkPolyData": ".vtp", "vtkImageData": ".vti"}


def program_path() -> str:
    """Return the path of the program `bindpose`: the environment variable BINDPOSE_PROGRAM, the program that was built with
    this package, or the one in PATH.

    Raises
    ------
    Unavailable
        There is no such program.
    """
    beside = (pathlib.Path(__file__).resolve().parent / PROGRAM).resolve()
    path = os.environ.get("BINDPOSE_PROGRAM") or (str(beside) if beside.exists() else shutil.which("bindpose"))
    if path is not None and not os.access(path, os.X_OK):
        raise Unavailable(f"{path} is not a program; see the environment variable BINDPOSE_PROGRAM")
    if path is None:
        raise Unavailable(f"the program 'bindpose' is missing; expected {beside} or a program in PATH")
    return path


def _as_file(data, folder, name):
    """Return the path of a file with the data. If `data` is not a path, write it to a new file in the folder."""
    if isinstance(data, (str, os.PathLike)):
        path = os.fspath(data)
        return os.path.join(".", path) if path.startswith("-") else path
    data = to_dataset(data)
    base = next((key for key in _EXTENSIONS if data.IsA(key)), "")
    path = os.path.join(folder, name + _EXTENSIONS.get(base, ".vtu"))
    write(data, path)
    return path


def _is_one_mesh(value):
    """Report whether the value is one mesh (a dataset, a path or a pair of arrays) rather than a sequence of meshes."""
    if is_dataset(value) or isinstance(value, (str, os.PathLike)):
        return True
    try:
        elements = np.asarray(value[1]) if value and len(value) == 2 else np.zeros(0)
    except ValueError:  # value[1] is itself a pair of arrays, so the value is a sequence of two meshes
        return False
    return elements.ndim == 2 and elements.dtype.kind in "iu"


@with_options("render")
def render(*meshes: Drawable, output: Path | None = None, handles: Handles | None = None,
           context: Drawable | Sequence[Drawable] = (), minus: Drawable | None = None, overwrite: bool = False,
           options) -> NDArray[np.uint8] | None:
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
        Dataset whose array is subtracted from the shown array. It must have as many points as the mesh.
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
        The program `bindpose`, a display and Xvfb, or (for a film) ffmpeg is missing; the message names it.

    Warns
    -----
    BindposeWarning
        One per warning of the program.

    Examples
    --------
    >>> tetrahedron = ([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
    ...                [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    >>> bindpose.render(tetrahedron, size="320x240", azimuth=30).shape
    (240, 320, 3)
    """
    if not meshes:
        raise InvalidInput("render needs at least one mesh")
    with tempfile.TemporaryDirectory() as folder:
        words = [_as_file(mesh, folder, f"mesh{k}") for k, mesh in enumerate(meshes)]
        picture = os.path.join(folder, "picture.png") if output is None else os.fspath(output)
        words.append(f"--output={picture}")
        for k, each in enumerate([context] if _is_one_mesh(context) else context or ()):
            words.append(f"--context={_as_file(each, folder, f'context{k}')}")
        for name, data in (("handles", handles), ("minus", minus)):
            if data is not None:
                words.append(f"--{name}={_as_file(data, folder, name)}")
        words += options.words("render")
        if overwrite:
            words.append("--overwrite")
        report_path = os.path.join(folder, "report.json")
        done = subprocess.run([program_path(), "render", *words, "--quiet", "--report", report_path], capture_output=True,
                              text=True, check=False)
        report = _report_in(report_path)
        if done.returncode:
            raise _error_of(done, report)
        for sentence in report.get("warnings", []):
            warn(sentence, BindposeWarning)
        return None if output is not None else _pixels(picture)


def _report_in(path):
    """Return the report that the program wrote; empty if it wrote none."""
    try:
        return json.loads(pathlib.Path(path).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}


def _error_of(done, report):
    """Return the exception for a failed run of the program."""
    if report.get("message"):
        return errors_by_status.get(report["status"], BindposeError)(report["message"], report)
    usage = [line for line in done.stderr.splitlines() if line.startswith("bindpose render: ")]
    if done.returncode == 1 and usage:
        return InvalidInput(usage[-1].removeprefix("bindpose render: ").removesuffix(" (see bindpose render --help)"))
    return BindposeError(f"the program {done.args[0]} ended with exit code {done.returncode}: {done.stderr.strip()[-500:]}")


def _pixels(path):
    image = read_image(path)
    columns, rows, _ = image.GetDimensions()
    values = numpy_support.vtk_to_numpy(image.GetPointData().GetScalars())
    return np.array(values.reshape(rows, columns, -1)[::-1])
