"""Motions of other programs as poses: joints are matched to handles by name, and other proportions are retargeted."""

import json
import math

import asset_files
import bindpose
import numpy as np
import pytest
import shapes
from gltf_file import GltfFile
from vtkmodules.util.numpy_support import vtk_to_numpy

# A chain along x, as long as the bar of shapes.bar() times `size`. The third joint is a leaf with the name of no handle.
BVH = """HIERARCHY
ROOT hips
{{
  OFFSET 0 0 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT spine
  {{
    OFFSET {half} 0 0
    CHANNELS 3 Zrotation Xrotation Yrotation
    JOINT hat
    {{
      OFFSET {half} 0 0
      CHANNELS 3 Zrotation Xrotation Yrotation
      End Site
      {{
        OFFSET {half} 0 0
      }}
    }}
  }}
}}
MOTION
Frames: 3
Frame Time: 0.25
0 5 0 0 0 0 0 0 0 0 0 0
0 5 0 30 0 0 40 0 0 0 0 0
{step} 5 0 30 0 0 40 0 0 0 0 0
"""


def write_bones(folder, bones):
    """Write bones as handles. `bones` maps a name to its head, its tail and the index of its parent."""
    ends = [end for head, tail, _ in bones.values() for end in (head, tail)]
    folder.write("bones.vtp", f"""<?xml version="1.0"?>
<VTKFile type="PolyData" version="0.1"><PolyData><Piece NumberOfPoints="{len(ends)}" NumberOfLines="{len(bones)}">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">{' '.join(str(x) for end in ends for x in end)}</DataArray></Points>
<Lines><DataArray type="Int64" Name="connectivity" format="ascii">{' '.join(map(str, range(len(ends))))}</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">{' '.join(str(2 * k + 2) for k in range(len(bones)))}</DataArray></Lines>
<CellData><DataArray type="String" Name="HandleName" format="ascii">{' '.join(str(ord(c)) for name in bones for c in name + chr(0))}</DataArray>
<DataArray type="Int32" Name="Parent" format="ascii">{' '.join(str(parent) for _, _, parent in bones.values())}</DataArray></CellData>
</Piece></PolyData></VTKFile>""")


@pytest.fixture
def rig(folder):
    """A bar with two bones along it, hips and spine, and a motion of a skeleton that is ten times as large."""
    folder.off("bar.off", shapes.bar())
    write_bones(folder, {"hips": ((0, 0.5, 0.5), (3, 0.5, 0.5), -1), "spine": ((3, 0.5, 0.5), (6, 0.5, 0.5), 0)})
    folder.run("weights", "bar.off", "--handles", "bones.vtp", "-o", "bar.vtp").is_good()
    folder.write("walk.bvh", BVH.format(half=30, step=20))
    return folder


def heads(file, frame):
    """Return the joints' heads in scene coordinates at a frame of the first animation of a glTF file."""
    nodes = json.loads(json.dumps(file.json["nodes"]))
    animation = file.json["animations"][0]
    for channel in animation["channels"]:
        values = file.numbers(animation["samplers"][channel["sampler"]]["output"])
        nodes[channel["target"]["node"]][channel["target"]["path"]] = values[min(frame, len(values) - 1)].tolist()
    parents = {child: k for k, node in enumerate(nodes) for child in node.get("children", [])}

    def matrix(k):
        x, y, z, w = nodes[k].get("rotation", [0, 0, 0, 1])
        turn = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                         [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                         [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])
        own = np.eye(4)
        own[:3, :3] = turn * nodes[k].get("scale", [1, 1, 1])
        own[:3, 3] = nodes[k].get("translation", [0, 0, 0])
        return matrix(parents[k]) @ own if k in parents else own

    return {nodes[k]["name"]: matrix(k)[:3, 3] for k in file.json["skins"][0]["joints"]}


