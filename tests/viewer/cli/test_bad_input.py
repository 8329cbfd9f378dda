"""Each verb of the program gets bad input of each kind. It must print one sentence, exit with code 2, and write no
files.
"""

import os

import pytest
import shapes

CUBE = shapes.off(shapes.cube())

# No verb can read these files. Each entry contains the content of the file and words of the error message.
UNREADABLE = {
    "missing.off": (None, ["missing.off", "No such file"]),
    "wrong.off": ("once upon a time\nthere was a mesh\n", ["wrong.off, line 1"]),
    "wrong.vtp": ("once upon a time\n", ["wrong.vtp"]),
    "wrong.stl": (bytes(range(256)) * 4, ["wrong.stl"]),
    "wrong.ply": (b"\xff\xfe" * 300, ["wrong.ply"]),
    "truncated.off": (CUBE[: len(CUBE) // 2], ["truncated.off, line"]),
    "empty.off": ("", ["empty.off is empty"]),
    "nothing.off": ("OFF\n0 0 0\n", ["nothing.off"]),
    "nan.off": (CUBE.replace("-1.0 -1.0 -1.0", "-1.0 nan -1.0"), ["nan.off, line 3", "not a finite number"]),
    "range.off": (CUBE.replace("3 0 4 6", "3 0 4 9"), ["range.off, line 11"]),
    "mesh.xyz": ("1 2 3\n", ["mesh.xyz", "unknown file name extension"]),
    "folder.off": ("folder", ["folder.off", "directory"]),
}

OTHERS = {"winding": ["-o", "out.vti"], "tetrahedralize": ["-o", "out.vtu"],
          "handles": ["--method", "points", "--number-of-points", "4", "-o", "out.vtp"],
          "weights": ["--handles", "h.tgf", "-o", "out.vtp"],
          "deform": ["--handles", "h.tgf", "--pose", "p.json", "-o", "out.vtp"],
          "render": ["-o", "out.png"], "info": []}


def arrange(folder):
    folder.write("h.tgf", shapes.TWO_POINTS)
    folder.write("p.json", shapes.BENT)
    folder.off("bar.off", shapes.bar())


@pytest.mark.parametrize("verb", OTHERS)
@pytest.mark.parametrize("name", UNREADABLE)
def test_unreadable_meshes(folder, verb, name):
    arrange(folder)
    content, words = UNREADABLE[name]
    if content == "folder":
        os.mkdir(folder / name)
    elif content is not None:
        folder.write(name, content)
    folder.run(verb, name, *OTHERS[verb]).is_refused(*words)


@pytest.mark.parametrize("verb", [verb for verb in OTHERS if OTHERS[verb]])
def test_outputs_that_cannot_be_written(folder, verb):
    """Check that the output path is checked before the work begins: the input mesh does not even exist."""
    words = OTHERS[verb][:-1]
    ending = OTHERS[verb][-1][3:]
    if verb == "deform":  # deform must first read the pose to determine its output files
        return
    folder.run(verb, "x.off", *words, f"no/such/out{ending}").is_refused("no/such/out", "No such file")
    os.mkdir(folder / f"dir{ending}")
    folder.run(verb, "x.off", *words, f"dir{ending}").is_refused("directory")
    folder.run(verb, "x.off", *words, "out.doc").is_refused("out.doc", "unknown file name extension")
    folder.run(verb, "x.off", *words, "out").is_refused("no file name extension")
    folder.write(f"there{ending}", "precious")
    folder.run(verb, "x.off", *words, f"there{ending}").is_refused("the file exists")
    assert (folder / f"there{ending}").read_text() == "precious"
