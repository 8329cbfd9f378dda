#!/usr/bin/env python3
"""Check the Python package with the tools of its users: `mypy --strict` on the code in the pages and on the first examples,
mypy on all other examples, and the rules of numpydoc on every public function.

Needs the Debian packages mypy and python3-numpydoc.
usage: tests/support/check_python_types.py [--build build]
"""

import argparse
import inspect
import os
import pathlib
import re
import subprocess
import sys
import tempfile
from collections.abc import Iterable

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGES = ("README.md", "python/README.md")
STRICT = ("examples/quickstart.py", "examples/01_inside_outside.py", "examples/benchmarks/python_poses.py")
# Rules of numpydoc that are not checked, because docstrings of the package may do the following: omit the extended
# summary (ES01); omit links to other functions (SA01, SA04); describe several parameters in one entry, or only by "See
# `winding_number`." (PR0x); list several types of a result (RT0x); begin on the line of the opening quotes, which
# numpydoc accepts since version 1.11 (GL01).
LEFT_OUT = {"GL01", "ES01", "SA01", "SA04", "PR01", "PR02", "PR03", "PR04", "PR06", "PR07", "PR08", "PR09", "RT02", "RT03", "RT05"}
# Options of mypy for scripts without annotations: check their calls of the package, but not their own variables.
LENIENT = ("--check-untyped-defs", *(f"--disable-error-code={code}" for code in (
    "var-annotated", "arg-type", "assignment", "index", "operator", "attr-defined", "union-attr", "dict-item", "list-item")))


def code_of(page: str) -> str:
    """Return the Python code in a page as one program."""
    return "\n".join(re.findall(r"^```python\n(.*?)^```", (ROOT / page).read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL))


def mypy(files: Iterable[pathlib.Path], package: pathlib.Path, cache: pathlib.Path, *options: str) -> bool:
    """Report whether mypy accepts the files. Errors in the modules that they import are not shown."""
    command = [sys.executable, "-m", "mypy", "--follow-imports=silent", "--ignore-missing-imports",
               f"--cache-dir={cache}", *options, *map(str, files)]
    search = os.pathsep.join(map(str, (package, ROOT / "examples", ROOT / "examples" / "gallery")))
    return subprocess.run(command, env={**os.environ, "MYPYPATH": search}, cwd=ROOT, check=False).returncode == 0


def numpydoc_errors(package: pathlib.Path) -> list[str]:
    """Return one sentence per rule of numpydoc that the documentation of a public function violates."""
    sys.path.insert(0, str(package))
    import bindpose
    from numpydoc.validate import validate

    names = [name for name, value in vars(bindpose).items() if inspect.isfunction(value)]
    names += ["Rig", *(f"Rig.{name}" for name in vars(bindpose.Rig) if not name.startswith("_"))]
    return [f"bindpose.{name}: {code} {sentence}" for name in names
            for code, sentence in validate(f"bindpose.{name}")["errors"]
            if code not in LEFT_OUT and not (code == "EX01" and name.startswith("Rig."))]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build", help="build folder (default: build)")
    build = parser.parse_args().build.resolve()
    package = next(build.glob("lib/python3*/dist-packages"), None)
    if package is None:
        sys.exit(f"check_python_types.py: there is no Python package in {build}")
    cache = build / "mypy"
    with tempfile.TemporaryDirectory() as folder:
        pages = [pathlib.Path(folder) / f"{page.replace('/', '_').replace('.', '_')}.py" for page in PAGES]
        for page, path in zip(PAGES, pages):
            path.write_text(code_of(page), encoding="utf-8")
        accepted = all([mypy([path], package, cache, "--strict") for path in (*pages, *(ROOT / name for name in STRICT))])
    # The scripts in examples/paraview are not checked: paraview.simple defines its functions only when it is imported.
    others = sorted({*ROOT.glob("examples/*.py"), *ROOT.glob("examples/*/*.py")} - {ROOT / name for name in STRICT} -
                    {*ROOT.glob("examples/paraview/*.py")})
    accepted = mypy(others, package, cache, *LENIENT) and accepted
    errors = numpydoc_errors(package)
    print("\n".join(errors) or "the documentation of all public functions follows numpydoc")
    sys.exit(bool(errors) or not accepted)


if __name__ == "__main__":
    main()
