#!/usr/bin/env python3
"""Measure how the work of the ParaView plugin scales with the number of MPI ranks, and print the result as Markdown.

tests/paraview.sh --scaling runs this script. It runs scaling.py with pvbatch on each number of ranks, several times, and
takes the median of the runs. The data are the same for all numbers of ranks (strong scaling). The efficiency of N ranks
is the processor time of one rank, divided by the sum of the processor times of the N ranks, so it can be measured on
fewer than N cores.

By default, all ranks run on one processor and take turns. Processors that share a core or a cache slow each other down,
which would count as lost efficiency. With --all-processors, the ranks run on all processors.

The bytes sent in a stage come from the report of vtkShareDataset. The bytes of the whole run are counted by Open MPI's
component pml/monitoring. With --check, the exit code is 1 if the efficiency of a goal is below --goal.
"""

import argparse
import csv
import json
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import sys

import cost_model

HERE = pathlib.Path(__file__).resolve().parent
SIZES = {"voxels": 64_000_000, "queries": 16_000_000, "grid_side": 16, "vertices": 8_000_000, "poses": 20,
         "instances": 2000, "frames": 5}
# Stages in which one rank works and the others wait or copy.
ONCE = ("surface, shared", "weights, solved once", "weights, shared", "handles, shared")
GOALS = ("winding numbers on a grid", "winding numbers at points", "skinning, one pose")
COLUMNS = ["run", "ranks", "rank", "stage", "calls", "points", "processor_seconds", "user_seconds", "system_seconds",
           "wall_seconds", "bytes_sent", "memory_bytes"]
WHOLE_RUN = "whole run"


def bytes_counted(folder, rank):
    """Return the bytes that a rank has sent according to Open MPI. A collective operation counts as its messages."""
    lines = (folder / f"sent.{rank}.prof").read_text().splitlines()
    return sum(int(re.match(r"[EI]\t\d+\t\d+\t(\d+) bytes", line)[1]) for line in lines if re.match(r"[EI]\t", line))


def measure(options, run, ranks):
    """Run scaling.py on the given number of ranks. Return one row per rank and stage."""
    folder = options.folder / f"{ranks}-{run}"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    (folder / "sizes.json").write_text(json.dumps({name: getattr(options, name) for name in SIZES}))
    words = ["mpirun", "--bind-to", "none", "-n", str(ranks), "--mca", "mpi_yield_when_idle", "1",
             "--mca", "pml_monitoring_enable", "1", "--mca", "pml_monitoring_enable_output", "3",
             "--mca", "pml_monitoring_filename", str(folder / "sent"),
             "pvbatch", "--sym", HERE / "scaling.py", options.plugin, options.mesh, folder]
    if not options.all_processors:
        words = ["taskset", "--cpu-list", str(min(os.sched_getaffinity(0))), *words]
    log = folder / "log"
    with open(log, "wb") as file:
        done = subprocess.run(["timeout", "--kill-after=10", str(options.time_limit), *words], stdout=file,
                              stderr=subprocess.STDOUT, check=False)
    if done.returncode != 0:
        late = done.returncode == 124
        reason = f"took longer than {options.time_limit} s" if late else f"exit code {done.returncode}"
        sys.exit(f"scaling.py on {ranks} rank(s) failed ({reason}); the log is {log}")
    rows = []
    for rank in range(ranks):
        measured = json.loads((folder / f"{rank}.json").read_text())
        if measured["ranks"] != ranks:
            sys.exit(f"pvbatch runs on {measured['ranks']} rank(s) instead of {ranks}; the log is {log}")
        about = {"run": run, "ranks": ranks, "rank": rank}
        rows += [{**about, "stage": stage, **row} for stage, row in measured["stages"].items()]
        rows.append({**about, "stage": WHOLE_RUN, "calls": 1, "bytes_sent": bytes_counted(folder, rank),
                     "memory_bytes": measured["peak_bytes"]})
    return rows


