#!/usr/bin/env python3
"""Play tours for the documentation: the tutorial of the window with its pictures, and the film of README.md.

The script also copies pictures of two other tours: from picture.json the weights over the picture, and from
rotations.json the clusters and angles.

usage: make_pictures.py PROGRAM [--film]    (the program bindpose; the film needs ffmpeg)

viewer/tutorial.md is generated from the steps of tutorial.json; a test compares the two and replays the tour.
"""

import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

TOURS = pathlib.Path(__file__).resolve().parent
ROOT = TOURS.parent.parent
sys.path.insert(0, str(TOURS.parent))
import quickstart  # noqa: E402  the demo mesh

PAGE = ROOT / "viewer" / "tutorial.md"
PICTURES = ROOT / "viewer" / "pictures"
FILM = ROOT / "examples" / "pictures" / "bend.gif"
HEAD = """# Five minutes with the window

In nine steps you bind, bend and animate a mesh with the mouse. Watch the steps on your own display, after
`examples/quickstart.sh` has built the program and unpacked `elephant-with-holes.off` of the Debian package libcgal-demo:

    cd build/demo-meshes && ../bin/bindpose view --play ../../examples/tours/tutorial.json

All steps and pictures of this page come from this tour, [tutorial.json](../examples/tours/tutorial.json). A test replays it and
its checks.

"""


def page(tour):
    """Return the tutorial's text: the texts of the steps, with the pictures at their steps."""
    text = HEAD
    number = 0
    for step in tour["steps"]:
        if "say" in step and not step["say"].startswith("*Show"):
            number += 1
            text += f"{number}. {step['say']}\n\n"
        elif "say" in step:
            text += f"   {step['say']}\n\n"
        if "screenshot" in step:
            name = step["screenshot"]
            text += f"   ![{name.replace('_', ' ')}](pictures/{name}.png)\n\n"
    return text.rstrip() + "\n"


def play(program, name, mesh_folder, output):
    subprocess.run([program, "view", "--play", TOURS / f"{name}.json", "--screenshot-dir", output, "--overwrite"],
                   cwd=mesh_folder, check=True)


def make_film(frames):
    """Create a GIF of the frames with its own color palette."""
    words = ["ffmpeg", "-v", "error", "-y", "-framerate", "12", "-i", frames / "bend_%04d.png", "-filter_complex",
             "tpad=stop_mode=clone:stop_duration=0.8,split[a][b];[a]palettegen=max_colors=96:stats_mode=diff[p];"
             "[b][p]paletteuse=dither=none:diff_mode=rectangle", FILM]
    subprocess.run(words, check=True)


def main():
    words = [word for word in sys.argv[1:] if word != "--film"]
    if len(words) != 1:
        sys.exit(__doc__)
    program = pathlib.Path(words[0]).resolve()
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)
        mesh_folder = quickstart.demo_mesh(scratch / "meshes").parent
        if "--film" in sys.argv:
            play(program, "film", mesh_folder, scratch / "film")
            make_film(scratch / "film")
            return
        play(program, "tutorial", mesh_folder, scratch / "tutorial")
        play(program, "picture", mesh_folder, scratch / "picture")
        play(program, "rotations", mesh_folder, scratch / "rotations")
        PICTURES.mkdir(exist_ok=True)
        for picture in [*sorted((scratch / "tutorial").glob("*.png")), scratch / "picture" / "over_picture.png",
                        scratch / "rotations" / "clusters.png", scratch / "rotations" / "angles.png"]:
            shutil.copy(picture, PICTURES)
    PAGE.write_text(page(json.loads((TOURS / "tutorial.json").read_text())))


if __name__ == "__main__":
    main()
