"""Commands that run in process groups of their own, with a time limit, and are measured."""

import contextlib
import dataclasses
import os
import pathlib
import signal
import subprocess
import threading
import time

GRACE = 5  # seconds between asking a process to end and killing it
running = set()  # process groups
closed = threading.Event()  # no process is started any more


@dataclasses.dataclass
class Finished:
    """How a process ended."""

    exit_code: int  # negative: ended by this signal
    seconds: float
    user_seconds: float
    peak_bytes: int  # of the process or its largest helper
    over_limit: bool
    message: str  # what it wrote to the standard error


def stop(group, over_limit, ended):
    """Ask a process group to end, which lets the program write its report, then kill it."""
    over_limit.set()
    with contextlib.suppress(ProcessLookupError):
        os.killpg(group, signal.SIGTERM)
        if not ended.wait(GRACE):
            os.killpg(group, signal.SIGKILL)


def end_all():
    """Kill all processes and start no others: the benchmark was interrupted."""
    closed.set()
    for group in list(running):
        with contextlib.suppress(ProcessLookupError):
            os.killpg(group, signal.SIGKILL)


def run_limited(words, limit, log):
    """Run a command in a process group of its own, for at most `limit` seconds."""
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
        os.killpg(process.pid, signal.SIGKILL)  # helpers that were left behind
    running.discard(process.pid)
    message = pathlib.Path(log).read_text(encoding="utf-8", errors="replace").strip()
    return Finished(process.returncode, seconds, usage.ru_utime, 1024 * usage.ru_maxrss, over_limit.is_set(), message)
