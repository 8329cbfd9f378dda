"""Files: round trips, and errors as exceptions."""

import bindpose
import numpy as np
import pytest
import shapes
from bindpose.meshes import points_of
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData


@pytest.mark.parametrize("ending", ["off", "obj", "ply", "vtp", "mesh"])
def test_arrays_come_back_bit_for_bit(tmp_path, ending):
    vertices, faces = shapes.sphere(radius=1 / 3)
    path = tmp_path / f"sphere.{ending}"
    bindpose.write((vertices, faces), path)
    back = bindpose.read(path)
    assert isinstance(back, vtkPolyData)
    assert np.array_equal(points_of(back), np.array(vertices))
    assert back.GetNumberOfCells() == len(faces)
    assert bindpose.report(back)["counts"]["vertices"] == len(vertices)


def test_existing_files_are_kept(tmp_path):
    path = tmp_path / "m.off"
    bindpose.write(shapes.cube(), path)
    with pytest.raises(bindpose.InvalidInput, match="exists already"):
        bindpose.write(shapes.flat(), path)
    assert bindpose.read(path).GetNumberOfCells() == 12
    bindpose.write(shapes.flat(), path, overwrite=True)
    assert bindpose.read(path).GetNumberOfCells() == 2


def test_errors(tmp_path):
    with pytest.raises(bindpose.InvalidInput, match="No such file") as caught:
        bindpose.read(tmp_path / "none.off")
    assert isinstance(caught.value, ValueError) and isinstance(caught.value, bindpose.BindposeError)
    assert caught.value.status == "invalid_input"
    assert caught.value.report["status"] == "invalid_input"
    (tmp_path / "bad.off").write_text("OFF\n3 1 0\n0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n")
    with pytest.raises(ValueError, match="bad.off, line 4"):
        bindpose.read(tmp_path / "bad.off")
    with pytest.raises(bindpose.InvalidInput, match="vtkImageData"):
        image = vtkImageData()
        image.SetDimensions(2, 2, 2)
        bindpose.write(image, tmp_path / "m.vtp")
    with pytest.raises(bindpose.InvalidInput, match="unknown ending"):
        bindpose.write(shapes.cube(), tmp_path / "m.doc")
    with pytest.raises(bindpose.InvalidInput, match="No such file"):
        bindpose.write(shapes.cube(), tmp_path / "no" / "m.off")
    assert [p.name for p in tmp_path.iterdir()] == ["bad.off"]


def test_a_file_without_a_report_has_none(tmp_path):
    assert bindpose.report(vtkPolyData()) == {}
