#!/usr/bin/env python3
"""Measure the time and memory of the verbs of `bindpose` (its subcommands) on closed and open surfaces of one and of four
million triangles.

The script scale_surfaces.py writes the surfaces. Each verb runs in a separate process on a pseudo-terminal, and this
script reads the progress that the verb prints. The table reports:
- the elapsed time in seconds;
- the peak memory of the process or of its largest helper process;
- the longest time in seconds during which the percentage and the name of the phase stayed the same.

With --cancel N, each verb runs N more times and is interrupted, each time at a later point of the run. The table then
also reports the longest time from an interrupt to the end of the process. The verb view is not interrupted. The script
fails if a verb fails or needs more than 12 GiB.

    measure_scale.py --build build                           four surfaces
    measure_scale.py --build build --millions 1 --cancel 4   time to cancel work on a million triangles
"""

import argparse
import contextlib
import dataclasses
import json
import os
import pathlib
import pty
import re
import select
import signal
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
SHAPES = ("closed", "open")
VERBS = ("info", "winding", "tetrahedralize", "weights", "deform", "view")
LIMIT = 1800.0  # time limit in seconds
GRACE = 60.0  # seconds between an interrupt and killing the process
MOST_MEMORY = 12 << 30
CANCELED = 4  # exit code of a canceled program
PROGRESS = re.compile(rb"([0-9]+) %  ([a-z][^\x1b\r\n]*)")
TOUR = {"tour": {"schema": 1, "name": "first picture", "view": [1200, 800], "seconds": LIMIT},
        "steps": [{"screenshot": "first"}]}
POSE = {"handles": {"p1": {"translate": [0.1, 0.0, 0.0]}}}


@dataclasses.dataclass
class Run:
    """Measurements of one run."""

    exit_code: int
    seconds: float
    peak_bytes: int
    silence: float = 0.0  # longest time in seconds during which the progress did not change
    silent: str = ""  # phase during the longest silence
    interrupted: float = 0.0  # seconds from the interrupt to the end of the process
    text: str = ""


class Screen:
    """Text that a process writes to a terminal."""

    def __init__(self):
        self.text = b""
        self.shown = (b"0", b"start")
        self.since = time.monotonic()
        self.silence, self.silent = 0.0, ""

    def look(self, chunk):
        self.text = (self.text + chunk)[-4000:]
        found = PROGRESS.findall(self.text)  # a line may be split over two reads
        if found and found[-1] != self.shown:
            self.change(found[-1])

    def change(self, shown):
        now = time.monotonic()
        if now - self.since > self.silence:
            self.silence, self.silent = now - self.since, " ".join(part.decode() for part in reversed(self.shown)) + " %"
        self.shown, self.since = shown, now


def run(words, interrupt_after=LIMIT):
    """Run a command on a terminal, and interrupt it after a time."""
    terminal, its_end = pty.openpty()
    start = time.monotonic()
    process = subprocess.Popen(words, stdin=its_end, stdout=its_end, stderr=its_end, start_new_session=True)
    os.close(its_end)
    screen, interrupted = Screen(), None
    while True:
        ready, _, _ = select.select([terminal], [], [], 0.01)
        if ready:
            try:
                chunk = os.read(terminal, 65536)
            except OSError:  # the process has closed the terminal
                break
            screen.look(chunk)
        now = time.monotonic()
        if interrupted is None and now - start > interrupt_after:
            interrupted = now
            os.kill(process.pid, signal.SIGINT)
        if interrupted is not None and now - interrupted > GRACE:
            os.killpg(process.pid, signal.SIGKILL)
    _, status, usage = os.wait4(process.pid, 0)
    end = time.monotonic()
    process.returncode = os.waitstatus_to_exitcode(status)
    os.close(terminal)
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)
    screen.change((b"", b""))
    return Run(process.returncode, end - start, 1024 * usage.ru_maxrss, screen.silence, screen.silent,
               end - interrupted if interrupted is not None else 0.0, screen.text.decode(errors="replace"))


