"""Operate ParaView's window with mouse and keys, for tests/paraview.sh: window.py PARAVIEW LIBRARY FOLDER.

PARAVIEW is the folder usr of the unpacked ParaView. The window runs under a window manager on a display of its own.
in_window.py runs inside of it: it builds the pipelines and answers questions about them.
"""

import json
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import sys
import time

import numpy as np
import plugin

TESTS = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(TESTS / "support"))
from desktop import Desktop, wait_for  # noqa: E402

DATA = TESTS.parent / "examples" / "tours" / "data"
SETTINGS = {"settings": {"GeneralSettings": {"ShowWelcomeDialog": 0, "AutoApply": 0}}}
WINDOW_SETTINGS = "[General]\nGeneralSettings.ShowWelcomeDialog=false\n"


class Window:
    """ParaView with the plugin, and a pipeline that in_window.py builds or loads."""

    def __init__(self, paraview, library, folder, name, state="", subdivisions=0, size=(1580, 1160)):
        self.folder = folder / name
        shutil.rmtree(self.folder, ignore_errors=True)
        settings = self.folder / ".config" / "ParaView"
        settings.mkdir(parents=True)
        (settings / "ParaView-UserSettings.json").write_text(json.dumps(SETTINGS))
        (settings / "ParaView5.11.0.ini").write_text(WINDOW_SETTINGS)
        self.requests = 0
        self.desktop = Desktop(self.folder, "1600x1200x24")
        try:
            self.start(paraview, library, state, subdivisions, size)
        except BaseException:
            self.desktop.end()
            raise

    def start(self, paraview, library, state, subdivisions, size):
        environment = {**variables(paraview), "BINDPOSE_PLUGIN": str(library), "BINDPOSE_FOLDER": str(self.folder),
                       "BINDPOSE_DATA": str(DATA), "BINDPOSE_STATE": str(state), "BINDPOSE_SUBDIVISIONS": str(subdivisions)}
        self.log = self.folder / "log.txt"
        with open(self.log, "wb") as log:
            self.process = self.desktop.start(
                "env", *(f"{key}={value}" for key, value in environment.items()), paraview / "bin" / "paraview",
                f"--script={TESTS / 'paraview' / 'in_window.py'}", stdout=log, stderr=log)
        self.id = self.desktop.wait_for_window("ParaView")
        self.ask("names()")
        self.desktop.tool("windowmove", self.id, 0, 0)
        self.desktop.tool("windowsize", self.id, *size)
        self.desktop.activate(self.id)
        self.offset = self.find_view()

    def __enter__(self):
        return self

    def __exit__(self, kind, *_):
        if kind:
            print(self.log.read_text(errors="replace")[-4000:], file=sys.stderr)
        self.desktop.end()

    def ask(self, code):
        """Return the value of a Python expression inside of ParaView."""
        self.requests += 1
        path = self.folder / "request.new"
        path.write_text(json.dumps({"id": self.requests, "code": code}))
        path.replace(self.folder / "request.json")

        def answer():
            try:
                found = json.loads((self.folder / "answer.json").read_text())
            except (FileNotFoundError, ValueError):
                return None
            return found if found["id"] == self.requests else None

        found = self.desktop.wait_for(answer, code)
        assert "error" not in found, found["error"]
        return found["value"]

    def find_view(self):
        """Return the screen position of the view's lower left corner: move the mouse over the view and ask for its position
        there.
        """
        for x, y in ((1200, 600), (1000, 500), (1300, 800), (800, 500)):
            self.desktop.tool("mousemove", x - 3, y - 3)
            time.sleep(0.2)
            self.desktop.tool("mousemove", x, y)
            time.sleep(0.3)
            view_x, view_y, width, height = self.ask("mouse()")
            if 0 < view_x < width and 0 < view_y < height:
                return x - view_x, y + view_y
        raise AssertionError("the render view was not found")

    def screen(self, pixel):
        return round(self.offset[0] + pixel[0]), round(self.offset[1] - pixel[1])

    def move(self, pixel):
        self.desktop.tool("mousemove", *self.screen(pixel))
        time.sleep(0.05)

    def click(self, pixel):
        self.move(pixel)
        self.desktop.tool("mousedown", 1)
        time.sleep(0.05)
        self.desktop.tool("mouseup", 1)
        time.sleep(0.1)

    def drag(self, pixel, motion, steps=10):
        """Press the left button on a pixel, move the mouse in steps, and release the button."""
        self.move((pixel[0] - 2, pixel[1]))
        self.move(pixel)
        self.desktop.tool("mousedown", 1)
        for step in range(1, steps + 1):
            self.move((pixel[0] + motion[0] * step / steps, pixel[1] + motion[1] * step / steps))
        self.desktop.tool("mouseup", 1)
        time.sleep(0.2)

    def drag_handle(self, name, motion, steps=10):
        self.drag(self.ask(f"pixel(handle_position({name!r}))"), motion, steps)

    def keys(self, *keys):
        self.desktop.activate(self.id)
        self.desktop.keys(*keys)
        time.sleep(0.3)

    def errors(self):
        """Return the lines of the log with an error."""
        return [line for line in self.log.read_text(errors="replace").splitlines() if re.search(r"\bERR\||ERROR:", line)]


