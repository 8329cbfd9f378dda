#!/usr/bin/env python3
"""Test that three edits are enough to add an option to the project.

The script edits a scratch copy of the project: the description of the option, the VTK setter with its use in the filter,
and the use in the kernel. Then the script builds the program and the Python package. The option must be in `bindpose
tetrahedralize --help`, in the Python signature and stub, in the ParaView properties, and in the table of
viewer/command_line.md. Its value must arrive in the kernel from the command line and from Python.

usage: new_option.py FOLDER [CMAKE_OPTION…]      FOLDER gets the copy and its build; it must not exist
       new_option.py --edit-only FOLDER            test only that the three edits can be made in the sources
"""

import json
import os
import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
CUBE = """OFF
8 12 0
0 0 0
1 0 0
1 1 0
0 1 0
0 0 1
1 0 1
1 1 1
0 1 1
3 0 2 1
3 0 3 2
3 4 5 6
3 4 6 7
3 0 1 5
3 0 5 4
3 1 2 6
3 1 6 5
3 2 3 7
3 2 7 6
3 3 0 4
3 3 4 7
"""


def run(*words, **options):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False, **options)
    if done.returncode:
        sys.exit(f"{' '.join(map(str, words))}\n{done.stdout[-3000:]}{done.stderr[-3000:]}")
    return done.stdout


def replace(path, old, new):
    text = path.read_text(encoding="utf-8")
    if old not in text:
        sys.exit(f"{path} does not contain '{old}'")
    path.write_text(text.replace(old, new, 1), encoding="utf-8")


def add_the_option(copy):
    """The three edits."""
    core, filters = copy / "filters" / "core" / "inside", copy / "filters"
    replace(core / "tetrahedralize.options.json", '"options": [', '''"options": [
      { "name": "made_up", "type": "number", "default": 0.25, "minimum": 0, "maximum": 2, "unit": "degrees",
        "help": "An option that a test made up." },''')
    replace(filters / "vtkTetrahedralizeSurface.h", "protected:\n", '''  /// An option that a test made up, degrees, 0 to 2; default 0.25.
  vtkSetClampMacro(MadeUp, double, 0.0, 2.0);
  vtkGetMacro(MadeUp, double);

protected:
''')
    replace(filters / "vtkTetrahedralizeSurface.h", "  int Method = AUTO;", "  double MadeUp = 0.25;\n  int Method = AUTO;")
    replace(filters / "vtkTetrahedralizeSurface.cxx", "  options.bare = this->Bare;",
            "  options.bare = this->Bare;\n  options.made_up = this->MadeUp;")
    replace(core / "tetrahedralize.h", "  bool bare = false;", "  bool bare = false;\n  double made_up = 0.25;")
    replace(core / "tetrahedralize.cpp",
            "  return status.ok() ? Tetrahedralizer(context, points, triangles, prepared, options, result).run()\n"
            "                     : status;",
            '''  if (!status.ok())
  {
    return status;
  }
  status = Tetrahedralizer(context, points, triangles, prepared, options, result).run();
  status.report.set("made_up", options.made_up);
  return status;''')


def expect(condition, sentence):
    if not condition:
        sys.exit(f"the new option {sentence}")


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    edit_only = sys.argv[1] == "--edit-only"
    folder = pathlib.Path(sys.argv[2 if edit_only else 1]).resolve()
    folder.mkdir(parents=True)
    copy = folder / "copy"
    build = copy / "build"
    if edit_only:
        shutil.copytree(ROOT / "filters", copy / "filters")
        add_the_option(copy)
        return
    run("git", "clone", "--quiet", ROOT, copy)
    add_the_option(copy)
    run("cmake", "-S", copy, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_UNITY_BUILD=ON",
        "-DBINDPOSE_WITH_QT=OFF", "-DBINDPOSE_BUILD_BENCHMARKS=OFF", *sys.argv[2:])
    # With this setting, the compiler cache finds the files that are the same as in the original.
    run("ninja", "-C", build, env={**os.environ, "CCACHE_BASEDIR": str(copy)})
    (folder / "cube.off").write_text(CUBE, encoding="ascii")
    program = build / "bin" / "bindpose"
    usage = run(program, "tetrahedralize", "--help")
    expect("--made-up" in usage and "An option that a test made up." in usage, "is not in --help")
    report = json.loads(run(program, "tetrahedralize", folder / "cube.off", "--made-up", "1.5", "-o", folder / "cube.vtu",
                            "--report", "-", "--quiet"))
    expect(report["made_up"] == 1.5, f"arrives in the kernel as {report['made_up']} from the command line")
    package = build / "lib" / "python3" / "dist-packages"
    code = ("import inspect, bindpose, sys; s = bindpose.read(sys.argv[1]); "
            "assert inspect.signature(bindpose.tetrahedralize).parameters['made_up'].default == 0.25; "
            "print(bindpose.report(bindpose.tetrahedralize(s, made_up=0.5))['made_up'])")
    printed = run("/usr/bin/python3", "-c", code, folder / "cube.off", env={"PYTHONPATH": str(package), "PATH": "/usr/bin:/bin"})
    expect(printed.strip() == "0.5", f"arrives in the kernel as {printed.strip()} from Python")
    expect("made_up: float=0.25" in (package / "bindpose" / "functions.pyi").read_text(encoding="utf-8"), "is not in the stub")
    generator = copy / "filters" / "options" / "generate.py"
    plugin = copy / "filters" / "paraview" / "plugin" / "inside.xml"
    run(sys.executable, "-B", generator, "paraview", plugin, folder / "inside.xml")
    expect('name="MadeUp"' in (folder / "inside.xml").read_text(encoding="utf-8"), "is not in the ParaView properties")
    page = copy / "viewer" / "command_line.md"
    run(sys.executable, "-B", generator, "page", page, folder / "page.md")
    expect("| `--made-up DEGREES` |" in (folder / "page.md").read_text(encoding="utf-8"), "is not in the page")
    print("a new option is three edits: found in --help, Python signature and stub, ParaView properties and the page")


if __name__ == "__main__":
    main()
