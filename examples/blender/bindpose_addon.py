"""Bindpose in Blender: smooth bounded weights for an armature, and a skeleton from a shape.

Install it by *Edit > Preferences > Add-ons > Install*, and set the path of the program `bindpose` in the preferences of
the add-on. It adds

- *Object > Parent > With Bindpose Weights*, for the selected meshes and the active armature;
- *Object > Bindpose > Skeleton from Shape*, for the active mesh.

The program runs in the background; Escape cancels it.
"""

import os
import shutil
import subprocess
import tempfile

import bpy
import numpy as np
from mathutils import Vector, kdtree

bl_info = {
    "name": "Bindpose Weights",
    "author": "The Bindpose developers",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "Object > Parent, Object > Bindpose",
    "description": "Bounded biharmonic weights for any mesh, however unclean, and skeletons from shapes",
    "category": "Rigging",
}

# Modifiers that keep the shape's surface. They are ignored, because their result depends on the pose or is finer.
IGNORED_MODIFIERS = {"ARMATURE", "SUBSURF", "MULTIRES", "CORRECTIVE_SMOOTH", "CLOTH", "SOFT_BODY"}
WEIGHT_THRESHOLD = 1e-4  # smaller weights are not stored in vertex groups


class BindposeError(Exception):
    """An error with a sentence for the user."""


# ---- Files -----------------------------------------------------------------------------------------------------------

def write_off(path, points, polygons):
    """Write a surface. Its coordinates have all digits of a double."""
    with open(path, "w", encoding="ascii") as file:
        file.write(f"OFF\n{len(points)} {len(polygons)} 0\n")
        file.writelines(f"{x!r} {y!r} {z!r}\n" for x, y, z in points)
        file.writelines(f"{len(polygon)} {' '.join(map(str, polygon))}\n" for polygon in polygons)


def write_bones(path, bones):
    """Write pairs of head and tail as a handle dataset. A bone that can have no vertex of its own gets no weights."""
    points = " ".join(f"{value!r}" for ends in bones for end in ends for value in end)
    count = len(bones)
    with open(path, "w", encoding="ascii") as file:
        file.write(f"""<?xml version="1.0"?>
<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian"><PolyData>
<Piece NumberOfPoints="{2 * count}" NumberOfLines="{count}">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">{points}</DataArray></Points>
<Lines><DataArray type="Int64" Name="connectivity" format="ascii">{' '.join(map(str, range(2 * count)))}</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">{' '.join(map(str, range(2, 2 * count + 1, 2)))}</DataArray></Lines>
<CellData><DataArray type="Int32" Name="Ownership" format="ascii">{' '.join(['1'] * count)}</DataArray></CellData>
</Piece></PolyData></VTKFile>
""")


def read_dmat(path):
    """Read a matrix, whose numbers are stored column by column."""
    with open(path, "rb") as file:
        columns, rows = map(int, file.readline().split())
        if (columns, rows) == (0, 0):  # the numbers are binary
            columns, rows = map(int, file.readline().split())
            values = np.frombuffer(file.read(), "<f8", columns * rows)
        else:
            values = np.array(file.read().split(), float)
    return values.reshape(columns, rows).T


def read_tgf(path):
    """Return the positions of the nodes and the bones as pairs of node indices."""
    with open(path, encoding="utf-8") as file:
        text = file.read()
    nodes, edges = text.split("#", 1)
    ids, points = {}, []
    for line in nodes.splitlines():
        words = line.split()
        if words:
            ids[words[0]] = len(points)
            points.append(Vector(map(float, words[1:4])))
    return points, [tuple(ids[word] for word in line.split()[:2]) for line in edges.splitlines() if line.split()]


# ---- Meshes and armatures --------------------------------------------------------------------------------------------

