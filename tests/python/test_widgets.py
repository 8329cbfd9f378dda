"""The VTK widgets from Python, without a window: handles are posed by numbers and edited."""

import bindpose
import numpy as np
import pytest
from vtkmodules.util.numpy_support import vtk_to_numpy


@pytest.fixture
def drawn():
    handles = bindpose.handles([[1, 2, 3]], [[[0, 0, 0], [0, 1, 0]]])
    representation = bindpose.vtkHandleSetRepresentation()
    representation.SetHandles(handles)
    return representation


def transform(representation, cell):
    array = representation.GetHandles().GetCellData().GetArray("Transform")
    return vtk_to_numpy(array)[cell].reshape(3, 4)


def test_poses_in_numbers(drawn):
    assert drawn.SetHandleTranslation(0, (0.5, 0, 0))
    assert np.allclose(transform(drawn, 0), [[1, 0, 0, 0.5], [0, 1, 0, 0], [0, 0, 1, 0]])
    assert drawn.SetHandleRotation(1, (0, 0, 1), 90)
    assert np.allclose(transform(drawn, 1)[:, :3] @ [0, 1, 0], [-1, 0, 0])
    axis = [0.0, 0.0, 0.0]
    assert drawn.GetHandleRotation(1, axis) == pytest.approx(90)
    assert axis == pytest.approx([0, 0, 1])
    assert drawn.SetHandleStretch(1, 1.5)
    assert drawn.GetHandleStretch(1) == 1.5
    assert not drawn.SetHandleStretch(0, 1.5), "a point has no length"
    assert not drawn.SetHandleScale(0, 0.0)


def test_selection(drawn):
    drawn.SetSelectedHandle(0)
    drawn.ToggleSelected(1)
    assert [drawn.GetSelectedHandle(i) for i in range(drawn.GetNumberOfSelectedHandles())] == [0, 1]
    assert drawn.GetDragRefusal(5) == drawn.IS_NO_HANDLE


@pytest.mark.parametrize("name", ["vtkHandleSetWidget", "vtkRegionBrushWidget"])
def test_bindings_are_a_table(name):
    widget = getattr(bindpose, name)()
    rows = [(widget.GetBindingWhen(i), widget.GetBindingInput(i), widget.GetBindingText(i))
            for i in range(widget.GetNumberOfBindings())]
    assert len(rows) == len(set(rows)) >= 5
    assert all(all(row) for row in rows)