def test_a_bvh_file_moves_the_handles_with_its_names(rig):
    run = rig.run("deform", "bar.vtp", "--handles", "bones.vtp", "--pose", "walk.bvh", "-o", "walk.glb", "--report", "-")
    report = run.is_good().report
    assert report["counts"]["frames"] == 3
    assert report["motion"] == "retargeted"
    assert report["handles_without_joint"] == [] and report["joints_without_handle"] == ["hat"]
    file = GltfFile(rig / "walk.glb")
    # The first frame is the rest pose, although the file raises its hips by 5.
    assert heads(file, 0)["hips"] == pytest.approx([0, 0.5, 0.5], abs=1e-5)
    turn = math.radians(30)
    knee = [3 * math.cos(turn), 0.5 + 3 * math.sin(turn), 0.5]
    assert heads(file, 1)["spine"] == pytest.approx(knee, abs=1e-4)
    # The skeleton of the file is ten times as large, so its step of 20 is a step of 2.
    assert heads(file, 2)["hips"] == pytest.approx([2, 0.5, 0.5], abs=1e-4)
    assert heads(file, 2)["spine"] == pytest.approx([knee[0] + 2, *knee[1:]], abs=1e-4)


def test_the_same_skeleton_moves_as_in_its_file(rig):
    rig.run("deform", "bar.vtp", "--handles", "bones.vtp", "--pose", "walk.bvh", "-o", "walk.glb").is_good()
    run = rig.run("deform", "bar.vtp", "--handles", "bones.vtp", "--pose", "walk.glb", "-o", "again.glb", "--report", "-").is_good()
    assert run.report["motion"] == "exact"
    first, second = GltfFile(rig / "walk.glb"), GltfFile(rig / "again.glb")
    for frame in range(3):
        for name, head in heads(first, frame).items():
            assert heads(second, frame)[name] == pytest.approx(head, abs=1e-5)


def test_an_asset_gets_the_motion_as_an_animation(rig):
    rig.write("bar.obj", "\n".join([*("v " + " ".join(map(str, v)) for v in shapes.bar()[0]),
                                    *("f " + " ".join(str(v + 1) for v in face) for face in shapes.bar()[1])]))
    rig.run("rig", "bar.obj", "--handles", "bones.vtp", "--pose", "walk.bvh", "-o", "bar.glb").is_good()
    file = GltfFile(rig / "bar.glb")
    assert len(file.json["animations"]) == 1
    assert heads(file, 2)["hips"] == pytest.approx([2, 0.5, 0.5], abs=1e-4)


def test_handles_without_a_joint_are_listed(rig):
    rig.write("other.bvh", BVH.format(half=30, step=20).replace("JOINT spine", "JOINT Spine_X"))
    run = rig.run("deform", "bar.vtp", "--handles", "bones.vtp", "--pose", "other.bvh", "-o", "walk.glb").is_good()
    assert "1 of 2 handles have no joint of the same name" in run.err and "'spine'" in run.err


