"""bindpose weights: properties of all valid weights, on the surface's own points and on tets."""

import bindpose
import numpy as np
import pytest
import shapes
from bindpose.meshes import add_point_array, is_tets, point_array, points_of, to_dataset


@pytest.fixture
def bar(folder):
    folder.off("bar.off", shapes.bar())
    folder.write("bones.tgf", shapes.TWO_BONES)
    folder.write("points.tgf", shapes.TWO_POINTS)
    return folder


def weights_of(path, name="Weights"):
    return point_array(bindpose.read(path), name)


def check(weights, points):
    assert weights.min() >= -1e-9 and weights.max() <= 1 + 1e-9
    assert weights.sum(axis=1) == pytest.approx(np.ones(len(points)), abs=1e-12)


def test_surface_through_tets(bar):
    run = bar.run("weights", "bar.off", "--handles", "bones.tgf", "-o", "w.vtp", "--report", "-").is_good()
    assert run.new_files == ["w.vtp"]
    mesh = bindpose.read(bar / "w.vtp")
    points, weights = points_of(mesh), weights_of(bar / "w.vtp")
    assert np.array_equal(points, np.array(shapes.bar()[0]))  # the points of the mesh are unchanged
    check(weights, points)
    array = mesh.GetPointData().GetArray("Weights")
    assert [array.GetComponentName(i) for i in range(2)] == ["b1", "b2"]
    left = points[:, 0] < 2
    assert (weights[left, 0] > 0.5).all() and (weights[points[:, 0] > 4, 1] > 0.5).all()
    report = run.report
    assert report["status"] == "ok" and report["method"].replace("_", "-") == "bounded-biharmonic"
    assert report["domain"] == "volume"
    assert report["transfer"] == "exact"
    assert {"tetrahedralize", "analyze", "factor", "solve", "total"} <= set(report["seconds"])
    assert report["kkt_residual"] <= 1e-6 and report["relative_gap"] <= 1e-6
    assert report["counts"]["handles"] == 2 and report["counts"]["tets"] > 0
    for handle, name in zip(report["handles"], ("b1", "b2")):
        assert handle["name"] == name and handle["kind"] == "bone" and handle["constrained_vertices"] > 0
    for key in ("bounds_violation", "row_sum_error", "iterations", "peak_memory_bytes"):
        assert key in report


def test_vtu_holds_the_tets_and_dmat_the_numbers(bar):
    bar.run("weights", "bar.off", "--handles", "points.tgf", "-o", "w.vtu").is_good()
    mesh = bindpose.read(bar / "w.vtu")
    assert is_tets(mesh)
    check(weights_of(bar / "w.vtu"), points_of(mesh))
    bar.run("weights", "bar.off", "--handles", "points.tgf", "-o", "w.vtp").is_good()
    bar.run("weights", "bar.off", "--handles", "points.tgf", "-o", "w.dmat").is_good()
    lines = (bar / "w.dmat").read_text().split()
    columns, rows = int(lines[0]), int(lines[1])
    assert (columns, rows) == (2, len(shapes.bar()[0]))
    values = np.array(lines[2:], dtype=float).reshape(columns, rows).T
    assert np.array_equal(values, weights_of(bar / "w.vtp"))


def test_tets_are_solved_on_directly(bar):
    bar.run("tetrahedralize", "bar.off", "-o", "bar.vtu").is_good()
    run = bar.run("weights", "bar.vtu", "--handles", "bones.tgf", "-o", "w.vtu", "--report", "-").is_good()
    assert "tetrahedralize" not in run.report["seconds"]
    bar.run("weights", "bar.vtu", "--handles", "bones.tgf", "-o", "w.dmat").is_good()
    own = bindpose.read(bar / "bar.vtu").GetNumberOfPoints()
    assert (bar / "w.dmat").read_text().splitlines()[0] == f"2 {own}"
    bar.run("weights", "bar.vtu", "--handles", "bones.tgf", "-o", "w2.vtp").is_refused("contains tets")
    bar.run("weights", "bar.vtu", "--handles", "bones.tgf", "--domain", "surface", "-o", "w2.vtu").is_refused("surface")


def test_domain_surface(bar):
    run = bar.run("weights", "bar.off", "--handles", "auto:4", "--domain", "surface", "-o", "w.vtp", "--report", "-").is_good()
    assert run.report["domain"] == "surface" and "tetrahedralize" not in run.report["seconds"]
    weights = weights_of(bar / "w.vtp")
    check(weights, shapes.bar()[0])
    assert weights.shape == (len(shapes.bar()[0]), 4)
    assert (weights.max(axis=0) == 1).all()  # each handle is on a vertex, where its weight is 1
    bar.run("weights", "bar.off", "--handles", "auto:4", "--domain", "surface", "-o", "w.vtu").is_refused("no tets")


