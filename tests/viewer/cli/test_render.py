"""bindpose render: pictures, also without a display; bindpose view without a display. tests/render checks the content
of pictures.
"""

import os
import shutil
import struct

import pytest
import shapes


def size_of(path):
    head = path.read_bytes()[:24]
    assert head[:8] == b"\x89PNG\r\n\x1a\n"
    return struct.unpack(">II", head[16:24])


NO_DISPLAY = {"DISPLAY": ""}


def test_it_finds_a_display_for_itself(folder):
    folder.off("sphere.off", shapes.sphere())
    run = folder.run("render", "sphere.off", "-o", "s.png", "--size", "320x240", "--report", "-",
                     environment=NO_DISPLAY).is_good()
    assert run.new_files == ["s.png"] and run.err == ""
    assert size_of(folder / "s.png") == (320, 240)
    assert run.report["status"] == "ok"


def test_the_exit_code_is_kept_when_cleaning_up_is_slow(folder):
    """An X server that resets itself after its last client signals xvfb-run. If xvfb-run is removing its files at that
    moment, it exits with 5 instead of the program's code. The slow "rm" makes this certain instead of rare.
    """
    folder.off("sphere.off", shapes.sphere(8, 4))
    os.mkdir(folder / "slow")
    folder.write("slow/rm", f"#!/bin/sh\nsleep 1\nexec {shutil.which('rm')} \"$@\"\n")
    os.chmod(folder / "slow/rm", 0o755)
    slow = {**NO_DISPLAY, "PATH": f"{folder / 'slow'}:{os.environ['PATH']}"}
    folder.run("render", "sphere.off", "-o", "s.png", "--array", "Weights", environment=slow).is_refused("Weights")


def test_tiles_handles_and_volumes(folder):
    folder.off("bar.off", shapes.bar())
    folder.write("h.tgf", shapes.TWO_BONES)
    folder.run("winding", "bar.off", "--resolution", "16", "-o", "w.vti").is_good()
    run = folder.run("render", "bar.off", "h.tgf", "w.vti", "--handles", "h.tgf", "--handle-names", "--columns", "3",
                     "--size", "600x200", "--title", "three", "-o", "all.png").is_good()
    assert run.err == ""
    assert size_of(folder / "all.png") == (600, 200)


def test_labels(folder):
    folder.off("bar.off", shapes.bar())
    folder.run("render", "bar.off", "bar.off", "--labels", "before,after", "--size", "300x200", "-o", "l.png").is_good()
    folder.run("render", "bar.off", "--labels", "a,b", "-o", "m.png").is_refused("--labels", "2 labels, but the picture has only 1 tile")


def test_a_scale_factor_and_a_transparent_background(folder):
    """Check that the picture has three times as many pixels in each direction, and an alpha channel if requested (PNG
    color type 6, otherwise 2).
    """
    folder.off("bar.off", shapes.bar())
    run = folder.run("render", "bar.off", "--size", "160x120", "--scale", "3", "--transparent", "-o", "b.png",
                     "--report", "-").is_good()
    assert size_of(folder / "b.png") == (480, 360)
    assert (run.report["picture"]["width"], run.report["picture"]["height"]) == (480, 360)
    assert (folder / "b.png").read_bytes()[25] == 6
    folder.run("render", "bar.off", "--size", "160x120", "-o", "c.png").is_good()
    assert (folder / "c.png").read_bytes()[25] == 2
    folder.run("render", "bar.off", "--scale", "9", "-o", "d.png").is_refused("--scale", "1 to 8", code=1)
    folder.run("render", "bar.off", "--size", "8000x8000", "--scale", "8", "-o", "d.png").is_refused(
        "64000 x 64000 pixels is too large")
    folder.run("render", "bar.off", "--transparent", "-o", "d.gif").is_refused("--transparent")


