"""tetrahedralize: volumes of known shapes, whatever state the surface is in."""

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
    """Two cubes that overlap: the winding number is 2 where they do."""
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
    folder.run(*words, "--cut-sigma", "0").is_refused()


def test_points_inside_as_wanted(folder):
    folder.off("sphere.off", shapes.sphere())
    words = ["tetrahedralize", "sphere.off", "-o", "m.vtu", "--overwrite", "--report", "-"]
    none = folder.run(*words, "--quality", "0", "--interior-edge", "0").is_good().report["counts"]
    many = folder.run(*words, "--interior-edge", "0.02").is_good().report["counts"]
    assert 2 * none["tet_vertices"] < many["tet_vertices"]
    folder.run(*words, "--quality", "0.5").is_refused()
    folder.run(*words, "--time-limit", "-1").is_refused()


def test_handles_are_vertices(folder):
    folder.off("bar.off", shapes.bar())
    folder.write("handles.tgf", shapes.TWO_BONES)
    report = folder.run("tetrahedralize", "bar.off", "--handles", "handles.tgf", "-o", "bar.vtu", "--report", "-").is_good().report
    mesh = bindpose.read(folder / "bar.vtu")
    heads = [points_of(mesh)[handle["vertex"]] for handle in report["handles"]]
    handles = bindpose.read(folder / "handles.tgf")
    for head in heads:
        assert np.abs(points_of(handles) - head).max(axis=1).min() == 0
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
