"""Install the add-on in Blender as a user does: addon_installed.py -- ADDON.py PROGRAM RESULT.json.

The script installs and enables the add-on, uses it with several paths in its preferences, disables it, and writes what it found.
"""

import json
import os
import pathlib
import sys

import bpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from addon_in_blender import add_armature, add_mesh, bar, select  # noqa: E402

NAME = "bindpose_addon"


def menu_entries():
    """Return the names of the functions by which the add-on draws in Blender's menus."""
    return {menu: [function.__name__ for function in getattr(bpy.types, menu).draw._draw_funcs
                   if function.__module__ == NAME]
            for menu in ("VIEW3D_MT_object_parent", "VIEW3D_MT_editor_menus")}


def operators():
    return sorted(name for name in dir(bpy.ops.object) if name.startswith("bindpose"))


def error_of_bind(path, search_path):
    """Bind a mesh with a path in the preferences and a value of PATH. Return the error, or an empty text."""
    bpy.context.preferences.addons[NAME].preferences.program = path
    os.environ["PATH"] = search_path
    thing = add_mesh("bar", *bar(rings=8))
    select(thing, bpy.data.objects["rig"])
    try:
        bpy.ops.object.bindpose_weights()
        error = ""
    except RuntimeError as failure:
        error = str(failure).strip().removeprefix("Error: ")
    is_bound = thing.parent is not None and len(thing.vertex_groups) == 2
    is_unchanged = thing.parent is None and len(thing.vertex_groups) == 0
    assert is_unchanged if error else is_bound
    return error


def main():
    addon, program, result = sys.argv[sys.argv.index("--") + 1:]
    bpy.ops.preferences.addon_install(filepath=addon)
    bpy.ops.preferences.addon_enable(module=NAME)
    preferences = bpy.context.preferences.addons[NAME].preferences
    found = {"file": sys.modules[NAME].__file__, "program": preferences.program, "menus": menu_entries(), "operators": operators()}
    add_armature()
    folder = os.path.dirname(program)
    found["runs"] = {
        "path": error_of_bind(program, "/none"), "missing": error_of_bind("/none/bindpose", folder),
        "folder": error_of_bind("/usr", folder), "other program": error_of_bind("/bin/true", folder),
        "empty, in PATH": error_of_bind("", folder), "empty, not in PATH": error_of_bind("", "/none"),
        "name, in PATH": error_of_bind("bindpose", folder)}
    bpy.ops.preferences.addon_disable(module=NAME)
    found["without"] = {"menus": menu_entries(), "operators": operators(),
                        "preferences": NAME in bpy.context.preferences.addons}
    with open(result, "w", encoding="utf-8") as file:
        json.dump(found, file)


if __name__ == "__main__":
    main()
