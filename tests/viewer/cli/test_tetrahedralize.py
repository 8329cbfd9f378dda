"""bindpose tetrahedralize: volumes of known shapes, also for unclean surfaces."""

import bindpose
import numpy as np
import pytest
import shapes
from bindpose.meshes import point_array, points_of, tets_of


def volumes(path):
    mesh = bindpose.read(path)
    p = points_of(mesh)[tets_of(mesh)]
    return np.einsum("ti,ti->t", np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), p[:, 3] - p[:, 0]) / 6


def test_a_clean_surface_keeps_its_vertices(folder):
    vertices, faces = shapes.bar()
    folder.off("bar.off", (vertices, faces))
    run = folder.run("tetrahedralize", "bar.off", "-o", "bar.vtu", "--report", "-").is_good()
    assert run.new_files == ["bar.vtu"] and run.err == ""
    assert volumes(folder / "bar.vtu").min() > 0
    assert volumes(folder / "bar.vtu").sum() == pytest.approx(6.0, rel=1e-10)
    report = run.report
    assert report["method"] == "cdt"
    assert report["counts"]["tets"] == len(volumes(folder / "bar.vtu"))
    assert report["volume"] == pytest.approx(6.0, rel=1e-10)
    assert report["winding_volume"] == pytest.approx(6.0, rel=1e-2)
    mesh = bindpose.read(folder / "bar.vtu")
    original = point_array(mesh, "OriginalPointIds")
    kept = original >= 0
    assert sorted(original[kept]) == list(range(len(vertices)))
    assert np.array_equal(points_of(mesh)[kept], np.array(vertices)[original[kept]])
    assert mesh.GetCellData().GetArray("WindingNumber") is not None


@pytest.mark.parametrize("name, mesh, volume", [
    ("open", shapes.open_cube(), 8.0), ("doubled", shapes.doubled(shapes.cube()), 8.0), ("quads", shapes.quads(), 8.0),
    ("flipped", shapes.flipped(shapes.cube()), 8.0),
])
def test_unclean_surfaces(folder, name, mesh, volume):
    folder.off("m.off", mesh)
    run = folder.run("tetrahedralize", "m.off", "-o", "m.vtu", "--report", "-").is_good()
    assert volumes(folder / "m.vtu").min() > 0
    assert volumes(folder / "m.vtu").sum() == pytest.approx(volume, rel=0.02), name
    assert run.report["volume"] == pytest.approx(volumes(folder / "m.vtu").sum())


@pytest.mark.parametrize("method", ["remesh", "embed"])
def test_the_other_methods(folder, method):
    folder.off("sphere.off", shapes.sphere())
    run = folder.run("tetrahedralize", "sphere.off", "--method", method, "-o", "s.mesh", "--report", "-").is_good()
    assert run.report["method"] == method
    total = volumes(folder / "s.mesh").sum()
    assert volumes(folder / "s.mesh").min() > 0
    assert total > 4.1 if method == "embed" else total == pytest.approx(4.1, rel=0.05)


@pytest.mark.parametrize("mesh", [shapes.flat(), shapes.one_triangle()])
def test_what_encloses_nothing_says_so(folder, mesh):
    folder.off("m.off", mesh)
    folder.run("tetrahedralize", "m.off", "-o", "m.vtu").is_refused()


def test_the_threshold_is_used(folder):
    """Check a threshold above 1. The winding number is 2 where two cubes overlap."""
    vertices, faces = shapes.cube()
    moved = [[x + 1 for x in v] for v in vertices]
    folder.off("two.off", (vertices + moved, faces + [[v + 8 for v in f] for f in faces]))
    for threshold, volume in (("0.5", 8 + 8 - 1), ("1.5", 1)):
        folder.run("tetrahedralize", "two.off", "--method", "cdt", "--winding-threshold", threshold, "-o", "m.vtu",
                   "--overwrite").is_good()
        assert volumes(folder / "m.vtu").sum() == pytest.approx(volume, rel=1e-6)


def test_how_an_open_surface_is_segmented(folder):
    vertices, faces = shapes.sphere()
    folder.off("open.off", (vertices, [f for i, f in enumerate(faces) if i % 5]))
    words = ["tetrahedralize", "open.off", "-o", "m.vtu", "--overwrite", "--report", "-"]
    cut = folder.run(*words, "--cut-smoothness", "2", "--cut-sigma", "0.2").is_good().report
    assert cut["segmentation"] == "graph-cut" and cut["energy"] <= cut["threshold_energy"]
    assert folder.run(*words, "--segmentation", "threshold").is_good().report["segmentation"] == "threshold"
    folder.run(*words, "--segmentation", "guess").is_refused(code=1)
    folder.run(*words, "--cut-sigma", "0").is_refused("--cut-sigma", "above 0", code=1)


def test_points_inside_as_wanted(folder):
    folder.off("sphere.off", shapes.sphere())
    words = ["tetrahedralize", "sphere.off", "-o", "m.vtu", "--overwrite", "--report", "-"]
    none = folder.run(*words, "--bare").is_good().report["counts"]
    many = folder.run(*words, "--interior-edge", "0.02").is_good().report["counts"]
    assert 2 * none["tet_vertices"] < many["tet_vertices"]
    folder.run(*words, "--quality", "21").is_refused("--quality", "0 to 20", code=1)
    folder.run(*words, "--bare", "--quality", "10").is_refused()
    folder.run(*words, "--time-limit", "-1").is_refused("--time-limit", "at least 0", code=1)