def commands(program, surface, folder):
    """Return the command line of each verb."""
    (folder / "tour.json").write_text(json.dumps(TOUR), encoding="utf-8")
    (folder / "pose.json").write_text(json.dumps(POSE), encoding="utf-8")
    words = {
        "info": [surface],
        "winding": [surface, "--resolution", "256", "-o", folder / "winding.vti"],
        "tetrahedralize": [surface, "-o", folder / "tets.vtu"],
        "weights": [surface, "--handles", "auto:8", "-o", folder / "weights.vtp"],
        "deform": [folder / "weights.vtp", "--handles", folder / "handles.vtp", "--pose", folder / "pose.json",
                   "-o", folder / "posed.vtp"],
        "view": [surface, "--play", folder / "tour.json", "--screenshot-dir", folder / "pictures"]}
    overwrite = {verb: [] if verb == "info" else ["--overwrite"] for verb in words}
    return {verb: [program, verb, *arguments, *overwrite[verb]] for verb, arguments in words.items()}


def counts_of(program, surface, folder):
    """Return the number of triangles. Also write the handles for the verb deform to a file."""
    done = subprocess.run([program, "info", surface, "--report", "-", "--quiet"], capture_output=True, text=True, check=True)
    subprocess.run([program, "handles", surface, "--method", "points", "--number-of-points", "8", "-o", folder / "handles.vtp", "--overwrite", "--quiet"],
                   check=True)
    return json.loads(done.stdout[done.stdout.index("{"):])["counts"]["triangles"]


def measure(options, name, surface, folder):
    """Return the rows of the table for one surface."""
    triangles = counts_of(options.program, surface, folder)
    rows = []
    (folder / "weights.vtp").unlink(missing_ok=True)
    wanted = {*options.verb, *(["weights"] if "deform" in options.verb else [])}
    for verb, words in commands(options.program, surface, folder).items():
        if verb not in wanted:
            continue
        done = run(words)
        row = {"surface": name, "triangles": triangles, "verb": verb, "s": f"{done.seconds:.1f}",
               "MiB": done.peak_bytes >> 20, "longest silence, s": f"{done.silence:.1f} ({done.silent})",
               "failed": done.exit_code != 0 or done.peak_bytes > MOST_MEMORY}
        if options.cancel and verb != "view":  # the window does not handle interrupts
            runs = [run(words, done.seconds * (k + 0.5) / options.cancel) for k in range(options.cancel)]
            row["longest after an interrupt, s"] = f"{max(each.interrupted for each in runs):.2f}"
            row["failed"] |= any(each.exit_code not in (0, CANCELED) for each in runs)
        print(" | ".join(str(value) for value in row.values()), flush=True)
        if row["failed"]:
            print(done.text, file=sys.stderr)
        rows.append(row)
    return rows


def as_markdown(rows, command):
    columns = list(dict.fromkeys(name for row in rows for name in row if name != "failed"))
    lines = ["# Scale: millions of triangles", "", "Measured by", "", f"    {command}", "",
             f"on a machine with {os.cpu_count()} cores. Open surfaces lack the triangles in forty balls.", "",
             "| " + " | ".join(columns) + " |", "|---" * len(columns) + "|"]
    lines += ["| " + " | ".join(str(row.get(name, "")) for name in columns) + " |" for row in rows]
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, required=True)
    parser.add_argument("--millions", type=int, nargs="+", choices=[1, 4], default=[1, 4])
    parser.add_argument("--shape", nargs="+", choices=SHAPES, default=SHAPES)
    parser.add_argument("--verb", nargs="+", choices=VERBS, default=VERBS)
    parser.add_argument("--cancel", type=int, default=0, metavar="N", help="interrupts per verb")
    parser.add_argument("--markdown", type=pathlib.Path, help="write the table to this file, too")
    options = parser.parse_args()
    options.program = options.build.resolve() / "bin" / "bindpose"
    rows = []
    with tempfile.TemporaryDirectory() as scratch:
        for millions in options.millions:
            folder = pathlib.Path(scratch) / str(millions)
            # Create the surfaces in a separate process to keep the memory of this process small.
            # The process of each verb is forked from this process. The measured peak memory of a
            # verb is therefore at least the memory of this process.
            subprocess.run([sys.executable, HERE / "scale_surfaces.py", folder, str(millions)], check=True)
            for shape in options.shape:
                rows += measure(options, f"{shape}, {millions} M", folder / f"{shape}.ply", folder)
    if options.markdown:
        options.markdown.write_text(as_markdown(rows, " ".join(["/usr/bin/python3", "tests/support/measure_scale.py", *sys.argv[1:]])),
                                    encoding="utf-8")
    return 1 if any(row["failed"] for row in rows) else 0


if __name__ == "__main__":
    sys.exit(main())