def test_bad_motions_are_one_sentence(rig):
    words = ("deform", "bar.vtp", "--handles", "bones.vtp", "-o", "walk.glb", "--pose")
    text = BVH.format(half=30, step=20)
    rig.write("names.bvh", text.replace("hips", "a").replace("spine", "b"))
    rig.run(*words, "names.bvh").is_refused("none of its joints has the name of a handle")
    rig.write("root.bvh", text.replace("ROOT hips", "hips"))
    rig.run(*words, "root.bvh").is_refused("root.bvh cannot be read")
    rig.write("half.bvh", text[:len(text) // 2])
    rig.run(*words, "half.bvh").is_refused("half.bvh cannot be read")
    rig.run(*words, "none.bvh").is_refused("none.bvh")
    rig.run(*words, "walk.bvh", environment={"BINDPOSE_IMPORTER": "/none"}).is_refused("BINDPOSE_IMPORTER")


# Three bones whose heads are not on one line, so that the axes of the file can be recognized.
PLATE_BONES = {"hips": ((1, 2, 0.5), (3, 2, 0.5), -1), "spine": ((3, 2, 0.5), (5, 2, 0.5), 0),
               "fin": ((3, 3, 0.5), (5, 3.5, 0.5), 0)}
STEP = np.array([1, 2, 3])


def plate_joints(scale):
    """Return the motion of the bones for collada_motion(). The hips turn about z, then the spine about y with a step of
    the hips. The fin only follows the hips.
    """
    heads = {name: scale * np.array(head) for name, (head, _, _) in PLATE_BONES.items()}
    spine, fin = heads["spine"] - heads["hips"], heads["fin"] - heads["hips"]
    return {"hips": (None, "z", [heads["hips"], heads["hips"], heads["hips"] + scale * STEP], [0, 30, 30]),
            "spine": ("hips", "y", [spine] * 3, [0, 0, 40]), "fin": ("hips", "z", [fin] * 3, [0, 0, 0])}


def posed_plate(points, weights, frame):
    """Return the points that linear blend skinning gives for the motion."""
    result, maps = np.zeros_like(points), {}
    for k, (name, (parent, axis, offsets, degrees)) in enumerate(plate_joints(1).items()):
        local = asset_files.transform(axis, degrees[frame], offsets[frame])
        maps[name] = maps[parent] @ local if parent else local
        linear, position = maps[name][:3, :3], maps[name][:3, 3]
        result += weights[:, k, None] * ((points - PLATE_BONES[name][0]) @ linear.T + position)
    return result


@pytest.mark.parametrize("in_parts", [False, True], ids=["matrices", "parts"])
@pytest.mark.parametrize("up, meter, scale", [("Y_UP", 1, 1), ("Z_UP", 0.01, 1000), ("X_UP", 0.0254, 5)])
def test_a_collada_motion(folder, in_parts, up, meter, scale):
    """A skeleton of another size in another unit and with other axes moves the mesh as its joints move."""
    folder.off("plate.off", shapes.bar(12, 8, 2, (6.0, 4.0, 1.0)))
    write_bones(folder, PLATE_BONES)
    folder.run("weights", "plate.off", "--handles", "bones.vtp", "-o", "plate.vtp").is_good()
    folder.write("walk.dae", asset_files.collada_motion(plate_joints(scale), [0, 0.25, 0.5], in_parts, meter, up))
    run = folder.run("deform", "plate.vtp", "--handles", "bones.vtp", "--pose", "walk.dae", "-o", "out.vtp", "--report", "-")
    report = run.is_good().report
    assert run.err == "" and report["motion"] == "retargeted" and report["counts"]["frames"] == 3
    assert report["handles_without_joint"] == report["joints_without_handle"] == []
    rest = bindpose.read(folder / "plate.vtp")
    points = vtk_to_numpy(rest.GetPoints().GetData()).astype(float)
    weights = vtk_to_numpy(rest.GetPointData().GetArray("Weights"))
    for frame in range(3):
        posed = vtk_to_numpy(bindpose.read(folder / f"out_{frame:04}.vtp").GetPoints().GetData())
        assert posed == pytest.approx(posed_plate(points, weights, frame), abs=1e-6)


def test_a_collada_file_without_a_motion(folder):
    folder.off("plate.off", shapes.bar(12, 8, 2, (6.0, 4.0, 1.0)))
    write_bones(folder, PLATE_BONES)
    folder.run("weights", "plate.off", "--handles", "bones.vtp", "-o", "plate.vtp").is_good()
    text = asset_files.collada_motion(plate_joints(1), [0, 0.25, 0.5], True)
    begin, end = text.index("<library_animations>"), text.index("<library_visual_scenes>")
    folder.write("still.dae", text[:begin] + text[end:])
    words = ("deform", "plate.vtp", "--handles", "bones.vtp", "-o", "out.vtp", "--pose")
    folder.run(*words, "still.dae").is_refused("still.dae", "no animation")
    folder.write("half.dae", text[:len(text) // 2])
    folder.run(*words, "half.dae").is_refused("half.dae cannot be read")
