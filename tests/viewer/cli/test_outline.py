"""bindpose outline: triangulation of the inside of images and curves."""

import math

import pytest
import shapes

SQUARE = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\n"


def disc(x, y):
    return 255, 128, 0, 255 * (math.hypot(x - 40, y - 30) < 20)


def test_image_by_its_alpha(folder):
    folder.write("disc.png", shapes.png(80, 60, disc))
    report = folder.run("outline", "disc.png", "-o", "disc.vtp", "--report", "-").is_good().report
    assert report["domain"] == "alpha" and report["counts"]["loops"] == 1
    assert report["area"] == pytest.approx(math.pi * 400, rel=0.03)
    assert report["min_angle"] >= 30 - 1e-9
    text = folder.run("info", "disc.vtp").is_good().out
    assert "TCoords" in text and "OriginalPointIds" in text and "WindingNumber" in text


def test_rectangle_and_edge(folder):
    folder.write("disc.png", shapes.png(80, 60, disc))
    report = folder.run("outline", "disc.png", "--rectangle", "--edge", "0.05", "-o", "all.vtp", "--report", "-").is_good().report
    assert report["domain"] == "rectangle"
    assert report["area"] == pytest.approx(4800)
    assert report["longest_edge"] <= 0.05 * 100 * (1 + 1e-9)


def test_curves(folder):
    folder.write("closed.obj", SQUARE + "f 1 2 3 4\n")
    folder.write("open.obj", SQUARE + "l 1 2 3 4\n")
    for name in ("closed.obj", "open.obj"):
        report = folder.run("outline", name, "-o", name + ".vtp", "--report", "-").is_good().report
        assert report["domain"] == "curves" and report["area"] == pytest.approx(4)
    folder.run("outline", "closed.obj", "--winding-threshold", "1.5", "-o", "no.vtp").is_refused("enclose nothing")


def test_handles(folder):
    folder.write("square.obj", SQUARE + "f 1 2 3 4\n")
    folder.write("handles.tgf", "1 0.5 0.5 0\n2 1 1 0\n3 1.5 1.2 0\n4 9 9 0\n#\n2 3 1 0 0\n")
    done = folder.run("outline", "square.obj", "--handles", "handles.tgf", "-o", "s.vtp", "--report", "-").is_good()
    assert "are outside the shape" in done.err
    handles = done.report["handles"]
    assert [handle["name"] for handle in handles] == ["p1", "p2", "b1"]
    assert handles[0]["vertex"] >= 0 and handles[1]["vertex"] == -1 and handles[2]["vertex"] >= 0


def test_bad_input(folder):
    folder.write("clear.png", shapes.png(8, 8, lambda x, y: (1, 2, 3, 0)))
    folder.write("broken.png", shapes.png(80, 60, disc)[:150])
    folder.write("text.png", "this is text")
    folder.write("text.jpg", "this is text")
    folder.write("text.tif", "this is text")
    folder.write("text.bmp", "this is text")
    folder.write("line.obj", "v 0 0 0\nv 1 1 0\nv 2 2 0\nl 1 2 3\n")
    folder.write("bent.obj", "v 0 0 0\nv 1 0 0\nv 1 1 1\nl 1 2 3\n")
    folder.off("cube.off", shapes.cube())
    for name, word in [("clear.png", "transparent"), ("nowhere.png", "no such file"), ("line.obj", "one line"),
                       ("bent.obj", "z = const"), ("cube.off", "z = const")] + [
                           (name, name) for name in ("broken.png", "text.png", "text.jpg", "text.tif", "text.bmp")]:
        folder.run("outline", name, "-o", "out.vtp").is_refused(word)
    folder.write("disc.png", shapes.png(80, 60, disc))
    for option, value, allowed in [("--min-angle", "40", "0 to 33"), ("--edge", "-1", "0 to 1"), ("--simplify", "2", "0 to 1"),
                                   ("--winding-threshold", "0", "above 0")]:
        folder.run("outline", "disc.png", option, value, "-o", "out.vtp").is_refused(option, allowed, code=1)
    folder.run("outline", "disc.png", "-o", "out.off").is_refused("out.off")


def test_without_the_helper(folder):
    folder.write("square.obj", SQUARE + "f 1 2 3 4\n")
    nowhere = {"BINDPOSE_MESHER": "/nowhere/bindpose-mesher"}
    folder.run("outline", "square.obj", "-o", "out.vtp", environment=nowhere).is_refused("bindpose-mesher")
