"""Make the pictures of filters/paraview/README.md after tests/paraview.sh: screenshots.py PARAVIEW LIBRARY.

PARAVIEW is the folder usr of the unpacked ParaView, LIBRARY the plugin. Needs ImageMagick.
"""

import pathlib
import subprocess
import sys
import tempfile
import time

from window import Window

PICTURES = pathlib.Path(__file__).resolve().parents[2] / "filters" / "paraview" / "pictures"
SIZE = (1280, 860)


def save(window, name):
    """Save a picture of the screen, which the window fills."""
    time.sleep(1)  # the window draws its panels after the view
    subprocess.run(["import", "-window", "root", "-crop", f"{SIZE[0]}x{SIZE[1]}+0+0", "+repage", "+dither",
                    "-colors", "128", PICTURES / f"{name}.png"], env=window.desktop.environment(), check=True)


def main():
    paraview, library = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
    PICTURES.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        with Window(paraview, library, folder, "bend", "none", size=SIZE) as window:
            window.ask("show_figure()")
            window.keys("alt+t", "b")
            window.desktop.wait_for(lambda: len(window.ask("names()")) == 5, "the chain")
            time.sleep(1)
            window.drag(window.ask("pixel([0.612, 0.343, 0])"), (-60, 110))  # the tip of an arm
            save(window, "bend_this_surface")
        with Window(paraview, library, folder, "placing", size=SIZE) as window:
            window.ask("add_placed()")
            for point in ([0, 0.84, 0], [0.42, 0.35, 0], [-0.42, 0.35, 0]):
                window.click(window.ask(f"pixel({point})"))
            save(window, "placed_handles")


if __name__ == "__main__":
    main()
