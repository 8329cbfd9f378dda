"""Handles that are made from arrays equal those that are read from files."""

import bindpose
import numpy as np
import pytest
import shapes


def names_and_parents(data):
    names = data.GetCellData().GetAbstractArray("HandleName")
    parents = data.GetCellData().GetArray("Parent")
    return [(names.GetValue(i), int(parents.GetValue(i))) for i in range(data.GetNumberOfCells())]


def test_arrays_and_tgf_agree(tmp_path):
    (tmp_path / "h.tgf").write_text("1 9 9 9 ear\n2 0 0 0\n3 1 0 0\n4 2 0 0\n#\n2 3\n3 4\n")
    from_file = bindpose.read_handles(tmp_path / "h.tgf")
    made = bindpose.handles([[9, 9, 9]], [[[0, 0, 0], [1, 0, 0]], [[1, 0, 0], [2, 0, 0]]], ["ear", "b1", "b2"])
    assert names_and_parents(made) == names_and_parents(from_file) == [("ear", -1), ("b1", -1), ("b2", 1)]
    for cell in range(3):
        assert made.GetCell(cell).GetBounds() == from_file.GetCell(cell).GetBounds()
    bindpose.write(made, tmp_path / "made.vtp")
    assert names_and_parents(bindpose.read_handles(tmp_path / "made.vtp")) == names_and_parents(made)


def test_defaults_and_parents():
    made = bindpose.handles(np.zeros((1, 3)), [[[0, 0, 0], [1, 0, 0]]])
    assert names_and_parents(made) == [("p1", -1), ("b1", -1)]
    made = bindpose.handles(points=[[0, 0, 0], [1, 1, 1]], parents=[-1, 0])
    assert names_and_parents(made) == [("p1", -1), ("p2", 0)]


@pytest.mark.parametrize("arguments, sentence", [
    ({}, "no handle"),
    ({"points": [[0, 0]]}, "#P x 3"),
    ({"bones": [[0, 0, 0]]}, "#B x 2 x 3"),
    ({"points": [[0, 0, 0]], "names": ["a", "b"]}, "2 names"),
])
def test_wrong_shapes(arguments, sentence):
    with pytest.raises(bindpose.InvalidInput, match=sentence):
        bindpose.handles(**arguments)


def test_farthest_points():
    data = bindpose.farthest_point_handles(shapes.cube(), 2)
    assert names_and_parents(data) == [("p1", -1), ("p2", -1)]
    assert data.GetBounds() == (-1, 1, -1, 1, -1, 1)
    with pytest.raises(bindpose.InvalidInput, match="only 8"):
        bindpose.farthest_point_handles(shapes.cube(), 9)


def test_automatic_points():
    data = bindpose.automatic_handles(shapes.cube(), method="points", number_of_points=5)
    assert [name for name, _parent in names_and_parents(data)] == ["p1", "p2", "p3", "p4", "p5"]
    assert all(abs(bound) < 1 for bound in data.GetBounds())
    assert bindpose.report(data)["counts"]["points_inside"] == 5
    corners = bindpose.automatic_handles(shapes.cube(), method="points", number_of_points=2, place_inside=False, distance="straight")
    assert corners.GetBounds() == (-1, 1, -1, 1, -1, 1)
    with pytest.raises(bindpose.InvalidInput, match="only 8"):
        bindpose.automatic_handles(shapes.cube(), method="points", number_of_points=9)
    with pytest.raises(bindpose.InvalidInput, match="along-edges"):
        bindpose.automatic_handles(shapes.cube(), method="points", number_of_points=2, distance="far")


def test_automatic_bones():
    points, triangles = shapes.bar()
    try:
        data = bindpose.automatic_handles((points, triangles), maximum_bones=3, longest_bone=0.1)
    except bindpose.Unavailable:
        pytest.skip("built without bindpose-mesher")
    assert sorted(name for name, _parent in names_and_parents(data)) == ["b1", "b2", "b3"]
    assert bindpose.report(data)["counts"]["joints_outside"] == 0
    bound = bindpose.weights((points, triangles), "skeleton:1")
    assert len(bound) == len(points) and np.allclose(bound, 1)
    with pytest.raises(bindpose.InvalidInput, match="an integer N"):
        bindpose.weights((points, triangles), "skeleton:none")