# ---- Tables ----------------------------------------------------------------------------------------


class Stage:
    """Measurements of one stage on one number of ranks: medians over the runs, per call of the stage."""

    def __init__(self, rows):
        """Take the rows of one stage and one number of ranks."""
        runs = [[row for row in rows if row["run"] == run] for run in sorted({row["run"] for row in rows})]

        def median(name, of_ranks, per_call=True):
            return statistics.median(of_ranks([row[name] / (row["calls"] if per_call else 1) for row in ranks])
                                     for ranks in runs)

        self.points = [row["points"] for row in sorted(runs[0], key=lambda row: row["rank"])]
        self.processor = median("processor_seconds", sum)
        self.least, self.most = median("processor_seconds", min), median("processor_seconds", max)
        self.wall = median("wall_seconds", max)
        self.sent = median("bytes_sent", sum)
        self.memory = median("memory_bytes", max, per_call=False)


def stages_of(rows):
    """Return nested dictionaries: result[name of the stage][number of ranks] is a Stage."""
    found = {}
    for row in rows:
        if row["stage"] != WHOLE_RUN:
            found.setdefault(row["stage"], {}).setdefault(row["ranks"], []).append(row)
    return {stage: {ranks: Stage(of_ranks) for ranks, of_ranks in by_ranks.items()}
            for stage, by_ranks in found.items()}


def efficiency(by_ranks, ranks):
    return by_ranks[1].processor / by_ranks[ranks].processor


def list_of(numbers):
    words = [str(number) for number in numbers]
    return " and ".join([", ".join(words[:-1]), words[-1]] if len(words) > 1 else words)


def interval(values):
    low, high = min(values), max(values)
    return f"{low:,}" if low == high else f"{low:,} – {high:,}"


def as_markdown(options, rows):
    stages = stages_of(rows)
    work = {stage: by_ranks for stage, by_ranks in stages.items() if stage not in ONCE}
    once = {stage: by_ranks for stage, by_ranks in stages.items() if stage in ONCE}
    place = "on all processors" if options.all_processors else "on one processor, taking turns"
    lines = [
        "# Scaling of the ParaView plugin", "",
        "Measured by", "", "    tests/paraview.sh --scaling --markdown filters/paraview/scaling.md", "",
        f"with pvbatch on {list_of(options.ranks)} MPI ranks {place}, with one thread per rank. Medians of "
        f"{options.runs} runs ({processor_name()}).", "",
        f"Winding numbers are those of {options.mesh.name}, with the method Fast. Weights have 8 handles on a grid of tets "
        f"with {options.grid_side + 1}³ points. The stage 'skinning, one pose' is the mean of {options.poses} poses, and "
        f"'crowd, one frame' of {options.frames} frames.", "",
        "## Work by pieces", "",
        "Each rank works on its own piece of the same data. Efficiency: the processor time of one rank, divided by the "
        "sum of the processor times of all ranks.", "",
        "| stage | ranks | points, voxels or instances per rank | processor s per rank | sum, s | efficiency | "
        "longest wall s | MB sent | largest growth of memory, MB |",
        "|---|---|---|---|---|---|---|---|---|",
    ]
    for stage, by_ranks in work.items():
        for ranks, measured in sorted(by_ranks.items()):
            seconds = f"{measured.least:.3g} – {measured.most:.3g}" if ranks > 1 else f"{measured.most:.3g}"
            lines.append(f"| {stage} | {ranks} | {interval(measured.points)} | {seconds} | {measured.processor:.3g} | "
                         f"{100 * efficiency(by_ranks, ranks):.0f} % | {measured.wall:.3g} | "
                         f"{measured.sent / 1e6:.3g} | {measured.memory / 1e6:.3g} |")
    lines += [
        "", "## Work of one rank, and copies for all ranks", "",
        "The first rank solves and sends the result to the others. Processor time of the other ranks is mostly waiting.",
        "", "| stage | ranks | processor s of the busiest rank | longest wall s | MB sent by all ranks |",
        "|---|---|---|---|---|",
    ]
    for stage, by_ranks in once.items():
        for ranks, measured in sorted(by_ranks.items()):
            lines.append(f"| {stage} | {ranks} | {measured.most:.3g} | {measured.wall:.3g} | "
                         f"{measured.sent / 1e6:.3g} |")
    lines += ["", "Bytes of a whole run, with all messages of ParaView, as Open MPI counts them:", "",
              "| ranks | MB sent by all ranks | of them in the reports of Share Dataset | largest peak memory of a rank, MB |",
              "|---|---|---|---|"]
    for ranks in options.ranks:
        runs = range(options.runs)
        whole = [[row for row in rows if row["ranks"] == ranks and row["run"] == run] for run in runs]
        counted = statistics.median(sum(row["bytes_sent"] for row in run if row["stage"] == WHOLE_RUN) for run in whole)
        reported = statistics.median(sum(row["bytes_sent"] for row in run if row["stage"] != WHOLE_RUN) for run in whole)
        peak = statistics.median(max(row["memory_bytes"] for row in run if row["stage"] == WHOLE_RUN) for run in whole)
        lines.append(f"| {ranks} | {counted / 1e6:.3g} | {reported / 1e6:.3g} | {peak / 1e6:.0f} |")
    return "\n".join(lines) + "\n"


