#!/usr/bin/env python3
"""Check the format of every source with clang-format, and the names in core with clang-tidy.

--tidy changed   the core files of the last commit (default; none outside of a git checkout)
--tidy all       all files of core, or those of a slice: files K, K + N, K + 2 N, … in the order of their names
--tidy none      format only
"""

import argparse
import pathlib
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDERS = ("filters", "viewer", "python", "tests", "examples")


def changed_files():
    """Return the names of the files that the last commit changed or that have uncommitted changes. In a shallow clone, the
    last commit has no parent, so only uncommitted changes are found. Without git the set is empty."""
    names = set()
    for revisions in (["HEAD~1", "HEAD"], ["HEAD"]):
        # In a container, the checkout may belong to another user. Without safe.directory, git refuses to read it.
        git = subprocess.run(["git", "-c", "safe.directory=*", "-C", ROOT, "diff", "--name-only", *revisions],
                             capture_output=True, text=True, check=False)
        names |= set(git.stdout.split())
    return names


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--build", type=pathlib.Path, required=True)
    parser.add_argument("--tidy", choices=["changed", "all", "none"], default="changed")
    parser.add_argument("--slice", default="1/1", metavar="K/N")
    options = parser.parse_args()
    first, step = (int(number) for number in options.slice.split("/"))

    sources = sorted(str(path.relative_to(ROOT)) for folder in FOLDERS for path in (ROOT / folder).rglob("*")
                     if path.suffix in (".h", ".cpp", ".cxx"))
    formatted = subprocess.run(["clang-format-14", "--dry-run", "-Werror", *sources], cwd=ROOT, check=False)
    print(f"{len(sources)} files formatted: {'yes' if formatted.returncode == 0 else 'no'}")

    core = {name for name in sources if name.startswith("filters/core/") and name.endswith(".cpp")}
    if options.tidy == "none":
        core.clear()
    elif options.tidy == "changed":
        core &= changed_files()
    core = sorted(core)[first - 1::step]

    def tidy(path):
        return subprocess.run(["clang-tidy-14", "--quiet", "-p", options.build, path], cwd=ROOT,
                              capture_output=True, text=True, check=False)

    wrong = 0
    with ThreadPoolExecutor(2) as pool:
        for result in pool.map(tidy, core):
            if result.returncode != 0:
                wrong += 1
                print(result.stdout)
    print(f"{len(core)} files of core looked at by clang-tidy, {wrong} with a name or bug to mend")
    return 1 if formatted.returncode or wrong else 0


if __name__ == "__main__":
    sys.exit(main())
