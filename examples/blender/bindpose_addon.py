"""Bindpose in Blender: smooth bounded weights for an armature, and a skeleton from a shape.

Install it by *Edit > Preferences > Add-ons > Install*, and set the path of the program `bindpose` in the preferences of
the add-on. It adds to the 3D viewport, in Object Mode:

- *Object > Parent > Armature Deform With Bindpose Weights*, for the selected meshes and the active armature;
- *Bindpose > Skeleton from Shape*, for the active mesh.

The program runs in the background; Escape cancels it.
"""

import os
import re
import shutil
import subprocess
import tempfile
import threading

import bpy
import numpy as np
from mathutils import Vector, kdtree

bl_info = {
    "name": "Bindpose Weights",
    "author": "The Bindpose developers",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "3D View > Object > Parent, 3D View > Bindpose",
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
    such as Mirror and Solidify, and without shape keys."""
    for data in (thing, thing.data):
        if data.library:
            raise BindposeError(f"'{data.name}' is linked from another file; make it local first")
    ignored = [m for m in thing.modifiers if m.type in IGNORED_MODIFIERS and m.show_viewport]
    shows_basis = thing.show_only_shape_key
    key = thing.active_shape_key_index
    for modifier in ignored:
        modifier.show_viewport = False
    if thing.data.shape_keys:
        thing.show_only_shape_key = True
        thing.active_shape_key_index = 0
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
        if thing.data.shape_keys:
            thing.show_only_shape_key = shows_basis
            thing.active_shape_key_index = key
    if not polygons:
        raise BindposeError(f"the mesh '{thing.name}' has no faces")
    return points, polygons


def world_points(mesh, to_world):
    local = np.empty(3 * len(mesh.vertices))
    mesh.vertices.foreach_get("co", local)
    matrix = np.array(to_world)
    return (local.reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3]).tolist()


def deform_bones(armature):
    """Return the deforming bones with a length, and their ends at rest in world coordinates. Only the first of several
    bones with the same ends is used."""
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
    """Return the rows of weights of the mesh's own vertices. Most modifiers keep their number or keep them first; otherwise
    each vertex gets the row of the nearest point of the shape."""
    count = len(vertex_points)
    if count == len(shape_points):
        return weights
    size = size_of(shape_points)
    if count <= len(shape_points) and \
            np.abs(np.array(shape_points[:count]) - np.array(vertex_points)).max(initial=0) <= 1e-6 * size:
        return weights[:count]
    return weights[nearest(shape_points, vertex_points)]


def size_of(points):
    """Return the largest side of the bounding box."""
    return np.ptp(np.array(points), axis=0).max()


def mirrored(points, middle):
    """Return the mirror images of points at the plane x = middle."""
    return [Vector((2 * middle - point.x, point.y, point.z)) for point in points]


def nearest(points, queries):
    """Return for each query the index of the nearest point."""
    tree = kdtree.KDTree(len(points))
    for index, point in enumerate(points):
        tree.insert(point, index)
    tree.balance()
    return [tree.find(query)[1] for query in queries]


def free_rows(weights, points):
    """Return the rows of weights of the groups that are not locked, each with the sum one. A row of zeros is replaced by the
    row of the nearest point that has weights."""
    sums = weights.sum(axis=1)
    given = np.nonzero(sums > WEIGHT_THRESHOLD)[0]
    if len(given) == 0:
        return weights
    missing = np.nonzero(sums <= WEIGHT_THRESHOLD)[0]
    rows = weights.copy()
    rows[missing] = weights[given[nearest(points[given], points[missing])]] if len(missing) else 0
    return rows / rows.sum(axis=1)[:, None]


def mirrored_mean(weights, names, points):
    """Return the mean of the weights and of their mirror images along x. The weights of a bone are mirrored to the bone with
    the opposite name. Vertices without a mirror image, and vertices with weights of a bone on one side that has no opposite
    bone, keep their weights."""
    opposite = [bpy.utils.flip_name(name) for name in names]  # the same name for a bone without a side
    flipped = [names.index(other) if other in names else column for column, other in enumerate(opposite)]
    is_alone = [other not in names for other in opposite]
    if len(points) == 0:
        return weights
    opposite_points = mirrored(points, 0)
    images = np.array(nearest(points, opposite_points))
    tolerance = 1e-3 * size_of(points)
    has_image = np.array([(point - points[image]).length <= tolerance for point, image in zip(opposite_points, images)])
    moves_alone = weights[:, is_alone].sum(axis=1) > WEIGHT_THRESHOLD
    has_image &= ~(moves_alone | moves_alone[images])
    rows = weights.copy()
    rows[has_image] = (weights[has_image] + weights[images[has_image]][:, flipped]) / 2
    return rows


def largest_weights(weights, count):
    """Return rows with the `count` largest weights and the same sums. 0: all weights."""
    if count == 0 or count >= weights.shape[1]:
        return weights
    columns = np.argsort(-weights, axis=1, kind="stable")[:, :count]
    kept = np.zeros_like(weights)
    np.put_along_axis(kept, columns, np.take_along_axis(weights, columns, axis=1), axis=1)
    sums = kept.sum(axis=1)
    return kept * np.divide(weights.sum(axis=1), sums, out=np.zeros(len(sums)), where=sums > 0)[:, None]


def set_vertex_groups(thing, names, weights):
    """Store weights in the vertex groups of the bones. Locked groups keep their weights; the others share the rest."""
    groups = {name: thing.vertex_groups.get(name) or thing.vertex_groups.new(name=name) for name in names}
    locked = {group.index for group in thing.vertex_groups if group.lock_weight}
    bone_groups = {group.index for group in groups.values()}
    kept = np.array([sum(entry.weight for entry in vertex.groups if entry.group in locked & bone_groups)
                     for vertex in thing.data.vertices])
    free = [k for k, name in enumerate(names) if groups[name].index not in locked]
    points = np.array([vertex.co[:] for vertex in thing.data.vertices])
    rows = free_rows(weights[:, free], points) * np.clip(1 - kept, 0, 1)[:, None]
    for column, k in enumerate(free):
        group = groups[names[k]]
        group.remove(range(len(thing.data.vertices)))
        for vertex in np.nonzero(rows[:, column] > WEIGHT_THRESHOLD)[0]:
            group.add([int(vertex)], float(rows[vertex, column]), "REPLACE")


def bind_armature(thing, armature):
    """Make the armature the parent of the mesh, with a modifier, and keep the position of the mesh."""
    world_matrix = thing.matrix_world.copy()
    thing.parent = armature
    thing.parent_type = "OBJECT"
    thing.matrix_world = world_matrix
    if not any(m.type == "ARMATURE" and m.object == armature for m in thing.modifiers):
        modifier = thing.modifiers.new("Armature", "ARMATURE")
        modifier.object = armature


def mirror_images(points, middle):
    """Return for each point the index of its mirror image at the plane x = middle, or None. Points that are almost mirror
    images are moved, so that they are exact."""
    tolerance = 0.03 * size_of(points)
    opposite_points = mirrored(points, middle)
    neighbors = nearest(points, opposite_points)
    images = [other if neighbors[other] == index and (opposite_points[index] - points[other]).length <= tolerance else None
              for index, other in enumerate(neighbors)]
    for index, other in enumerate(images):
        if other is not None and index <= other:
            points[index] = (points[index] + opposite_points[other]) / 2
            points[other] = mirrored([points[index]], middle)[0]
    return images


def bone_names(points, bones, images):
    """Return names of bones. Two bones that are mirror images get the same name with the ends .L and .R, which Blender's
    tools for symmetric poses expect."""
    indices = {frozenset(ends): index for index, ends in enumerate(bones)}
    names = [""] * len(bones)
    for index, ends in enumerate(bones):
        other = indices.get(frozenset(images[end] for end in ends), index)
        if other == index:
            names[index] = f"Bone.{index + 1:03}"
        elif index < other:
            is_left = sum(points[end].x for end in ends) > sum(points[end].x for end in bones[other])
            names[index], names[other] = (f"Bone.{index + 1:03}.{side}" for side in ("LR" if is_left else "RL"))
    return names


def make_armature(name, points, bones, middle, context):
    """Make an armature of bones between points. A bone that begins where another ends is its child. The armature is at the
    mirror plane x = middle."""
    data = bpy.data.armatures.new(name)
    armature = bpy.data.objects.new(name, data)
    armature.location.x = middle
    context.collection.objects.link(armature)
    for thing in context.selected_objects:
        thing.select_set(False)
    armature.select_set(True)
    context.view_layer.objects.active = armature
    bpy.ops.object.mode_set(mode="EDIT")
    ending = {}
    to_local = Vector((-middle, 0, 0))
    images = mirror_images(points, middle)
    for (head, tail), bone_name in zip(bones, bone_names(points, bones, images)):
        bone = data.edit_bones.new(bone_name)
        bone.head, bone.tail = points[head] + to_local, points[tail] + to_local
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
    """Return the path in the preferences. An empty path, or a name without a folder, is searched in the PATH."""
    addon = context.preferences.addons.get(__name__)
    path = (addon.preferences.program.strip() if addon else "") or "bindpose"
    found = shutil.which(bpy.path.abspath(path))
    if not found:
        raise BindposeError(f"the program '{path}' is not found; set its path in the preferences of the add-on")
    return os.path.abspath(found)


def object_named(name):
    """Return an object that may have been deleted since the program was started."""
    thing = bpy.data.objects.get(name)
    if thing is None:
        raise BindposeError(f"the object '{name}' is gone")
    return thing


class Job:
    """Runs of the program, one after the other, in a temporary folder."""

    def __init__(self, context, commands):
        self.program = program_path(context)
        self.folder = tempfile.TemporaryDirectory(prefix="bindpose-")
        self.commands = [list(words) for words in commands]
        self.count = len(self.commands)
        self.process = None
        self.reader = None  # the thread that reads the messages of the process
        self.messages = []
        self.percent = 0

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def result(self, name):
        """Return the path of a file that the program has written."""
        path = self.path(name)
        if not os.path.exists(path):
            raise BindposeError(f"'{self.program}' has not written a result; set the path of bindpose in the preferences of the "
                                "add-on")
        return path

    def poll(self):
        """Start the next command if none runs. Return True if all commands are done; raise BindposeError for an error."""
        if self.process:
            code = self.process.poll()
            if code is None:
                return False
            self.reader.join()
            self.process = None
            if code not in (0, 3):  # 3: not converged, the result is written
                message = self.messages[-1] if self.messages else f"the program ended with code {code}"
                raise BindposeError(message.split(": ", 1)[-1])
        if not self.commands:
            return True
        self.percent, self.messages = 0, []
        self.process = subprocess.Popen([self.program, *self.commands.pop(0), "--progress", "lines"], cwd=self.folder.name,
                                        text=True, encoding="utf-8", errors="replace", stdout=subprocess.DEVNULL,
                                        stderr=subprocess.PIPE)
        self.reader = threading.Thread(target=self.read_messages, args=(self.process.stderr,), daemon=True)
        self.reader.start()
        return False

    def read_messages(self, stream):
        for line in stream:
            step = re.match(r"progress (\d+) %", line)
            if step:
                self.percent = int(step[1])
            elif line.strip():
                self.messages.append(line.strip())

    def progress(self):
        """Return the finished fraction of all commands."""
        done = self.count - len(self.commands) - (self.process is not None)
        return (done + (self.percent / 100 if self.process else 0)) / self.count

    def end(self):
        if self.process:
            self.process.terminate()
            self.process.wait()
        self.folder.cleanup()


class BindposeOperator:
    """An operator that runs the program without blocking the window."""

    bl_options = {"UNDO"}
    interactive = False
    job = None

    def invoke(self, context, _event):
        """Ask for the options. Blender then calls `execute`."""
        self.interactive = True
        return context.window_manager.invoke_props_dialog(self)

    def execute(self, context):
        return self.run_in_background(context) if self.interactive else self.run_to_the_end(context)

    def run_in_background(self, context):
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
        if event.type == "ESC" and event.value == "PRESS":
            self.cancel(context)
            self.report({"INFO"}, "canceled")
            return {"CANCELLED"}
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        runs, done = False, False
        try:
            context.window_manager.progress_update(100 * self.job.progress())
            runs = not self.job.poll()
            if not runs:
                self.finish_in_object_mode(context, self.job)
                done = True
        except (BindposeError, RuntimeError, ReferenceError, OSError) as error:
            self.report({"ERROR"}, str(error))
        finally:  # also after an error that is not expected
            if not runs:
                self.cancel(context)
        return {"PASS_THROUGH"} if runs else {"FINISHED"} if done else {"CANCELLED"}

    def cancel(self, context):
        """End the program. Blender also calls this method when it ends the operator, for example to load a file, and when the
        user closes the dialog."""
        if self.job is None:
            return
        self.job.end()
        context.window_manager.event_timer_remove(self.timer)
        context.window_manager.progress_end()

    def run_to_the_end(self, context):
        """Run without a window, for scripts."""
        try:
            job = self.start(context)
        except BindposeError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        try:
            while not job.poll():
                if job.process:
                    job.process.wait()
            self.finish_in_object_mode(context, job)
        except (BindposeError, RuntimeError, OSError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        finally:
            job.end()
        return {"FINISHED"}

    def finish_in_object_mode(self, context, job):
        if context.mode != "OBJECT":
            raise BindposeError("the result can only be used in Object Mode; run the command again")
        self.finish(context, job)

    @staticmethod
    def start_job(context, commands, write_inputs):
        """Return a job after `write_inputs(job)` has written its input files."""
        job = Job(context, commands)
        try:
            write_inputs(job)
        except (BindposeError, OSError) as error:
            job.end()
            raise BindposeError(str(error)) from None
        return job


class OBJECT_OT_bindpose_weights(BindposeOperator, bpy.types.Operator):
    """Parent the selected meshes to the active armature with weights of Bindpose"""

    bl_idname = "object.bindpose_weights"
    bl_label = "Armature Deform With Bindpose Weights"

    influences: bpy.props.IntProperty(  # type: ignore[valid-type]
        name="Influences", description="Largest number of bones per vertex. 0: all", default=0, min=0)
    mirror: bpy.props.BoolProperty(  # type: ignore[valid-type]
        name="Mirror", default=False,
        description="Bones with symmetric names, such as arm.L and arm.R, get weights that are mirror images along x. Always on "
                    "for meshes whose symmetry along x is on")

    @classmethod
    def poll(cls, context):
        active = context.active_object
        return (context.mode == "OBJECT" and active is not None and active.type == "ARMATURE" and
                any(o.type == "MESH" for o in context.selected_objects))

    def start(self, context):
        self.armature = context.active_object.name
        things = [thing for thing in context.selected_objects if thing.type == "MESH"]
        shared = next((thing for thing in things if thing.data.users > 1), None)
        if shared:
            raise BindposeError(f"other objects use the mesh of '{shared.name}', too; make it a single user first")
        self.things = [thing.name for thing in things]
        self.bones, ends = deform_bones(context.active_object)
        self.shapes = []
        commands = []
        for index in range(len(things)):
            words = ["weights", f"{index}.off", "--handles", "bones.vtp", "-o", f"{index}.dmat"]
            words += ["--maximum-influences", str(self.influences)] if self.influences else []
            commands.append(words)

        def write_inputs(job):
            write_bones(job.path("bones.vtp"), ends)
            for index, thing in enumerate(things):
                points, polygons = shape_of(thing, context)
                self.shapes.append(points)
                write_off(job.path(f"{index}.off"), points, polygons)

        return self.start_job(context, commands, write_inputs)

    def finish(self, _context, job):
        armature = object_named(self.armature)
        for index, (name, points) in enumerate(zip(self.things, self.shapes)):
            thing = object_named(name)
            weights = to_vertices(read_dmat(job.result(f"{index}.dmat")), points,
                                  world_points(thing.data, thing.matrix_world))
            if len(weights) != len(thing.data.vertices):
                raise BindposeError(f"the mesh '{name}' has changed; run the command again")
            if self.mirror or thing.data.use_mirror_x:
                weights = mirrored_mean(weights, self.bones, [vertex.co for vertex in thing.data.vertices])
                weights = largest_weights(weights, self.influences)
            set_vertex_groups(thing, self.bones, weights)
            bind_armature(thing, armature)


class OBJECT_OT_bindpose_skeleton(BindposeOperator, bpy.types.Operator):
    """Make an armature along the curve skeleton of the active mesh"""

    bl_idname = "object.bindpose_skeleton"
    bl_label = "Skeleton from Shape"

    maximum_bones: bpy.props.IntProperty(  # type: ignore[valid-type]
        name="Bones", description="Largest number of bones. 0: as many as the shape needs", default=0, min=0)

    @classmethod
    def poll(cls, context):
        return context.mode == "OBJECT" and context.active_object is not None and context.active_object.type == "MESH"

    def start(self, context):
        thing = context.active_object
        self.mesh_name = thing.name

        def write_inputs(job):
            points, polygons = shape_of(thing, context)
            coordinates = [point[0] for point in points]
            self.middle = (min(coordinates) + max(coordinates)) / 2
            write_off(job.path("shape.off"), points, polygons)

        return self.start_job(
            context, [["handles", "shape.off", "--maximum-bones", str(self.maximum_bones), "-o", "bones.tgf"]], write_inputs)

    def finish(self, context, job):
        points, bones = read_tgf(job.result("bones.tgf"))
        if not bones:
            raise BindposeError(f"the mesh '{self.mesh_name}' has no curve skeleton with bones")
        make_armature(f"{self.mesh_name} skeleton", points, bones, self.middle, context)


class BindposePreferences(bpy.types.AddonPreferences):
    bl_idname = __name__

    program: bpy.props.StringProperty(  # type: ignore[valid-type]
        name="Program", subtype="FILE_PATH", default="",
        description="Path of the program bindpose. Empty: the program is searched in the PATH")

    def draw(self, _context):
        self.layout.prop(self, "program")


class VIEW3D_MT_bindpose(bpy.types.Menu):
    bl_label = "Bindpose"

    def draw(self, _context):
        draw_operators(self.layout, OBJECT_OT_bindpose_skeleton, OBJECT_OT_bindpose_weights)


CLASSES = (OBJECT_OT_bindpose_weights, OBJECT_OT_bindpose_skeleton, BindposePreferences, VIEW3D_MT_bindpose)


def draw_operators(layout, *operators):
    """Draw menu entries that open the dialogs of operators. Without `operator_context`, a menu that a shortcut opens calls the
    operators without a dialog, and Blender is blocked until they end."""
    layout.operator_context = "INVOKE_DEFAULT"
    for operator in operators:
        layout.operator(operator.bl_idname)


def draw_parent_entry(self, _context):
    """Draw the last entry of *Object > Parent*. An add-on cannot add it to the group *Armature Deform*, because Blender draws
    this group as one list, nor to the popup of Ctrl-P, which Blender draws in C."""
    self.layout.separator()
    draw_operators(self.layout, OBJECT_OT_bindpose_weights)


def draw_header_menu(self, context):
    if context.mode == "OBJECT":
        self.layout.menu(VIEW3D_MT_bindpose.__name__)


def register():
    for each in CLASSES:
        bpy.utils.register_class(each)
    bpy.types.VIEW3D_MT_object_parent.append(draw_parent_entry)
    bpy.types.VIEW3D_MT_editor_menus.append(draw_header_menu)


def unregister():
    bpy.types.VIEW3D_MT_editor_menus.remove(draw_header_menu)
    bpy.types.VIEW3D_MT_object_parent.remove(draw_parent_entry)
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)


if __name__ == "__main__":
    register()
