"""Conversion of arrays to VTK datasets and back."""

import bindpose
import numpy as np
import pytest
import shapes
from bindpose import meshes
from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkCellArray, vtkPolyData, vtkUnstructuredGrid


def test_triangles_and_tets():
    vertices, faces = shapes.cube()
    surface = meshes.to_dataset((vertices, faces))
    assert surface.GetNumberOfCells() == 12 and not meshes.is_tets(surface)
    assert np.array_equal(meshes.points_of(surface), np.array(vertices))
    tets = meshes.to_dataset((np.eye(4, 3), np.array([[3, 0, 1, 2]], dtype=np.int32)))
    assert meshes.is_tets(tets)
    assert np.array_equal(meshes.tets_of(tets), [[3, 0, 1, 2]])
    assert meshes.to_dataset(surface) is surface


def test_the_arrays_stay_the_callers():
    vertices = np.array(shapes.cube()[0], dtype=float)
    surface = meshes.to_dataset((vertices, shapes.cube()[1]))
    vertices[:] = 7
    assert surface.GetBounds() == (-1, 1, -1, 1, -1, 1)


@pytest.mark.parametrize("mesh", [
    5, "mesh", (np.zeros((3, 3)),), (np.zeros((3, 2)), [[0, 1, 2]]), (np.zeros((3, 3)), [[0, 1]]),
    (np.zeros((3, 3)), [[0.5, 1, 2]]), ([["a", "b", "c"]], [[0, 0, 0]]),
])
def test_what_is_no_mesh(mesh):
    with pytest.raises(bindpose.InvalidInput):
        meshes.to_dataset(mesh)


@pytest.mark.parametrize("kind, size, message", [("Verts", 0, "vertex cell 0 has 0 points"), ("Lines", 1, "line 0 has 1 point;"),
                                                 ("Polys", 2, "polygon 0 has 2 points"), ("Strips", 2, "triangle strip 0 has 2 points")])
def test_cells_with_too_few_points(kind, size, message):
    surface = meshes.to_dataset(shapes.cube())
    cells = vtkCellArray()
    cells.InsertNextCell(size, list(range(size)))
    getattr(surface, f"Set{kind}")(cells)
    handles = bindpose.handles(points=[[0, 0, 0], [1, 1, 1]])
    for function in (bindpose.winding_number, bindpose.defects, bindpose.tetrahedralize, bindpose.automatic_handles,
                     lambda mesh: bindpose.weights(mesh, handles)):
        with pytest.raises(bindpose.InvalidInput, match=message):
            function(surface)


def test_tets_with_too_few_points():
    grid = meshes.to_dataset((np.eye(4, 3), np.array([[3, 0, 1, 2]])))
    cells = vtkCellArray()
    cells.InsertNextCell(3, [0, 1, 2])
    grid.SetCells(VTK_TETRA, cells)
    with pytest.raises(bindpose.InvalidInput, match="cell 0 of type 10 has 3 points; expected 4"):
        bindpose.weights(grid, bindpose.handles(points=[[0, 0, 0], [1, 0, 0]]))


def test_arrays_remember_their_report():
    array = bindpose.Array([[1.0, 2.0]], {"status": "ok"}, ["a", "b"])
    assert bindpose.report(array) == {"status": "ok"}
    assert array.names == ["a", "b"]
    assert (2 * array).tolist() == [[2.0, 4.0]]
    assert bindpose.report(array.copy()) == {"status": "ok"}


class PolyData(vtkPolyData):
    """Replace pyvista.PolyData."""


class Grid(vtkUnstructuredGrid):
    """Replace pyvista.UnstructuredGrid."""


def wrap(data):
    """Replace pyvista.wrap(). Bindpose looks for a function of this name in the package that contains the class of a
    dataset.
    """
    result = {"vtkPolyData": PolyData, "vtkUnstructuredGrid": Grid}[data.GetClassName()]()
    result.ShallowCopy(data)
    return result


def test_results_have_the_class_of_their_source():
    mesh = PolyData()
    mesh.ShallowCopy(meshes.to_dataset(shapes.bar()))
    handles = bindpose.handles(points=[[0, 0.5, 0.5], [6, 0.5, 0.5]])
    weighted = bindpose.weights(mesh, handles, domain="surface")
    assert type(weighted) is PolyData and bindpose.report(weighted)["seconds"]
    frames = bindpose.deform(weighted, handles, {"frames": [{"handles": {}}] * 2})
    assert [type(frame) for frame in frames] == [PolyData, PolyData]
    assert type(bindpose.bind(mesh, handles, domain="surface").pose({})) is PolyData
    tets = bindpose.tetrahedralize(mesh)
    assert type(tets) is Grid and tets.GetNumberOfCells() > 0 and bindpose.report(tets)["method"] == "cdt"
    assert type(bindpose.weights(meshes.to_dataset(shapes.bar()), handles, domain="surface")) is vtkPolyData
