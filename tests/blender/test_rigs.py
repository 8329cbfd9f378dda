"""Blender imports the glTF files that Bindpose writes and poses them. Blender's vertices must equal Bindpose's linear
blend skinning.
"""

import json
import os
import pathlib
import subprocess

import bindpose
import numpy as np
import pytest
from bindpose.meshes import add_point_array, points_of, to_dataset

SCRIPT = pathlib.Path(__file__).with_name("in_blender.py")
BONES = "1 0.3 .5 .5\n2 2 .5 .5\n3 4 .5 .5\n4 5.7 .5 .5\n5 5.7 .5 .9\n6 1 .1 .5\n7 3 .9 .1\n#\n1 2 1 0 0\n2 3 1 0 0\n3 4 1 0 0\n"
NAMES = ["p1", "p2", "p3", "b1", "b2", "b3"]


def cloth(n=20):
    """Return a slightly wavy 6 x 1 sheet of triangles, in which no two vertices coincide."""
    x, y = np.meshgrid(np.linspace(0, 6, 3 * n), np.linspace(0, 1, n), indexing="ij")
    points = np.stack([x, y, 0.5 + 0.2 * np.sin(x)], axis=2).reshape(-1, 3)
    ids = np.arange(len(points)).reshape(x.shape)
    a, b, c, d = (part.ravel() for part in (ids[:-1, :-1], ids[1:, :-1], ids[1:, 1:], ids[:-1, 1:]))
    return points, np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "h.tgf").write_text(BONES)
    return tmp_path


def rig(folder, row_sum=1.0, **options):
    """Write a rig in which every vertex has weights of all six handles, so the file contains two sets of joint weights.
    """
    mesh = to_dataset(cloth())
    points = points_of(mesh)
    weights = np.random.default_rng(3).uniform(0.02, 0.1, (len(points), 6))
    weights[:, 3:] += np.exp(-((points[:, :1] - [1, 3, 5]) ** 2))
    weights *= row_sum / weights.sum(axis=1, keepdims=True)
    add_point_array(mesh, "Weights", weights, NAMES)
    return mesh, bindpose.write_rig(mesh, folder / "h.tgf", folder / "rig.glb", **options)


def blender(folder, *words):
    command = ["blender", "-b", "--factory-startup", "--python-exit-code", "3", "--python", SCRIPT, "--",
               folder / "rig.glb", folder / "result.json", *words]
    done = subprocess.run(command, capture_output=True, text=True, timeout=500, check=False,
                          env={k: v for k, v in os.environ.items() if k != "PYTHONPATH"})
    assert done.returncode == 0, done.stdout + done.stderr
    return json.loads((folder / "result.json").read_text())


def error(mesh, found, expected):
    """Return the largest distance between found and expected points, in bounding-box diagonals."""
    points = points_of(mesh)
    return np.linalg.norm(np.array(found) - expected, axis=1).max() / np.linalg.norm(np.ptp(points, axis=0))


TURN = {"handles": {"b2": {"rotate": {"axis": [0, 0, 1], "degrees": 40}}}}


@pytest.mark.parametrize("row_sum", [1.0, 0.7])
def test_a_posed_bone(folder, row_sum):
    mesh, report = rig(folder, row_sum)
    assert report["sets"] == 2 and report["rest_joint"] == ("no" if row_sum == 1.0 else "yes")
    found = blender(folder, "b2", "40")
    assert found["most_groups"] == (6 if row_sum == 1.0 else 7)  # Blender reads both sets of joint weights
    assert {name: found["bones"][name] for name in NAMES} == {
        "p1": None, "p2": None, "p3": None, "b1": None, "b2": "b1", "b3": "b2"}
    assert error(mesh, found["rest"], points_of(mesh)) < 1e-5
    posed = points_of(bindpose.deform(mesh, folder / "h.tgf", TURN))
    assert np.abs(posed - points_of(mesh)).max() > 0.5
    assert error(mesh, found["posed"], posed) < 1e-5


def test_the_largest_four_weights(folder):
    mesh, report = rig(folder, maximum_influences=4)
    assert report["sets"] == 1 and report["counts"]["dropped_weights"] > 0
    found = blender(folder, "b2", "40")
    assert found["most_groups"] == 4
    kept = bindpose.read(folder / "rig.glb")
    posed = points_of(bindpose.deform(kept, folder / "h.tgf", TURN))
    assert error(mesh, found["posed"], posed) < 1e-5
    # The file keeps four of the six weights per vertex. Posing with all six weights gives other positions. The
    # difference, in bounding-box diagonals, is less than the dropped fraction of the weights.
    all_six = points_of(bindpose.deform(mesh, folder / "h.tgf", TURN))
    assert 1e-4 < error(mesh, found["posed"], all_six) < report["dropped_share"]


def test_an_animation(folder):
    frames = [{"handles": {"b2": {"rotate": {"axis": [1, 0, 1], "degrees": 15 * k}, "scale": 1 + 0.1 * k},
                           "b3": {"translate": [0, 0.3 * k, 0]}, "p1": {"translate": [0, 0, -0.2 * k]}}}
              for k in range(4)]
    mesh, _ = rig(folder)
    posed = bindpose.deform(mesh, folder / "h.tgf", {"frames": frames})
    for animation in ("joints", "morph"):
        report = bindpose.write_rig(mesh, folder / "h.tgf", folder / "rig.glb", frames=posed, animation=animation,
                                    overwrite=True)
        assert report["animation"] == animation and report.get("animation_error", 0) < 1e-6
        found = blender(folder, "0", "1", "3")
        for frame in (0, 1, 3):
            assert error(mesh, found["frames"][str(frame)], points_of(posed[frame])) < 1e-5, (animation, frame)
