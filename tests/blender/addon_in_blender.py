"""Use the add-on inside of Blender: addon_in_blender.py -- ADDON.py PROGRAM RESULT.json.

The script makes a bar with a seam of open edges and two separate balls, binds it to an armature by the operator of the
add-on and by bone heat, makes a skeleton from the bar, and writes what it found.
"""

import importlib.util
import json
import math
import sys

import bpy
import numpy
from mathutils import Vector

if "bool" not in numpy.__dict__:
    numpy.bool = bool


def load_addon(path, program):
    spec = importlib.util.spec_from_file_location("bindpose_addon", path)
    addon = importlib.util.module_from_spec(spec)
    sys.modules["bindpose_addon"] = addon
    spec.loader.exec_module(addon)
    addon.program_path = lambda _context: program  # a script has no preferences of the add-on
    addon.register()
    return addon


def add_mesh(name, points, faces):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(points, [], faces)
    thing = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(thing)
    return thing


def bar(sides=8, rings=24, length=6.0, radius=0.5):
    """Return a tube with open ends, whose vertices occur twice at each ring in the middle: two parts that only touch."""
    points, faces = [], []
    for part in range(2):
        first = len(points)
        for ring in range(rings // 2 + 1):
            x = length * (ring + part * rings // 2) / rings
            points += [(x, radius * math.cos(2 * math.pi * k / sides), radius * math.sin(2 * math.pi * k / sides))
                       for k in range(sides)]
        for ring in range(rings // 2):
            for k in range(sides):
                a, b = first + ring * sides + k, first + ring * sides + (k + 1) % sides
                faces.append((a, b, b + sides, a + sides))
    return points, faces


def add_armature():
    data = bpy.data.armatures.new("rig")
    armature = bpy.data.objects.new("rig", data)
    bpy.context.collection.objects.link(armature)
    select(armature)
    bpy.ops.object.mode_set(mode="EDIT")
    for name, head, tail in (("lower", 0.2, 3), ("upper", 3, 5.8), ("control", 8, 9)):
        bone = data.edit_bones.new(name)
        bone.head, bone.tail = Vector((head, 0, 0)), Vector((tail, 0, 0))
    data.edit_bones["control"].use_deform = False
    bpy.ops.object.mode_set(mode="OBJECT")
    return armature


def select(*things):
    """Select objects; the last one is the active object."""
    for thing in bpy.context.selected_objects:
        thing.select_set(False)
    for thing in things:
        thing.select_set(True)
    bpy.context.view_layer.objects.active = things[-1]


def weights_of(thing):
    names = {group.index: group.name for group in thing.vertex_groups}
    return [{names[entry.group]: entry.weight for entry in vertex.groups} for vertex in thing.data.vertices]


def main():
    addon, program, result = sys.argv[sys.argv.index("--") + 1:]
    bpy.ops.wm.read_factory_settings(use_empty=True)
    load_addon(addon, program)
    found = {}
    armature = add_armature()
    thing = add_mesh("bar", *bar())
    thing.location = (0, 0, 0.1)
    select(thing, armature)
    found["result"] = list(bpy.ops.object.bindpose_weights())
    found["points"] = [list(thing.matrix_world @ vertex.co) for vertex in thing.data.vertices]
    found["weights"] = weights_of(thing)
    found["parent"] = thing.parent.name
    found["modifiers"] = [modifier.type for modifier in thing.modifiers]
    # A locked group keeps its weights.
    thing.vertex_groups["upper"].lock_weight = True
    thing.vertex_groups["upper"].add(range(len(thing.data.vertices)), 0.25, "REPLACE")
    select(thing, armature)
    bpy.ops.object.bindpose_weights()
    found["locked"] = weights_of(thing)
    # Half a bar with a mirror modifier.
    points, faces = bar()
    half = add_mesh("half", [point for point in points], [face for face in faces if max(points[v][2] for v in face) <= 0.01])
    modifier = half.modifiers.new("Mirror", "MIRROR")
    modifier.use_axis = (False, False, True)
    select(half, armature)
    bpy.ops.object.bindpose_weights()
    found["mirrored"] = weights_of(half)
    # Bone heat, for comparison.
    heat = add_mesh("heat", *bar())
    select(heat, armature)
    try:
        bpy.ops.object.parent_set(type="ARMATURE_AUTO")
        found["heat"] = weights_of(heat)
    except RuntimeError as error:
        found["heat"] = str(error)
    select(thing)
    found["skeleton"] = list(bpy.ops.object.bindpose_skeleton())
    skeleton = bpy.context.view_layer.objects.active
    found["bones"] = [[list(bone.head_local), list(bone.tail_local)] for bone in skeleton.data.bones]
    # Errors are one sentence.
    empty = add_mesh("empty", [(0, 0, 0)], [])
    select(empty, armature)
    try:
        bpy.ops.object.bindpose_weights()
    except RuntimeError as error:
        found["error"] = str(error)
    with open(result, "w", encoding="utf-8") as file:
        json.dump(found, file)


if __name__ == "__main__":
    main()
