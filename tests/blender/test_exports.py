"""Characters with an animation that Blender exports as FBX and Collada files are read by `bindpose rig`."""

import json
import os
import pathlib
import subprocess

import numpy as np
import pytest
from driver import Folder
from gltf_file import GltfFile

SCRIPT = pathlib.Path(__file__).with_name("export_in_blender.py")
# Blender's scene is in meters with z up. glTF is in meters with y up; Blender's FBX file is in centimeters with y up.
TO_GLTF = np.array([[1, 0, 0], [0, 0, 1], [0, -1, 0]], float)
FILES = pytest.mark.parametrize("ending", ["fbx", "dae"])


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A folder with the files that Blender exports; see export_in_blender.py."""
    path = tmp_path_factory.mktemp("exports")
    done = subprocess.run(["blender", "-b", "--factory-startup", "--python-exit-code", "3", "--python", SCRIPT, "--", path],
                          capture_output=True, text=True, timeout=500, check=False,
                          env={key: value for key, value in os.environ.items() if key != "PYTHONPATH"})
    assert done.returncode == 0, done.stdout + done.stderr
    return Folder(path)


@pytest.fixture(scope="module")
def rigs(folder):
    """New weights for the joints of each file, as glTF files."""
    for ending in ("fbx", "dae"):
        name = f"character.{ending}"
        folder.run("rig", name, "--handles", name, "-o", f"{ending}.glb").is_good()
    return {ending: GltfFile(folder / f"{ending}.glb") for ending in ("fbx", "dae")}


@pytest.fixture(scope="module")
def expected(folder):
    return json.loads((folder / "character.json").read_text())


def to_gltf(points):
    return np.array(points) @ TO_GLTF.T


def set_distance(first, second):
    """Return the largest distance from a point of one set to the nearest point of the other set."""
    distances = np.linalg.norm(first[:, None] - second[None], axis=2)
    return max(distances.min(axis=0).max(), distances.min(axis=1).max())


def joint_matrices(file, seconds=None):
    """Return the joint-to-scene matrices by the names of the joints, at rest or at a time of the animation. Values between keys
    are interpolated linearly."""
    motion, = file.json["animations"]
    moved = {}
    for channel in motion["channels"] if seconds is not None else []:
        sampler = motion["samplers"][channel["sampler"]]
        times, values = file.numbers(sampler["input"])[:, 0], file.numbers(sampler["output"])
        moved[channel["target"]["node"], channel["target"]["path"]] = [np.interp(seconds, times, column) for column in values.T]
    matrices = file.scene_matrices(moved)
    skin, = file.json["skins"]
    return {file.json["nodes"][joint]["name"]: matrices[joint] for joint in skin["joints"]}


@FILES
def test_positions_in_meters_with_y_up(rigs, expected, ending):
    assert set_distance(rigs[ending].skinned_points(), to_gltf(expected[ending][0]["points"])) < 1e-5


@FILES
def test_names_of_bones(rigs, expected, ending):
    joints = joint_matrices(rigs[ending])
    assert set(joints) == set(expected["parents"])
    for name, matrix in joints.items():
        assert matrix[:3, 3] == pytest.approx(to_gltf(expected[ending][0]["heads"][name]), abs=1e-5)
    nodes = rigs[ending].json["nodes"]
    parents = {nodes[child]["name"]: node["name"] for node in nodes for child in node.get("children", [])}
    assert {name: parents[name] for name in joints if parents[name] in joints} == {
        name: parent for name, parent in expected["parents"].items() if parent}


@FILES
def test_the_animation(rigs, expected, ending):
    file = rigs[ending]
    first = {"fbx": 0, "dae": 1 / 24}[ending]  # Collada counts from frame 0, and the animation begins at frame 1
    rest, points = joint_matrices(file), to_gltf(expected[ending][0]["points"])
    for seconds, state in zip((0, 0.5, 1), expected[ending]):
        posed = np.zeros_like(points)
        for name, matrix in joint_matrices(file, first + seconds).items():
            assert matrix[:3, 3] == pytest.approx(to_gltf(state["heads"][name]), abs=1e-5)
            weights = np.array([row.get(name, 0) for row in expected["weights"]])
            turn = matrix @ np.linalg.inv(rest[name])
            posed += weights[:, None] * (points @ turn[:3, :3].T + turn[:3, 3])
        assert np.abs(posed - to_gltf(state["points"])).max() < 2e-5
    assert np.abs(posed - points).max() > 1


@FILES
def test_half_of_a_file(folder, ending):
    data = (folder / f"character.{ending}").read_bytes()
    if ending == "fbx":
        assert data.startswith(b"Kaydara FBX Binary")
    name = folder.write(f"half.{ending}", data[:len(data) // 2])
    folder.run("rig", name, "-o", "half.glb").is_refused(f"{name} cannot be read")
