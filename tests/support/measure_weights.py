#!/usr/bin/env python3
"""Compare the time and the results of `bindpose weights` for three settings: tets of the volume, an embedding, and the
preview.

The time is the reported total time in seconds, tets included. The root mean square and the largest difference are over
the weights of all handles at the points of the surface. Runs on one surface alternate between the three settings, so that
other load on the machine affects them equally.
"""

import argparse
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile

from all_surfaces import real_surfaces
from all_weights import rows_of

SURFACES = [("hand.off", 20), ("elephant.off", 8), ("elephant.off", 24), ("armadillo.off", 10), ("refined_elephant.off", 10)]
LARGEST = 100_000_000  # file size in bytes; larger files are skipped
WAYS = {"volume": ["--domain", "volume"], "embedding": ["--domain", "embedding"],
        "preview": ["--domain", "embedding", "--stage", "preview"]}


def run(options, surface, handles, words, out):
    done = subprocess.run([options.program, "weights", surface, "--handles", f"auto:{handles}", *words, "-o", out, "--overwrite",
                           "--quiet", "--report", "-"], capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


def spread(seconds):
    return f"{statistics.median(seconds):.1f} ({min(seconds):.1f} to {max(seconds):.1f})"


def differences(a, b):
    gaps = [abs(x - y) for x, y in zip(a, b)]
    return f"{(sum(g * g for g in gaps) / len(gaps))**0.5:.4f}", f"{max(gaps):.3f}"


def measure(options, surface, handles, scratch):
    seconds = {way: [] for way in WAYS}
    reports = {}
    for _ in range(options.runs):
        for way, words in WAYS.items():
            reports[way] = run(options, surface, handles, words, scratch / f"{way}.dmat")
            seconds[way].append(reports[way]["seconds"]["total"])
    weights = {way: [w for row in rows_of(scratch / f"{way}.dmat") for w in row] for way in WAYS}
    guard = reports["embedding"].get("guard", {})
    return [str(reports["volume"]["counts"]["triangles"]), str(handles), str(reports["volume"]["counts"]["tets"]),
            *(spread(seconds[way]) for way in WAYS), *differences(weights["volume"], weights["embedding"]),
            f"{guard.get('rms_difference', 0):.4f}", differences(weights["embedding"], weights["preview"])[1]]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, required=True)
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--surface", action="append", help="only these")
    parser.add_argument("--markdown", type=pathlib.Path, help="write the table to this file, too")
    options = parser.parse_args()
    options.program = options.build.resolve() / "bin" / "bindpose"
    rows = [["surface", "triangles", "handles", "tets", "volume s", "embedding s", "preview s", "rms", "largest", "guard's rms",
             "preview's largest"]]
    with tempfile.TemporaryDirectory() as folder:
        scratch = pathlib.Path(folder)
        surfaces = {surface.path.name: surface.path for surface in real_surfaces(scratch, LARGEST)}
        for name, handles in SURFACES:
            if not options.surface or name in options.surface:
                rows.append([name, *measure(options, surfaces[name], handles, scratch)])
                print(rows[-1], flush=True)
    if options.markdown:
        text = ["# Seconds for weights", "", "Measured by", "", "    /usr/bin/python3 " + " ".join(sys.argv), "",
                f"as median (shortest to longest) of {options.runs} runs, tets included, on a machine with 2 cores that others used, too.",
                "`rms` and `largest` are of the difference between volume and embedding at the surface's points; the volume's own",
                "tets are no finer than the surface, so that a coarse one (the hand) is the less exact of the two.", "",
                "| " + " | ".join(rows[0]) + " |", "|---" * len(rows[0]) + "|", *("| " + " | ".join(row) + " |" for row in rows[1:])]
        options.markdown.write_text("\n".join(text) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