def test_without_a_display_or_xvfb_it_names_the_package(folder):
    """Without a display, VTK would terminate the process. The program must prevent this."""
    folder.off("sphere.off", shapes.sphere(8, 4))
    nowhere = {"DISPLAY": "", "PATH": "/nowhere"}
    folder.run("render", "sphere.off", "-o", "s.png", environment=nowhere).is_refused("xvfb")
    broken = {"DISPLAY": ":97531", "PATH": "/nowhere"}
    folder.run("render", "sphere.off", "-o", "s.png", environment=broken).is_refused("xvfb")


def test_a_tour_with_a_bad_file_ends_with_its_sentence(folder):
    folder.write("t.json", '{"tour": {"schema": 1}, "steps": []}')
    folder.write("bad.off", "once upon a time\n")
    folder.run("view", "bad.off", "--play", "t.json").is_refused("bad.off, line 1")
    folder.run("view", "gone.off", "--play", "t.json").is_refused("gone.off", "No such file")


def test_view_without_a_display(folder):
    folder.off("sphere.off", shapes.sphere(8, 4))
    folder.run("view", "sphere.off", environment=NO_DISPLAY).is_refused()


@pytest.mark.parametrize("words, sentence", [
    (["--array", "Weights"], "Weights"),
    (["--component", "hip"], "Weights"),
    (["--size", "big"], "--size 'big'"),
    (["--size", "0x10"], "--size '0x10'"),
    (["--range", "1"], "--range '1'"),
    (["--handles", "none.tgf"], "none.tgf"),
    (["--handles", "sphere.off"], "sphere.off"),
])
def test_what_cannot_be_drawn(folder, words, sentence):
    assert shutil.which("xvfb-run") and os.access(shutil.which("xvfb-run"), os.X_OK)
    folder.off("sphere.off", shapes.sphere(8, 4))
    folder.run("render", "sphere.off", "-o", "s.png", *words, environment=NO_DISPLAY).is_refused(sentence)


def test_isosurfaces_a_cloud_and_context(folder):
    folder.off("sphere.off", shapes.sphere())
    folder.run("winding", "sphere.off", "--resolution", "16", "-o", "w.vti").is_good()
    small = ["--size", "160x120", "--report", "-"]
    run = folder.run("render", "w.vti", "--isosurface", "0.75,0.25", "-o", "i.png", *small).is_good()
    assert run.err == "" and run.report["picture"]["isosurfaces"] == [0.25, 0.75]
    run = folder.run("render", "w.vti", "--volume", "--context", "sphere.off", "-o", "v.png", *small).is_good()
    assert run.err == "" and size_of(folder / "v.png") == (160, 120)
    # A level that no value reaches is not an error, because another tile may contain it.
    run = folder.run("render", "w.vti", "--isosurface", "0.5,7", "-o", "n.png", *small).is_good()
    assert "no isosurface at 7" in run.err


@pytest.mark.parametrize("file, words, sentence", [
    ("w.vti", ["--isosurface", "high"], "--isosurface 'high'"),
    ("w.vti", ["--isosurface", "0.5,"], "--isosurface '0.5,'"),
    ("w.vti", ["--isosurface", "nan"], "level of an isosurface"),
    ("w.vti", ["--isosurface", ",".join(["1"] + [f"0.{k}" for k in range(10, 30)])], "at most 16"),
    ("w.vti", ["--volume", "--range", "0,1"], "without a range"),
    ("w.vti", ["--context", "none.off"], "none.off"),
    ("w.vti", ["--context", "w.vti"], "context"),
    ("sphere.off", ["--isosurface", "0.5"], "need a volume"),
    ("sphere.off", ["--volume"], "of a volume"),
])
def test_what_is_no_volume(folder, file, words, sentence):
    folder.off("sphere.off", shapes.sphere(8, 4))
    folder.run("winding", "sphere.off", "--resolution", "6", "-o", "w.vti").is_good()
    folder.run("render", file, "-o", "s.png", *words).is_refused(sentence)


