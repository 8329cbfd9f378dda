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


def cross_of_boxes():
    """Return two crossing boxes of small squares, along x and z. The lower end is longer."""
    points, faces = [], []
    for low, high in (((-3, -0.4, -0.4), (3, 0.4, 0.4)), ((-0.4, -0.4, -4), (0.4, 0.4, 2))):
        counts = [max(2, round((b - a) / 0.4)) for a, b in zip(low, high)]
        for axis in range(3):
            u, v = (axis + 1) % 3, (axis + 2) % 3
            for side in (0, 1):
                first = len(points)
                for i in range(counts[u] + 1):
                    for j in range(counts[v] + 1):
                        point = [0, 0, 0]
                        point[axis] = (low, high)[side][axis]
                        point[u] = low[u] + (high[u] - low[u]) * i / counts[u]
                        point[v] = low[v] + (high[v] - low[v]) * j / counts[v]
                        points.append(tuple(point))
                for i in range(counts[u]):
                    for j in range(counts[v]):
                        a = first + i * (counts[v] + 1) + j
                        face = (a, a + counts[v] + 1, a + counts[v] + 2, a + 1)
                        faces.append(face if side else face[::-1])
    return points, faces


def add_bones(name, bones):
    """Add an armature. A bone is {name: (parent or None, head, tail)}; parents come first."""
    data = bpy.data.armatures.new(name)
    armature = bpy.data.objects.new(name, data)
    bpy.context.collection.objects.link(armature)
    select(armature)
    bpy.ops.object.mode_set(mode="EDIT")
    for bone_name, (parent, head, tail) in bones.items():
        bone = data.edit_bones.new(bone_name)
        bone.head, bone.tail = head, tail
        bone.parent = data.edit_bones[parent] if parent else None
    bpy.ops.object.mode_set(mode="OBJECT")
    return armature


def add_armature():
    armature = add_bones("rig", {name: (None, (head, 0, 0), (tail, 0, 0))
                                 for name, head, tail in (("lower", 0.2, 3), ("upper", 3, 5.8), ("control", 8, 9))})
    armature.data.bones["control"].use_deform = False
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
    found["bones"] = [[list(skeleton.matrix_world @ end) for end in (bone.head_local, bone.tail_local)]
                      for bone in skeleton.data.bones]
    # A cross of two boxes: its arms are mirror images. Its mesh has the option for symmetry.
    cross = add_mesh("cross", *cross_of_boxes())
    cross.location = (20, 0, 0)
    bpy.context.view_layer.update()
    select(cross)
    bpy.ops.object.bindpose_skeleton()
    skeleton = bpy.context.view_layer.objects.active
    found["named_bones"] = {bone.name: [list(bone.head_local), list(bone.tail_local)] for bone in skeleton.data.bones}
    cross.data.use_mirror_x = True
    select(cross, skeleton)
    bpy.ops.object.bindpose_weights()
    found["cross"] = [list(vertex.co) for vertex in cross.data.vertices]
    found["cross_weights"] = weights_of(cross)
    # A bone on one side without an opposite bone keeps its weights, on both sides.
    left = next(bone.name for bone in skeleton.data.bones if bone.name.endswith(".L"))
    skeleton.data.bones[left[:-1] + "R"].use_deform = False
    found["alone"] = []
    for is_symmetric in (False, True):
        cross.data.use_mirror_x = is_symmetric
        select(cross, skeleton)
        bpy.ops.object.bindpose_weights()
        found["alone"].append([row.get(left, 0) for row in weights_of(cross)])
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
