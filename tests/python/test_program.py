"""Pictures by the program, the package as the program, and its version."""

import os
import pathlib
import re
import subprocess
import sys

import bindpose
import numpy as np
import pytest
import shapes
from bindpose.meshes import to_dataset


def test_a_picture_is_an_array():
    picture = bindpose.render(shapes.cube(), size="200x160")
    assert picture.shape == (160, 200, 3) and picture.dtype == np.uint8
    assert len(np.unique(picture.reshape(-1, 3), axis=0)) > 10
    clear = bindpose.render(to_dataset(shapes.cube()), size="200x160", transparent=True)
    assert clear.shape == (160, 200, 4) and set(np.unique(clear[..., 3])) >= {0, 255}


def test_the_first_row_of_a_picture_is_at_the_top():
    points, triangles = shapes.cube()
    flat = np.array(points) * [1, 0.2, 1] + [0, 5, 0]
    low = np.array(points) * 0.01
    tower = (np.concatenate([flat, low]), np.concatenate([triangles, np.array(triangles) + len(points)]))
    alpha = bindpose.render(tower, size="200x200", transparent=True)[..., 3]
    covered = np.nonzero(alpha.any(axis=1))[0]
    widths = (alpha > 0).sum(axis=1)
    assert widths[covered[:10]].max() > 5 * widths[covered[-1]]


def test_several_meshes_handles_and_context(tmp_path):
    handles = bindpose.handles(points=[[0, 0, 1]])
    bindpose.write(shapes.cube(), tmp_path / "cube.off")
    bindpose.render(shapes.sphere(16, 8), tmp_path / "cube.off", output=tmp_path / "p.png", handles=handles,
                    context=[shapes.open_cube()], labels=["a", "b"], size="300x150", edges=True)
    assert (tmp_path / "p.png").read_bytes().startswith(b"\x89PNG")
    with pytest.raises(bindpose.InvalidInput, match="the file exists"):
        bindpose.render(shapes.cube(), output=tmp_path / "p.png")
    bindpose.render(shapes.cube(), output=tmp_path / "p.png", overwrite=True, size="100x100")


@pytest.mark.parametrize("keywords, sentence", [
    ({"size": "wide"}, "size"), ({"scale": 9}, "scale must be an integer"), ({"color": "red"}, "color must be one of"),
    ({"array": "Missing"}, "Missing"), ({"handles": "missing.tgf"}, "missing.tgf")])
def test_a_wrong_option_is_named(keywords, sentence):
    with pytest.raises(bindpose.InvalidInput, match=sentence):
        bindpose.render(shapes.cube(), **keywords)


def test_nothing_to_draw():
    with pytest.raises(bindpose.InvalidInput, match="at least one mesh"):
        bindpose.render()


def test_defects_of_a_surface():
    assert bindpose.defects(shapes.cube()).GetNumberOfCells() == 0
    found = bindpose.defects(shapes.open_cube())
    names = found.GetCellData().GetAbstractArray("DefectName")
    assert {names.GetValue(k) for k in range(found.GetNumberOfCells())} == {"boundary edge"}
    assert bindpose.report(found)["counts"]["boundary_edges"] == found.GetNumberOfCells() == 4


def test_the_module_is_the_program():
    done = subprocess.run([sys.executable, "-m", "bindpose", "--version"], capture_output=True, text=True, check=True)
    assert bindpose.__version__ in done.stdout and re.fullmatch(r"\d+\.\d+\.\d+", bindpose.__version__)
    done = subprocess.run([sys.executable, "-m", "bindpose", "inf"], capture_output=True, text=True, check=False)
    assert done.returncode == 1 and "info" in done.stderr


def test_a_progress_bar_on_the_standard_error(capfd):
    seen = []
    bindpose.winding_number(shapes.sphere(60, 30), 64, progress=lambda *each: seen.append(each), progress_bar=True)
    drawn = capfd.readouterr().err
    assert seen and re.search(r"\r\[#*-*\] +\d+ % evaluate", drawn) and drawn.endswith("\r")
    bindpose.winding_number(shapes.cube(), 8)
    assert capfd.readouterr().err == ""


def test_another_version_of_vtk_is_refused(tmp_path):
    (tmp_path / "vtkmodules").mkdir()
    (tmp_path / "vtkmodules" / "__init__.py").write_text("")
    (tmp_path / "vtkmodules" / "vtkCommonCore.py").write_text(
        "class vtkVersion:\n    GetVTKMajorVersion = staticmethod(lambda: 9)\n    GetVTKMinorVersion = staticmethod(lambda: 77)\n")
    package = pathlib.Path(bindpose.__file__).parents[1]
    done = subprocess.run([sys.executable, "-c", "import bindpose"], capture_output=True, text=True, check=False,
                          env={**os.environ, "PYTHONPATH": os.pathsep.join(map(str, (tmp_path, package)))})
    assert re.search(r"ImportError: this bindpose was built for VTK 9\.\d+, but vtkmodules is VTK 9\.77: ", done.stderr)