def processor_name():
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.split(":", 1)[1].strip()
    return "unknown processor"


def missed_goals(options, rows):
    """Return one sentence per goal whose efficiency is too low on the largest number of ranks."""
    ranks, stages = max(options.ranks), stages_of(rows)
    reached = {stage: efficiency(stages[stage], ranks) for stage in GOALS}
    return [f"{stage}: efficiency {value:.3f} on {ranks} ranks, the goal is {options.goal}"
            for stage, value in reached.items() if value < options.goal]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--plugin", type=pathlib.Path, required=True, help="the file Bindpose.so")
    parser.add_argument("--mesh", type=pathlib.Path, required=True, help="a surface with open edges")
    parser.add_argument("--folder", type=pathlib.Path, required=True, help="for logs and measurements of single runs")
    parser.add_argument("--csv", type=pathlib.Path, required=True, help="output: one row per run, rank and stage")
    parser.add_argument("--markdown", type=pathlib.Path, help="write the tables to this file, too")
    parser.add_argument("--ranks", type=int, nargs="+", default=[1, 2, 4], help="numbers of ranks, among them 1")
    parser.add_argument("--runs", type=int, default=3, help="runs for each number of ranks")
    parser.add_argument("--all-processors", action="store_true", help="let the ranks run on all processors")
    parser.add_argument("--time-limit", type=int, default=600, help="seconds for one run")
    parser.add_argument("--goal", type=float, default=0.85, help=f"smallest efficiency of: {'; '.join(GOALS)}")
    parser.add_argument("--check", action="store_true", help="exit with code 1 if a goal is missed")
    for name, size in SIZES.items():
        parser.add_argument(f"--{name.replace('_', '-')}", type=int, default=size)
    options = parser.parse_args()
    if 1 not in options.ranks or min(options.ranks) < 1 or options.runs < 1:
        parser.error("--ranks needs positive numbers, one of them 1, and --runs a positive number")

    rows = []
    for run in range(options.runs):
        for ranks in options.ranks:
            print(f"run {run + 1} of {options.runs} on {ranks} rank(s) ...", flush=True)
            rows += measure(options, run, ranks)
    with open(options.csv, "w", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS, restval=0, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    text = as_markdown(options, rows) + "\n" + cost_model.as_markdown(cost_model.read(options.csv))
    print(text)
    if options.markdown:
        options.markdown.write_text(text)
    missed = missed_goals(options, rows)
    for sentence in missed:
        print(sentence)
    return 1 if missed and options.check else 0


if __name__ == "__main__":
    sys.exit(main())
