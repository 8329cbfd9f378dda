#!/usr/bin/env python3
"""Format and names: clang-format on every tracked source, clang-tidy's naming rules on core.

--tidy changed   the core files of the last commit (default)
--tidy all       all of core
--tidy none      format only
"""

import argparse
import pathlib
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

ROOT = pathlib.Path(__file__).resolve().parents[2]


def git(*words):
    return subprocess.run(["git", "-C", ROOT, *words], capture_output=True, text=True, check=False).stdout.split()


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--build", type=pathlib.Path, required=True)
    parser.add_argument("--tidy", choices=["changed", "all", "none"], default="changed")
    options = parser.parse_args()

    sources = git("ls-files", "*.h", "*.cpp", "*.cxx")
    if not sources:
        print("git lists no source: the check needs a checkout")
        return 1
    formatted = subprocess.run(["clang-format-14", "--dry-run", "-Werror", *sources], cwd=ROOT, check=False)
    print(f"{len(sources)} files formatted: {'yes' if formatted.returncode == 0 else 'no'}")

    core = set(git("ls-files", "filters/core/*.cpp"))
    if options.tidy == "none":
        core = set()
    elif options.tidy == "changed":
        # A shallow clone has no parent: then there is no change to look at.
        core &= set(git("diff", "--name-only", "HEAD~1", "HEAD")) | set(git("diff", "--name-only", "HEAD"))

    def tidy(path):
        return subprocess.run(["clang-tidy-14", "--quiet", "-p", options.build, path], cwd=ROOT,
                              capture_output=True, text=True, check=False)

    wrong = 0
    with ThreadPoolExecutor(2) as pool:
        for result in pool.map(tidy, sorted(core)):
            if result.returncode != 0:
                wrong += 1
                print(result.stdout)
    print(f"{len(core)} files of core looked at by clang-tidy, {wrong} with a name or bug to mend")
    return 1 if formatted.returncode or wrong else 0


if __name__ == "__main__":
    sys.exit(main())
