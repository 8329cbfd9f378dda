#!/usr/bin/env python3
"""Check an installed Python package: its location, metadata, programs and libraries.

usage: installed_package.py PREFIX
"""

import importlib.metadata
import pathlib
import subprocess
import sys
import tempfile

import bindpose
from bindpose.program import program_path

prefix = pathlib.Path(sys.argv[1]).resolve()
for path in (bindpose.__file__, program_path()):
    assert pathlib.Path(path).resolve().is_relative_to(prefix), f"{path} is not in {prefix}"
assert importlib.metadata.version("bindpose") == bindpose.__version__
readers = {point.name: point for point in importlib.metadata.entry_points(group="pyvista.readers")}
assert {".mesh", ".off", ".tgf"} <= set(readers)
done = subprocess.run([program_path(), "--version"], capture_output=True, text=True, check=True)
assert bindpose.__version__ in done.stdout

tetrahedron = ([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
assert bindpose.contains(tetrahedron, [[0.1, 0.1, 0.1], [1, 1, 1]]).tolist() == [True, False]
assert bindpose.tetrahedralize(tetrahedron, method="cdt").report["status"] == "ok"  # finds the helper program
with tempfile.TemporaryDirectory() as folder:
    bindpose.write(tetrahedron, pathlib.Path(folder) / "t.vtp")
    assert bindpose.read(pathlib.Path(folder) / "t.vtp").GetNumberOfCells() == 4  # finds the helper reader
