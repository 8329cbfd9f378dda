"""Use the add-on in Blender's window: addon_in_window.py -- ADDON.py PROGRAM RESULT.json.

The script runs in Blender with the option --enable-event-simulate. It selects the entries of the add-on in the menus of the 3D
viewport, confirms the dialogs of the operators with the Enter key, and waits for the weights and the skeleton. It cancels
another run with Escape, and writes what it found.
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


def simulate(event, value):
    """Simulate an event of the keyboard or the mouse. The pointer is in the middle of the window."""
    window = bpy.context.window_manager.windows[0]
    window.event_simulate(type=event, value=value, x=window.width // 2, y=window.height // 2)


def press(key):
    for value in ("PRESS", "RELEASE"):
        simulate(key, value)


def press_enter_until(condition):
    """Press the Enter key until a condition is true, at most ten times. Menus ignore the key shortly after they open.
    After each press, wait up to five seconds, because a second press would also end the dialog that the first opens."""
    for _ in range(10):
        if condition():
            break
        press("RET")
        for _ in range(50):
            if condition():
                break
            yield


def wait_until(condition):
    """Wait until a condition is true, at most 60 seconds."""
    end = time.monotonic() + 60
    while not condition() and time.monotonic() < end:
        yield


def select_in_menu(name, *keys):
    """Open a menu at the pointer and press keys."""
    simulate("MOUSEMOVE", "NOTHING")
    yield
    with window_context():
        bpy.ops.wm.call_menu(name=name)
    yield 1
    for key in keys:
        press(key)
        yield 1


class Proxy:
    """An object with some of its attributes replaced."""

    def __init__(self, thing, **replaced):
        self.__dict__.update(replaced, thing=thing)

    def __getattr__(self, name):
        return getattr(self.thing, name)


def record_progress(addon, values):
    """Record the values that the operators report to Blender's window manager."""
    modal = addon.BindposeOperator.modal

    def recording_modal(self, context, event):
        manager = context.window_manager

        def update(value):
            values.append(value)
            manager.progress_update(value)

        return modal(self, Proxy(context, window_manager=Proxy(manager, progress_update=update)), event)

    addon.BindposeOperator.modal = recording_modal


def steps(addon, program, found):
    """Do the steps of the test. Blender's event loop runs at each `yield`, for 0.1 seconds or the seconds that follow it."""
    addon = load_addon(addon, program)
    jobs = []  # all jobs that were started
    dialogs = []  # the names of the operators whose dialogs were opened
    make, invoke = addon.Job.__init__, addon.BindposeOperator.invoke

    def recording_make(job, *words):
        make(job, *words)
        jobs.append(job)

    def recording_invoke(self, context, event):
        dialogs.append(self.bl_idname)
        return invoke(self, context, event)

    addon.Job.__init__, addon.BindposeOperator.invoke = recording_make, recording_invoke
    found["progress"] = []
    record_progress(addon, found["progress"])

    # The last entry of this menu is the add-on's.
    thing = add_mesh("bar", *bar())
    with window_context():
        armature = add_armature()
        select(thing, armature)
    yield from select_in_menu("VIEW3D_MT_object_parent", "END")
    yield from press_enter_until(lambda: dialogs)
    found["before_enter"] = len(jobs)
    yield from press_enter_until(lambda: jobs)
    yield from wait_until(lambda: thing.vertex_groups)
    found["weights"] = weights_of(thing)
    found["parent"] = thing.parent.name if thing.parent else None
    found["folder_is_gone"] = not pathlib.Path(jobs[0].folder.name).exists()

    # The last menu of the header is the add-on's. Its first entry makes a skeleton.
    with window_context():
        select(thing)
    yield from select_in_menu("VIEW3D_MT_editor_menus", "END", "RIGHT_ARROW")
    yield from press_enter_until(lambda: len(dialogs) == 2)
    yield from press_enter_until(lambda: len(jobs) == 2)
    yield from wait_until(lambda: "bar skeleton" in bpy.data.objects)
    found["skeleton"] = "bar skeleton" in bpy.data.objects
    found["dialogs"] = dialogs[:]

    # Escape closes the dialog.
    with window_context():
        thing.vertex_groups.clear()
        select(thing, armature)
        bpy.ops.object.bindpose_weights("INVOKE_DEFAULT")
    yield 1
    press("ESC")
    yield 1
    found["after_escape"] = len(jobs) - 2

    # Escape cancels the program.
    with window_context():
        bpy.ops.object.bindpose_weights("INVOKE_DEFAULT")
    yield
    press("RET")
    end = time.monotonic() + 60
    while (len(jobs) < 3 or jobs[2].process is None) and time.monotonic() < end:
        yield 0.01
    process = jobs[2].process
    press("ESC")
    for _ in range(20):
        yield
    found["canceled"] = process.poll() is not None and process.returncode != 0 and len(thing.vertex_groups) == 0


def main():
    addon, program, result = sys.argv[sys.argv.index("--") + 1:]
    found = {}
    bpy.context.preferences.view.show_splash = False  # the splash screen would receive the first events
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