def shape_of(thing, context):
    """Return the points and polygons of a mesh object in world coordinates, with the modifiers that change its surface,
    such as Mirror and Solidify."""
    ignored = [m for m in thing.modifiers if m.type in IGNORED_MODIFIERS and m.show_viewport]
    for modifier in ignored:
        modifier.show_viewport = False
    try:
        context.view_layer.update()
        evaluated = thing.evaluated_get(context.evaluated_depsgraph_get())
        mesh = evaluated.to_mesh()
        points = world_points(mesh, thing.matrix_world)
        polygons = [tuple(polygon.vertices) for polygon in mesh.polygons]
        evaluated.to_mesh_clear()
    finally:
        for modifier in ignored:
            modifier.show_viewport = True
    if not polygons:
        raise BindposeError(f"the mesh '{thing.name}' has no faces")
    return points, polygons


def world_points(mesh, to_world):
    local = np.empty(3 * len(mesh.vertices))
    mesh.vertices.foreach_get("co", local)
    matrix = np.array(to_world)
    return (local.reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3]).tolist()


def deform_bones(armature):
    """Return the deforming bones with a length, and their ends at rest in world coordinates. Of bones with the same ends
    only the first is used."""
    bones, ends, found = [], [], set()
    for bone in armature.data.bones:
        head, tail = (tuple(armature.matrix_world @ end) for end in (bone.head_local, bone.tail_local))
        if bone.use_deform and head != tail and frozenset((head, tail)) not in found:
            found.add(frozenset((head, tail)))
            bones.append(bone.name)
            ends.append((head, tail))
    if not bones:
        raise BindposeError(f"the armature '{armature.name}' has no deforming bones")
    return bones, ends


def to_vertices(weights, shape_points, vertex_points):
    """Return the rows of weights of the mesh's own vertices. Most modifiers keep them first; otherwise each vertex gets
    the row of the nearest point of the shape."""
    count = len(vertex_points)
    size = np.ptp(np.array(shape_points), axis=0).max()
    if count <= len(shape_points) and \
            np.abs(np.array(shape_points[:count]) - np.array(vertex_points)).max(initial=0) <= 1e-6 * size:
        return weights[:count]
    tree = kdtree.KDTree(len(shape_points))
    for index, point in enumerate(shape_points):
        tree.insert(point, index)
    tree.balance()
    return weights[[tree.find(point)[1] for point in vertex_points]]


def set_vertex_groups(thing, names, weights):
    """Store weights in the vertex groups of the bones. Locked groups keep their weights; the others share the rest."""
    groups = {name: thing.vertex_groups.get(name) or thing.vertex_groups.new(name=name) for name in names}
    locked = {group.index for group in thing.vertex_groups if group.lock_weight}
    bone_groups = {group.index for group in groups.values()}
    kept = np.array([sum(entry.weight for entry in vertex.groups if entry.group in locked & bone_groups)
                     for vertex in thing.data.vertices])
    free = [k for k, name in enumerate(names) if groups[name].index not in locked]
    rows = weights[:, free]
    sums = rows.sum(axis=1)
    rows = rows * (np.clip(1 - kept, 0, 1) / np.where(sums > 0, sums, 1))[:, None]
    for column, k in enumerate(free):
        group = groups[names[k]]
        group.remove(range(len(thing.data.vertices)))
        for vertex in np.nonzero(rows[:, column] > WEIGHT_THRESHOLD)[0]:
            group.add([int(vertex)], float(rows[vertex, column]), "REPLACE")


def bind_armature(thing, armature):
    """Make the armature the parent of the mesh, with a modifier, and keep the mesh at its place."""
    place = thing.matrix_world.copy()
    thing.parent = armature
    thing.matrix_world = place
    if not any(m.type == "ARMATURE" and m.object == armature for m in thing.modifiers):
        modifier = thing.modifiers.new("Armature", "ARMATURE")
        modifier.object = armature


