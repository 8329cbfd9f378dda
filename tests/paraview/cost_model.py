#!/usr/bin/env python3
"""Predict time, memory and messages of large data on many ranks from the measurements of scaling_table.py, as Markdown.

The model of a stage has three constants, which are fitted to the measured numbers of ranks by least squares:

    processor seconds of all ranks = R * A + N * B        A: work that every rank repeats, B: work per item
    memory of one rank             = C + N / R * D        C: memory that every rank needs, D: memory per item
    bytes sent by all ranks        = (R - 1) * S          S: size of the copies that the first rank sends

where R is the number of ranks and N the number of voxels, points or instances. filters/paraview/README.md states the
assumptions.
"""

import argparse
import csv
import math
import pathlib
import statistics
import sys

# One row per stage: name of the stage, kind of items that the stage processes, number of items, and earlier stages that
# send copies of the inputs to all ranks.
CASES = (
    ("winding numbers on a grid", "voxels", 1e9, ("surface, shared",)),
    ("winding numbers at points", "points", 1e8, ("surface, shared",)),
    ("transfer of weights", "points", 1e8, ("weights, shared",)),
    ("skinning, bind and first pose", "points", 1e8, ("handles, shared",)),
    ("skinning, one pose", "points", 1e8, ()),
    ("crowd, bind and first frame", "instances", 1e5, ("weights, shared", "handles, shared")),
    ("crowd, one frame", "instances", 1e5, ()),
)
SOLVE = "weights, solved once"
ASSETS = 1e5
RANKS = (1, 64, 1024)


def read(path):
    """Return the rows of a file that scaling_table.py has written, with numbers instead of texts."""
    with open(path, newline="") as file:
        return [{name: value if name == "stage" else float(value) for name, value in row.items()}
                for row in csv.DictReader(file)]


def medians(rows, stage, name, of_ranks, per_call=True):
    """Return the median of one measurement of a stage over all runs, for each number of ranks (the keys of the result).
    The function `of_ranks` combines the values of the ranks of one run."""
    runs = {}
    for row in rows:
        if row["stage"] == stage:
            value = row[name] / (row["calls"] if per_call else 1.0)
            runs.setdefault(row["ranks"], {}).setdefault(row["run"], []).append(value)
    if not runs:
        sys.exit(f"the measurements have no stage '{stage}'")
    return {ranks: statistics.median(of_ranks(values) for values in by_run.values())
            for ranks, by_run in runs.items()}


def fit(pairs):
    """Return a >= 0 and b that minimize the sum of (a * x + b * y - value)^2 over pairs of (x, y) and value."""
    xx = sum(x * x for (x, _), _ in pairs)
    xy = sum(x * y for (x, y), _ in pairs)
    yy = sum(y * y for (_, y), _ in pairs)
    xv = sum(x * value for (x, _), value in pairs)
    yv = sum(y * value for (_, y), value in pairs)
    determinant = xx * yy - xy * xy
    if determinant > 1e-9 * xx * yy:
        a, b = (xv * yy - yv * xy) / determinant, (yv * xx - xv * xy) / determinant
        if a >= 0.0:
            return a, b
    return 0.0, yv / yy


class Model:
    """Constants of one stage."""

    def __init__(self, rows, stage, shared):
        processor = medians(rows, stage, "processor_seconds", sum)
        memory = medians(rows, stage, "memory_bytes", statistics.mean, per_call=False)
        points = medians(rows, stage, "points", sum, per_call=False)
        self.per_rank, self.per_item = fit([((ranks, points[ranks]), value) for ranks, value in processor.items()])
        self.rank_bytes, self.item_bytes = fit(
            [((1.0, points[ranks] / ranks), value) for ranks, value in memory.items()])
        sent = [medians(rows, name, "bytes_sent", sum) for name in shared]
        self.copy_bytes = sum(statistics.mean(value / (ranks - 1) for ranks, value in of_share.items() if ranks > 1)
                              for of_share in sent if max(of_share) > 1)

    def seconds(self, items, ranks):
        """Return the processor seconds of one rank: the elapsed time if each rank has a core."""
        return self.per_rank + items / ranks * self.per_item

    def memory(self, items, ranks):
        return self.rank_bytes + items / ranks * self.item_bytes

    def sent(self, ranks):
        return (ranks - 1) * self.copy_bytes


