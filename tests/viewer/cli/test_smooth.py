"""bindpose smooth: the data of a file is smoothed and has only the requested extrema."""

import math

import pytest

SIDE = 12


def square(scalars, extra=""):
    """Return a square grid with SIDE x SIDE cells and the point scalars Height, as a legacy VTK file."""
    row = SIDE + 1
    points = [(i / SIDE, j / SIDE) for j in range(row) for i in range(row)]
    faces = []
    for j in range(SIDE):
        for i in range(SIDE):
            a = j * row + i
            faces += [(a, a + 1, a + row + 1), (a, a + row + 1, a + row)]
    lines = ["# vtk DataFile Version 3.0", "square", "ASCII", "DATASET POLYDATA", f"POINTS {len(points)} double"]
    lines += [f"{x} {y} 0" for x, y in points]
    lines += [f"POLYGONS {len(faces)} {4 * len(faces)}"] + ["3 " + " ".join(map(str, face)) for face in faces]
    lines += [f"POINT_DATA {len(points)}", "SCALARS Height double 1", "LOOKUP_TABLE default"]
    lines += [repr(scalars(x, y)) for x, y in points]
    return "\n".join(lines) + "\n" + extra


def waves(x, y):
    return math.sin(6 * x) * math.cos(4 * y) + 0.1 * math.sin(97 * x + 31 * y)


def lists(**kinds):
    """Return one array of integers per name. Its values are 0 except at the given vertices."""
    count = (SIDE + 1) ** 2
    lines = [f"FIELD FieldData {len(kinds)}"]
    for name, its in kinds.items():
        lines += [f"{name} 1 {count} int", " ".join(str(its.get(v, 0)) for v in range(count))]
    return "\n".join(lines) + "\n"


def test_persistence_and_count(folder):
    folder.write("square.vtk", square(waves))
    done = folder.run("smooth", "square.vtk", "--persistence", "0.4", "--extrema-output", "extrema.vtp", "-o", "s.vtp",
                      "--report", "-").is_good()
    report = done.report
    assert report["extrema_from"] == "persistence" and report["interior_extrema"] == 0
    assert report["counts"]["data_extrema"] > report["counts"]["maxima"] + report["counts"]["minima"]
    assert max(report["relative_gap"], report["kkt_residual"]) <= 1e-6
    assert done.new_files == ["extrema.vtp", "s.vtp"]
    text = folder.run("info", "s.vtp").is_good().out
    assert "Smoothed" in text and "Height" in text
    two = folder.run("smooth", "square.vtk", "--array", "Height", "--number-of-extrema", "2", "--order", "3", "--guide", "harmonic",
                     "--keep-values", "--tolerance", "1e-9", "--rebuilds", "2", "-o", "two.vtk", "--report", "-").is_good().report
    assert two["extrema_from"] == "count" and len(two["extrema"]) == 2
    assert max(two["relative_gap"], two["kkt_residual"]) <= 1e-9
    for extremum in two["extrema"]:
        assert extremum["value"] == pytest.approx(extremum["data"], abs=0)


def test_list(folder):
    folder.write("square.vtk", square(waves, lists(Extrema={20: 1, 140: -1}, Other={140: 1, 20: -1})))
    report = folder.run("smooth", "square.vtk", "-o", "s.vtp", "--report", "-").is_good().report
    assert report["extrema_from"] == "list"
    assert [(e["vertex"], e["kind"]) for e in report["extrema"]] == [(20, "maximum"), (140, "minimum")]
    report = folder.run("smooth", "square.vtk", "--extrema", "Other", "-o", "o.vtp", "--report", "-").is_good().report
    assert [(e["vertex"], e["kind"]) for e in report["extrema"]] == [(20, "minimum"), (140, "maximum")]
    report = folder.run("smooth", "square.vtk", "--number-of-extrema", "3", "-o", "c.vtp", "--report", "-").is_good().report
    assert report["extrema_from"] == "count"


def test_refusals(folder):
    folder.write("square.vtk", square(waves, lists(Extrema={20: 1})))
    folder.write("flat.vtk", square(lambda x, y: 3.5))
    folder.run("smooth", "square.vtk", "-o", "s.vtp").is_refused("no minimum")
    folder.run("smooth", "square.vtk", "--array", "Depth", "-o", "s.vtp").is_refused("'Depth'", "Height")
    folder.run("smooth", "square.vtk", "--extrema", "List", "-o", "s.vtp").is_refused("--extrema", "'List'")
    folder.run("smooth", "square.vtk", "--number-of-extrema", "2", "-o", "s.vtu").is_refused("vtp")
    folder.run("smooth", "square.vtk", "--number-of-extrema", "2", "-o", "s.obj").is_refused("s.obj")
    folder.run("smooth", "square.vtk", "--persistence", "1", "-o", "s.vtp").is_refused("--persistence", "below 1", code=1)
    folder.run("smooth", "square.vtk", "--number-of-extrema", "2", "--data-weight", "-1", "-o", "s.vtp").is_refused("--data-weight", "at least 0", code=1)
    assert "constant" in folder.run("smooth", "flat.vtk", "-o", "s.vtp").is_good().err
    few = folder.run("smooth", "square.vtk", "--number-of-extrema", "2", "--maximum-iterations", "1", "-o", "few.vtp")
    assert few.code == 3 and "not certified" in few.err
