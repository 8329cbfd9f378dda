"""The progress line on a terminal: it never decreases, names the current phase, and is proportional to the time."""

import os
import pty
import re
import subprocess
import time

import pytest
import shapes
from driver import PROGRAM


def progress_of(folder, *words):
    """Return the seconds since the start, the percentage and the text of every progress line on a terminal. The last
    row contains the end of the run.
    """
    master, slave = pty.openpty()
    start = time.monotonic()
    run = subprocess.Popen([PROGRAM, *map(str, words)], cwd=folder.path, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                           stderr=slave)
    os.close(slave)
    rows = []
    while True:
        try:
            data = os.read(master, 65536)
        except OSError:  # on Linux, reading fails after the program has closed the terminal
            break
        if not data:
            break
        now = time.monotonic() - start
        rows += [(now, int(percent), text.strip()) for percent, text in re.findall(r"\] +(\d+) %  ([^\r\x1b]*)", data.decode())]
    os.close(master)
    assert run.wait() == 0
    return rows + [(time.monotonic() - start, 100, "")]


@pytest.mark.parametrize("words, names", [
    (("weights", "m.off", "--handles", "auto:8", "-o", "w.vtp"), ["read", "handles", "weights: tetrahedralize", "write"]),
    (("tetrahedralize", "m.off", "-o", "t.vtu"), ["read", "tetrahedralize: winding", "tetrahedralize: tetgen", "write"]),
    (("winding", "m.off", "--resolution", "160", "-o", "w.vti"), ["read", "winding: build", "winding: evaluate", "write"]),
])
def test_progress_follows_the_clock(folder, words, names):
    folder.off("m.off", shapes.sphere(160, 80))
    rows = progress_of(folder, *words)
    percents = [percent for _, percent, _ in rows]
    assert percents == sorted(percents)
    texts = [text for _, _, text in rows]
    assert all(name in texts for name in names), sorted(set(texts))
    assert not any(text.endswith(":") for text in texts)
    end = rows[-1][0]
    if end < 2.0:
        return  # starting the program is a large part of such a short run
    off = [abs(percent / 100 - seconds / end) for seconds, percent, _ in rows[:-1]]
    assert sum(off) / len(off) < 0.3
    # The program must end soon after the progress line reaches 98 %.
    late = end - min(seconds for seconds, percent, _ in rows if percent >= 98)
    assert late < 0.2 * end + 0.2


def test_lines_for_other_programs(folder):
    folder.off("m.off", shapes.sphere(80, 40))
    words = ("weights", "m.off", "--handles", "auto:4", "-o", "w.vtp", "--overwrite", "--progress", "lines")
    lines = folder.run(*words).is_good().err.splitlines()
    found = [re.fullmatch(r"progress (\d+) % (.+)", line) for line in lines]
    assert len(found) > 3 and all(found)
    percents = [int(match[1]) for match in found]
    assert percents == sorted(percents) and percents[-1] <= 100
    assert "handles" in {match[2] for match in found}
    assert folder.run(*words, "--quiet").is_good().err == ""
    assert folder.run(*words[:-2]).is_good().err == ""  # no bar without a terminal
