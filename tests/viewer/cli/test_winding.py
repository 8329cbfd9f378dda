"""winding: analytic values on grids and at points."""

import bindpose
import numpy as np
import pytest
import shapes
from bindpose.meshes import point_array, points_of


def test_grid_of_a_cube(folder):
    folder.off("cube.off", shapes.cube())
    run = folder.run("winding", "cube.off", "--grid", "24", "-o", "field.vti", "--report", "-").is_good()
    assert run.new_files == ["field.vti"]
    assert run.err == ""  # no progress where nobody looks
    field = bindpose.read(folder / "field.vti")
    assert field.GetDimensions() == (24, 24, 24)
    spacing = field.GetSpacing()
    assert spacing[0] == pytest.approx(spacing[1]) == pytest.approx(spacing[2])
    padding = 0.1 * 2 * 3**0.5
    assert field.GetBounds() == pytest.approx([s * (1 + padding) for s in (-1, 1) * 3], rel=1e-9)
    values = point_array(field, "WindingNumber")
    assert values.dtype == np.float64
    points = np.array([field.GetPoint(i) for i in range(field.GetNumberOfPoints())])
    inside = np.abs(points).max(axis=1) < 1
    assert np.abs(values - inside).max() < 1e-12
    report = run.report
    assert report["status"] == "ok" and report["method"]
    assert {"build", "evaluate", "total"} <= set(report["seconds"])
    assert report["counts"]["triangles"] == 12
    assert report["winding_volume"] == pytest.approx(8.0, rel=0.2)


def test_points_of_a_dataset(folder):
    folder.off("open.off", shapes.open_cube())
    # SPEC values of the cube without its top.
    known = {(0, 0, 0): 5 / 6, (0, 0, 0.5): 0.704832764699, (0, 0, -0.5): 0.900443260337, (0, 0, 1.5): 0.295167235301}
    vertices = [list(p) for p in known]
    folder.off("at.off", (vertices, [[0, 1, 2]]))
    folder.run("winding", "open.off", "--points", "at.off", "--method", "exact", "-o", "at.vtp").is_good()
    result = bindpose.read(folder / "at.vtp")
    assert np.array_equal(points_of(result), np.array(vertices, dtype=float))
    assert point_array(result, "WindingNumber") == pytest.approx(list(known.values()), abs=1e-11)


def test_same_bits_for_any_number_of_threads(folder):
    folder.off("sphere.off", shapes.sphere())
    results = []
    for threads in ("1", "2"):
        name = f"t{threads}.vti"
        folder.run("winding", "sphere.off", "--grid", "20", "--threads", threads, "-o", name).is_good()
        results.append(point_array(bindpose.read(folder / name), "WindingNumber"))
    assert np.array_equal(*results)


def test_any_surface_has_a_field(folder):
    folder.off("m.off", shapes.cube())
    centre = folder.off("centre.off", ([[0.01, 0.02, 0.03]] * 3, [[0, 1, 2]]))
    for mesh, expected in ((shapes.flipped(shapes.cube()), -1), (shapes.doubled(shapes.cube()), 2), (shapes.quads(), 1)):
        folder.off("m.off", mesh)
        folder.run("winding", "m.off", "--points", centre, "-o", "w.vtp", "--overwrite").is_good()
        assert point_array(bindpose.read(folder / "w.vtp"), "WindingNumber") == pytest.approx([expected] * 3, abs=1e-12)
    for mesh in (shapes.flat(), shapes.one_triangle()):
        folder.off("m.off", mesh)
        folder.run("winding", "m.off", "--grid", "8", "-o", "w.vti", "--overwrite").is_good()
        assert np.isfinite(point_array(bindpose.read(folder / "w.vti"), "WindingNumber")).all()


def test_endings_fit_what_is_written(folder):
    folder.off("cube.off", shapes.cube())
    folder.run("winding", "cube.off", "-o", "w.vtp").is_refused("w.vtp", "ending")
    folder.run("winding", "cube.off", "--points", "cube.off", "-o", "w.vti").is_refused("w.vti", "ending")
