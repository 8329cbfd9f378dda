#!/usr/bin/env python3
"""Run the examples and the whole gallery, and update the pictures and numbers of the README.

Pictures are written to examples/pictures, shrunk to less than 200 kB each. Numbers replace the text in
gallery/README.md between `<!-- NAME -->` and `<!-- end -->`. The script needs the Debian package sweethome3d-furniture.
"""

import argparse
import json
import os
import pathlib
import re
import subprocess
import sys

import common
from vtkmodules.vtkIOImage import vtkPNGReader, vtkPNGWriter
from vtkmodules.vtkImagingCore import vtkImageResize

FOLDER = pathlib.Path(__file__).resolve().parent
PICTURES = common.EXAMPLES / "pictures"
LARGEST = 200_000  # maximum size of a picture file in bytes
SCRIPTS = ("../01_inside_outside.py", "open_crossing_flipped.py", "boundary_and_parts.py", "amount_of_insideness.py",
           "jump_and_harmonic.py", "closing_holes.py", "growth.py", "cost_of_a_point.py",
           "defect_classes.py", "hull_segmentation.py", "cut_out_cartoon.py", "image_rectangle.py",
           "near_limbs.py", "limbs_in_front.py", "colors_of_handles.py", "new_hues.py",
           "rigidity_brush.py", "original_and_faster.py", "spurious_extrema.py", "topological_simplification.py",
           "small_features.py", "mesh_independence.py",
           "weights_in_volume.py", "preview_and_certified.py", "cost_of_weights.py", "clothes_on_a_body.py",
           "armor_on_a_character.py", "materials_of_an_asset.py",
           "parents_and_children.py", "candy_wrapper.py", "bent_elbow.py", "stretch_and_twist.py", "dragged_points.py",
           "handle_modes.py", "drag_only.py", "disjoint_skeleton.py", "four_energies.py", "rotation_clusters.py",
           "surface_and_volume.py", "bent_furniture.py", "tether.py", "full_and_reduced.py", "extra_weights.py", "crowd.py",
           "jello.py", "procedural.py",
           "orders_and_boundaries.py", "torus_and_tubes.py", "rig_in_a_file.py",
           "automatic_handles.py")


def shrink(source, target):
    """Shrink the picture to the largest width that fits into LARGEST bytes, at most 1400 pixels."""
    reader = vtkPNGReader()
    reader.SetFileName(str(source))
    reader.Update()
    columns, rows, _ = reader.GetOutput().GetDimensions()
    width = min(columns, 1400)
    while True:
        resize = vtkImageResize()
        resize.SetInputConnection(reader.GetOutputPort())
        resize.SetOutputDimensions(width, round(rows * width / columns), 1)
        writer = vtkPNGWriter()
        writer.SetInputConnection(resize.GetOutputPort())
        writer.SetCompressionLevel(9)
        writer.SetFileName(str(target))
        writer.Write()
        if target.stat().st_size < LARGEST:
            return
        width = width * 9 // 10


def rows(numbers, prefix=""):
    """Return one table line per number, with its name. The name of a number in nested dicts consists of the keys of all
    levels, joined by commas."""
    lines = []
    for key, value in numbers.items():
        if isinstance(value, dict):
            lines += rows(value, f"{prefix}{key}, ")
        else:
            name = f"{prefix}{key}".replace("|", "\\|")
            lines.append(f"| {name} | {common.number(value)} |")
    return lines


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("gallery-output"))
    parser.add_argument("scripts", nargs="*", metavar="SCRIPT.py", help="scripts to run (default: all)")
    options = parser.parse_args()
    unknown = [script for script in options.scripts if script not in SCRIPTS]
    if unknown:
        parser.error(f"unknown script {unknown[0]}; expected some of {', '.join(SCRIPTS)}")
    output = options.output.absolute()
    readme = FOLDER / "README.md"
    text = readme.read_text()
    for script in options.scripts or SCRIPTS:
        print(f"\n{script}", flush=True)
        subprocess.run([sys.executable, FOLDER / script, "--output", output], check=True,
                       # common.py has added the folder of the package to sys.path
                       env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)})
        name = pathlib.Path(script).stem.removeprefix("01_")
        shrink(output / f"{name}.png", PICTURES / f"{name}.png")
        table = "\n".join(["| number | |", "|---|---|", *rows(json.loads((output / f"{name}.json").read_text()))])
        text, found = re.subn(f"(<!-- {name} -->\n).*?(<!-- end -->)", lambda m: m[1] + table + "\n" + m[2], text, flags=re.S)
        if found != 1:
            sys.exit(f"refresh.py: {readme} has no line <!-- {name} -->")
    readme.write_text(text)


if __name__ == "__main__":
    main()