def variables(paraview):
    library = next((paraview / "lib").glob("*-linux-gnu"))
    return {"PATH": f"{paraview / 'bin'}:{os.environ['PATH']}", "LD_LIBRARY_PATH": str(library),
            "PYTHONPATH": str(paraview / "lib" / "python3" / "dist-packages")}


def batch(paraview, *words):
    subprocess.run(["pvbatch", *map(str, words)], env={**os.environ, **variables(paraview)}, check=True, timeout=600)


def check_a_drag(open_window, paraview, library, folder):
    """A drag poses the shape: one undo step, one line of the trace, no bind, and a state with the same mesh in pvbatch."""
    state = folder / "posed.pvsm"
    with open_window("drag") as window:
        before = window.ask("handle_position('left_hand')")
        binds = window.ask("binds()")
        window.ask("start_trace()")
        window.drag_handle("left_hand", (60, 80))
        trace = window.ask("stop_trace()")
        text = window.ask("pose_text()")
        assert "left_hand" in text and "right_hand" not in text, text
        moved = np.subtract(window.ask("handle_position('left_hand')"), before)
        assert np.linalg.norm(moved) > 0.1 and moved[0] > 0 and moved[1] > 0, moved
        assert window.ask("binds()") == binds, "a drag must not bind again"
        assert trace.count("PoseJSON") == 1, trace
        milliseconds = window.ask("drag_milliseconds()")
        assert len(milliseconds) >= 5, milliseconds
        window.ask(f"save_points({str(folder / 'posed.npy')!r})")
        window.ask(f"save_state({str(state)!r})")
        # One undo step reverts the whole drag.
        window.keys("ctrl+z")
        assert window.ask("pose_text()") == ""
        assert np.allclose(window.ask("handle_position('left_hand')"), before, atol=1e-12)
        window.keys("ctrl+y")
        assert window.ask("pose_text()") == text
        # Escape cancels a drag: neither the pose nor the undo stack changes.
        pixel = window.ask("pixel(handle_position('head'))")
        window.move(pixel)
        window.desktop.tool("mousedown", 1)
        window.move((pixel[0] + 30, pixel[1] + 20))
        # Press Escape without keys(), which uses xdotool's option --clearmodifiers. This option would release the mouse
        # button.
        window.desktop.tool("key", "Escape")
        window.desktop.wait_for(lambda: window.ask("pose_text()") == text, "the end of the drag")
        window.desktop.tool("mouseup", 1)
        assert window.ask("pose_text()") == text
        window.keys("ctrl+z")
        assert window.ask("pose_text()") == ""
        window.ask(f"picture({str(folder / 'drag.png')!r})")
        assert not window.errors(), window.errors()
    batch(paraview, TESTS / "paraview" / "posed_state.py", library, state, folder / "batch.npy")
    difference = np.abs(np.load(folder / "posed.npy") - np.load(folder / "batch.npy")).max()
    assert difference <= 1e-12, difference
    print(f"a drag in the window: one undo step, one line of the trace; pvbatch differs by {difference:.1e}")
    return state


