"""The plugin for PyVista, with a stand-in for PyVista (stand_in/pyvista), because no package of Debian 12 contains it."""

import inspect
import pathlib
import subprocess
import sys

import bindpose
import numpy as np
import pytest
import shapes
from bindpose.meshes import point_array, points_of, to_dataset

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent / "stand_in"))
import pyvista  # noqa: E402
from pyvista.core.utilities.reader_registry import LocalFileRequiredError  # noqa: E402


def mesh_of(shape):
    return pyvista.wrap(to_dataset(shape))


def test_the_package_does_not_import_pyvista():
    code = "import bindpose, sys; sys.exit('pyvista' in sys.modules or 'bindpose.pyvista_plugin' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_every_stage_is_a_method_of_the_mesh():
    bar = mesh_of(shapes.bar())
    handles = bindpose.handles(bones=[[[0.5, 0.5, 0.5], [3, 0.5, 0.5]], [[3, 0.5, 0.5], [5.5, 0.5, 0.5]]])
    assert type(bar.bindpose.winding_number(8)) is pyvista.ImageData
    assert bar.bindpose.contains([[3, 0.5, 0.5], [9, 9, 9]]).tolist() == [True, False]
    assert type(bar.bindpose.tetrahedralize(method="embed")) is pyvista.UnstructuredGrid
    assert type(bar.bindpose.defects()) is pyvista.PolyData
    weighted = bar.bindpose.weights(handles, domain="surface")
    assert type(weighted) is pyvista.PolyData and point_array(weighted, "Weights").shape[1] == 2
    bend = {"b2": {"rotate": {"axis": [0, 0, 1], "degrees": 40}}}
    posed = weighted.bindpose.deform(handles, {"handles": bend})
    assert type(posed) is pyvista.PolyData
    rig = bar.bindpose.bind(handles, domain="surface")
    assert type(rig.pose(bend)) is pyvista.PolyData and np.array_equal(points_of(rig.pose(bend)), points_of(posed))
    assert bar.bindpose.render(size="80x60").shape == (60, 80, 3)


def test_methods_have_the_signatures_of_the_functions():
    ours = list(inspect.signature(pyvista.PolyData().bindpose.tetrahedralize).parameters)
    assert ours == list(inspect.signature(bindpose.tetrahedralize).parameters)[1:]
    assert "Fill the inside" in pyvista.PolyData().bindpose.tetrahedralize.__doc__
    with pytest.raises(AttributeError):
        pyvista.PolyData().bindposes


def test_files_of_the_package(tmp_path):
    cube = mesh_of(shapes.cube())
    for extension in (".off", ".mesh"):
        path = str(tmp_path / f"cube{extension}")
        pyvista.handler("pyvista.writers", extension)(cube, path)
        back = pyvista.handler("pyvista.readers", extension)(path)
        assert type(back) is pyvista.PolyData and np.array_equal(points_of(back), points_of(cube))
    (tmp_path / "h.tgf").write_text("1 0 0 0\n2 1 0 0\n#\n1 2 1\n")
    assert pyvista.handler("pyvista.readers", ".tgf")(str(tmp_path / "h.tgf")).GetNumberOfCells() == 1
    weighted = bindpose.weights(cube, "auto:2", domain="surface")
    pyvista.handler("pyvista.writers", ".dmat")(weighted, str(tmp_path / "w.dmat"))
    assert (tmp_path / "w.dmat").read_text().split()[:2] == ["2", str(cube.GetNumberOfPoints())]
    with pytest.raises(bindpose.InvalidInput, match="unexpected option 'level'"):
        pyvista.handler("pyvista.readers", ".off")(str(tmp_path / "cube.off"), level=1)


def test_other_files_are_left_to_pyvista(tmp_path):
    read = pyvista.handler("pyvista.readers", ".mesh")
    (tmp_path / "prism.mesh").write_text("MeshVersionFormatted 1\nDimension 3\nVertices\n6\n" + "0 0 0 0\n" * 6 +
                                         "Prisms\n1\n1 2 3 4 5 6 0\nEnd\n")
    assert type(read(str(tmp_path / "prism.mesh"))) is pyvista.UnstructuredGrid
    (tmp_path / "text.mesh").write_text("a text")
    with pytest.raises(bindpose.InvalidInput, match="text.mesh"):
        read(str(tmp_path / "text.mesh"))
    with pytest.raises(LocalFileRequiredError):
        read("https://example.org/tets.mesh")