OTHERS = ["monotone", "harmonic", "biharmonic", "triharmonic", "graph-biharmonic", "linear-subspace", "inverse-distance",
          "smoothed-harmonic", "bone-heat"]


@pytest.mark.parametrize("method", OTHERS)
def test_other_methods(bar, method):
    run = bar.run("weights", "bar.off", "--handles", "points.tgf", "--method", method, "-o", "w.vtp", "--report", "-").is_good()
    assert run.report["method"] == method
    weights = weights_of(bar / "w.vtp")
    assert weights.sum(axis=1) == pytest.approx(np.ones(len(weights)), abs=1e-9)
    if method in ("monotone", "harmonic", "inverse-distance", "bone-heat"):
        assert weights.min() >= -1e-9


def test_raw_columns_and_their_certificate(bar):
    run = bar.run("weights", "bar.off", "--handles", "points.tgf", "--tolerance", "1e-9", "--order", "3", "--keep-raw",
                  "-o", "w.vtu", "--report", "-").is_good()
    assert run.report["method"] == "bounded-triharmonic"
    assert run.report["relative_gap"] <= 1e-9 and run.report["kkt_residual"] <= 1e-9
    raw, weights = weights_of(bar / "w.vtu", "RawWeights"), weights_of(bar / "w.vtu")
    assert raw.min() >= 0 and raw.max() <= 1
    sums = raw.sum(axis=1, keepdims=True)
    assert np.abs(sums - 1).max() == pytest.approx(run.report["row_sum_error"], abs=1e-12)
    assert weights == pytest.approx(raw / sums, abs=1e-12)
    bar.run("weights", "bar.off", "--handles", "points.tgf", "--keep-raw", "-o", "w.vtp").is_good()
    assert weights_of(bar / "w.vtp", "RawWeights").shape == weights_of(bar / "w.vtp").shape
    bar.run("weights", "bar.off", "--handles", "points.tgf", "-o", "w2.vtp").is_good()
    assert weights_of(bar / "w2.vtp", "RawWeights") is None


def test_too_few_iterations_are_exit_three(bar):
    run = bar.run("weights", "bar.off", "--handles", "points.tgf", "--method", "monotone", "--maximum-iterations", "1",
                  "--tolerance", "1e-9", "-o", "w.vtp", "--report", "-")
    assert run.code == 3 and run.report["status"] == "not_converged" and run.report["relative_gap"] > 1e-9
    assert "not certified" in run.err
    assert weights_of(bar / "w.vtp").sum(axis=1) == pytest.approx(1, abs=1e-9), "the result is kept"
    bar.run("weights", "bar.off", "--handles", "points.tgf", "--maximum-iterations", "0", "-o", "w2.vtp").is_refused(
        "--maximum-iterations", "at least 1", code=1)