def make_armature(name, points, bones, context):
    """Make an armature of bones between points. A bone that begins where another ends is its child."""
    data = bpy.data.armatures.new(name)
    armature = bpy.data.objects.new(name, data)
    context.collection.objects.link(armature)
    for thing in context.selected_objects:
        thing.select_set(False)
    armature.select_set(True)
    context.view_layer.objects.active = armature
    bpy.ops.object.mode_set(mode="EDIT")
    ending = {}
    for head, tail in bones:
        bone = data.edit_bones.new("Bone")
        bone.head, bone.tail = points[head], points[tail]
        ending.setdefault(tail, bone.name)
    for (head, _), bone in zip(bones, list(data.edit_bones)):
        parent = ending.get(head)
        if parent and parent != bone.name:
            bone.parent = data.edit_bones[parent]
            bone.use_connect = True
    bpy.ops.object.mode_set(mode="OBJECT")
    return armature


# ---- The program -----------------------------------------------------------------------------------------------------

def program_path(context):
    addon = context.preferences.addons.get(__name__)
    path = addon.preferences.program if addon else "bindpose"
    found = shutil.which(bpy.path.abspath(path))
    if not found:
        raise BindposeError(f"the program '{path}' is not found; set its path in the preferences of the add-on")
    return found


class Job:
    """Runs of the program, one after the other, in a temporary folder."""

    def __init__(self, context, commands):
        self.folder = tempfile.TemporaryDirectory(prefix="bindpose-")
        self.program = program_path(context)
        self.commands = [list(words) for words in commands]
        self.count = len(self.commands)
        self.process = None

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def poll(self):
        """Start the next command if none runs. Return True if all commands are done; raise BindposeError for an error."""
        if self.process:
            code = self.process.poll()
            if code is None:
                return False
            lines = self.process.stderr.read().splitlines() or [f"the program ended with code {code}"]
            self.process = None
            if code not in (0, 3):  # 3: not converged, the result is written
                raise BindposeError(lines[-1].split(": ", 1)[-1])
        if not self.commands:
            return True
        self.process = subprocess.Popen([self.program, *self.commands.pop(0)], cwd=self.folder.name, text=True,
                                        stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        return False

    def progress(self):
        return (self.count - len(self.commands) - (self.process is not None)) / self.count

    def end(self):
        if self.process:
            self.process.terminate()
            self.process.wait()
        self.folder.cleanup()


class BindposeOperator:
    """An operator that runs the program without blocking the window."""

    bl_options = {"REGISTER", "UNDO"}

    def invoke(self, context, _event):
        try:
            self.job = self.start(context)
        except BindposeError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        self.timer = context.window_manager.event_timer_add(0.1, window=context.window)
        context.window_manager.progress_begin(0, 100)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type == "ESC":
            self.close(context)
            self.report({"INFO"}, "canceled")
            return {"CANCELLED"}
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        context.window_manager.progress_update(100 * self.job.progress())
        try:
            if not self.job.poll():
                return {"RUNNING_MODAL"}
            self.finish(context, self.job)
        except BindposeError as error:
            self.close(context)
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        self.close(context)
        return {"FINISHED"}

    def close(self, context):
        self.job.end()
        context.window_manager.event_timer_remove(self.timer)
        context.window_manager.progress_end()

    def execute(self, context):
        """Run to the end, for scripts and without a window."""
        try:
            job = self.start(context)
        except BindposeError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        try:
            while not job.poll():
                if job.process:
                    job.process.wait()
            self.finish(context, job)
        except BindposeError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        finally:
            job.end()
        return {"FINISHED"}


class OBJECT_OT_bindpose_weights(BindposeOperator, bpy.types.Operator):
    """Parent the selected meshes to the active armature with weights of Bindpose"""

    bl_idname = "object.bindpose_weights"
    bl_label = "With Bindpose Weights"

    influences: bpy.props.IntProperty(name="Influences", description="Largest number of bones per vertex. 0: all",
                                      default=0, min=0)
    mirror: bpy.props.BoolProperty(name="Mirror", default=False,
                                   description="Bones that are mirror images along x get mirrored weights")

    @classmethod
    def poll(cls, context):
        active = context.active_object
        return active is not None and active.type == "ARMATURE" and any(o.type == "MESH" for o in context.selected_objects)

    def start(self, context):
        self.armature = context.active_object
        self.things = [thing for thing in context.selected_objects if thing.type == "MESH"]
        self.bones, ends = deform_bones(self.armature)
        commands = []
        for index in range(len(self.things)):
            words = ["weights", f"{index}.off", "--handles", "bones.vtp", "-o", f"{index}.dmat"]
            words += ["--maximum-influences", str(self.influences)] if self.influences else []
            commands.append(words + (["--mirror", "x"] if self.mirror else []))
        job = Job(context, commands)
        try:
            write_bones(job.path("bones.vtp"), ends)
            self.shapes = []
            for index, thing in enumerate(self.things):
                points, polygons = shape_of(thing, context)
                self.shapes.append(points)
                write_off(job.path(f"{index}.off"), points, polygons)
        except BindposeError:
            job.end()
            raise
        return job

    def finish(self, context, job):
        for index, (thing, points) in enumerate(zip(self.things, self.shapes)):
            weights = to_vertices(read_dmat(job.path(f"{index}.dmat")), points,
                                  world_points(thing.data, thing.matrix_world))
            set_vertex_groups(thing, self.bones, weights)
            bind_armature(thing, self.armature)


class OBJECT_OT_bindpose_skeleton(BindposeOperator, bpy.types.Operator):
    """Make an armature along the curve skeleton of the active mesh"""

    bl_idname = "object.bindpose_skeleton"
    bl_label = "Skeleton from Shape"

    maximum_bones: bpy.props.IntProperty(name="Bones", description="Largest number of bones. 0: as many as the shape needs",
                                         default=0, min=0)

    @classmethod
    def poll(cls, context):
        return context.active_object is not None and context.active_object.type == "MESH"

    def start(self, context):
        self.thing = context.active_object
        points, polygons = shape_of(self.thing, context)
        job = Job(context, [["handles", "shape.off", "--maximum-bones", str(self.maximum_bones), "-o", "bones.tgf"]])
        write_off(job.path("shape.off"), points, polygons)
        return job

    def finish(self, context, job):
        points, bones = read_tgf(job.path("bones.tgf"))
        if not bones:
            raise BindposeError(f"the mesh '{self.thing.name}' has no curve skeleton with bones")
        make_armature(f"{self.thing.name} skeleton", points, bones, context)


class BindposePreferences(bpy.types.AddonPreferences):
    bl_idname = __name__

    program: bpy.props.StringProperty(name="Program", subtype="FILE_PATH", default="bindpose",
                                      description="Path of the program bindpose")

    def draw(self, _context):
        self.layout.prop(self, "program")


class VIEW3D_MT_bindpose(bpy.types.Menu):
    bl_label = "Bindpose"

    def draw(self, _context):
        self.layout.operator(OBJECT_OT_bindpose_skeleton.bl_idname)
        self.layout.operator(OBJECT_OT_bindpose_weights.bl_idname, text="Parent with Bindpose Weights")


CLASSES = (OBJECT_OT_bindpose_weights, OBJECT_OT_bindpose_skeleton, BindposePreferences, VIEW3D_MT_bindpose)


def draw_parent_entry(self, _context):
    self.layout.operator(OBJECT_OT_bindpose_weights.bl_idname)


def draw_menu(self, _context):
    self.layout.menu("VIEW3D_MT_bindpose")


def register():
    for each in CLASSES:
        bpy.utils.register_class(each)
    bpy.types.VIEW3D_MT_object_parent.append(draw_parent_entry)
    bpy.types.VIEW3D_MT_object.append(draw_menu)


def unregister():
    bpy.types.VIEW3D_MT_object.remove(draw_menu)
    bpy.types.VIEW3D_MT_object_parent.remove(draw_parent_entry)
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)


if __name__ == "__main__":
    register()
