"""Ctrl-C during any verb: exit code 4, a quick end, and no partial file."""

import contextlib
import os
import pathlib
import pty
import signal
import subprocess
import time

import pytest
import shapes
from driver import PROGRAM

LONG = {
    "winding": ["--resolution", "1200", "-o", "out.vti"],
    "tetrahedralize": ["-o", "out.vtu"],
    "weights": ["--handles", "auto:40", "-o", "out.vtp"],
}
if (pathlib.Path(PROGRAM).parent / "bindpose-mesher").exists():
    LONG["handles"] = ["--skeleton-triangles", "300000", "-o", "out.vtp"]


def wait_until_at_work(process):
    """Wait until one second after the program has started its signal thread. Before this time, the program loads its
    libraries, possibly from a slow disk.
    """
    give_up = time.monotonic() + 60
    while time.monotonic() < give_up and process.poll() is None:
        threads = pathlib.Path(f"/proc/{process.pid}/task").glob("*/comm")
        with contextlib.suppress(FileNotFoundError):  # threads may end at any time
            if "signals\n" in [thread.read_text() for thread in threads]:
                break
        time.sleep(0.02)
    time.sleep(1.0)
    assert process.poll() is None, "this machine is too fast for the test"


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
@pytest.mark.parametrize("verb", LONG)
def test_cancel(folder, verb, number):
    folder.off("sphere.off", shapes.sphere(240, 160))
    process = subprocess.Popen([PROGRAM, verb, "sphere.off", *LONG[verb], "--report", "r.json"], cwd=folder.path,
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    wait_until_at_work(process)
    process.send_signal(number)
    asked = time.monotonic()
    _out, err = process.communicate(timeout=60)
    assert process.returncode == 4
    assert time.monotonic() - asked < 60  # 200 ms on an idle machine, longer only during a factorization
    assert err == f"bindpose {verb}: canceled\n"
    assert sorted(os.listdir(folder.path)) == ["r.json", "sphere.off"]
    assert '"canceled"' in (folder / "r.json").read_text()


def test_a_long_sequence_is_canceled(folder):
    """A sequence checks all its output files, then writes them one after another."""
    folder.off("bar.off", shapes.bar())
    folder.write("h.tgf", shapes.TWO_BONES)
    folder.write("p.json", '{"version": 2, "handles": {"b2": {"translate": ["sin(t)", 0, 0]}}}')
    before = sorted(os.listdir(folder.path))
    words = ["deform", "bar.off", "--handles", "h.tgf", "--pose", "p.json", "--method", "mls", "-o", "out.vtp"]
    process = subprocess.Popen([PROGRAM, *words, "--frames", "100000"], cwd=folder.path, stderr=subprocess.PIPE, text=True)
    wait_until_at_work(process)
    process.send_signal(signal.SIGTERM)
    asked = time.monotonic()
    _out, err = process.communicate(timeout=60)
    assert process.returncode == 4 and err == "bindpose deform: canceled\n"
    assert time.monotonic() - asked < 60  # 200 ms on an idle machine
    assert sorted(os.listdir(folder.path)) == before
    folder.run(*words, "--frames", "1000000000").is_refused("--frames", "100000", code=1)


def test_a_second_signal_ends_at_once(folder):
    folder.off("sphere.off", shapes.sphere(240, 160))
    process = subprocess.Popen([PROGRAM, "weights", "sphere.off", "--handles", "auto:40", "-o", "out.vtp"],
                               cwd=folder.path, stderr=subprocess.DEVNULL)
    wait_until_at_work(process)
    for _ in range(2):
        process.send_signal(signal.SIGINT)
        time.sleep(0.01)
    assert process.wait(timeout=60) == 4
    assert os.listdir(folder.path) == ["sphere.off"]


def test_progress_is_for_terminals_only(folder):
    folder.off("sphere.off", shapes.sphere(60, 30))
    words = ["winding", "sphere.off", "--resolution", "96", "-o", "a.vti", "--overwrite"]
    assert folder.run(*words).is_good().err == ""

    def on_a_terminal(*more):
        ours, theirs = pty.openpty()
        process = subprocess.Popen([PROGRAM, *words, *more], cwd=folder.path, stderr=theirs)
        os.close(theirs)
        text = b""
        while True:
            try:
                block = os.read(ours, 4096)
            except OSError:  # the program has closed the terminal
                break
            if not block:
                break
            text += block
        os.close(ours)
        assert process.wait() == 0
        return text.decode()

    shown = on_a_terminal()
    assert " %  " in shown and "winding" in shown and "evaluate" in shown
    assert shown.endswith("\r\x1b[K")  # the progress line is erased at the end
    assert on_a_terminal("--quiet") == ""