@pytest.mark.parametrize("values, size, sentence", [
    ("nan 0 0 0 1 1 1 1", "1 1 1", "1 of the 8 values of 'WindingNumber' is not finite"),
    ("0 1 0 1", "1 1 0", "one sample thick along z"),
])
def test_volumes_that_have_no_isosurface(folder, values, size, sentence):
    extent = " ".join("0 " + end for end in size.split())
    folder.write("w.vti", f'''<VTKFile type="ImageData" version="0.1" byte_order="LittleEndian">
<ImageData WholeExtent="{extent}" Origin="0 0 0" Spacing="1 1 1"><Piece Extent="{extent}"><PointData>
<DataArray type="Float64" Name="WindingNumber" format="ascii">{values}</DataArray>
</PointData></Piece></ImageData></VTKFile>''')
    for words in (["--isosurface", "0.5"], ["--volume"]):
        folder.run("render", "w.vti", "-o", "s.png", *words).is_refused(sentence)


def open_sphere():
    """Return a sphere without one cap, so that it has 24 open edges."""
    vertices, faces = shapes.sphere()
    return vertices, [face for face in faces if 0 not in face]


@pytest.fixture
def tets(folder):
    """Write lattice tets of a sphere, which need no helper, into a file with arrays and into a file without arrays."""
    folder.off("sphere.off", shapes.sphere())
    folder.off("open.off", open_sphere())
    for file in ("tets.vtu", "tets.mesh"):
        folder.run("tetrahedralize", "sphere.off", "--method", "embed", "--resolution", "8", "-o", file).is_good()
    return folder


def test_tets_inside_out(tets):
    small = ["--size", "200x150", "--report", "-", "-o"]
    whole = tets.run("render", "tets.vtu", "--section", "none", *small, "w.png").is_good().report["picture"]["tets"]
    counts = tets.run("info", "tets.vtu", "--report", "-").is_good().report["counts"]
    assert whole == counts["tets"]
    # A cut removes the tets between the plane and the camera. Views from the front and from behind together draw every
    # tet exactly once.
    front = tets.run("render", "tets.vtu", "--section", "z=0.01", *small, "f.png").is_good().report["picture"]["tets"]
    back = tets.run("render", "tets.vtu", "--section", "0,0,1@0,0,0.01", "--azimuth", "180", *small, "b.png")
    assert 0 < front < whole and front + back.is_good().report["picture"]["tets"] == whole
    run = tets.run("render", "tets.vtu", "--color", "label", "--shrink", "0.7", *small, "l.png").is_good()
    classes = run.report["picture"]["colors"]
    assert [c["name"] for c in classes] == ["outside", "inside"] and sum(c["count"] for c in classes) == whole
    run = tets.run("render", "tets.vtu", "--color", "rung", *small, "r.png").is_good()
    assert run.report["picture"]["colors"] == [{"name": "embed", "count": whole}]
    run = tets.run("render", "tets.mesh", "--color", "quality", *small, "q.png").is_good()
    assert run.report["picture"]["range"][0] == 0 and 70 < run.report["picture"]["range"][1] < 71
    tets.run("render", "tets.vtu", "--color", "winding-number", *small, "n.png").is_good()


def test_defects_are_counted(tets):
    small = ["--size", "200x150", "--report", "-", "-o"]
    found = [{"name": "unreferenced vertex", "count": 1}, {"name": "boundary edge", "count": 24}]
    run = tets.run("render", "open.off", "--defects", *small, "d.png").is_good()
    assert run.report["picture"]["defects"] == found
    # Draw the defects over tets. The defects are those of the context surface, or come from a file. Two tiles show the
    # defects twice, but the report counts them once.
    run = tets.run("render", "tets.vtu", "tets.mesh", "--context", "open.off", "--defects", *small, "t.png").is_good()
    assert run.report["picture"]["defects"] == found
    tets.run("info", "open.off", "--defects", "d.vtp", "--quiet").is_good()
    run = tets.run("render", "d.vtp", *small, "f.png").is_good()
    assert run.report["picture"]["defects"] == found
    run = tets.run("render", "sphere.off", "--defects", *small, "c.png").is_good()
    assert "defects" not in run.report["picture"]


