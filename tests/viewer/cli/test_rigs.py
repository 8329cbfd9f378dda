"""glTF: weights and deform write rigs, every verb reads them."""

import json

import bindpose
import numpy as np
import pytest
import shapes
from bindpose.meshes import add_point_array, points_of, to_dataset

FRAMES = {"fps": 8, "frames": [{"handles": {"b2": {"rotate": {"axis": [0, 0, 1], "degrees": 20 * k}}}}
                               for k in range(3)]}


@pytest.fixture
def bar(folder):
    mesh = to_dataset(shapes.bar())
    x = points_of(mesh)[:, 0] / 6
    add_point_array(mesh, "Weights", np.stack([1 - x, x], axis=1), ["b1", "b2"])
    bindpose.write(mesh, folder / "bar.vtp")
    folder.write("h.tgf", shapes.TWO_BONES)
    folder.write("seq.json", json.dumps(FRAMES))
    folder.mesh = mesh
    return folder


def deform(folder, *more, mesh="bar.vtp", handles="h.tgf", pose="seq.json", output="out.glb"):
    return folder.run("deform", mesh, "--handles", handles, "--pose", pose, "-o", output, *more)


def test_weights_make_a_rig(folder):
    folder.off("cube.off", shapes.cube())
    folder.write("h.tgf", "1 -0.9 0 0\n2 0.9 0 0\n3 0 0.9 0\n#\n")
    run = folder.run("weights", "cube.off", "--handles", "h.tgf", "-o", "rig.glb", "--report", "r.json").is_good()
    assert run.new_files == ["r.json", "rig.glb"]
    report = json.loads((folder / "r.json").read_text())
    assert report["gltf"]["counts"]["joints"] == 3 and report["gltf"]["pose_error"] < 1e-6
    folder.run("weights", "cube.off", "--handles", "h.tgf", "-o", "rig.vtp").is_good()
    ours = bindpose.read(folder / "rig.vtp").GetPointData().GetArray("Weights")
    back = bindpose.read(folder / "rig.glb").GetPointData().GetArray("Weights")
    for v in range(8):
        assert back.GetTuple(v) == pytest.approx(ours.GetTuple(v), abs=2e-7)
    report = folder.run("info", "rig.glb", "--report", "-").is_good().report
    assert [handle["name"] for handle in report["handles"]] == ["p1", "p2", "p3"]
    text = folder.run("info", "rig.glb").is_good().out
    assert "point  p2" in text and "weights a vertex" in text


def test_a_sequence_is_an_animation(bar):
    report = deform(bar, "--report", "-").is_good().report
    assert report["counts"]["frames"] == 3
    assert report["gltf"]["animation"] == "joints" and report["gltf"]["animation_error"] < 1e-6
    assert "3 frames, 8 a second" in bar.run("info", "out.glb").is_good().out
    # The file is mesh, handles and pose in one.
    deform(bar, output="a.vtp").is_good()
    deform(bar, mesh="out.glb", handles="out.glb", pose="out.glb", output="b.vtp").is_good()
    for frame in range(3):
        expected = points_of(bindpose.read(bar / f"a_000{frame}.vtp"))
        assert points_of(bindpose.read(bar / f"b_000{frame}.vtp")) == pytest.approx(expected, abs=2e-6)


def test_other_methods_are_morph_targets(bar):
    report = deform(bar, "--method", "full-arap", "--report", "-").is_good().report
    assert report["gltf"]["animation"] == "morph"
    report = deform(bar, "--method", "dqs", "--gltf-animation", "joints", "--overwrite", "--report", "-").is_good().report
    assert 1e-3 < report["gltf"]["animation_error"] < 0.2  # how far linear blends are from dual quaternions
    bindpose.write(shapes.bar(), bar / "plain.off")
    deform(bar, "--method", "mls", "--overwrite", mesh="plain.off").is_good()
    deform(bar, "--overwrite", "--method", "mls", "--gltf-animation", "joints", mesh="plain.off").is_refused("morph")


def test_one_pose_is_how_the_joints_stand(bar):
    bar.write("pose.json", json.dumps(FRAMES["frames"][2]))
    deform(bar, pose="pose.json").is_good()
    assert "animation" not in bar.run("info", "out.glb").is_good().out
    deform(bar, pose="pose.json", output="a.vtp").is_good()
    bar.write("rest.json", '{"handles": {}}')
    deform(bar, mesh="out.glb", handles="out.glb", pose="rest.json", output="b.vtp").is_good()
    assert points_of(bindpose.read(bar / "b.vtp")) == pytest.approx(points_of(bindpose.read(bar / "a.vtp")), abs=2e-6)


def test_broken_files_are_named(bar):
    deform(bar).is_good()
    whole = (bar / "out.glb").read_bytes()
    bar.write("cut.glb", whole[: len(whole) // 2])
    bar.write("text.gltf", "{}")
    for name in ("cut.glb", "text.gltf"):
        bar.run("info", name).is_refused(name)
        deform(bar, mesh=name, output="o.vtp").is_refused(name)
        deform(bar, handles=name, output="o.vtp").is_refused(name)
        deform(bar, pose=name, output="o.vtp").is_refused(name)
    deform(bar).is_refused("out.glb", "the file exists")
