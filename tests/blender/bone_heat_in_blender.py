"""Bind a mesh to a skeleton by the add-on and by bone heat: bone_heat_in_blender.py -- ADDON PROGRAM MESH.npz RESULT.npz.

MESH.npz has the arrays `points` (#V x 3) and `triangles` (#F x 3). The add-on makes the skeleton. RESULT.npz has the
weights of both methods (#V x #bones) and their seconds, or an error.
"""

import pathlib
import sys
import time

import bpy
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from addon_in_blender import add_mesh, load_addon, select  # noqa: E402

MAXIMUM_BONES = 12


def weights_of(thing, bones):
    """Return the weights of the bones as a matrix. A bone without a vertex group has no weights."""
    columns = {group.index: bones.index(group.name) for group in thing.vertex_groups if group.name in bones}
    weights = np.zeros((len(thing.data.vertices), len(bones)))
    for row, vertex in enumerate(thing.data.vertices):
        for entry in vertex.groups:
            if entry.group in columns:
                weights[row, columns[entry.group]] = entry.weight
    return weights


def bind(name, mesh, armature, operator):
    """Bind a copy of the mesh. Return its weights and the seconds."""
    thing = add_mesh(name, *mesh)
    select(thing, armature)
    start = time.perf_counter()
    operator()
    seconds = time.perf_counter() - start
    return weights_of(thing, [bone.name for bone in armature.data.bones]), seconds


def main():
    addon, program, source, result = sys.argv[sys.argv.index("--") + 1:]
    bpy.ops.wm.read_factory_settings(use_empty=True)
    load_addon(addon, program)
    with np.load(source) as arrays:
        mesh = arrays["points"].tolist(), arrays["triangles"].tolist()
    found = {}
    try:
        thing = add_mesh("shape", *mesh)
        select(thing)
        start = time.perf_counter()
        bpy.ops.object.bindpose_skeleton(maximum_bones=MAXIMUM_BONES)
        found["skeleton_seconds"] = time.perf_counter() - start
        armature = bpy.context.view_layer.objects.active
        found["heat"], found["heat_seconds"] = bind(
            "heat", mesh, armature, lambda: bpy.ops.object.parent_set(type="ARMATURE_AUTO"))
        found["bindpose"], found["bindpose_seconds"] = bind("bindpose", mesh, armature, bpy.ops.object.bindpose_weights)
    except RuntimeError as error:  # the operators report errors in this way
        found["error"] = str(error)
    np.savez(result, **found)


main()
