#!/usr/bin/env python3
"""Cost of weights for increasingly fine tets of an elephant: seconds per handle, their parts, and memory.

Each solve is a separate process with one thread. Values are medians of repeated runs, with bars from the fastest to the
slowest run; the finest tets have a single run. The analysis (ordering and symbolic factor, once for all handles) is
divided by the number of handles; factorizations and iterations are computed for each handle. Every column reaches its
certificate: relative gap and natural residual of at most 1e-6; otherwise the script stops. The chart also shows the
time of the preview weights.

Numbers: vertices and tets; seconds per handle, by number of handles; exponents p of time ~ vertices^p; MiB at the
peak and as estimated beforehand; the worst gap and residual.
"""

import json
import subprocess

import common
import bindpose
import numpy as np
from vtkmodules.vtkChartsCore import vtkChartLegend

import charts

MEBIBYTE = 1024 ** 2
PARTS = {"whole": charts.DARK, "factor": charts.ORANGE, "iterate": charts.GREEN, "analyze": charts.VIOLET}


def solve(tets, handles, *words):
    """Return the report of `bindpose weights`."""
    done = subprocess.run([common.program(), "weights", tets, "--handles", f"auto:{handles}", "--threads", "1",
                           *words, "-o", tets.with_name("weights.vtu"), "--overwrite", "--quiet", "--report", "-"],
                          capture_output=True, text=True, check=False)
    if done.returncode:
        raise common.Stop(done.stderr.strip() or f"bindpose weights ended with exit code {done.returncode}")
    return json.loads(done.stdout)


def seconds_of(report, handles):
    """Return the seconds per handle."""
    seconds = report["seconds"]
    return {"whole": seconds["weights"] / handles, "analyze": seconds["analyze"] / handles,
            "factor": seconds["factor"] / handles,
            "iterate": (seconds["weights"] - seconds["analyze"] - seconds["factor"]) / handles}


def make(options):
    elephant = common.demo_mesh(options, "elephant.off")
    edges = (0.04, 0.0113) if options.small else (0.0205, 0.0145, 0.0113, 0.0077)
    handle_counts = (4,) if options.small else (4, 24)
    sizes, tet_counts, peaks, estimates, previews = [], [], [], [], []
    spreads = {(count, part): [] for count in handle_counts for part in PARTS}
    gap = residual = 0.0
    for edge in edges:
        tets = options.scratch / "tets.vtu"
        bindpose.write(bindpose.tetrahedralize(elephant, interior_edge=edge), tets, overwrite=True)
        finest = edge == edges[-1]
        repeats = 1 if finest or options.small else 3
        for count in handle_counts[:1] if finest else handle_counts:
            reports = [solve(tets, count) for _ in range(repeats)]
            taken = [seconds_of(report, count) for report in reports]
            for part in PARTS:
                spreads[count, part].append(np.quantile([one[part] for one in taken], [0, 0.5, 1]))
            gap = max(gap, reports[0]["relative_gap"])
            residual = max(residual, reports[0]["kkt_residual"])
            if count == handle_counts[0]:
                sizes.append(reports[0]["counts"]["vertices"])
                tet_counts.append(reports[0]["counts"]["tets"])
                peaks.append(reports[0]["peak_memory_bytes"] / MEBIBYTE)
                estimates.append(reports[0]["memory_estimate_bytes"] / MEBIBYTE)
                previews.append(min(solve(tets, count, "--stage", "preview")["seconds"]["preview"]
                                    for _ in range(repeats)) / count)
    vertices = ("vertices", 4e3, 8e4)
    names = {5e3: "5,000", 1e4: "10,000", 2e4: "20,000", 5e4: "50,000"}
    times = charts.Panel("one thread", vertices, ("time per handle", 1e-3, 100), log=True, x_names=names,
                         y_names={1e-3: "1 ms", 1e-2: "10 ms", 0.1: "100 ms", 1: "1 s", 10: "10 s", 100: "100 s"})
    numbers = {"vertices": sizes, "tets": tet_counts}
    for (count, part), spread in spreads.items():
        fastest, median, slowest = np.array(spread).T
        power = float(np.polyfit(np.log(sizes[:len(median)]), np.log(median), 1)[0])
        few = count == handle_counts[0]
        numbers[f"{count} handles, {part}: seconds per handle"] = [float(s) for s in median]
        numbers[f"{count} handles, {part}: exponent p of time ~ vertices^p"] = power
        if few or part == "whole":
            times.line(f"{part}, {count} handles: exponent {power:.2f}", sizes[:len(median)], median, PARTS[part],
                       dots=True, dashed=not few)
            for ends in zip(sizes, sizes, fastest, slowest):
                times.line("", ends[:2], ends[2:], PARTS[part], 2)
    times.line("preview", sizes, previews, charts.BLUE, dots=True)
    memory = charts.Panel("4 handles", vertices, ("memory, MiB", 50, 5e3), log=True, x_names=names,
                          y_names={100: "100", 200: "200", 500: "500", 1e3: "1,000", 2e3: "2,000"})
    memory.line("peak", sizes, peaks, charts.DARK, dots=True)
    memory.line("estimate before the solve", sizes, estimates, charts.BLUE, dots=True, dashed=True)
    charts.draw(options.picture, [times, memory], (1700, 700),
                legends=[(vtkChartLegend.LEFT, vtkChartLegend.TOP)] * 2)
    return {**numbers, "preview: seconds per handle": previews, "MiB at the peak": peaks, "MiB estimated": estimates,
            "worst relative gap": gap, "worst natural residual": residual}


if __name__ == "__main__":
    common.main(__file__, __doc__, make)
