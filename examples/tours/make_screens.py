#!/usr/bin/env python3
"""Create a picture of every panel of the window: light and dark, 1280 x 800, 1920 x 1080, 2560 x 1600, and 1280 x 800
with twice the pixels, for inspection after a change of the look.

usage: make_screens.py PROGRAM FOLDER    (the program bindpose; pictures go to FOLDER/LOOK_SIZE/NAME.png)
"""

import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

TOURS = pathlib.Path(__file__).resolve().parent
# Name, size of the window, Qt scale factor.
SIZES = [
    ("1280x800", [1280, 800], 1),
    ("1920x1080", [1920, 1080], 1),
    ("2560x1600", [2560, 1600], 1),
    ("1280x800_2x", [1280, 800], 2),
]


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    program, folder = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    words = [program, "view"]
    if not os.environ.get("DISPLAY"):
        words = ["xvfb-run", "-a", "-s", "-screen 0 2600x1700x24 -noreset", *words]
    tour = json.loads((TOURS / "panels.json").read_text())
    steps = tour["steps"]
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)
        shutil.copytree(TOURS / "data", scratch / "data")
        for look in ("dark", "light"):
            for name, size, scale in SIZES:
                tour["tour"]["size"] = size
                tour["steps"] = [{"action": f"view.appearance.{look}"}, *steps]
                (scratch / "panels.json").write_text(json.dumps(tour))
                output = folder / f"{look}_{name}"
                subprocess.run([*words, "--play", scratch / "panels.json", "--screenshot-dir", output, "--overwrite",
                                "--time-limit", "300"], env={**os.environ, "QT_SCALE_FACTOR": str(scale)}, check=True)
                print(f"{output}: {len(list(output.glob('*.png')))} pictures")


if __name__ == "__main__":
    main()
