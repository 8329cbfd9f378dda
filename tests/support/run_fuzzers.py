#!/usr/bin/env python3
"""Run libFuzzer on each target of tests/fuzz, and print executions, coverage and peak memory as a table.

Each target starts from its files in tests/fuzz/corpus and from the inputs of earlier runs, which are kept in the build
folder. A crash, an input that takes more than 30 s, or one that takes too much memory ends the run of its target; libFuzzer
writes this input to the build folder. Fix the fault, and add the input to the corpus under a name that says what is wrong
with it.

usage: run_fuzzers.py --build BUILD [--target NAME]... [--slice K/N] [--seconds 600] [--jobs 2] [--markdown FILE]
"""

import argparse
import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
CORPUS = ROOT / "tests/fuzz/corpus"
LONGEST_INPUT = 8192  # bytes
TIME_LIMIT = 30  # seconds; the sanitizers take 10 to 20 times as long as a release build
MEMORY_LIMIT = 1024  # MiB, of which the sanitizers take about half
HEADER = ("| target | files | executions | coverage, edges | peak memory, MiB | result |\n"
          "|---|---:|---:|---:|---:|---|")


def run_target(program, build, name, seconds):
    """Run one target. Return a row of the table and whether the run found no fault."""
    found = build / "fuzz-inputs" / name
    faults = build / "fuzz-faults" / name
    for folder in (found, faults):
        folder.mkdir(parents=True, exist_ok=True)
    run = subprocess.run(
        [program, f"-max_total_time={seconds}", f"-max_len={LONGEST_INPUT}", f"-timeout={TIME_LIMIT}",
         f"-rss_limit_mb={MEMORY_LIMIT}", "-print_final_stats=1", f"-artifact_prefix={faults}/", str(found),
         str(CORPUS / name)],
        env={**os.environ, "BINDPOSE_FUZZ_TARGET": name, "ASAN_OPTIONS": "detect_leaks=0"},
        stdin=subprocess.DEVNULL, capture_output=True, text=True, errors="replace", check=False)
    (build / f"fuzz-{name}.log").write_text(run.stdout + run.stderr, encoding="utf-8")
    executions = re.search(r"stat::number_of_executed_units:\s*(\d+)", run.stderr)
    memory = re.search(r"stat::peak_rss_mb:\s*(\d+)", run.stderr)
    coverage = re.findall(r"cov: (\d+)", run.stderr)
    passed = run.returncode == 0 and executions is not None
    row = "| {} | {} | {:,} | {:,} | {} | {} |".format(
        name, len(list((CORPUS / name).iterdir())), int(executions[1]) if executions else 0,
        int(coverage[-1]) if coverage else 0, memory[1] if memory else "",
        "no fault" if passed else f"FAULT, see {build.name}/fuzz-{name}.log")
    return row, passed


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, required=True, help="folder of a build with BINDPOSE_FUZZERS=ON")
    parser.add_argument("--target", action="append", help="run only this target (default: all)")
    parser.add_argument("--slice", default="1/1", help="run only part K of N of the targets")
    parser.add_argument("--seconds", type=int, default=600, help="duration of each target")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="targets that run at the same time")
    parser.add_argument("--markdown", type=pathlib.Path, help="also write the table to this file")
    options = parser.parse_args()
    build = options.build.resolve()
    program = build / "bin/bindpose_fuzz"
    part, parts = (int(number) for number in options.slice.split("/"))
    names = (options.target or sorted(folder.name for folder in CORPUS.iterdir()))[part - 1::parts]
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        results = list(pool.map(lambda name: run_target(program, build, name, options.seconds), names))
    table = "\n".join([HEADER, *(row for row, _ in results)])
    print(table)
    if options.markdown:
        options.markdown.write_text(
            f"# Fuzzing\n\nEach target ran for {options.seconds} s, with {options.jobs} targets at the same time, under the "
            "address and undefined-behavior sanitizers:\n\n```sh\ncmake --preset fuzz && ninja -C build-fuzz bindpose_fuzz\n"
            f"python3 tests/support/run_fuzzers.py --build build-fuzz --seconds {options.seconds} --jobs {options.jobs} "
            f"--markdown tests/fuzzing.md\n```\n\n{table}\n", encoding="utf-8")
    return 0 if all(passed for _, passed in results) else 1


if __name__ == "__main__":
    sys.exit(main())
