"""bindpose handles: automatic handles of a shape."""

import pathlib

import pytest
from driver import PROGRAM

needs_helper = pytest.mark.skipif(not (pathlib.Path(PROGRAM).parent / "bindpose-mesher").exists(),
                                  reason="built without bindpose-mesher")


def bar(folder, name="bar.off", length=8, missing=0):
    """Write a bar of unit cubes along x. Its last `missing` triangles are removed."""
    points = [(x, y, z) for x in range(length + 1) for y in (0, 1) for z in (0, 1)]
    triangles = [(0, 1, 3), (0, 3, 2)]
    for x in range(length):
        ring = [4 * x + i for i in (0, 2, 3, 1)]
        for a, b in zip(ring, ring[1:] + ring[:1]):
            triangles += [(a, b, b + 4), (a, b + 4, a + 4)]
    last = 4 * length
    triangles += [(last, last + 3, last + 1), (last, last + 2, last + 3)]
    triangles = triangles[:len(triangles) - missing]
    lines = [f"{x} {y} {z}" for x, y, z in points] + [f"3 {a} {b} {c}" for a, b, c in triangles]
    folder.write(name, f"OFF\n{len(points)} {len(triangles)} 0\n" + "\n".join(lines) + "\n")


@needs_helper
@pytest.mark.parametrize("missing", [0, 2])
def test_skeleton(folder, missing):
    bar(folder, missing=missing)
    report = folder.run("handles", "bar.off", "--longest-bone", "0.5", "-o", "bones.tgf", "--report", "-").is_good().report
    assert report["method"] == "skeleton"
    assert report["surface"] == ("lattice" if missing else "clean")
    assert report["counts"]["joints_outside"] == 0
    assert [handle["name"] for handle in report["handles"]] == ["b1", "b2"]
    assert report["handles"][0]["kind"] == "bone"
    nodes = (folder / "bones.tgf").read_text().split("#")[0].splitlines()
    places = [list(map(float, line.split()[1:4])) for line in nodes]
    assert len(places) == 3  # the two bones share a joint
    assert min(x for x, _, _ in places) < 1 and max(x for x, _, _ in places) > 7 - missing
    assert all(abs(y - 0.5) < 0.15 and abs(z - 0.5) < 0.15 for _, y, z in places)
    # Other verbs can read the file.
    text = folder.run("info", "bones.tgf").is_good().out
    assert "b2" in text


@needs_helper
def test_bones_at_most(folder):
    bar(folder)
    words = ("handles", "bar.off", "--longest-bone", "0.1", "--maximum-bones", "3", "-o", "bones.vtp", "--report", "-")
    assert folder.run(*words).is_good().report["counts"]["handles"] == 3


def test_points(folder):
    bar(folder)
    report = folder.run("handles", "bar.off", "--method", "points", "--number-of-points", "6", "-o", "points.vtp", "--report", "-").is_good().report
    assert report["method"] == "points" and report["distance"] == "along-edges"
    assert report["counts"]["handles"] == 6 and report["counts"]["points_inside"] == 6
    words = ("handles", "bar.off", "--method", "points", "--number-of-points", "6", "--no-place-inside", "--distance", "straight", "-o", "on.tgf", "--report", "-")
    report = folder.run(*words).is_good().report
    assert report["counts"]["points_inside"] == 0 and report["distance"] == "straight"
    assert (folder / "on.tgf").read_text().startswith("1 ")


@needs_helper
def test_weights_of_a_skeleton(folder):
    bar(folder)
    report = folder.run("weights", "bar.off", "--handles", "skeleton:1", "-o", "w.vtp", "--report", "-").is_good().report
    assert [handle["name"] for handle in report["handles"]] == ["b1"]
    folder.run("weights", "bar.off", "--handles", "skeleton:x", "-o", "x.vtp").is_refused("--handles skeleton:N needs an integer N between 1 and 100000 (got 'x')")


def test_bad_input(folder):
    folder.write("flat.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n")
    assert folder.run("handles", "flat.off", "-o", "flat.vtp", "--report", "-").is_good().report["surface"] == "lattice"
    folder.run("handles", "flat.off", "--method", "points", "--number-of-points", "5", "-o", "x.vtp").is_refused("only 4 distinct vertices")
    bar(folder)
    folder.run("handles", "bar.off", "--bone-tolerance", "2", "-o", "x.vtp").is_refused("--bone-tolerance", "0.001 to 1", code=1)
    folder.run("handles", "bar.off", "--skeleton-triangles", "5", "-o", "x.vtp").is_refused("--skeleton-triangles", "100 to 1000000", code=1)
    folder.run("handles", "bar.off", "-o", "x.png").is_refused("png")
    assert not (folder / "x.vtp").exists()
