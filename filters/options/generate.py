#!/usr/bin/env python3
"""Generate code and documentation from the descriptions of options.

usage: generate.py check                              read and check all descriptions
       generate.py option-table OUT.cxx               the table of the command line
       generate.py set-options OUT.h                  functions that pass typed options to filters
       generate.py window OUT.h                       words, labels and ranges of options in the window
       generate.py paraview TEMPLATE.xml BASES.xml… OUT.xml
                                                      proxies with their properties; BASES have their base proxies
       generate.py python-table OUT.py                the table of the Python package
       generate.py python-stub MODULE.py OUT.pyi      the stub of a module
       generate.py python-package-stub __init__.py vtkCLASS.h… OUT.pyi
                                                      the stub of the package, with VTK classes
       generate.py page PAGE.md OUT.md                a page with its tables of options; OUT may be PAGE
"""

import pathlib
import sys

import command_line
import documentation
import paraview
import python_package
import window
from descriptions import DescriptionError, read_sets, read_verbs


def read(path):
    return pathlib.Path(path).read_text(encoding="utf-8")


def generated(kind, inputs):
    if kind == "python-package-stub":
        classes = [pathlib.Path(header).stem for header in inputs[1:]]
        wrapped = [name for name, header in zip(classes, inputs[1:]) if f"_EXPORT {name} " in read(header)]
        return python_package.package_stub(read(inputs[0]), wrapped)
    sets = read_sets()
    if kind == "window":
        return window.header(sets)
    if kind == "paraview":
        template, *bases = (paraview.fill(read(path), sets) for path in inputs)
        return paraview.inherit(template, bases)
    verbs, common = read_verbs(sets)
    if kind == "python-table":
        return python_package.table(sets, verbs)
    if kind == "python-stub":
        return python_package.stub(read(inputs[0]), sets, verbs)
    if kind == "option-table":
        return command_line.table(verbs, common)
    if kind == "set-options":
        return command_line.setters(sets, verbs)
    if kind == "page":
        return documentation.page(read(inputs[0]), verbs, common)
    return ""


def main():
    inputs = {"check": 0, "option-table": 0, "set-options": 0, "window": 0, "paraview": 1, "python-table": 0, "python-stub": 1,
              "page": 1}
    arguments = sys.argv[1:]
    kind = arguments[0] if arguments else ""
    if kind in ("python-package-stub", "paraview"):
        inputs[kind] = max(1, len(arguments) - 2)
    if kind not in inputs or len(arguments) != (1 if kind == "check" else 2 + inputs[kind]):
        sys.exit(__doc__)
    try:
        text = generated(kind, arguments[1:-1])
    except DescriptionError as error:
        sys.exit(f"generate.py: {error}")
    if kind != "check":
        out = pathlib.Path(arguments[-1])
        out.parent.mkdir(parents=True, exist_ok=True)
        out.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