def check_a_state(open_window, state, folder):
    """A state brings the pose back, and the widget continues from it. Deleting inputs under the widget is harmless."""
    with open_window("state", state) as window:
        posed = window.ask("handle_position('left_hand')")
        assert "left_hand" in window.ask("pose_text()")
        window.drag_handle("left_hand", (-40, -60))
        assert np.linalg.norm(np.subtract(window.ask("handle_position('left_hand')"), posed)) > 0.05
        window.ask("delete('handles')")
        window.drag_handle("left_hand", (10, 10))
        for name in ("bent", "pose", "weights"):
            window.ask(f"delete({name!r})")
        for name in window.ask("names()"):  # only the reader is left; it is named after its file
            window.ask(f"delete({name!r})")
        window.move((200, 200))
        window.move((220, 220))
        assert window.ask("names()") == []
    moved = folder / "moved.pvsm"
    moved.write_text(state.read_text().replace(str(DATA), str(folder / "nowhere")))
    with open_window("moved", moved) as window:
        assert "left_hand" in window.ask("pose_text()")
        window.move((200, 200))
        errors = window.errors()
        assert any("figure.off" in line for line in errors), errors
    print("a state brings the pose back; deleted inputs and moved files cause messages only")


def check_speed(open_window):
    """While a mesh of 99,456 triangles is dragged, drawing begins soon after each motion of the mouse."""
    with open_window("speed", subdivisions=3) as window:
        window.drag_handle("left_hand", (60, 80), steps=30)
        milliseconds = window.ask("drag_milliseconds()")
        assert "left_hand" in window.ask("pose_text()")
    median = statistics.median(milliseconds)
    print(f"a motion of a drag on 99,456 triangles: {median:.1f} ms before drawing "
          f"(median of {len(milliseconds)}, largest {max(milliseconds):.1f} ms)")
    assert median <= plugin.DRAG_LIMIT, median


def check_placing(open_window, folder):
    """Points are placed by clicks inside of the shape, and moved after Escape."""
    with open_window("placing") as window:
        window.ask("add_placed()")
        window.click(window.ask("pixel([0, 0.84, 0])"))
        window.click(window.ask("pixel([0, 0.2, 0])"))
        lines = window.ask("placed_text()").splitlines()
        points = [[float(word) for word in line.split()[1:4]] for line in lines[:lines.index("#")]]
        assert len(points) == 2, lines
        # The front and back sides of the shape have opposite z, so the middle is at z = 0.
        assert np.allclose(points, [[0, 0.84, 0], [0, 0.2, 0]], atol=0.05), points
        window.keys("Escape")
        window.drag(window.ask("pixel([0, 0.2, 0])"), (0, -40))
        moved = window.ask("placed_text()").splitlines()
        assert moved[0] == lines[0] and moved[1] != lines[1], moved
        window.keys("ctrl+z")
        assert window.ask("placed_text()").splitlines() == lines
        window.keys("ctrl+z")
        assert len(window.ask("placed_text()").splitlines()) == 2  # one point and the line "#"
        window.ask(f"picture({str(folder / 'placing.png')!r})")
        assert not window.errors(), window.errors()
    print("Placed Handles: placed, moved and taken back in the window")


def check_bend_this_surface(open_window, folder):
    """The action of the menu Tools builds the chain as one undo step, or says why it cannot."""
    with open_window("bend", "none") as window:
        window.keys("alt+t", "b")
        window.desktop.wait_for_window("^Bend This Surface$")
        window.desktop.keys("Escape")
        wait_for(lambda: not window.desktop.window("^Bend This Surface$"), "the end of the message")
        window.ask("show_figure()")
        window.ask("start_trace()")
        window.keys("alt+t", "b")
        window.desktop.wait_for(lambda: len(window.ask("names()")) == 5, "the chain")
        trace = window.ask("stop_trace()")
        for name in ("AutomaticHandles", "BoundedBiharmonicWeights", "PoseHandles", "ReducedARAP"):
            assert f"{name}(" in trace, trace
        window.keys("ctrl+z")
        window.desktop.wait_for(lambda: window.ask("names()") == ["figure"], "the surface alone after one undo step")
        window.keys("ctrl+y")
        window.desktop.wait_for(lambda: len(window.ask("names()")) == 5, "the chain again")
        window.ask(f"picture({str(folder / 'bend.png')!r})")
        assert not window.errors(), window.errors()
    print("Bend This Surface: one undo step, traced; a message without a surface")


def main():
    paraview, library, folder = (pathlib.Path(word).resolve() for word in sys.argv[1:4])
    folder.mkdir(parents=True, exist_ok=True)

    def open_window(name, state="", subdivisions=0):
        return Window(paraview, library, folder, name, state, subdivisions)

    state = check_a_drag(open_window, paraview, library, folder)
    check_a_state(open_window, state, folder)
    check_speed(open_window)
    check_placing(open_window, folder)
    check_bend_this_surface(open_window, folder)


if __name__ == "__main__":
    main()
