#!/usr/bin/env python3
"""Cost of the winding number per point, for surfaces of all types, in one run of the benchmarks.

Every row of `bindpose_benchmarks --benchmark_filter=winding` runs on one thread: grids, scattered points, points within
1e-4 diagonals of the surface, points 1e6 diagonals from the origin. The unit Y is the time per triangle of the
direct sum in the same run: Y is comparable between machines. Bars are medians of five repetitions, and the dots are
one standard deviation higher. Surfaces: refined_elephant.off (closed) and elephant-with-holes.off of the Debian package
libcgal-demo; bumpy spheres that are closed, open, cut into patches, or disconnected (every triangle moved by its own
size, and about half of them turned over); and random triangles in a box.

Numbers: Y per row, nanoseconds per row, and the largest error beyond the row's tolerance.
"""

import json
import os
import subprocess

import common
import quickstart

import charts

COLORS = {"closed": charts.BLUE, "open": charts.GREEN, "unordered": charts.ORANGE}
SURFACES = {"elephant": ("closed", "elephant"), "closed": ("closed", "closed"), "holes": ("open", "elephant with holes"),
            "open": ("open", "open"), "patches": ("open", "patches"), "soup": ("unordered", "soup along a surface"),
            "orderless": ("unordered", "soup in a box")}


def run(options):
    """Return the benchmark's rows as {name: {"median": counters, "stddev": counters, …}}."""
    program = common.BUILD / "bin" / "bindpose_benchmarks"
    if not program.exists():
        raise common.Stop(f"cannot find {program}; configure with -DBINDPOSE_BUILD_BENCHMARKS=ON and build")
    folder = options.output / "meshes"
    for name in ("refined_elephant.off", "elephant-with-holes.off"):
        quickstart.demo_mesh(folder, name)
    which = "winding/(grid/(elephant/samples:64|holes/samples:128)|scattered/(elephant|holes|closed:20000))" if options.small \
        else "winding/(grid|scattered|near|far)"
    out = options.scratch / "rows.json"
    done = subprocess.run([program, f"--benchmark_filter={which}.*threads:1", f"--benchmark_out={out}",
                           "--benchmark_out_format=json"],
                          env={**os.environ, "BINDPOSE_BENCHMARK_MESHES": str(folder)}, capture_output=True, text=True,
                          check=False)
    if done.returncode:
        raise common.Stop(done.stderr.strip() or f"bindpose_benchmarks ended with exit code {done.returncode}")
    rows = {}
    for row in json.loads(out.read_text())["benchmarks"]:
        name = row["run_name"].split("/threads")[0].removeprefix("winding/")
        rows.setdefault(name, {})[row["aggregate_name"]] = row
    return rows


def label(name, row):
    """Return the row's group and its label."""
    where, surface, *rest = name.split("/")
    group, surface = SURFACES[surface.split(":")[0]]
    tolerance = next((float(word.split(":")[1]) for word in rest if word.startswith("tolerance")), None)
    samples = next((word.split(":")[1] for word in rest if word.startswith("samples")), None)
    what = {"grid": f"grid {samples}³", "scattered": "scattered", "near": "near",
            "far_from_origin": "far from the origin"}[where]
    kept = f", {tolerance:.0e}".replace("e-0", "e-") if tolerance else ", exact"
    return group, f"{surface} {round(row['triangles'] / 1000):,}k, {what}{kept}", tolerance or 1e-10


def make(options):
    rows, numbers, beyond = [], {}, 0.0
    for name, found in run(options).items():
        median, spread = found["median"], found["stddev"]
        group, text, tolerance = label(name, median)
        beyond = max(beyond, median["error"] - tolerance)
        rows.append((group, text, median["Y"], spread["Y"]))
        numbers[f"{text}: Y"] = median["Y"]
        numbers[f"{text}: ns"] = median["ns"]
    numbers["largest error minus the tolerance"] = beyond
    rows.reverse()  # the first row at the top
    panel = charts.Panel("Time per query point",
                         ("units of Y: time per triangle of the direct sum, about 20 ns", 0.05, 300),
                         ("", 10 ** -0.7, 10 ** (len(rows) - 0.3)), log=True,
                         x_names={0.1: "0.1", 1: "1", 10: "10", 100: "100"},
                         y_names={10.0 ** i: text for i, (_, text, *_) in enumerate(rows)})
    named = set()
    for i, (group, _, cost, spread) in enumerate(rows):
        at = 10.0 ** i
        panel.line("" if group in named else group, (0.05, cost), (at, at), COLORS[group], 14)
        panel.line("", (cost + spread, cost + 1.001 * spread), (at, at), charts.DARK, 2, dots=True)
        named.add(group)
    charts.draw(options.picture, [panel], (1400, 140 + 34 * len(rows)), left=390)
    return numbers


if __name__ == "__main__":
    common.main(__file__, __doc__, make)