def test_handles_are_vertices(folder):
    folder.off("bar.off", shapes.bar())
    folder.write("handles.tgf", shapes.TWO_BONES)
    report = folder.run("tetrahedralize", "bar.off", "--handles", "handles.tgf", "-o", "bar.vtu", "--report", "-").is_good().report
    mesh = bindpose.read(folder / "bar.vtu")
    heads = [points_of(mesh)[handle["vertex"]] for handle in report["handles"]]
    assert len(heads) == 2
    for head in heads:
        assert list(head) in [[0.5, 0.5, 0.5], [3, 0.5, 0.5]]
    folder.run("tetrahedralize", "bar.off", "--handles", "none.tgf", "-o", "b.vtu").is_refused("none.tgf")


def test_what_cannot_be_filled_names_embed(folder):
    folder.off("cube.off", shapes.cube())
    run = folder.run("tetrahedralize", "cube.off", "--winding-threshold", "1.5", "-o", "cube.vtu")
    run.is_refused("--method embed")
    folder.run("tetrahedralize", "cube.off", "--winding-threshold", "1.5", "--method", "embed", "-o", "cube.vtu").is_good()


def test_the_histogram_counts_every_tet(folder):
    folder.off("bar.off", shapes.bar())
    report = folder.run("tetrahedralize", "bar.off", "-o", "bar.vtu", "--report", "-").is_good().report
    assert sum(entry["tets"] for entry in report["quality"]) == report["counts"]["tets"]
    worst = min(entry["dihedral_angle"] for entry in report["quality"] if entry["tets"])
    assert worst <= report["min_dihedral_angle"] < worst + 5


def test_a_wrap_makes_a_shell_of_what_is_open(folder):
    folder.off("open.off", shapes.open_cube())
    run = folder.run("tetrahedralize", "open.off", "--method", "wrap", "--wrap-alpha", "0.05", "--wrap-offset", "0.002",
                     "-o", "m.vtu", "--report", "-").is_good()
    report = run.report
    assert report["method"] == "wrap" and report["counts"]["kept_vertices"] == 0
    assert volumes(folder / "m.vtu").min() > 0
    # The open cube has five faces of area 4, wrapped in a shell that is at least two offsets thick.
    assert 20 * 2 * 0.002 * 12**0.5 < report["volume"] < 1
    assert report["winding_volume"] == pytest.approx(8, rel=0.02)
    assert "thin shell" in run.err and "4 boundary edges" in run.err
    assert report["distance_max"] >= 0.199


@pytest.mark.parametrize("mesh", [shapes.flat(), shapes.one_triangle()])
def test_a_wrap_holds_what_encloses_nothing(folder, mesh):
    folder.off("m.off", mesh)
    folder.run("tetrahedralize", "m.off", "--method", "wrap", "--wrap-alpha", "0.1", "-o", "m.mesh").is_good()
    assert volumes(folder / "m.mesh").min() > 0


def test_wraps_that_cannot_be(folder):
    folder.off("cube.off", shapes.cube())
    words = ["tetrahedralize", "cube.off", "--method", "wrap", "-o", "m.vtu"]
    folder.run(*words, "--wrap-alpha", "0").is_refused("--wrap-alpha", "0.0001 to 1", code=1)
    folder.run(*words, "--wrap-offset", "-1").is_refused("--wrap-offset", "1e-06 to 1", code=1)
    folder.run(*words, "--wrap-alpha", "0.0005", "--time-limit", "0.3").is_refused("time limit", code=5)


FAKE_FTETWILD = """#!/bin/sh
while [ "$1" != --output ]; do shift; done
cp "$(dirname "$0")/tets.mesh" "$2"
"""


def test_ftetwild_is_run_where_it_is(folder):
    """Check the call of fTetWild. A script replaces the program. It returns a cube in the coordinates of
    fTetWild: the center is at the origin, and the length of the bounding-box diagonal is between 1 and 2.
    """
    folder.off("unit.off", shapes.cube(-0.5, 0.5))
    folder.run("tetrahedralize", "unit.off", "-o", "tets.mesh").is_good()
    folder.off("cube.off", shapes.cube())
    (folder / folder.write("ftetwild", FAKE_FTETWILD)).chmod(0o755)
    there = {"BINDPOSE_FTETWILD": str(folder / "ftetwild"), "TMPDIR": str(folder.path)}
    words = ["tetrahedralize", "cube.off", "--method", "ftetwild", "-o", "m.vtu"]
    run = folder.run(*words, "--report", "-", environment=there).is_good()
    assert run.new_files == ["m.vtu"], "nothing temporary"
    assert run.report["method"] == "ftetwild"
    assert volumes(folder / "m.vtu").sum() == pytest.approx(8, rel=1e-12)
    assert run.report["distance_max"] == pytest.approx(0, abs=1e-9)
    nowhere = {"BINDPOSE_FTETWILD": "/nowhere/ftetwild"}
    folder.run(*words, "--overwrite", environment=nowhere).is_refused("/nowhere/ftetwild")
    folder.write("ftetwild", "#!/bin/sh\necho its last words; exit 3\n")
    folder.run(*words, "--overwrite", environment=there).is_refused("its last words", code=5)


def test_the_whole_hull(folder):
    vertices, faces = shapes.cube()
    far = [[x + 3, y, z] for x, y, z in vertices]
    folder.off("two.off", (vertices + far, faces + [[v + 8 for v in face] for face in faces]))
    run = folder.run("tetrahedralize", "two.off", "--method", "cdt", "--keep-outside", "-o", "h.vtu", "--report", "-")
    report = run.is_good().report
    assert report["volume"] == pytest.approx(16) and 0 < report["counts"]["tets_inside"] < report["counts"]["tets"]
    assert folder.run("info", "h.vtu", "--report", "-").is_good().report["volume"] == pytest.approx(20)
    folder.run("tetrahedralize", "two.off", "--keep-outside", "-o", "n.vtu").is_refused("--keep-outside", "auto", "cdt", code=1)
