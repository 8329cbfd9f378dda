"""Make a character with an animation in Blender and export it: export_in_blender.py -- FOLDER.

The script writes FOLDER/character.fbx, FOLDER/character.dae and FOLDER/character.json. The last file has, for both other files,
the vertices and the heads of the bones in Blender's coordinates of the scene (meters, with z up) at frames of the animation,
the first of which is the rest pose. It also has the weights of the vertices and the parents of the bones.
"""

import json
import math
import pathlib
import sys

import bpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from addon_in_blender import add_bones, add_mesh, cross_of_boxes, weights_of  # noqa: E402

BONES = {"root": (None, (0, 0, -3.5), (0, 0, 0)), "spine": ("root", (0, 0, 0), (0, 0, 1.8)),
         "arm.L": ("spine", (0.3, 0, 0), (2.8, 0, 0)), "arm.R": ("spine", (-0.3, 0, 0), (-2.8, 0, 0))}
FRAMES = (1, 13, 25)  # at 24 frames per second: at 0, 0.5 and 1 seconds
DEGREES = {"spine": (0, 20, -10), "arm.L": (0, 35, 70), "arm.R": (0, -25, 15)}  # around the bone's x axis, at the frames


def add_character(armature):
    """Add a mesh whose parent is the armature. Near joints, vertices have weights of several bones."""
    thing = add_mesh("body", *cross_of_boxes())
    thing.parent = armature
    modifier = thing.modifiers.new("Armature", "ARMATURE")
    modifier.object = armature
    groups = {name: thing.vertex_groups.new(name=name) for name in BONES}
    for vertex in thing.data.vertices:
        x, _, z = vertex.co
        arm = min(max((abs(x) - 0.3) / 0.6, 0), 1)
        above = min(max((z + 0.5) / 1.0, 0), 1)
        for name, weight in (("arm.L" if x > 0 else "arm.R", arm), ("spine", (1 - arm) * above),
                             ("root", (1 - arm) * (1 - above))):
            if weight > 0:
                groups[name].add([vertex.index], weight, "REPLACE")
    return thing


def animate(armature):
    scene = bpy.context.scene
    scene.render.fps = 24
    scene.frame_start, scene.frame_end = FRAMES[0], FRAMES[-1]
    for name, angles in DEGREES.items():
        bone = armature.pose.bones[name]
        bone.rotation_mode = "QUATERNION"
        for frame, angle in zip(FRAMES, angles):
            bone.rotation_quaternion = (math.cos(math.radians(angle) / 2), math.sin(math.radians(angle) / 2), 0, 0)
            bone.keyframe_insert("rotation_quaternion", frame=frame)


def state(thing, armature):
    """Return the vertices and the heads of the bones in coordinates of the scene."""
    graph = bpy.context.evaluated_depsgraph_get()
    evaluated = thing.evaluated_get(graph)
    points = [list(evaluated.matrix_world @ vertex.co) for vertex in evaluated.to_mesh().vertices]
    evaluated.to_mesh_clear()
    bones = armature.evaluated_get(graph).pose.bones
    return {"points": points, "heads": {bone.name: list(armature.matrix_world @ bone.head) for bone in bones}}


def states(thing, armature):
    """Return the states at all frames, and go back to the first."""
    found = []
    for frame in (*FRAMES, FRAMES[0]):
        bpy.context.scene.frame_set(frame)
        found.append(state(thing, armature))
    return found[:-1]


def main():
    folder = pathlib.Path(sys.argv[sys.argv.index("--") + 1])
    bpy.ops.wm.read_factory_settings(use_empty=True)
    armature = add_bones("skeleton", BONES)
    thing = add_character(armature)
    animate(armature)
    found = {"weights": weights_of(thing), "parents": {name: parent for name, (parent, _, _) in BONES.items()}}
    # The Collada exporter leaves the transform of the armature out of the bind matrix of its child, so it is the identity.
    found["dae"] = states(thing, armature)
    bpy.ops.wm.collada_export(filepath=str(folder / "character.dae"))
    armature.location = (0.5, -1, 4)
    armature.rotation_euler = (0, 0, math.radians(30))
    found["fbx"] = states(thing, armature)
    bpy.ops.export_scene.fbx(filepath=str(folder / "character.fbx"))
    (folder / "character.json").write_text(json.dumps(found), encoding="utf-8")


main()
