#!/usr/bin/env python3
"""Check that sources compile one by one. A unity build compiles several files as one, which hides a missing #include.

The commands come from a second build folder, which is only configured, without unity builds. Generated headers come from
the first one.

usage: compile_alone.py --build BUILD [--slice K/N]
"""

import argparse
import concurrent.futures
import json
import os
import pathlib
import shlex
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]


def check(entry, alone, build):
    """Check the syntax of a source. Return the messages of the compiler; empty: no error."""
    words = shlex.split(entry["command"].replace(str(alone), str(build)))
    words[words.index("-o"):words.index("-o") + 2] = ["-fsyntax-only"]
    run = subprocess.run(words, cwd=build, capture_output=True, text=True, check=False)
    return run.stderr if run.returncode else ""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, required=True, help="folder of a complete build")
    parser.add_argument("--slice", default="1/1", help="check only every Nth source, beginning with the Kth")
    options = parser.parse_args()
    build = options.build.resolve()
    alone = build / "alone"
    subprocess.run(["cmake", "-S", ROOT, "-B", alone, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_UNITY_BUILD=OFF",
                    "-DBINDPOSE_BUILD_TESTS=ON", "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON", "-DCMAKE_CXX_COMPILER_LAUNCHER="],
                   stdout=subprocess.DEVNULL, check=True)
    entries = [entry for entry in json.loads((alone / "compile_commands.json").read_text())
               if not pathlib.Path(entry["file"]).is_relative_to(alone)]
    entries.sort(key=lambda entry: entry["file"])
    part, parts = (int(number) for number in options.slice.split("/"))
    entries = entries[part - 1::parts]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        results = list(pool.map(lambda entry: check(entry, alone, build), entries))
    wrong = [result for result in results if result]
    print("\n".join(wrong))
    print(f"{len(entries)} sources checked one by one, {len(wrong)} with errors")
    return 1 if wrong or not entries else 0


if __name__ == "__main__":
    sys.exit(main())
