"""Run a script of the folder examples/ as a user would, and check its output files."""

import json
import os
import pathlib
import subprocess
import sys

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "examples"


def script(name, *words, environment=None):
    """Run the script. Return the finished process, with its output as text."""
    return subprocess.run([sys.executable, "-B", EXAMPLES / name, *map(str, words)], capture_output=True, text=True,
                          timeout=300, check=False, env={**os.environ, **(environment or {})})


def pixels(path):
    reader = vtkPNGReader()
    reader.SetFileName(str(path))
    reader.Update()
    columns, rows, _ = reader.GetOutput().GetDimensions()
    return vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).reshape(rows, columns, -1)[..., :3].astype(int)


def numbers_of(name, folder, stem=None, environment=None):
    """Run the script in its quick variant. Check that its picture shows something on white paper. Return its numbers.
    """
    done = script(name, "--small", "--output", folder, environment=environment)
    assert done.returncode == 0 and done.stderr == "", done.stderr
    stem = stem or pathlib.Path(name).stem
    picture = pixels(folder / f"{stem}.png")
    drawn = (np.abs(picture - 255) > 16).any(axis=2)
    assert 0.02 < drawn.mean() < 0.9
    assert len(np.unique(picture.reshape(-1, 3), axis=0)) > 50
    for edge in (drawn[0], drawn[-1], drawn[:, 0], drawn[:, -1]):
        assert not edge.any()  # the picture is not cropped
    return json.loads((folder / f"{stem}.json").read_text())


def is_refused(done, *words):
    """Check that the program printed one sentence with these words and no traceback."""
    assert done.returncode == 2, done.stderr
    assert len(done.stderr.splitlines()) == 1, done.stderr
    for word in words:
        assert word in done.stderr
