"""Names of handles with any characters come back from every format."""

import json
import random
import urllib.parse

import bindpose
import numpy as np
import pytest
import shapes
from bindpose.meshes import add_point_array, points_of, to_dataset

NAMES = ["a&b", "<arm>", '"quoted"', "it's", "&lt;", "&#65;", "]]>", "<!-- x", "back\\slash", "{\"json\": 1}", "50 %s %n", "é",
         "e\u0301", "\u05e9\u05dc\u05d5\u05dd", "\u4eba", "\U0001f9b4", "\ufeffmark", "\u2028", "a" * 300, "x  y", "#", "1e5", "nan",
         "null", "p1", "../up", "C:\\x", "?*|"]
POINTS = [[-1, 0, 0], [1, 0, 0], [0, 1, 0]]


def random_name(source):
    """Return a name of 1 to 8 characters from all of Unicode, without control characters, surrogates and blanks at its ends."""
    while True:
        name = "".join(chr(source.choice([source.randrange(0x20, 0x7f), source.randrange(0xa0, 0xd800),
                                          source.randrange(0xe000, 0x110000)])) for _ in range(source.randint(1, 8)))
        if name == name.strip():
            return name


def names_of(handles):
    array = handles.GetCellData().GetAbstractArray("HandleName")
    return [array.GetValue(k) for k in range(array.GetNumberOfValues())]


def triples():
    source = random.Random(5)
    fixed = [NAMES[k:k + 3] for k in range(0, len(NAMES) - 2, 3)]
    return fixed + [[random_name(source) for _ in range(3)] for _ in range(20)]


@pytest.fixture(scope="module")
def weighted():
    """Return a sphere, and weights for three handles."""
    mesh = to_dataset(shapes.sphere(12, 6))
    distances = np.linalg.norm(points_of(mesh)[:, None, :] - np.array(POINTS, float), axis=2)
    weights = 1 / (0.1 + distances)
    return mesh, weights / weights.sum(axis=1, keepdims=True)


@pytest.mark.parametrize("names", triples())
def test_names_come_back(tmp_path, weighted, names):
    mesh, weights = weighted
    handles = bindpose.handles(points=POINTS, names=names)
    bindpose.write(handles, tmp_path / "h.vtp")
    assert names_of(bindpose.read_handles(tmp_path / "h.vtp")) == names

    lines = [f"{k + 1} {x} {y} {z} {name}" for k, ((x, y, z), name) in enumerate(zip(POINTS, names))]
    (tmp_path / "h.tgf").write_text("\n".join([*lines, "#", ""]), encoding="utf-8")
    assert names_of(bindpose.read_handles(tmp_path / "h.tgf")) == names

    surface = to_dataset(mesh)
    add_point_array(surface, "Weights", weights, names)
    is_long = max(len(urllib.parse.quote(name)) for name in names) > 255
    if is_long:
        with pytest.raises(bindpose.InvalidInput, match="at most 255 bytes"):
            bindpose.write(surface, tmp_path / "w.vtk")
    for name in ("w.vtp", "w.vtk")[:1 if is_long else 2]:
        bindpose.write(surface, tmp_path / name)
        array = bindpose.read(tmp_path / name).GetPointData().GetArray("Weights")
        assert [array.GetComponentName(k) for k in range(3)] == names

    bindpose.write_rig(surface, handles, tmp_path / "rig.glb")
    rig = bindpose.read_rig(tmp_path / "rig.glb")
    assert sorted(names_of(rig.handles)) == sorted(names)

    pose = {"version": 2, "handles": {names[1]: {"translate": [0, 0, 3]}}}
    (tmp_path / "p.json").write_text(json.dumps(pose), encoding="utf-8")
    moved = [bindpose.deform(surface, handles, each) for each in (pose, tmp_path / "p.json")]
    expected = points_of(mesh) + weights[:, 1:2] * [0, 0, 3]
    for each in moved:
        assert points_of(each) == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("name", ["", "a\nb", "tab\t", "\x00", "a\x7f", "\x85"])
def test_names_with_control_characters_are_refused(name):
    mesh = to_dataset(shapes.sphere(12, 6))
    with pytest.raises((bindpose.InvalidInput, ValueError)):
        bindpose.weights(mesh, bindpose.handles(points=POINTS, names=["p1", name, "p3"]), domain="surface")
