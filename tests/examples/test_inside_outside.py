"""Check the output of the example page, on a demo mesh and on a mesh of the user."""

import json

import pytest
from running import is_refused, numbers_of, pixels, script


def test_the_demo_mesh(tmp_path):
    numbers = numbers_of("01_inside_outside.py", tmp_path, "inside_outside")
    holes, crossing, closed = (numbers[name] for name in ("as it is", "crossing a copy", "without holes"))
    assert holes["vtk_refuses"] and not crossing["vtk_refuses"] and not closed["vtk_refuses"]
    assert holes["wrong"] < holes["vtk_wrong"]
    # Counting crossings of a ray classifies an overlap as outside.
    assert crossing["wrong"] == 0 and crossing["vtk_wrong"] > 0
    assert closed["wrong"] == 0
    for tolerance, error in numbers["tolerance"].items():
        assert error <= float(tolerance)
    assert numbers["gradient"] < 1e-4
    assert numbers["flipped, orient_patches=False"] > 0
    assert numbers["flipped, orient_patches=True"] == 0
    assert numbers["boundary_lines"] == numbers["open_edges"] > 0
    assert 0.03 < numbers["winding_volume"] < 0.0462012  # the upper bound is the volume of the elephant without holes


OPEN_BOX = """OFF
8 5 0
0 0 0
1 0 0
1 1 0
0 1 0
0 0 1
1 0 1
1 1 1
0 1 1
4 0 3 2 1
4 0 1 5 4
4 1 2 6 5
4 2 3 7 6
4 3 0 4 7
"""


def test_a_mesh_of_ones_own(tmp_path):
    """Run on an OFF file with quads that is open at the top. The file format and the polygons must not matter."""
    (tmp_path / "box.off").write_text(OPEN_BOX)
    done = script("01_inside_outside.py", tmp_path / "box.off", "--small", "--output", tmp_path)
    assert done.returncode == 0 and done.stderr == "", done.stderr
    numbers = json.loads((tmp_path / "inside_outside.json").read_text())
    assert numbers["as it is"]["vtk_refuses"] and "wrong" not in numbers["as it is"]
    assert numbers["boundary_lines"] == 4
    assert pixels(tmp_path / "inside_outside.png").shape == (960, 1800, 3)


@pytest.mark.parametrize("text, words", [(None, "box.off"), ("OFF\n3 1 0\n", "box.off")])
def test_what_is_wrong_is_one_sentence(tmp_path, text, words):
    if text:
        (tmp_path / "box.off").write_text(text)
    is_refused(script("01_inside_outside.py", tmp_path / "box.off", "--output", tmp_path), words)