@pytest.mark.parametrize("file, words, sentence", [
    ("tets.vtu", ["--section", "q=1"], "--section 'q=1'"),
    ("tets.vtu", ["--section", "x="], "--section 'x='"),
    ("tets.vtu", ["--section", "1,0@0,0,0"], "--section '1,0@0,0,0'"),
    ("tets.vtu", ["--section", "0,0,0@0,0,0"], "section plane"),
    ("tets.vtu", ["--section", "1.5"], "between 0 (back) and 1 (front)"),
    ("tets.vtu", ["--section", "z=-9"], "removes all tets"),
    ("tets.vtu", ["--color", "label", "--array", "Label"], "--color label"),
    ("tets.vtu", ["--color", "label", "--range", "0,1"], "cannot have a range"),
    ("tets.vtu", ["--defects"], "--context SURFACE"),
    ("tets.mesh", ["--color", "label"], "no cell array 'Label'"),
    ("tets.mesh", ["--color", "rung"], "no field data array 'Method'"),
    ("tets.mesh", ["--color", "winding-number"], "WindingNumber"),
    ("sphere.off", ["--color", "quality"], "need tets"),
    ("sphere.off", ["--shrink", "0.5"], "shrinking needs tets"),
    ("sphere.off", ["--section", "x=0"], "needs tets or a volume"),
    ("sphere.off", ["--slice"], "a slice needs tets"),
    ("tets.vtu", ["--slice", "--section", "z=9"], "does not cross any tet"),
    ("tets.vtu", ["--slice", "--section", "none"], "needs a section"),
    ("tets.vtu", ["--slice", "--shrink", "0.5"], "cannot be combined with shrunk tets"),
])
def test_what_tets_do_not_have(tets, file, words, sentence):
    tets.run("render", file, "-o", "s.png", *words).is_refused(sentence)


@pytest.mark.parametrize("option, value", [("--zoom", "0"), ("--shrink", "0"), ("--shrink", "1.1"), ("--fps", "1001")])
def test_numbers_out_of_range_are_usage_errors(folder, option, value):
    folder.off("sphere.off", shapes.sphere(8, 4))
    folder.run("render", "sphere.off", "-o", "s.png", option, value).is_refused(option, "above 0", code=1)


def test_a_slice_through_the_weights_of_a_volume(folder):
    """Check a cut through tets with weights, from `weights -o OUT.vtu`."""
    folder.off("sphere.off", shapes.sphere())
    folder.write("h.tgf", "1 0 0 0.5 top\n2 0 0 -0.5 bottom\n#\n")
    folder.run("weights", "sphere.off", "--handles", "h.tgf", "--domain", "embedding", "--embedding-resolution", "8", "--keep-raw",
               "-o", "w.vtu").is_good()
    small = ["--slice", "--section", "x=0.01", "--size", "200x150", "--report", "-", "-o"]
    picture = folder.run("render", "w.vtu", "--component", "top", *small, "t.png").is_good().report["picture"]
    whole = folder.run("info", "w.vtu", "--report", "-").is_good().report["counts"]["tets"]
    assert picture["component"] == "top" and picture["range"] == [0, 1] and 0 < picture["tets"] < whole / 3
    folder.run("render", "w.vtu", "--array", "RawWeights", "--component", "top", *small, "r.png").is_good()
    folder.run("render", "w.vtu", "--color", "handle", *small, "h.png").is_good()
    folder.run("render", "w.vtu", "--component", "top", "--extrema", *small, "e.png").is_good()


def test_an_unknown_color_is_usage(tets):
    tets.run("render", "tets.vtu", "-o", "s.png", "--color", "mood").is_refused("mood", code=1)


