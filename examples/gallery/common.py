"""The common parts of the gallery scripts: options, the package, the program, numbers.

A script defines `make(options)`, which draws `options.picture` and returns its numbers; `common.main` calls it.
`import common` must precede `import bindpose`, because this module adds the build to the search path of Python.
"""

import argparse
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

EXAMPLES = pathlib.Path(__file__).resolve().parent.parent
BUILD = EXAMPLES.parent / "build"
sys.path.insert(0, str(EXAMPLES))
# The build folder comes last, so that PYTHONPATH and an installed package take precedence.
sys.path.append(str(BUILD / "lib" / "python3" / "dist-packages"))

try:
    import bindpose
except ModuleNotFoundError as error:
    if error.name != "bindpose":
        sys.exit(f"{sys.executable} cannot import {error.name}; use the Python that VTK was built for, often /usr/bin/python3")
    sys.exit(f"the package bindpose is not in {BUILD}; run examples/quickstart.sh first, or set PYTHONPATH")
import quickstart  # noqa: E402  the demo meshes
from vtkmodules.vtkFiltersCore import vtkImageAppend  # noqa: E402
from vtkmodules.vtkIOImage import vtkPNGReader, vtkPNGWriter  # noqa: E402
from vtkmodules.vtkRenderingCore import vtkWindowToImageFilter  # noqa: E402


class Stop(Exception):
    """Ends a script with a message."""


def program():
    """Return the path of the program `bindpose`: from BINDPOSE_PROGRAM, the build, or the PATH."""
    named = os.environ.get("BINDPOSE_PROGRAM")
    found = named or shutil.which("bindpose", path=f"{BUILD / 'bin'}:{os.environ.get('PATH', '')}")
    if not found:
        raise Stop("cannot find the program bindpose; run examples/quickstart.sh first, or set BINDPOSE_PROGRAM")
    return found


def render(options, *words, picture=None):
    """Run `bindpose render` on files in `options.scratch`, and write `options.picture`, or `picture` if given. Return
    the part `picture` of the report."""
    words = ["render", *map(str, words), "-o", str(picture or options.picture), "--overwrite", "--quiet", "--report", "-"]
    done = subprocess.run([program(), *words], cwd=options.scratch, capture_output=True, text=True, check=False)
    if done.returncode:
        raise Stop(done.stderr.strip() or f"bindpose render ended with exit code {done.returncode}")
    return json.loads(done.stdout)["picture"]


def write_picture(window, path):
    """Render a window again and write it as a PNG."""
    window.Render()
    image = vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    writer = vtkPNGWriter()
    writer.SetFileName(str(path))
    writer.SetInputConnection(image.GetOutputPort())
    writer.Write()
    if writer.GetErrorCode():
        raise OSError(f"cannot write {path}")


def side_by_side(options, pictures, columns):
    """Combine pictures of equal size, row by row, into `options.picture`."""
    rows = vtkImageAppend()
    rows.SetAppendAxis(1)
    for first in reversed(range(0, len(pictures), columns)):  # the rows of a vtkImageData start at the bottom
        row = vtkImageAppend()
        row.SetAppendAxis(0)
        for picture in pictures[first:first + columns]:
            reader = vtkPNGReader()
            reader.SetFileName(str(picture))
            row.AddInputConnection(reader.GetOutputPort())
        rows.AddInputConnection(row.GetOutputPort())
    writer = vtkPNGWriter()
    writer.SetFileName(str(options.picture))
    writer.SetInputConnection(rows.GetOutputPort())
    writer.Write()
    if writer.GetErrorCode():
        raise OSError(f"cannot write {options.picture}")


def demo_mesh(options, name):
    """Return a mesh of the Debian package libcgal-demo, by its file name, as a vtkPolyData."""
    return bindpose.read(quickstart.demo_mesh(options.output / "meshes", name))


def display_or_again():
    """Run this command again under xvfb-run if there is no display, because VTK would end the process."""
    if os.environ.get("DISPLAY"):
        return
    xvfb = shutil.which("xvfb-run")
    if not xvfb:
        raise Stop("there is no display; install the Debian package xvfb")
    os.execv(xvfb, [xvfb, "-a", "-s", "-screen 0 1280x1024x24 -noreset", sys.executable, *sys.argv])


def number(value):
    """Return a number in the format of the README."""
    if isinstance(value, list):
        return " ".join(map(number, value))
    return f"{value:.3g}" if isinstance(value, float) else str(value)


def main(file, text, make):
    """Run a script: `make(options)` draws options.picture and returns {name: number}.

    options.output is the folder, options.scratch a temporary folder; options.small requests a quick run on less data.
    The numbers are printed and written to NAME.json next to NAME.png.
    """
    name = pathlib.Path(file).stem
    parser = argparse.ArgumentParser(description=text, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("gallery-output"),
                        help="folder for the picture and the numbers (default: gallery-output)")
    parser.add_argument("--small", action="store_true", help="use less data for a quick run; the claims are still checked")
    options = parser.parse_args()
    options.output = options.output.absolute()
    options.picture = options.output / f"{name}.png"
    try:
        display_or_again()
        options.output.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory() as scratch:
            options.scratch = pathlib.Path(scratch)
            numbers = make(options)
        for key, value in numbers.items():
            print(f"{key:>32}  {number(value)}")
        (options.output / f"{name}.json").write_text(json.dumps(numbers, indent=2) + "\n")
        print(f"{'picture':>32}  {options.picture}")
    except (Stop, quickstart.Stop, bindpose.BindposeError, OSError) as error:
        print(f"{name}: {error}", file=sys.stderr)
        sys.exit(2)
