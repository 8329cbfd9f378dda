"""Pose a glTF file inside of Blender: in_blender.py -- FILE.glb RESULT.json [BONE DEGREES] [FRAME…].

The script imports the file. It rotates BONE by DEGREES around the z axis of glTF through the head of the bone, or
evaluates the given frames of the animation. It writes the vertices that Blender's armature modifier computes, in the
coordinates of the file.
"""

import json
import math
import sys

import bpy
import numpy
from mathutils import Matrix

# Blender 3.4's importer uses numpy.bool, which Debian's numpy 1.24 no longer has.
if "bool" not in numpy.__dict__:
    numpy.bool = bool

# The importer rotates glTF's y-up coordinates to Blender's z-up coordinates.
TO_BLENDER = Matrix(((1, 0, 0, 0), (0, 0, -1, 0), (0, 1, 0, 0), (0, 0, 0, 1)))


def points_of(mesh, place):
    map_back = TO_BLENDER.inverted() @ place
    return [list(map_back @ vertex.co) for vertex in mesh.vertices]


def evaluated_points(thing):
    bpy.context.view_layer.update()
    evaluated = thing.evaluated_get(bpy.context.evaluated_depsgraph_get())
    points = points_of(evaluated.to_mesh(), evaluated.matrix_world)
    evaluated.to_mesh_clear()
    return points


def main():
    source, result, *words = sys.argv[sys.argv.index("--") + 1:]
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.context.scene.render.fps = 24
    bpy.ops.import_scene.gltf(filepath=source)
    (thing,) = [o for o in bpy.data.objects if o.type == "MESH" and o.vertex_groups]
    armature = thing.find_armature()
    found = {
        "rest": points_of(thing.data, thing.matrix_world),
        "bones": {bone.name: bone.parent.name if bone.parent else None for bone in armature.data.bones},
        "most_groups": max(len(vertex.groups) for vertex in thing.data.vertices),
        "frames": {},
    }
    if words and not words[0].isdigit():
        bone = armature.pose.bones[words[0]]
        turn = TO_BLENDER @ Matrix.Rotation(math.radians(float(words[1])), 4, "Z") @ TO_BLENDER.inverted()
        head = Matrix.Translation(bone.head)
        bone.matrix = head @ turn @ head.inverted() @ bone.matrix
        found["posed"] = evaluated_points(thing)
        words = words[2:]
    for word in words:
        bpy.context.scene.frame_set(int(word))
        found["frames"][word] = evaluated_points(thing)
    with open(result, "w", encoding="utf-8") as file:
        json.dump(found, file)


main()
