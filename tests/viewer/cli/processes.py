"""Find, wait for and replace the helper processes of a run of the program, and limit its resources."""

import contextlib
import os
import pathlib
import resource
import subprocess
import time

from driver import PROGRAM


def start(folder, *words, **more):
    """Start the program in a folder."""
    return subprocess.Popen([PROGRAM, *words], cwd=folder.path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                            **more)


def children(parent):
    """Return the process ids of the children that are not zombies."""
    found = []
    for entry in os.listdir("/proc"):
        with contextlib.suppress(OSError, ValueError):
            if entry.isdigit():
                state, parent_id = pathlib.Path("/proc", entry, "stat").read_text().rpartition(")")[2].split()[:2]
                if int(parent_id) == parent and state != "Z":
                    found.append(int(entry))
    return found


def wait_for_helper(process, seconds=60):
    """Wait for the first child of the process and return its id."""
    give_up = time.monotonic() + seconds
    while time.monotonic() < give_up:
        found = children(process.pid)
        if found:
            return found[0]
        assert process.poll() is None, "it ended without a helper"
        time.sleep(0.002)
    raise AssertionError("no helper was started")


def runs(number):
    """Report whether a process runs. A zombie does not run."""
    with contextlib.suppress(OSError):
        return pathlib.Path("/proc", str(number), "stat").read_text().rpartition(")")[2].split()[0] != "Z"
    return False


def wait_for_end(number, seconds=30):
    """Wait until the process has ended."""
    give_up = time.monotonic() + seconds
    while runs(number):
        assert time.monotonic() < give_up, "the process is still running"
        time.sleep(0.002)


def limited(kind, size):
    """Return a function for preexec_fn that sets a limit of a process."""
    return lambda: resource.setrlimit(kind, (size, size))


def stand_in(folder, variable, script):
    """Write a shell script that replaces a helper program. Return the environment that selects it.
    `variable` is the environment variable of the helper program.
    """
    name = "stand_in.sh"
    folder.write(name, f"#!/bin/sh\n{script}\n")
    os.chmod(folder / name, 0o755)
    return {variable: str(folder / name)}
