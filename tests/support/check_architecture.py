#!/usr/bin/env python3
"""The arrows of the house, read from the includes: fails where one points upwards.

core names no VTK header; inside core base <- inside <- weights <- pose, io on base only; filters
do not know the viewer; nothing outside the tests includes a test's header.
"""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.MULTILINE)

# Which folders of core a folder of core may include from.
CORE_ARROWS = {
    "base": {"base"},
    "io": {"base", "io"},
    "inside": {"base", "inside"},
    "weights": {"base", "inside", "weights"},
    "pose": {"base", "inside", "weights", "pose"},
    "mesher": {"base", "inside", "mesher"},
}


def sources(folder):
    for path in sorted((ROOT / folder).rglob("*")):
        if path.suffix in (".h", ".cpp", ".cxx"):
            yield path, INCLUDE.findall(path.read_text())


def main():
    wrong = []
    core = {path.relative_to(ROOT / "filters/core").as_posix() for path, _ in sources("filters/core")}
    for path, includes in sources("filters/core"):
        stage = path.relative_to(ROOT / "filters/core").parts[0]
        for include in includes:
            if pathlib.PurePath(include).name.startswith("vtk"):
                wrong.append(f"{path.relative_to(ROOT)} names the VTK header {include}")
            if include not in core:
                continue
            other = include.split("/")[0]
            if other not in CORE_ARROWS[stage]:
                wrong.append(f"{path.relative_to(ROOT)} ({stage}) includes {include} ({other})")
    for folder, forbidden in (
        ("filters", ("viewer/", "scene/", "app/", "cli/", "widgets/", "vtkHandleSet", "Q", "support/")),
        ("viewer", ("support/",)),
    ):
        for path, includes in sources(folder):
            for include in includes:
                if include.startswith(forbidden):
                    wrong.append(f"{path.relative_to(ROOT)} includes {include}")
    for line in wrong:
        print(line)
    count = len(core)
    print(f"{count} files of core read, {len(wrong)} arrows point the wrong way")
    return 1 if wrong or count == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
