"""Use the add-on in Blender's window: addon_in_window.py -- ADDON.py PROGRAM RESULT.json.

The script runs in Blender with the option --enable-event-simulate. It confirms the dialog of the operator with the Enter key,
waits for the weights, cancels a second run with Escape, and writes what it found.
"""

import json
import pathlib
import sys
import time
import traceback

import bpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from addon_in_blender import add_armature, add_mesh, bar, load_addon, select, weights_of  # noqa: E402


def window_context():
    window = bpy.context.window_manager.windows[0]
    area = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    region = next(region for region in area.regions if region.type == "WINDOW")
    return bpy.context.temp_override(window=window, area=area, region=region)


def press(key):
    window = bpy.context.window_manager.windows[0]
    for value in ("PRESS", "RELEASE"):
        window.event_simulate(type=key, value=value, x=window.width // 2, y=window.height // 2)


def steps(addon, program, found):
    """Do the steps of the test. Blender's event loop runs at each `yield`, for 0.1 seconds or the seconds that follow it."""
    addon = load_addon(addon, program)
    jobs = []  # all jobs that were started
    make = addon.Job.__init__

    def remember(job, *words):
        make(job, *words)
        jobs.append(job)

    addon.Job.__init__ = remember
    thing = add_mesh("bar", *bar())
    with window_context():
        armature = add_armature()
        select(thing, armature)
        bpy.ops.object.bindpose_weights("INVOKE_DEFAULT")
    yield
    found["before_enter"] = len(jobs)
    press("RET")
    end = time.monotonic() + 60
    while not thing.vertex_groups and time.monotonic() < end:
        yield
    found["weights"] = weights_of(thing)
    found["parent"] = thing.parent.name if thing.parent else None
    found["folder_is_gone"] = not pathlib.Path(jobs[0].folder.name).exists()

    with window_context():
        thing.vertex_groups.clear()
        select(thing, armature)
        bpy.ops.object.bindpose_weights("INVOKE_DEFAULT")
    yield
    press("RET")
    end = time.monotonic() + 60
    while (len(jobs) < 2 or jobs[1].process is None) and time.monotonic() < end:
        yield 0.01
    process = jobs[1].process
    press("ESC")
    for _ in range(20):
        yield
    found["canceled"] = process.poll() is not None and process.returncode != 0 and len(thing.vertex_groups) == 0


def main():
    addon, program, result = sys.argv[sys.argv.index("--") + 1:]
    found = {}
    work = steps(addon, program, found)

    def next_step():
        try:
            return next(work) or 0.1
        except StopIteration:
            pass
        except BaseException:  # pylint: disable=broad-except
            found["error"] = traceback.format_exc()
        with open(result, "w", encoding="utf-8") as file:
            json.dump(found, file)
        bpy.ops.wm.quit_blender()
        return None

    bpy.app.timers.register(next_step, first_interval=1.0)


if __name__ == "__main__":
    main()
