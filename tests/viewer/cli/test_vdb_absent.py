"""In a build without OpenVDB, the program names the missing package before it does any work."""

import bindpose
import pytest
import shapes


def test_winding_names_the_package(folder):
    folder.off("mesh.off", shapes.cube())
    folder.run("winding", "mesh.off", "-o", "field.vdb").is_refused("libopenvdb-dev")
    folder.run("winding", "none.off", "-o", "field.vdb").is_refused("libopenvdb-dev")


def test_write_names_the_package(tmp_path):
    field = bindpose.winding_number(shapes.cube(), 8)
    with pytest.raises(bindpose.Unavailable, match="libopenvdb-dev"):
        bindpose.write(field, tmp_path / "field.vdb")
    assert not list(tmp_path.iterdir())