def square(name_values, points=4):
    """Return a flat square with point arrays as the text of a .vtp file. Each array has a name, component names, and
    values by point.
    """
    arrays = "".join(
        f'<DataArray type="Float64" Name="{name}" NumberOfComponents="{len(words)}" format="ascii" '
        + " ".join(f'ComponentName{k}="{word}"' for k, word in enumerate(words)) + f">{values}</DataArray>"
        for name, words, values in name_values)
    places = "0 0 0 1 0 0 1 1 0 0 1 0 0.5 2 0"
    coordinates = " ".join(places.split()[:3 * points])
    return f'''<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian"><PolyData>
<Piece NumberOfPoints="{points}" NumberOfPolys="2"><PointData>{arrays}</PointData>
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">{coordinates}</DataArray></Points>
<Polys><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 0 2 3</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">3 6</DataArray></Polys></Piece></PolyData></VTKFile>'''


@pytest.fixture
def weighted(folder):
    """Write a sphere with biharmonic weights without bounds, and their raw columns. Each handle is a vertex."""
    folder.off("sphere.off", shapes.sphere())
    folder.write("h.tgf", "1 0 0 1 top\n2 0 0 -1 bottom\n3 1 0 0 side\n#\n")
    folder.run("weights", "sphere.off", "--handles", "h.tgf", "--domain", "surface", "--method", "biharmonic", "--keep-raw",
               "-o", "w.vtp").is_good()
    return folder


def test_cells_by_handle(weighted):
    run = weighted.run("render", "w.vtp", "--color", "handle", "--size", "300x200", "-o", "c.png", "--report", "-").is_good()
    colors = run.report["picture"]["colors"]
    assert {c["name"] for c in colors} <= {"top", "bottom", "side"} and len(colors) == 3
    assert sum(c["count"] for c in colors) == len(shapes.sphere()[1])
    weighted.write("two.vtp", square([("Weights", ["left", "right"], "1 0 0 1 0 1 0.7 0.3")]))
    run = weighted.run("render", "two.vtp", "--color", "handle", "-o", "t.png", "--report", "-").is_good()
    # A triangle has the color of the handle with the largest sum of weights over the corners of the triangle. The sums
    # for left and right are 1 and 2 on the first triangle, and 1.7 and 1.3 on the second.
    assert run.report["picture"]["colors"] == [{"name": "left", "count": 1}, {"name": "right", "count": 1}]


def test_extrema_are_those_of_the_certificate(weighted):
    handles = weighted.run("weights", "sphere.off", "--handles", "h.tgf", "--domain", "surface", "--method", "biharmonic",
                           "-o", "again.vtp", "--report", "-").is_good().report["handles"]
    for handle in handles:
        run = weighted.run("render", "w.vtp", "--array", "RawWeights", "--component", handle["name"], "--extrema",
                           "--size", "200x150", "-o", "e.png", "--overwrite", "--report", "-").is_good()
        (extrema,) = run.report["picture"]["extrema"]
        assert extrema["maxima"] + extrema["minima"] == extrema["drawn"] == handle["interior_extrema"]
    # Without --array, the array Weights is used. The report contains separate numbers for each of the two tiles.
    run = weighted.run("render", "w.vtp", "w.vtp", "--extrema", "--size", "300x150", "-o", "f.png", "--report", "-").is_good()
    assert run.report["picture"]["array"] == "Weights" and len(run.report["picture"]["extrema"]) == 2


def test_row_sums(weighted):
    run = weighted.run("render", "w.vtp", "--color", "row-sum", "--size", "200x150", "-o", "r.png", "--report", "-").is_good()
    # Weights without bounds sum to one.
    assert run.report["picture"]["row_sum"]["minimum"] == pytest.approx(1, abs=1e-9)
    weighted.write("raw.vtp", square([("RawWeights", ["a", "b"], "1 0 0 1.25 0.5 0.75 0.5 0.25")]))
    run = weighted.run("render", "raw.vtp", "--color", "row-sum", "--size", "200x150", "-o", "s.png", "--report", "-").is_good()
    assert run.report["picture"]["row_sum"] == {"minimum": 0.75, "maximum": 1.25}
    assert run.report["picture"]["range"] == [0.75, 1.25]


