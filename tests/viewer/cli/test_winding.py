"""bindpose winding: analytic values on grids and at points."""

import bindpose
import numpy as np
import pytest
import shapes
from bindpose.meshes import point_array, points_of


def test_grid_of_a_cube(folder):
    folder.off("cube.off", shapes.cube())
    run = folder.run("winding", "cube.off", "--resolution", "24", "-o", "field.vti", "--report", "-").is_good()
    assert run.new_files == ["field.vti"]
    assert run.err == ""  # without a terminal there is no progress line
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
    # These are the exact winding numbers of the cube without its top.
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
        folder.run("winding", "sphere.off", "--resolution", "20", "--threads", threads, "-o", name).is_good()
        results.append(point_array(bindpose.read(folder / name), "WindingNumber"))
    assert np.array_equal(*results)


def test_any_surface_has_a_field(folder):
    folder.off("m.off", shapes.cube())
    center = folder.off("center.off", ([[0.01, 0.02, 0.03]] * 3, [[0, 1, 2]]))
    for mesh, expected in ((shapes.flipped(shapes.cube()), -1), (shapes.doubled(shapes.cube()), 2), (shapes.quads(), 1)):
        folder.off("m.off", mesh)
        folder.run("winding", "m.off", "--points", center, "-o", "w.vtp", "--overwrite").is_good()
        assert point_array(bindpose.read(folder / "w.vtp"), "WindingNumber") == pytest.approx([expected] * 3, abs=1e-12)
    for mesh in (shapes.flat(), shapes.one_triangle()):
        folder.off("m.off", mesh)
        folder.run("winding", "m.off", "--resolution", "8", "-o", "w.vti", "--overwrite").is_good()
        assert np.isfinite(point_array(bindpose.read(folder / "w.vti"), "WindingNumber")).all()


def test_fast_keeps_its_tolerance(folder):
    vertices, triangles = shapes.sphere()
    folder.off("soup.off", (vertices, triangles[::2]))
    exact, fast = [], []
    for values, *options in ((exact, "exact"), (fast, "fast", "--tolerance", "1e-4")):
        run = folder.run("winding", "soup.off", "--resolution", "20", "--method", *options, "-o", "w.vti", "--overwrite",
                         "--report", "-").is_good()
        values[:] = point_array(bindpose.read(folder / "w.vti"), "WindingNumber")
    assert np.abs(np.subtract(exact, fast)).max() <= 1e-4
    assert run.report["error_bound"] == 1e-4 and run.report["measured_error"] <= 1e-4
    assert run.report["method"] == "fast" and run.report["method_reason"]


def test_every_output_on_demand(folder):
    folder.off("open.off", shapes.open_cube())
    run = folder.run("winding", "open.off", "--resolution", "10", "--compute-gradient", "--compute-inside", "--winding-threshold", "0.7",
                     "--output-precision", "single", "--boundary", "boundary.vtp", "-o", "w.vti").is_good()
    assert sorted(run.new_files) == ["boundary.vtp", "w.vti"]
    field = bindpose.read(folder / "w.vti")
    values = point_array(field, "WindingNumber")
    assert values.dtype == np.float32
    assert np.array_equal(point_array(field, "Inside"), values >= 0.7)
    gradient = point_array(field, "WindingNumberGradient").reshape(10, 10, 10, 3)
    step = field.GetSpacing()[2]
    middle = values.reshape(10, 10, 10)[2:6, 5, 5]  # there is no wall between these samples
    assert gradient[3:5, 5, 5, 2] == pytest.approx((middle[2:] - middle[:-2]) / (2 * step), rel=0.1)
    boundary = bindpose.read(folder / "boundary.vtp")
    assert boundary.GetNumberOfLines() == 4 and boundary.GetBounds() == pytest.approx((-1, 1, -1, 1, 1, 1))


def test_cell_centers_and_orientation(folder):
    folder.off("flipped.off", shapes.flipped(shapes.cube()))
    folder.off("at.off", ([[-1.5, -1.5, 0], [1.5, -1.5, 0], [0, 3, 0]], [[0, 1, 2]]))
    run = folder.run("winding", "flipped.off", "--points", "at.off", "--sample-cell-centers", "--orient-patches",
                     "-o", "at.vtp", "--report", "-").is_good()
    result = bindpose.read(folder / "at.vtp")
    assert result.GetCellData().GetArray("WindingNumber").GetValue(0) == pytest.approx(1.0)
    assert run.report["counts"]["turned_components"] == 1


def test_options_that_make_no_sense(folder):
    folder.off("cube.off", shapes.cube())
    folder.run("winding", "cube.off", "--tolerance", "0", "-o", "w.vti").is_refused("--tolerance", "1e-08 to 0.1", code=1)
    folder.run("winding", "cube.off", "--resolution", "100000", "-o", "w.vti").is_refused("samples")
    folder.run("winding", "cube.off", "--boundary", "b.png", "-o", "w.vti").is_refused("b.png")


def test_endings_fit_what_is_written(folder):
    folder.off("cube.off", shapes.cube())
    folder.run("winding", "cube.off", "-o", "w.vtp").is_refused("w.vtp", "file name extension")
    folder.run("winding", "cube.off", "--points", "cube.off", "-o", "w.vti").is_refused("w.vti", "file name extension")


def test_curves_and_oriented_points(folder):
    from vtkmodules.vtkCommonCore import vtkDoubleArray
    from vtkmodules.vtkFiltersSources import vtkRegularPolygonSource

    circle = vtkRegularPolygonSource()
    circle.SetNumberOfSides(64)
    circle.GeneratePolygonOff()
    circle.SetRadius(1.0)
    circle.Update()
    bindpose.write(circle.GetOutput(), folder / "circle.vtp")
    run = folder.run("winding", "circle.vtp", "--resolution", "20", "-o", "w.vti", "--report", "-").is_good()
    field = bindpose.read(folder / "w.vti")
    assert field.GetDimensions() == (20, 20, 1)
    radius = np.array([np.hypot(*field.GetPoint(i)[:2]) for i in range(400)])
    values = point_array(field, "WindingNumber")
    turn = np.sign(values[np.argmin(radius)])  # the sign depends on the orientation of the curve in the source file
    assert np.array_equal(values[radius > 1.01], np.zeros((radius > 1.01).sum()))
    assert np.array_equal(values[radius < 0.99], np.full((radius < 0.99).sum(), turn)) and turn != 0
    assert run.report["counts"]["segments"] == 64

    from bindpose.meshes import to_dataset
    vertices, _ = shapes.sphere(40, 20)
    cloud = to_dataset((vertices, [[0, 1, 2]]))
    cloud.SetPolys(None)
    normals = vtkDoubleArray()
    normals.SetName("Normals")
    normals.SetNumberOfComponents(3)
    for vertex in vertices:
        normals.InsertNextTuple(vertex)
    cloud.GetPointData().SetNormals(normals)
    bindpose.write(cloud, folder / "cloud.vtp")
    folder.off("at.off", ([[0, 0, 0], [0.1, 0.2, 0.3], [0, 0, 2]], [[0, 1, 2]]))
    folder.run("winding", "cloud.vtp", "--points", "at.off", "-o", "at.vtp").is_good()
    assert point_array(bindpose.read(folder / "at.vtp"), "WindingNumber") == pytest.approx([1, 1, 0], abs=0.1)
