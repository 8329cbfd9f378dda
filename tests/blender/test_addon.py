"""The Blender add-on: installation, weights in vertex groups, locked groups, modifiers, a skeleton, errors, the window."""

import json
import os
import pathlib
import subprocess

import pytest

HERE = pathlib.Path(__file__).resolve().parent
ADDON = HERE.parents[1] / "examples" / "blender" / "bindpose_addon.py"


def run_blender(script, folder, *options):
    """Run a script in Blender and return what it found. Blender's folders for users are empty."""
    result = folder / "result.json"
    environment = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
    environment["TMPDIR"] = str(folder)
    for name in ("SCRIPTS", "CONFIG"):
        user = folder / name.lower()
        user.mkdir()
        environment[f"BLENDER_USER_{name}"] = str(user)
    done = subprocess.run(
        ["blender", *options, "--factory-startup", "--python-exit-code", "3", "--python", HERE / script, "--", ADDON,
         os.environ["BINDPOSE_PROGRAM"], result],
        capture_output=True, text=True, timeout=500, check=False, env=environment)
    assert done.returncode == 0 and result.exists(), done.stdout + done.stderr
    assert "Traceback" not in done.stdout + done.stderr, done.stdout + done.stderr
    return json.loads(result.read_text())


@pytest.fixture(scope="module")
def found(tmp_path_factory):
    """What Blender found; see addon_in_blender.py."""
    return run_blender("addon_in_blender.py", tmp_path_factory.mktemp("blender"), "-b")


def test_every_vertex_has_weights_that_sum_to_one(found):
    assert found["result"] == ["FINISHED"] and found["parent"] == "rig" and found["modifiers"] == ["ARMATURE"]
    for (x, _, _), weights in zip(found["points"], found["weights"]):
        assert set(weights) <= {"lower", "upper"} and sum(weights.values()) == pytest.approx(1, abs=1e-3)
        assert all(0 <= weight <= 1 + 1e-6 for weight in weights.values())
        if x < 2:
            assert weights.get("lower", 0) > weights.get("upper", 0)
        if x > 4:
            assert weights.get("upper", 0) > weights.get("lower", 0)


def test_vertices_at_the_same_place_get_equal_weights(found):
    places = {}
    for point, weights in zip(found["points"], found["weights"]):
        places.setdefault(tuple(round(value, 6) for value in point), []).append(weights)
    twice = [rows for rows in places.values() if len(rows) == 2]
    assert len(twice) == 8
    for first, second in twice:
        assert first == pytest.approx(second, abs=1e-6)


def test_a_locked_group_keeps_its_weights(found):
    for weights in found["locked"]:
        assert weights["upper"] == pytest.approx(0.25) and weights["lower"] == pytest.approx(0.75, abs=1e-3)


def test_a_mirror_modifier_completes_the_shape(found):
    rows = [weights for weights in found["mirrored"] if weights]
    assert len(rows) > 0 and all(sum(weights.values()) == pytest.approx(1, abs=1e-3) for weights in rows)


def test_a_skeleton_lies_in_the_shape(found):
    assert found["skeleton"] == ["FINISHED"] and len(found["bones"]) >= 1
    for ends in found["bones"]:
        for x, y, z in ends:
            assert -0.01 <= x <= 6.01 and y * y + (z - 0.1) ** 2 <= 0.26


def test_mirrored_bones_have_symmetric_names(found):
    bones = {name: sorted(ends) for name, ends in found["named_bones"].items()}
    left = [name for name in bones if name.endswith(".L")]
    assert left and {f"{name[:-1]}R" for name in left} <= set(bones)
    for name in left:
        center = [(a + b) / 2 for a, b in zip(*bones[name])]
        other = [(a + b) / 2 for a, b in zip(*bones[f"{name[:-1]}R"])]
        assert center[0] > 0 and center == pytest.approx([-other[0], *other[1:]], abs=1e-5)


def test_a_symmetric_mesh_gets_symmetric_weights(found):
    rows = {tuple(round(value, 4) for value in point): weights
            for point, weights in zip(found["cross"], found["cross_weights"])}
    swapped = {name: name[:-1] + {"L": "R", "R": "L"}.get(name[-1], name[-1]) for name in found["named_bones"]}
    for (x, y, z), weights in rows.items():
        other = rows[-x, y, z]
        for name, weight in weights.items():
            assert other.get(swapped[name], 0) == pytest.approx(weight, abs=2e-4)


def test_a_bone_without_an_opposite_bone_is_not_mirrored(found):
    plain, mirrored = found["alone"]
    assert max(plain) > 0.9 and mirrored == pytest.approx(plain, abs=2e-4)


def test_errors_name_the_object(found):
    assert "the mesh 'empty' has no faces" in found["error"]


@pytest.fixture(scope="module")
def found_in_window(tmp_path_factory):
    """What Blender found in its window; see addon_in_window.py."""
    found = run_blender("addon_in_window.py", tmp_path_factory.mktemp("window"), "--enable-event-simulate")
    assert "error" not in found, found["error"]
    return found


def test_menu_entries_call_the_operators(found_in_window):
    found = found_in_window
    assert found["dialogs"] == ["OBJECT_OT_bindpose_weights", "OBJECT_OT_bindpose_skeleton"]
    assert found["before_enter"] == 0  # the dialog asks first
    assert found["parent"] == "rig" and all(sum(row.values()) == pytest.approx(1, abs=1e-3) for row in found["weights"])
    assert found["skeleton"]


def test_progress_is_shown(found_in_window):
    values = found_in_window["progress"]
    assert all(0 <= value <= 100 for value in values) and any(0 < value < 100 for value in values)


def test_the_window_stays_usable_and_escape_cancels(found_in_window):
    assert found_in_window["folder_is_gone"] and found_in_window["after_escape"] == 0 and found_in_window["canceled"]


@pytest.fixture(scope="module")
def installed(tmp_path_factory):
    """What Blender found after the installation of the add-on; see addon_installed.py."""
    folder = tmp_path_factory.mktemp("installed")
    return folder, run_blender("addon_installed.py", folder, "-b")


def test_enable_and_disable(installed):
    folder, found = installed
    assert found["file"] == str(folder / "scripts" / "addons" / "bindpose_addon.py")
    assert found["program"] == ""
    assert found["menus"] == {"VIEW3D_MT_object_parent": ["draw_parent_entry"], "VIEW3D_MT_editor_menus": ["draw_header_menu"]}
    assert found["operators"] == ["bindpose_skeleton", "bindpose_weights"]
    assert found["without"] == {"menus": {"VIEW3D_MT_object_parent": [], "VIEW3D_MT_editor_menus": []}, "operators": [],
                                "preferences": False}


def test_the_path_in_the_preferences(installed):
    runs = installed[1]["runs"]
    assert runs["path"] == "" and runs["empty, in PATH"] == "" and runs["name, in PATH"] == ""
    for name, program in (("missing", "/none/bindpose"), ("folder", "/usr"), ("empty, not in PATH", "bindpose")):
        assert runs[name] == f"the program '{program}' is not found; set its path in the preferences of the add-on"
    assert runs["other program"] == ("'/bin/true' has not written a result; set the path of bindpose in the preferences of the "
                                     "add-on")