def test_differences(folder):
    folder.write("a.vtp", square([("Weights", ["l", "r"], "1 0 0.5 0.5 0 1 0.25 0.75")]))
    folder.write("b.vtp", square([("Weights", ["l", "r"], "1 0 0.25 0.75 0 1 0.5 0.5")]))
    for words, array in ((["--component", "r"], "Weights"), (["--array", "Weights", "--component", "1"], "Weights")):
        run = folder.run("render", "a.vtp", "--minus", "b.vtp", *words, "--size", "200x150", "-o", "d.png", "--overwrite",
                         "--report", "-").is_good()
        picture = run.report["picture"]
        assert picture["array"] == array and picture["range"] == [-0.25, 0.25]
        assert picture["difference"] == {"largest": 0.25, "rms": pytest.approx(0.25 / 2 ** 0.5)}
    run = folder.run("render", "a.vtp", "b.vtp", "--minus", "b.vtp", "--size", "200x150", "-o", "e.png", "--report", "-")
    assert run.is_good().report["picture"]["difference"] == {"largest": 0.25, "rms": pytest.approx(0.125)}


@pytest.mark.parametrize("file, words, sentence", [
    ("plain.vtp", ["--color", "handle"], "bindpose weights"),
    ("w.vtp", ["--color", "handle", "--range", "0,1"], "cannot have a range"),
    ("w.vtp", ["--color", "handle", "--array", "Weights"], "--color handle"),
    ("w.vtp", ["--color", "handle", "--extrema"], "point array"),
    ("plain.vtp", ["--extrema"], "Weights"),
    ("nan.vtp", ["--extrema", "--array", "Heat"], "'Heat' has a value that is not"),
    ("w.vtp", ["--color", "row-sum"], "weights --keep-raw"),
    ("raw.vtp", ["--color", "row-sum", "--range", "2,3"], "row sums must contain 1"),
    ("w.vtp", ["--color", "rotation-cluster"], "deform --rotation-arrays"),
    ("turned.vtp", ["--color", "rotation-cluster", "--range", "0,1"], "cannot have a range"),
    ("turned.vtp", ["--color", "rotation-cluster"], "'RotationCluster' of point 2 is 2e+09"),
    ("w.vtp", ["--color", "rotation"], "deform --rotation-arrays"),
    ("w.vtp", ["--minus", "none.vtp"], "none.vtp"),
    ("w.vtp", ["--minus", "five.vtp"], "5 points; expected 4"),
    ("w.vtp", ["--minus", "plain.vtp"], "no point array 'Weights'"),
    ("w.vtp", ["--minus", "nan.vtp", "--component", "b"], "no component 'b'"),
    ("w.vtp", ["--minus", "w.vtp", "--range", "1,2"], "difference must contain 0"),
    ("w.vtp", ["--minus", "w.vtp", "--color", "handle"], "difference"),
])
def test_what_cannot_be_inspected(folder, file, words, sentence):
    two = ("Weights", ["a", "b"], "1 0 0.5 0.5 0 1 0.25 0.75")
    folder.write("w.vtp", square([two]))
    folder.write("raw.vtp", square([("RawWeights", ["a", "b"], two[2])]))
    folder.write("five.vtp", square([("Weights", ["a", "b"], two[2] + " 1 0")], points=5))
    folder.write("plain.vtp", square([]))
    folder.write("turned.vtp", square([("RotationCluster", ["c"], "0 1 2e9 0")]))
    folder.write("nan.vtp", square([("Weights", ["a"], "1 1 1 1"), ("Heat", ["h"], "0 1 nan 2")]))
    folder.run("render", file, "-o", "s.png", *words).is_refused(sentence)