def test_what_memory_has_no_room_for_is_refused_before_it_is_begun(bar):
    bar.run("tetrahedralize", "bar.off", "--interior-edge", "0.02", "-o", "tets.vtu").is_good()
    tets = ("weights", "tets.vtu", "--handles", "bones.tgf", "--threads", "1")
    report = bar.run(*tets, "-o", "w.dmat", "--report", "-").is_good().report
    assert report["memory_estimate_bytes"] == pytest.approx(report["peak_memory_bytes"], rel=0.15)
    bar.run(*tets, "-o", "no.dmat", "--memory-limit", "40").is_refused("2 columns on", "the limit is 40 MiB", code=5)
    limit = str(report["memory_estimate_bytes"] // 2**20 + 20)
    bar.run(*tets, "-o", "same.dmat", "--memory-limit", limit).is_good()
    assert (bar / "same.dmat").read_bytes() == (bar / "w.dmat").read_bytes()
    bar.run(*tets, "-o", "no.dmat", "--memory-limit", "-1").is_refused("--memory-limit", code=1)


def test_the_mesh_can_be_kept(bar):
    bar.run("tetrahedralize", "bar.off", "-o", "tets.vtu").is_good()
    kept = bar.run("weights", "tets.vtu", "--handles", "points.tgf", "--keep-mesh", "-o", "w.vtu",
                   "--report", "-").is_good()
    assert kept.report["counts"]["inserted_vertices"] == 0


def test_automatic_handles(bar):
    bar.run("weights", "bar.off", "--handles", "auto", "-o", "w.vtp").is_good()
    assert weights_of(bar / "w.vtp").shape[1] == 8
    for wrong in ("auto:0", "auto:x", "auto:"):
        bar.run("weights", "bar.off", "--handles", wrong, "-o", "w2.vtp").is_refused(
            "--handles auto:N needs an integer N between 1 and 100000", f"(got '{wrong[5:]}')")
    bar.run("weights", "bar.off", "--handles", "auto:5000", "-o", "w2.vtp").is_refused("distinct vertices")


def test_regions(bar):
    mesh = to_dataset(shapes.bar())
    x = points_of(mesh)[:, 0]
    add_point_array(mesh, "Parts", np.where(x < 1, 1, np.where(x > 5, 2, 0)).astype(np.int32))
    bindpose.write(mesh, bar / "painted.vtp")
    for more in ([], ["--domain", "surface"]):
        bar.run("weights", "painted.vtp", "--handles", "auto:1", "--regions", "Parts", "-o", "w.vtp", "--overwrite",
                *more).is_good()
        weights = weights_of(bar / "w.vtp")
        array = bindpose.read(bar / "w.vtp").GetPointData().GetArray("Weights")
        names = [array.GetComponentName(i) for i in range(array.GetNumberOfComponents())]
        assert names == ["p1", "r1", "r2"]
        check(weights, x)
        # The point handle p1 is in one of the regions r1 and r2. The weight of r1 is 0 in r2, and the weight of r2 is 0
        # in r1.
        assert (weights[x > 5][:, 1] < 1e-9).all() and (weights[x < 1][:, 2] < 1e-9).all()
    bar.run("weights", "painted.vtp", "--handles", "auto:1", "--regions", "Nope", "-o", "w2.vtp").is_refused("'Nope'")
    add_point_array(mesh, "Halves", np.where(x < 1, 1.0, 0.5))
    bindpose.write(mesh, bar / "halves.vtp")
    first = np.flatnonzero(x >= 1)[0]
    bar.run("weights", "halves.vtp", "--handles", "auto:1", "--regions", "Halves", "-o", "w2.vtp").is_refused(
        f"the region label of point {first} in the array 'Halves' must be an integer, not 0.5")


def test_bad_handles(bar):
    def refused(text, *words):
        bar.write("h.tgf", text)
        bar.run("weights", "bar.off", "--handles", "h.tgf", "-o", "out.vtp").is_refused(*words)

    refused("1 1 0.5 0.5\n2 1 0.5 0.5\n#\n", "'p1' and 'p2'", "same position")
    refused("1 1 0.5 0.5 a\n2 5 0.5 0.5 a\n#\n", "two handles are named 'a'")
    refused("1 1 0.5 0.5\n2 1 0.5 0.5\n#\n1 2\n", "length zero")
    refused("1 1 0.5 nan\n", "h.tgf, line 1")
    refused("#\n", "no node")
    bar.run("weights", "bar.off", "--handles", "none.tgf", "-o", "out.vtp").is_refused("none.tgf")
    bar.run("weights", "bar.off", "--handles", "bar.off", "-o", "out.vtp").is_refused("bar.off", "unknown file name extension")


def test_a_handle_outside_is_told(bar):
    bar.write("h.tgf", "1 0.5 0.5 0.5 inside\n2 5 0.5 3.5 outside\n#\n")
    run = bar.run("weights", "bar.off", "--handles", "h.tgf", "-o", "w.vtp", "--report", "-").is_good()
    assert any("outside" in warning for warning in run.report["warnings"])
    assert "bindpose weights: warning: " in run.err
    check(weights_of(bar / "w.vtp"), shapes.bar()[0])
    quiet = bar.run("weights", "bar.off", "--handles", "h.tgf", "-o", "w.vtp", "--overwrite", "--quiet").is_good()
    assert quiet.err == ""


@pytest.mark.parametrize("name, mesh", [
    ("open", shapes.open_cube()), ("flipped", shapes.flipped(shapes.cube())),
    ("doubled", shapes.doubled(shapes.cube())), ("quads", shapes.quads()),
])
def test_unclean_surfaces_have_weights(folder, name, mesh):
    folder.off("m.off", mesh)
    run = folder.run("weights", "m.off", "--handles", "auto:3", "-o", "w.vtp", "--report", "-").is_good()
    check(weights_of(folder / "w.vtp"), mesh[0])
    assert run.report["status"] == "ok", name


@pytest.mark.parametrize("mesh", [shapes.flat(), shapes.one_triangle()])
def test_flat_shapes_are_solved_on_themselves(folder, mesh):
    folder.off("m.off", mesh)
    run = folder.run("weights", "m.off", "--handles", "auto:2", "-o", "w.vtp", "--report", "-").is_good()
    assert run.report["domain"] == "surface" and "flat" in run.report["domain_reason"]
    folder.run("weights", "m.off", "--handles", "auto:2", "--domain", "surface", "-o", "s.vtp").is_good()
    assert np.array_equal(weights_of(folder / "w.vtp"), weights_of(folder / "s.vtp"))
    check(weights_of(folder / "s.vtp"), mesh[0])
    folder.run("weights", "m.off", "--handles", "auto:2", "-o", "w.vtu").is_refused("planar")


def test_a_sheet_that_is_not_flat_is_solved_in_a_lattice(folder):
    columns = range(17)
    vertices = [[i / 4, j / 4, 0.01 * (i / 4) ** 2] for j in range(5) for i in columns]
    corners = [(j * 17 + i, j * 17 + i + 1, (j + 1) * 17 + i + 1, (j + 1) * 17 + i) for j in range(4) for i in columns[:-1]]
    mesh = vertices, [triangle for a, b, c, d in corners for triangle in ([a, b, c], [a, c, d])]
    folder.off("m.off", mesh)
    run = folder.run("weights", "m.off", "--handles", "auto:2", "-o", "w.vtp", "--report", "-").is_good()
    assert run.report["domain"] == "embedding" and run.report["domain_reason"] == "the surface is not closed"
    check(weights_of(folder / "w.vtp"), mesh[0])
    forced = folder.run("weights", "m.off", "--handles", "auto:2", "--domain", "volume", "-o", "v.vtp")
    assert forced.code in (2, 3), "a sheet's conforming tets are refused, or their weights are not certified"


def test_embedding_and_preview(bar):
    volume = bar.run("weights", "bar.off", "--handles", "bones.tgf", "-o", "w.vtp", "--report", "-").is_good()
    assert volume.report["domain"] == "volume" and "well shaped" in volume.report["domain_reason"]
    run = bar.run("weights", "bar.off", "--handles", "bones.tgf", "--domain", "embedding", "-o", "e.vtp", "--report",
                  "-").is_good()
    report = run.report
    assert report["domain"] == "embedding" and report["embedding"]["resolution"] > report["guard"]["resolution"]
    assert report["guard"]["rms_difference"] <= 0.02
    weights = weights_of(bar / "w.vtp")
    embedded = weights_of(bar / "e.vtp")
    check(embedded, shapes.bar()[0])
    # The tolerance is large, because the bar's own tets are coarse.
    assert np.sqrt(((weights - embedded) ** 2).mean()) <= 0.03
    bar.run("weights", "bar.off", "--handles", "bones.tgf", "--domain", "embedding", "--embedding-resolution", "12", "-o",
            "e.vtu").is_good()
    assert is_tets(bindpose.read(bar / "e.vtu"))
    run = bar.run("weights", "bar.off", "--handles", "bones.tgf", "--stage", "preview", "-o", "p.vtp", "--report",
                  "-").is_good()
    assert run.report["stage"] == "preview" and "analyze" not in run.report["seconds"]
    preview = weights_of(bar / "p.vtp")
    check(preview, shapes.bar()[0])
    assert np.abs(preview - weights).max() <= 0.2
    bar.run("weights", "bar.off", "--handles", "bones.tgf", "--domain", "embedding", "--embedding-resolution", "3", "-o",
            "x.vtp").is_refused("between 6 and 1000")


def test_cage_of_a_tgf_file(folder):
    """Check a closed cage around a flat square. Its edges are the outline of the square, and weights are linear along
    them.
    """
    n = 8
    vertices = [[i / n, j / n, 0] for j in range(n + 1) for i in range(n + 1)]
    corners = [(j * (n + 1) + i, j * (n + 1) + i + 1, (j + 1) * (n + 1) + i + 1, (j + 1) * (n + 1) + i)
               for j in range(n) for i in range(n)]
    folder.off("m.off", (vertices, [list(t) for a, b, c, d in corners for t in ((a, b, c), (a, c, d))]))
    folder.write("cage.tgf", "1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n#\n" +
                 "".join(f"{k} {k % 4 + 1} 0 0 1\n" for k in range(1, 5)))
    run = folder.run("weights", "m.off", "--handles", "cage.tgf", "-o", "w.vtp", "--report", "-").is_good()
    assert run.err == "" and [h["kind"] for h in run.report["handles"]] == ["cage_vertex"] * 4
    weights = weights_of(folder / "w.vtp")
    check(weights, vertices)
    x, y = np.array(vertices)[:, 0], np.array(vertices)[:, 1]
    below = y == 0
    assert np.abs(weights[below, 0] - (1 - x[below])).max() <= 1e-9
    assert np.abs(weights[below, 1] - x[below]).max() <= 1e-9 and (weights[below, 2:] <= 1e-9).all()
    run = folder.run("weights", "m.off", "--handles", "cage.tgf", "--domain", "cage", "-o", "c.vtp", "--report", "-").is_good()
    assert run.report["domain"] == "cage" and run.report["counts"]["triangles"] > 2 * n * n
    check(weights_of(folder / "c.vtp"), vertices)
    folder.run("weights", "m.off", "--handles", "auto:3", "--domain", "cage", "-o", "d.vtp").is_refused("closed cage")


def test_terms_by_arrays_of_the_surface(bar):
    surface = to_dataset(shapes.bar())
    points = points_of(surface)
    pins = np.full((len(points), 2), np.nan)
    pins[10, 0] = 0.9
    block = (points[:, 0] > 2) & (points[:, 0] < 4)
    add_point_array(surface, "Given", pins)
    add_point_array(surface, "RigidSet", block.astype(np.int64))
    add_point_array(surface, "Paint", np.ones(len(points)))
    bindpose.write(surface, bar / "painted.vtp")
    words = ("weights", "painted.vtp", "--handles", "points.tgf", "-o", "w.vtp", "--overwrite", "--report", "-")
    run = bar.run(*words, "--pinned", "Given", "--rigidity", "Paint").is_good()
    weights = weights_of(bar / "w.vtp")
    check(weights, points)
    assert weights[10, 0] == 0.9
    # The array of rigid sets is found by its default name.
    assert block.sum() > 1 and np.ptp(weights[block], axis=0).max() == 0
    assert run.report["relative_gap"] <= 1e-6
    bar.run(*words, "--partition-of-unity", "coupled", "--bounds=-0.5,1.5", "--mirror", "x").is_refused("mirrored")
    bar.run(*words, "--domain", "embedding").is_refused("use domain volume instead of embedding")
    run = bar.run(*words, "--partition-of-unity", "coupled").is_good()
    assert run.report["partition"]["of_unity"] == "coupled" and run.report["partition"]["largest_difference"] >= 0
    run = bar.run(*words, "--maximum-influences", "1", "--rigid-set", "RigidSet").is_good()
    assert run.report["counts"]["capped_vertices"] > 0


def test_terms_that_cannot_be(bar):
    words = ("weights", "bar.off", "--handles", "points.tgf", "-o", "w.vtp")
    for more, text, code in (
        (("--pinned", "nothing"), "no point array 'nothing'", 2),
        (("--bounds", "0"), "2 numbers", 1),
        (("--bounds", "0.1,1"), "bounds", 2),
        (("--method", "harmonic", "--maximum-influences", "2"), "bounded-biharmonic|monotone", 1),
        (("--method", "monotone", "--partition-of-unity", "coupled"), "only bounded weights", 2),
    ):
        bar.run(*words, *more).is_refused(text, code=code)


def test_endpoints_are_taken_by_stretchable_bones(bar):
    folder = bar
    folder.write("bones.tgf", "1 0 0.5 0.5\n2 3 0.5 0.5\n3 6 0.5 0.5\n#\n1 2 1\n2 3 1\n")
    run = folder.run("weights", "bar.off", "--handles", "bones.tgf", "--endpoints", "joints", "-o", "w.vtp", "--report", "-")
    assert run.is_good().report["endpoints"]["method"] == "joints" and run.report["relative_gap"] <= 1e-6
    folder.write("long.json", '{"handles": {"b2": {"tail": [12, 0.5, 0.5]}}}')
    for method, end in (("stbs", 12), ("lbs", 6)):
        folder.run("deform", "w.vtp", "--handles", "bones.tgf", "--pose", "long.json", "--method", method, "-o",
                   f"{method}.vtp").is_good()
        assert abs(points_of(bindpose.read(folder / f"{method}.vtp"))[:, 0].max() - end) < 0.3
    folder.run("weights", "bar.off", "--handles", "auto:3", "--endpoints", "bounded", "-o", "n.vtp").is_refused("no bone")