def size(count):
    """Return a number of bytes in MB, GB or TB."""
    for unit, scale in (("TB", 1e12), ("GB", 1e9)):
        if count >= scale:
            return f"{count / scale:.3g} {unit}"
    return f"{count / 1e6:.3g} MB"


def duration(seconds):
    if seconds >= 7200.0:
        return f"{seconds / 3600.0:.3g} h"
    return f"{seconds:.0f} s" if seconds >= 100.0 else f"{seconds:.3g} s"


def power(count):
    exponent = round(math.log10(count))
    return f"10^{exponent}" if count == 10.0 ** exponent else f"{count:.3g}"


def as_markdown(rows, ranks=RANKS, assets=None):
    """Return the fitted constants and the predictions as Markdown.

    `assets` is a pair: the mean processor seconds per model, and the number of models. By default, the seconds are
    those of the weights that scaling.py solves.
    """
    models = {stage: Model(rows, stage, shared) for stage, _, _, shared in CASES}
    lines = [
        "## Cost model", "",
        "Constants that `tests/paraview/cost_model.py` fits to the measurements. "
        "`filters/paraview/README.md` has the formulas and the assumptions.", "",
        "| stage | A: repeated on every rank, processor s | B: processor s per million items | "
        "C: memory of every rank | D: bytes per item | S: sent to every rank |",
        "|---|---|---|---|---|---|",
    ]
    for stage, _, _, _ in CASES:
        model = models[stage]
        lines.append(f"| {stage} | {model.per_rank:.3g} | {1e6 * model.per_item:.3g} | {size(model.rank_bytes)} | "
                     f"{model.item_bytes:.3g} | {size(model.copy_bytes)} |")
    lines += ["", "Predictions:", "",
              "| stage | items | ranks | s per rank | processor time of all ranks | memory per rank | sent by all ranks |",
              "|---|---|---|---|---|---|---|"]
    for stage, items, count, _ in CASES:
        model = models[stage]
        for number in ranks:
            seconds = model.seconds(count, number)
            lines.append(f"| {stage} | {power(count)} {items} | {number} | {duration(seconds)} | "
                         f"{duration(number * seconds)} | {size(model.memory(count, number))} | "
                         f"{size(model.sent(number))} |")
    if assets:
        seconds, origin = assets[0], f"mean of {assets[1]} models"
    else:
        seconds, origin = medians(rows, SOLVE, "processor_seconds", max)[1], f"stage '{SOLVE}'"
    elapsed = [f"; {duration(math.ceil(ASSETS / number) * seconds)} on {number} cores" for number in ranks if number > 1]
    lines += ["", f"{power(ASSETS)} assets, each bound by one process: {duration(ASSETS * seconds)} of processor time, "
              f"with {seconds:.3g} s per asset ({origin}){''.join(elapsed)}."]
    return "\n".join(lines) + "\n"


def mean_of_assets(path):
    """Return the mean processor seconds of the models with certified weights in a file of tests/real_meshes.py, and the
    number of these models."""
    with open(path, newline="") as file:
        seconds = [float(row["weights_user_seconds"]) for row in csv.DictReader(file)
                   if row["weights_outcome"] == "certified"]
    if not seconds:
        sys.exit(f"{path} has no model with certified weights")
    return statistics.mean(seconds), len(seconds)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("csv", type=pathlib.Path, help="the file that scaling_table.py --csv has written")
    parser.add_argument("--ranks", type=int, nargs="+", default=RANKS, help="numbers of ranks of the predictions")
    parser.add_argument("--assets", type=pathlib.Path, help="a file of tests/real_meshes.py --csv, for the time per asset")
    options = parser.parse_args()
    if min(options.ranks) < 1:
        parser.error("--ranks needs positive numbers")
    print(as_markdown(read(options.csv), options.ranks, mean_of_assets(options.assets) if options.assets else None))
    return 0


if __name__ == "__main__":
    sys.exit(main())
