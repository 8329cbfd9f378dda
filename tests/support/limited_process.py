"""Run commands in separate process groups with a time limit, and measure their time and memory."""

import contextlib
import dataclasses
import os
import pathlib
import signal
import subprocess
import threading
import time

GRACE = 5  # seconds between the request to end a process and killing it
running = set()  # ids of the process groups that are running
closed = threading.Event()  # set when no further process may start


@dataclasses.dataclass
class Finished:
    """Result of a process."""

    exit_code: int  # negative: the signal that ended the process
    seconds: float
    user_seconds: float
    peak_bytes: int  # peak memory of the process or of its largest helper
    over_limit: bool
    message: str  # standard error of the process


def stop(group, over_limit, ended):
    """Ask a process group to end, so that the program can still write its report. Kill the group after GRACE seconds."""
    over_limit.set()
    with contextlib.suppress(ProcessLookupError):
        os.killpg(group, signal.SIGTERM)
        if not ended.wait(GRACE):
            os.killpg(group, signal.SIGKILL)


def end_all():
    """Kill all processes and prevent new ones. real_meshes.py calls this function when it is interrupted."""
    closed.set()
    for group in list(running):
        with contextlib.suppress(ProcessLookupError):
            os.killpg(group, signal.SIGKILL)


def run_limited(words, limit, log):
    """Run a command in a separate process group for at most `limit` seconds."""
    if closed.is_set():
        raise InterruptedError("no process is started any more")
    over_limit, ended = threading.Event(), threading.Event()
    start = time.monotonic()
    with open(log, "wb") as errors:
        process = subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=errors, start_new_session=True)
    running.add(process.pid)
    timer = threading.Timer(limit, stop, (process.pid, over_limit, ended))
    timer.daemon = True
    timer.start()
    _, status, usage = os.wait4(process.pid, 0)
    seconds = time.monotonic() - start
    ended.set()
    timer.cancel()
    process.returncode = os.waitstatus_to_exitcode(status)
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)  # helper processes may still be running
    running.discard(process.pid)
    message = pathlib.Path(log).read_text(encoding="utf-8", errors="replace").strip()
    return Finished(process.returncode, seconds, usage.ru_utime, 1024 * usage.ru_maxrss, over_limit.is_set(), message)
