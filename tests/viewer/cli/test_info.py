"""bindpose info: the numbers of known meshes."""

import json
import math
import time

import bindpose
import pytest
import shapes


def test_cube(folder):
    folder.off("cube.off", shapes.cube())
    run = folder.run("info", "cube.off").is_good()
    assert run.err == ""
    assert run.new_files == []
    for line in ("points              8", "triangles           12", "closed              yes", "volume              8"):
        assert line in run.out
    report = folder.run("info", "cube.off", "--report", "-").is_good().report
    assert report["status"] == "ok"
    assert report["format"] == "off"
    counts = report["counts"]
    assert (counts["vertices"], counts["triangles"], counts["components"]) == (8, 12, 1)
    assert counts["boundary_edges"] == counts["nonmanifold_edges"] == 0
    assert report["volume"] == pytest.approx(8.0, rel=1e-14)
    assert report["area"] == pytest.approx(24.0, rel=1e-14)
    assert report["bounds"] == [-1, 1, -1, 1, -1, 1]
    assert report["diagonal"] == pytest.approx(2 * math.sqrt(3))
    assert report["seconds"]["total"] > 0 and report["peak_memory_bytes"] > 0


def test_a_count_of_crossings_that_takes_too_long_is_left_out(folder):
    """Long needles through one point: every pair of them crosses. Their count is left out."""
    count = 20_000
    vertices, faces = [], []
    for k in range(count):
        angle = math.pi * k / count
        x, y, z = math.cos(angle), math.sin(angle), 1e-4 * math.sin(7.0 * k)
        vertices += [(x, y, z), (-x, -y, -z), (-x + 1e-3 * y, -y - 1e-3 * x, z)]
        faces.append((3 * k, 3 * k + 1, 3 * k + 2))
    folder.off("needles.off", (vertices, faces))
    started = time.monotonic()
    run = folder.run("info", "needles.off", "--report", "r.json").is_good()
    assert time.monotonic() - started < 20  # 2 s on an idle machine
    assert "self-intersections  counting stopped at its time limit of 1.7 s" in run.out
    counts = json.loads((folder / "r.json").read_text())["counts"]
    assert counts["triangles"] == count and "self_intersections" not in counts


def test_where_a_surface_is_unclean(folder):
    folder.off("m.off", shapes.open_cube())
    run = folder.run("info", "m.off", "--defects", "d.vtp").is_good()
    assert run.new_files == ["d.vtp"] and "boundary edges" in run.out
    defects = bindpose.read(folder / "d.vtp")
    assert defects.GetNumberOfLines() == defects.GetNumberOfCells() == 4
    assert defects.GetCellData().GetAbstractArray("DefectName").GetValue(0) == "boundary edge"
    folder.off("cube.off", shapes.cube())
    run = folder.run("info", "cube.off", "--defects", "none.vtp").is_good()
    assert run.new_files == [] and "no defect" in run.err
    folder.run("info", "m.off", "--defects", "d.off").is_refused()


def test_numbers_are_those_of_the_legend(folder):
    """Check the units of the counts. Inward components are counted as components. Intersections are counted as pairs of
    triangles, and also as triangles that are part of a pair.
    """
    vertices, faces = [], []
    for k in range(3):
        cube = shapes.flipped(shapes.cube(3.0 * k, 3.0 * k + 1))
        faces += [[v + len(vertices) for v in face] for face in cube[1]]
        vertices += cube[0]
    for corner in ([-2, -2, -2], [-3, -2.2, -2.1]):
        cube = shapes.cube(0, 1.5)
        faces += [[v + len(vertices) for v in face] for face in cube[1]]
        vertices += [[a + b for a, b in zip(v, corner)] for v in cube[0]]
    folder.off("m.off", (vertices, faces))
    run = folder.run("info", "m.off", "--defects", "d.vtp").is_good()
    counts = folder.run("info", "m.off", "--report", "-").is_good().report["counts"]
    assert counts["components"] == 5 and counts["inward_components"] == 3
    assert f"{counts['self_intersections']} pairs, {counts['crossing_triangles']} intersecting triangles" in run.out
    cells = bindpose.read(folder / "d.vtp").GetCellData()
    kinds = [cells.GetAbstractArray("DefectName").GetValue(k) for k in range(cells.GetNumberOfTuples())]
    inward = {int(cells.GetArray("InwardComponent").GetTuple1(k)) for k, kind in enumerate(kinds) if kind == "inward component"}
    assert inward == {0, 1, 2} and kinds.count("inward component") == 36
    assert kinds.count("crossing triangle") == counts["crossing_triangles"] > 0
    report = folder.run("render", "m.off", "--defects", "-o", "d.png", "--size", "200x200", "--report", "-").is_good().report
    legend = {entry["name"]: entry["count"] for entry in report["picture"]["defects"]}
    assert legend["inward component"] == 3 and legend["crossing triangle"] == counts["crossing_triangles"]


def test_unclean_surfaces(folder):
    def counts(mesh):
        folder.off("m.off", mesh)
        report = folder.run("info", "m.off", "--report", "-").is_good().report
        return report, report["counts"]

    report, c = counts(shapes.open_cube())
    assert c["boundary_edges"] == 4 and report["closed"] == "no" and "volume" not in report
    report, c = counts(shapes.flipped(shapes.cube()))
    assert report["volume"] == pytest.approx(-8.0) and c["misoriented_edges"] == 0
    report, c = counts(shapes.doubled(shapes.cube()))
    assert c["nonmanifold_edges"] == 18 and report["volume"] == pytest.approx(16.0)
    report, c = counts(shapes.quads())
    assert c["triangles"] == 12 and c["triangulated_cells"] == 6 and report["volume"] == pytest.approx(8.0)
    report, c = counts(shapes.flat())
    assert c["boundary_edges"] == 4 and report["area"] == pytest.approx(1.0)
    report, c = counts(shapes.one_triangle())
    assert c["triangles"] == 1 and c["boundary_edges"] == 3
    vertices, faces = shapes.cube()
    report, c = counts((vertices, faces + [[0, 0, 1]]))
    assert c["degenerate_triangles"] == 1


def test_handles(folder):
    folder.write("h.tgf", shapes.TWO_BONES)
    run = folder.run("info", "h.tgf").is_good()
    assert "bone  b2  parent b1" in run.out
    report = folder.run("info", "h.tgf", "--report", "-").is_good().report
    assert report["handles"] == [{"name": "b1", "kind": "bone"}, {"name": "b2", "kind": "bone"}]


def test_tets(folder):
    folder.write("t.mesh", "MeshVersionFormatted 2 Dimension 3 Vertices 4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n"
                           "Tetrahedra 1\n1 2 3 4 0\nEnd\n")
    report = folder.run("info", "t.mesh", "--report", "-").is_good().report
    assert report["counts"]["tets"] == 1 and report["counts"]["boundary_triangles"] == 4
    assert report["volume"] == pytest.approx(1 / 6)


def test_report_file(folder):
    folder.off("cube.off", shapes.cube())
    assert folder.run("info", "cube.off", "--report", "r.json").is_good().new_files == ["r.json"]
    folder.run("info", "cube.off", "--report", "r.json").is_refused("r.json", "the file exists")
    folder.run("info", "cube.off", "--report", "r.json", "--overwrite").is_good()
    folder.run("info", "cube.off", "--report", "no/r.json").is_refused("no/r.json")


def test_report_of_a_failure(folder):
    run = folder.run("info", "none.off", "--report", "-").is_refused("none.off")
    assert run.report["status"] == "invalid_input"
    assert "none.off" in run.report["message"]
    assert "volume" not in run.report
