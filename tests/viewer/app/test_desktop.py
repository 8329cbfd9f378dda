"""The window under a window manager, among other windows. Keys, menus, dialogs and the mouse are operated through the X
server, as by a user. The tests read the results from saved sessions.
"""

import json
import os
import pathlib
import signal
import sys
import time

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "support"))
from desktop import Desktop as EmptyDesktop  # noqa: E402

PROGRAM = os.environ["BINDPOSE_PROGRAM"]
DATA = pathlib.Path(__file__).resolve().parents[3] / "examples" / "tours" / "data"


class Desktop(EmptyDesktop):
    """A desktop on which Bindpose is started."""

    def __init__(self, home):
        super().__init__(home, BINDPOSE_AUTOSAVE_SECONDS="0.2")

    def start_program(self, *words):
        """Start Bindpose with its standard error redirected to a file."""
        with open(self.home / "said.txt", "ab") as said:
            return self.start(PROGRAM, *words, stderr=said)


@pytest.fixture
def desktop(tmp_path):
    there = Desktop(tmp_path)
    yield there
    there.end()
    # Qt warns of problems that may terminate the program, such as GUI calls from a second thread.
    said = tmp_path / "said.txt"
    assert not said.exists() or "thread" not in said.read_text(errors="replace"), said.read_text(errors="replace")


class App:
    """The program with a bound figure, in the middle of the desktop."""

    def __init__(self, desktop, *files):
        self.desktop = desktop
        self.process = desktop.start_program("view", *map(str, files))
        self.window = desktop.wait_for_window("Bindpose")
        desktop.wait_for(lambda: self.title() != "Bindpose" or not files, "an opened file")

    def title(self):
        return self.desktop.tool("getwindowname", self.window)

    def mouse(self, x, y, *more):
        """Move the mouse to a pixel of the window."""
        self.desktop.tool("mousemove", "--window", self.window, x, y, *more)

    def activate(self):
        self.desktop.activate(self.window)

    def save_as(self, path):
        """Save with the dialog, which asks for a file name."""
        self.desktop.keys("ctrl+shift+s")
        self.desktop.wait_for_window("Save the session")
        self.desktop.keys("ctrl+a")
        self.desktop.tool("type", "--delay", "5", str(path))
        self.desktop.keys("Return")
        self.desktop.wait_for(lambda: not self.desktop.window("Save the session"), "the dialog's end")
        return self.saved(path)

    def saved(self, path):
        return self.desktop.wait_for(lambda: path.exists() and json.loads(path.read_text()), f"{path}")

    def save(self, path):
        """Save again and replace the existing file."""
        before = path.stat().st_mtime_ns
        self.desktop.keys("ctrl+s")
        self.desktop.wait_for(lambda: path.stat().st_mtime_ns != before, "the session, saved again")
        return self.saved(path)


def translations(session):
    """Return the translation of each handle as three numbers."""
    return [[handle["transform"][k] for k in (3, 7, 11)] for handle in session["pose"]]


def move_all(desktop, app, *keys):
    """Start a move of all handles by a key, move the mouse up and to the right, then press these keys."""
    app.activate()
    app.mouse(300, 250)
    desktop.keys("ctrl+a", "g")
    for step in range(1, 6):
        time.sleep(0.1)  # wait as long as a fast user would
        app.mouse(300 + 8 * step, 250 - 4 * step)
    time.sleep(0.1)
    desktop.keys(*keys)


def test_keys_dialogs_undo_and_escape(desktop, tmp_path):
    app = App(desktop, DATA / "figure_weights.vtp", DATA / "figure.tgf")
    assert "figure" in app.title()
    path = tmp_path / "work.bindpose"
    rest = app.save_as(path)
    assert all(move == [0, 0, 0] for move in translations(rest))
    # Type a number during the move: all handles move by 0.25 along x.
    move_all(desktop, app, "x", "0", "period", "2", "5", "Return")
    moved = translations(app.save(path))
    assert all(move == pytest.approx([0.25, 0, 0]) for move in moved), moved
    # Esc during a move restores the pose bit by bit.
    move_all(desktop, app, "Escape")
    desktop.keys("k")  # add a key frame, so that there is something to save
    assert translations(app.save(path)) == moved
    desktop.keys("ctrl+z", "ctrl+z")
    assert translations(app.save(path)) == translations(rest)
    desktop.keys("ctrl+shift+z")
    assert translations(app.save(path)) == moved
    # If no number is typed, the mouse determines the move.
    move_all(desktop, app, "Return")
    assert translations(app.save(path)) != moved


def test_menus_and_the_window_manager(desktop, tmp_path):
    app = App(desktop, DATA / "figure_weights.vtp", DATA / "figure.tgf")
    path = tmp_path / "work.bindpose"
    assert app.save_as(path)["options"]["show.outlines"] is True
    app.activate()
    desktop.keys("alt+v", "o")
    assert app.save(path)["options"]["show.outlines"] is False
    # Let the window manager change the size of the window.
    desktop.tool("windowsize", "--sync", app.window, 900, 700)
    desktop.wait_for(lambda: "Geometry: 900x700" in desktop.tool("getwindowgeometry", app.window), "another size")
    # Closing the window with unsaved changes opens a dialog. Esc closes the dialog and keeps the window open. After the
    # changes are saved, closing the window ends the program.
    app.activate()
    desktop.keys("k")
    desktop.wait_for(lambda: "*" in app.title(), "a mark of what is not saved")
    desktop.keys("alt+F4")
    desktop.wait_for_window("^Bindpose$")
    desktop.keys("Escape")
    desktop.wait_for(lambda: not desktop.window("^Bindpose$"), "the question's end")
    app.activate()
    app.save(path)
    desktop.close(app.window, app.process)


def test_a_killed_window_leaves_its_work_to_the_next(desktop, tmp_path):
    app = App(desktop, DATA / "figure_weights.vtp", DATA / "figure.tgf")
    move_all(desktop, app, "x", "0", "period", "5", "Return")
    recovery = tmp_path / ".local" / "share" / "bindpose" / "recovery"

    def kept():
        for file in recovery.glob("*/work.bindpose"):
            try:
                session = json.loads(file.read_text())
            except FileNotFoundError:  # a newer backup has replaced the file
                continue
            if all(move == pytest.approx([0.5, 0, 0]) for move in translations(session)):
                return file
        return None

    copy = desktop.wait_for(kept, "a copy of the work")
    app.process.send_signal(signal.SIGKILL)
    app.process.wait()
    desktop.running.remove(app.process)
    assert kept() == copy
    after = App(desktop)
    after.activate()
    desktop.keys("alt+r")
    desktop.wait_for(lambda: "figure" in after.title(), "the work of the one before")
    restored = translations(after.save_as(tmp_path / "restored.bindpose"))
    assert all(move == pytest.approx([0.5, 0, 0]) for move in restored), restored


@pytest.mark.parametrize("content, words", [("once upon a time\n", "line 1"), (None, "No such file")])
def test_a_bad_file_from_an_icon_opens_a_window(desktop, tmp_path, content, words):
    """If a desktop starts the program with a bad file, there is no terminal. The window stays open and empty until it
    is closed. bindpose_app_tests checks the text of its error bar.
    """
    path = tmp_path / "bad.off"
    if content:
        path.write_text(content)
    process = desktop.start_program("view", str(path))
    window = desktop.wait_for_window("^Bindpose$")
    said = (tmp_path / "said.txt").read_text()
    assert "bindpose view: warning: " in said and words in said, said
    desktop.close(window, process)
