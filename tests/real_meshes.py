#!/usr/bin/env python3
"""Benchmark weights and tets on 820 real furniture models, whose surfaces have the usual defects of modeled meshes.

The models are the .obj files of the Debian package sweethome3d-furniture. With --set made, support/furniture.py makes
models with the same defects. With --set hostile, it makes models with worse defects. Two commands process each model:

    bindpose weights MODEL.obj --handles auto:8
    bindpose tetrahedralize MODEL.obj

Each command runs in a separate process with a time limit. The measured seconds, processor time and peak memory are those
of the process and its helpers. This script checks the results with code that does not come from Bindpose. Weights must
be finite, in [0, 1], sum to one within 1e-9, and have a certificate (relative gap and residual at most 1e-6). Tets must
have positive volumes. A refusal must be justified. The script writes one row per model to a .csv file, and a summary to
a .md file.

    real_meshes.py --build build                              everything: hours
    real_meshes.py --build build --sample 40                  40 models of all sizes, the same ones every time
    real_meshes.py --build build --slice 2/3                  models 2, 5, 8, … in the order of their names
    real_meshes.py --build build --only scopia/cup scopia/keys --verb weights
    real_meshes.py --build build --set made --check           synthetic furniture: a minute
    real_meshes.py --build build --verb none --accuracy 10    weights of ten models, compared with those on good tets
    real_meshes.py --build build --compare old.csv            compare the seconds with those of an earlier run
    real_meshes.py --build build --check                      exit code 1 if a model fails
    real_meshes.py --build build --check 'weights_seconds_95<=20' 'tets_thin_files<=10'

The goals of --check are limits for entries of the table "Numbers" in the summary.
"""

import argparse
import collections
import concurrent.futures
import csv
import dataclasses
import importlib
import json
import math
import multiprocessing
import os
import pathlib
import platform
import random
import re
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import zipfile

TESTS = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(TESTS / "support"))
import weights_accuracy  # noqa: E402
from limited_process import end_all, run_limited  # noqa: E402

PACKAGE = "sweethome3d-furniture"
HANDLES = 8
SEED = 820
SMALL = 100_000  # number of triangles; the summary of peak memory covers smaller models
THIN_SHARE = 0.01  # a file counts as thin if a larger fraction of its tets has angles below 5 degrees
VERBS = {"weights": "weights", "tets": "tetrahedralize"}  # prefix of the columns: verb of the program
GOOD = {"weights": ("certified", "refused"), "tets": ("filled", "refused")}
PERCENTILES = {"median": 50, "90": 90, "95": 95, "99": 99, "max": 100}
EXITS = {1: "usage error", 2: "refused", 3: "not converged", 4: "canceled", 5: "internal error"}
# These phases contain other phases, so they are not reported as the reason why a run is slow.
CONTAINERS = {"total", "tetrahedralize", "weights", "cdt", "parts"}
SURFACE = ["triangles", "boundary_edges", "nonmanifold_edges", "misoriented_edges", "duplicate_vertices",
           "duplicate_triangles", "degenerate_triangles", "self_intersections", "components", "inward_components"]
RUN = ["outcome", "message", "exit", "status", "seconds", "user_seconds", "peak_mb", "method", "rungs_failed", "tets",
       "min_dihedral", "below_5", "forced", "phases", "warnings"]
# Columns for the verb `weights` only.
SOLVE = ["domain", "domain_reason", "relative_gap", "kkt_residual", "guard_rms", "leak"]
COLUMNS = ["name", "bytes", *SURFACE, *(f"weights_{key}" for key in [*RUN, *SOLVE]), *(f"tets_{key}" for key in RUN)]


@dataclasses.dataclass
class Model:
    name: str
    size: int  # file size in bytes
    file: pathlib.Path  # the .obj file, or the archive that contains it
    member: str = ""  # name of the .obj file in the archive

    def copy_to(self, folder):
        path = folder / "model.obj"
        if self.member:
            with zipfile.ZipFile(self.file) as archive:
                path.write_bytes(archive.read(self.member))
        else:
            shutil.copyfile(self.file, path)
        return path


# ---- Models ----------------------------------------------------------------------------------------


def package_files():
    done = subprocess.run(["dpkg", "-L", PACKAGE], capture_output=True, text=True, check=False)
    return [pathlib.Path(line) for line in done.stdout.splitlines() if line.endswith(".sh3f")]


def model_name(member):
    """Return the name of a model: scopia/cup for scopia/cup/cup.obj."""
    path = pathlib.PurePosixPath(member).with_suffix("")
    return str(path.parent if path.name == path.parent.name else path)


def real_models():
    models = []
    for file in package_files():
        with zipfile.ZipFile(file) as archive:
            models += [Model(model_name(info.filename), info.file_size, file, info.filename)
                       for info in archive.infolist() if info.filename.lower().endswith(".obj")]
    return sorted(models, key=lambda model: model.name)


def made_models(folder, kind):
    """Write the models of furniture.py. The script runs as a separate process, see in_other_process."""
    words = ["--hostile"] if kind == "hostile" else []
    subprocess.run([sys.executable, TESTS / "support" / "furniture.py", folder, *words], check=True)
    return [Model(path.stem, path.stat().st_size, path) for path in sorted(pathlib.Path(folder).glob("*.obj"))]


def sample(models, count):
    """Return one model from each of `count` equally large classes of file size. The models are the same every time."""
    ordered = sorted(models, key=lambda model: (model.size, model.name))
    count = min(count, len(ordered))
    draw = random.Random(SEED)
    borders = [round(k * len(ordered) / count) for k in range(count + 1)]
    return [ordered[draw.randrange(first, last)] for first, last in zip(borders, borders[1:])]


def named_models(options, folder):
    models = real_models() if options.set == "furniture" else made_models(folder, options.set)
    first, step = options.slice
    return [model for model in models[first - 1::step]
            if not options.only or any(word in model.name for word in options.only)]


# ---- Processes -------------------------------------------------------------------------------------


def in_other_process(module, name, *arguments):
    """Call a function of result_checks or accuracy_checks in another process. Those modules load VTK and numpy. The
    measured peak memory of a child process includes the memory of its parent at the start of the child. Therefore this
    process must stay small.
    """
    return getattr(importlib.import_module(module), name)(*arguments)


# ---- One run ---------------------------------------------------------------------------------------


def command(options, prefix, model, folder):
    output = folder / ("out.vtp" if prefix == "weights" else "out.vtu")
    handles = ["--handles", f"auto:{HANDLES}"] if prefix == "weights" else []
    return output, [options.program, VERBS[prefix], model, *handles, "-o", output, "--report", folder / "report.json",
                    "--overwrite", "--quiet", "--threads", str(options.threads)]


def read_report(path):
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}


def slowest_phases(report, count=3):
    phases = {name: seconds for name, seconds in report.get("seconds", {}).items() if name not in CONTAINERS}
    largest = sorted(phases.items(), key=lambda item: -item[1])[:count]
    return ", ".join(f"{name} {seconds:.1f}" for name, seconds in largest)


def from_report(report):
    counts, tets = report.get("counts", {}), report.get("counts", {}).get("tets")
    return {"status": report.get("status", "no report"), "method": report.get("method"),
            "domain": report.get("domain"), "domain_reason": report.get("domain_reason"), "tets": tets,
            "min_dihedral": report.get("min_dihedral_angle"),
            "below_5": counts.get("tets_below_5_degrees", 0) / tets if tets else None,
            "forced": counts.get("tets_below_5_degrees_forced", 0) / tets if tets else None,
            "relative_gap": report.get("relative_gap"), "kkt_residual": report.get("kkt_residual"),
            "guard_rms": report.get("guard", {}).get("rms_difference"),
            "rungs_failed": sum(rung.get("outcome") != "ok" for rung in report.get("rungs", [])),
            "phases": slowest_phases(report), "warnings": "; ".join(report.get("warnings", []))}


def outcome_of(prefix, done, report, wrong):
    """Return one or two words that say how the run ended."""
    if done.over_limit:
        return "over time limit"
    if done.exit_code < 0:
        return "crash"
    if done.exit_code != 0:
        return "false refusal" if wrong else EXITS.get(done.exit_code, "unknown exit code")
    if not report:
        return "no report"
    return "wrong result" if wrong else GOOD[prefix][0]


def message_of(prefix, done, wrong):
    said = done.message.removeprefix(f"bindpose {VERBS[prefix]}: ").replace("\n", " / ")
    if done.over_limit:
        said = f"stopped after {done.seconds:.0f} s"
    elif done.exit_code < 0:
        said = f"{signal.Signals(-done.exit_code).name} {said}".strip()
    return "; ".join([*filter(None, [said]), *wrong])


def checked(options, pool, prefix, done, report, model, output):
    """Check the result of a run. Return the numbers that were measured on the result, and the list of its errors under
    "wrong".
    """
    if done.over_limit or done.exit_code not in (0, 2):
        return {"wrong": []}
    if done.exit_code == 2:
        arguments = ("check_refusal", prefix, options.program, model, done.message, HANDLES)
    elif prefix == "weights":
        arguments = ("check_weights", output, report, HANDLES)
    else:
        arguments = ("check_tets", output, report)
    try:
        return pool.submit(in_other_process, "result_checks", *arguments).result()
    except Exception as error:  # an unreadable file is a wrong result and must not end the benchmark
        return {"wrong": [f"the check failed: {error}"]}


def run_verb(options, pool, prefix, model, folder):
    """Run one verb on one model. Return the columns of the table, without their prefix, and the report."""
    output, words = command(options, prefix, model, folder)
    for path in (output, folder / "report.json"):
        path.unlink(missing_ok=True)
    done = run_limited(words, options.time_limit, folder / "errors.txt")
    report = read_report(folder / "report.json")
    numbers = checked(options, pool, prefix, done, report, model, output)
    wrong = numbers.pop("wrong")
    row = {**from_report(report), **numbers, "outcome": outcome_of(prefix, done, report, wrong),
           "message": message_of(prefix, done, wrong), "exit": done.exit_code,
           "seconds": round(done.seconds, 3), "user_seconds": round(done.user_seconds, 3),
           "peak_mb": round(done.peak_bytes / 1e6, 1)}
    return row, report


def run_model(options, pool, model):
    """Run all verbs on one model and return its row of the table."""
    row = dict.fromkeys(COLUMNS, "")
    row.update(name=model.name, bytes=model.size)
    with tempfile.TemporaryDirectory(prefix="real_meshes_") as folder:
        folder = pathlib.Path(folder)
        path = model.copy_to(folder)
        for prefix in options.prefixes:
            cells, report = run_verb(options, pool, prefix, path, folder)
            row.update({f"{prefix}_{key}": "" if value is None else value for key, value in cells.items()})
            # Each verb overwrites the columns in SURFACE. The final values are those of the last verb,
            # `tetrahedralize`, whose report describes the surface as it is in the file.
            row.update({key: report["counts"][key] for key in SURFACE if key in report.get("counts", {})})
    return row


def processes(count):
    return concurrent.futures.ProcessPoolExecutor(count, multiprocessing.get_context("spawn"))


def run_accuracy(options, models):
    """Return the rows of --accuracy."""
    with processes(options.jobs) as pool:
        def check(name, *arguments):
            return pool.submit(in_other_process, "accuracy_checks", name, *arguments).result()
        return weights_accuracy.accuracy(options, check, models, HANDLES)


def run_models(options, models):
    """Run all models and return their rows, sorted by name. Each row is written to the .csv file as soon as it is
    known.
    """
    rows = read_rows(options.csv) if options.resume else {}
    models = [model for model in models if model.name not in rows]
    with processes(options.jobs) as pool, concurrent.futures.ThreadPoolExecutor(options.jobs) as threads:
        futures = [threads.submit(run_model, options, pool, model) for model in models]
        try:
            for k, future in enumerate(concurrent.futures.as_completed(futures), 1):
                row = future.result()
                rows[row["name"]] = row
                write_rows(options.csv, rows)
                print(f"{k}/{len(models)} {progress_line(row, options.prefixes)}", flush=True)
        except BaseException:  # mainly for Ctrl-C: do not wait for the remaining models
            threads.shutdown(wait=False, cancel_futures=True)
            end_all()
            raise
    return rows


def progress_line(row, prefixes):
    parts = [row["name"]]
    for prefix in prefixes:
        part = f"{prefix} {row[f'{prefix}_outcome']} {row[f'{prefix}_seconds']:.1f} s"
        failed = row[f"{prefix}_outcome"] not in GOOD[prefix]
        parts.append(f"{part} ({row[f'{prefix}_message']})" if failed and row[f"{prefix}_message"] else part)
    return " | ".join(parts)


# ---- The table as a file ---------------------------------------------------------------------------


def write_rows(path, rows):
    with open(path, "w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS, extrasaction="ignore", lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows[name] for name in sorted(rows))


def as_number(text):
    try:
        return float(text) if text != "" else ""
    except ValueError:
        return text


def read_rows(path):
    if not path.exists():
        return {}
    with open(path, encoding="utf-8", newline="") as file:
        return {row["name"]: {key: value if key == "name" else as_number(value) for key, value in row.items()}
                for row in csv.DictReader(file)}


# ---- Summary ---------------------------------------------------------------------------------------


def percentile(values, percent):
    """Return a percentile: at least `percent` percent of the values are less than or equal to the returned value."""
    ordered = sorted(values)
    return ordered[max(0, math.ceil(percent / 100 * len(ordered)) - 1)] if ordered else math.nan


def column(rows, name):
    return [row[name] for row in rows if row.get(name, "") != ""]


def ran(rows, prefix):
    return [row for row in rows if row.get(f"{prefix}_outcome", "")]


def succeeded(rows, prefix):
    return [row for row in rows if row.get(f"{prefix}_outcome") == GOOD[prefix][0]]


def numbers_of(rows, prefix):
    """Return all numbers of the summary under the names that --check uses."""
    rows = ran(rows, prefix)
    done, outcomes = succeeded(rows, prefix), collections.Counter(column(rows, f"{prefix}_outcome"))
    small = [row for row in rows if row["triangles"] == "" or row["triangles"] < SMALL]
    per_triangle = [row[f"{prefix}_tets"] / row["triangles"] for row in done
                    if row[f"{prefix}_tets"] != "" and row["triangles"]]
    numbers = {"models": len(rows), GOOD[prefix][0]: len(done), "refused": outcomes["refused"],
               "failed": sum(count for word, count in outcomes.items() if word not in GOOD[prefix]),
               "crashed": outcomes["crash"], "over_limit": outcomes["over time limit"]}
    for kind in ("seconds", "user_seconds"):
        numbers.update({f"{kind}_{name}": percentile(column(rows, f"{prefix}_{kind}"), percent)
                        for name, percent in PERCENTILES.items()})
    numbers.update({"tets_per_triangle_median": percentile(per_triangle, 50),
                    "tets_per_triangle_95": percentile(per_triangle, 95),
                    "thin_files": sum(share > THIN_SHARE for share in column(done, f"{prefix}_below_5")),
                    "thin_files_not_forced": sum(
                        below - forced > THIN_SHARE for below, forced in zip(column(done, f"{prefix}_below_5"),
                                                                             column(done, f"{prefix}_forced"))),
                    "peak_mb_small": max(column(small, f"{prefix}_peak_mb"), default=math.nan),
                    "peak_mb": max(column(rows, f"{prefix}_peak_mb"), default=math.nan)})
    if prefix == "weights":
        leaks = column(done, "weights_leak")
        numbers.update({"leak_models": len(leaks), "leaks": sum(leak > weights_accuracy.LEAK for leak in leaks),
                        "leak_max": max(leaks, default=0.0)})
    return {f"{prefix}_{key}": value for key, value in numbers.items()}


def all_numbers(rows, prefixes, accuracy):
    numbers = {name: value for prefix in prefixes for name, value in numbers_of(rows, prefix).items()}
    return {**numbers, **(weights_accuracy.numbers(accuracy) if accuracy is not None else {})}


def text_of(value):
    if isinstance(value, str) or value is None:
        return (value or "").replace("|", "\\|")
    if isinstance(value, float) and not value.is_integer():
        return "" if math.isnan(value) else f"{value:.3g}" if abs(value) < 100 else f"{value:.0f}"
    return f"{value:.0f}"


def table(heads, rows):
    return ["| " + " | ".join(heads) + " |", "|" + "---|" * len(heads),
            *("| " + " | ".join(text_of(cell) for cell in row) + " |" for row in rows), ""]


def outcome_lines(rows, prefixes):
    lines = ["## Outcomes", ""]
    for prefix in prefixes:
        outcomes = collections.Counter(column(rows, f"{prefix}_outcome"))
        total = sum(outcomes.values())
        words = ", ".join(f"{count} {word}" for word, count in outcomes.most_common())
        lines.append(f"- `bindpose {VERBS[prefix]}` on {total} models: {words}.")
    return [*lines, ""]


def seconds_lines(rows, prefixes):
    names = {"seconds": "seconds", "user_seconds": "processor seconds"}
    cells = [[f"{VERBS[prefix]}: {names[kind]}",
              *(percentile(column(ran(rows, prefix), f"{prefix}_{kind}"), p) for p in PERCENTILES.values())]
             for prefix in prefixes for kind in names]
    return ["## Seconds", "", "Of all models, those that failed among them.", "",
            *table(["", "median", "90 %", "95 %", "99 %", "slowest"], cells)]


def refusal_lines(rows, prefixes):
    lines = ["## Refused, and why", ""]
    for prefix in prefixes:
        sentences = collections.Counter(re.sub(r"\d[\d.e+-]*", "N", str(row[f"{prefix}_message"]))
                                        for row in rows if row.get(f"{prefix}_outcome") == "refused")
        lines += [f"- {VERBS[prefix]}: {count} x “{sentence}”" for sentence, count in sentences.most_common()]
    return [*lines, ""] if len(lines) > 2 else []


def failures(rows, prefixes):
    return [(row, prefix) for prefix in prefixes for row in ran(rows, prefix)
            if row[f"{prefix}_outcome"] not in GOOD[prefix]]


def domain_or_rung(row, prefix):
    if prefix == "tets" or not row["weights_domain"]:
        return row[f"{prefix}_method"]
    reason = row["weights_domain_reason"]
    return f"{row['weights_domain']} ({reason})" if reason else row["weights_domain"]


def failure_lines(rows, prefixes):
    cells = [[row["name"], VERBS[prefix], row["triangles"], row[f"{prefix}_outcome"], row[f"{prefix}_seconds"],
              domain_or_rung(row, prefix), row[f"{prefix}_message"]]
             for row, prefix in failures(rows, prefixes)]
    if not cells:
        return ["## Failures", "", "None.", ""]
    heads = ["model", "verb", "triangles", "outcome", "s", "domain or rung", "message"]
    return ["## Failures", "", *table(heads, cells)]


def leak_lines(rows):
    measured = [row for row in rows if row.get("weights_leak", "") != ""]
    leaks = sorted(((row["weights_leak"], row["name"]) for row in measured), reverse=True)
    if not leaks:
        return []
    over = [[name, leak] for leak, name in leaks if leak > weights_accuracy.LEAK]
    return ["## Leaks between separate parts", "",
            f"- Models with two or more parts with handles that do not touch, cross or contain each other: "
            f"{len(leaks)}.",
            f"- Those on which a handle of one part has a weight above {weights_accuracy.LEAK:g} on another: {len(over)}.",
            f"- The largest such weight: {leaks[0][0]:.3g} ({leaks[0][1]}).", "",
            *(table(["model", "largest weight"], over) if over else [])]


def slowest_lines(rows, prefixes, count=10):
    lines = []
    for prefix in prefixes:
        slowest = sorted(ran(rows, prefix), key=lambda row: -row[f"{prefix}_seconds"])[:count]
        cells = [[row["name"], row[f"{prefix}_seconds"], row[f"{prefix}_user_seconds"], row["triangles"],
                  domain_or_rung(row, prefix), row[f"{prefix}_tets"], row[f"{prefix}_rungs_failed"],
                  row[f"{prefix}_phases"]] for row in slowest]
        lines += [f"## The slowest: {VERBS[prefix]}", "",
                  *table(["model", "s", "processor s", "triangles", "domain or rung", "tets", "rungs failed",
                          "slowest phases, s"], cells)]
    return lines


def numbers_lines(numbers):
    cells = [[f"`{name}`", value] for name, value in numbers.items()]
    return ["## Numbers", "",
            f"`…peak_mb_small` is the largest peak of models below {SMALL:,} triangles, in MB (10^6 bytes);",
            f"`…thin_files` counts files with over {100 * THIN_SHARE:.0f} % of tets below 5 degrees, `…_not_forced` those",
            "with so many that no triangle of the surface forces: none with a corner, or an edge, of less than 5 degrees, or with",
            "another triangle right in front of it.", "",
            *table(["name for --check", "value"], cells)]


def compare_lines(rows, old, prefixes):
    lines = ["## Before and after", ""]
    for prefix in prefixes:
        pairs = [(old[row["name"]], row) for row in ran(rows, prefix)
                 if old.get(row["name"], {}).get(f"{prefix}_outcome")]
        before, after = [pair[0] for pair in pairs], [pair[1] for pair in pairs]
        cells = [[f"{when}: {kind}", *(percentile(column(side, f"{prefix}_{kind}"), p) for p in PERCENTILES.values())]
                 for kind in ("seconds", "user_seconds") for when, side in (("before", before), ("after", after))]
        lines += [f"{VERBS[prefix]}, models in both tables: {len(pairs)}; {len(succeeded(before, prefix))} "
                  f"{GOOD[prefix][0]} before, {len(succeeded(after, prefix))} after.", "",
                  *table(["", "median", "90 %", "95 %", "99 %", "slowest"], cells)]
        changed = [[b["name"], b[f"{prefix}_outcome"], a[f"{prefix}_outcome"]] for b, a in pairs
                   if b[f"{prefix}_outcome"] != a[f"{prefix}_outcome"]]
        lines += table(["model", "before", "after"], changed) if changed else []
    return lines


def machine():
    lines = pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    names = [line.split(":")[1].strip() for line in lines if line.startswith("model name")]
    return f"{names[0] if names else platform.machine()}, {os.cpu_count()} cores"


def benchmark_lines(options, rows, old):
    lines = outcome_lines(rows, options.prefixes) + seconds_lines(rows, options.prefixes)
    lines += compare_lines(rows, old, options.prefixes) if old else []
    lines += failure_lines(rows, options.prefixes) + refusal_lines(rows, options.prefixes)
    return lines + leak_lines(rows) + slowest_lines(rows, options.prefixes)


def markdown(options, rows, old, accuracy):
    words = [pathlib.Path(word).name if word.startswith("/") else word for word in sys.argv[1:]]
    source = f"that tests/support/furniture.py makes ({options.set})"
    if options.set == "furniture":
        source = f"of the Debian package {PACKAGE}"
    lines = ["# Real furniture models: weights and tets", "", "Measured by", "",
             f"    /usr/bin/python3 tests/real_meshes.py {shlex.join(words)}", "",
             f"on {len(rows or accuracy)} models {source},",
             f"{options.time_limit:g} s allowed for each run, {options.jobs} at once ({machine()}).",
             f"Weights are for {HANDLES} handles spread over the surface (`--handles auto:{HANDLES}`).", ""]
    lines += benchmark_lines(options, rows, old) if rows else []
    lines += weights_accuracy.lines(accuracy, table) if accuracy is not None else []
    lines += numbers_lines(all_numbers(rows, options.prefixes, accuracy))
    return "\n".join(lines)


# ---- Goals -----------------------------------------------------------------------------------------


def broken_goals(options, rows, accuracy):
    """Return one sentence for each guarantee that is broken and for each goal NAME<=NUMBER that is missed."""
    broken = [f"{row['name']}: {VERBS[prefix]}: {row[f'{prefix}_outcome']}: {row[f'{prefix}_message']}"
              for row, prefix in failures(rows, options.prefixes)]
    numbers = all_numbers(rows, options.prefixes, accuracy)
    if options.accuracy and numbers["accuracy_models"] < options.accuracy:
        broken.append(f"--accuracy: {numbers['accuracy_models']} models measured, {options.accuracy} wanted")
    for goal in options.check or []:
        name, limit = (word.strip() for word in goal.split("<="))
        if not numbers[name] <= float(limit):
            broken.append(f"{name} is {numbers[name]:g}, the goal is at most {limit}")
    return broken


def check_goal_names(parser, options):
    known = all_numbers([], options.prefixes, [] if options.accuracy else None)
    for goal in options.check or []:
        name, found, limit = (word.strip() for word in goal.partition("<="))
        if name not in known or not found or not isinstance(as_number(limit), float):
            parser.error(f"--check: '{goal}' is not valid: expected NAME<=NUMBER, with NAME one of {', '.join(known)}")


# ---- Options ---------------------------------------------------------------------------------------


def slice_of_models(text):
    first, _, step = text.partition("/")
    if not (first.isdigit() and step.isdigit() and 1 <= int(first) <= int(step)):
        raise argparse.ArgumentTypeError(f"'{text}' is not valid: expected K/N with integers 1 <= K <= N")
    return int(first), int(step)


def parse_options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, required=True, help="build folder with bin/bindpose")
    parser.add_argument("--set", choices=["furniture", "made", "hostile"], default="furniture",
                        help="models of the package, or made ones (default: furniture)")
    parser.add_argument("--sample", type=int, default=0, metavar="N", help="only N models, the same ones every time")
    parser.add_argument("--slice", type=slice_of_models, default=(1, 1), metavar="K/N",
                        help="only every N-th model by name, from the K-th on (default: 1/1)")
    parser.add_argument("--only", nargs="+", metavar="NAME", help="only models whose names contain one of these")
    parser.add_argument("--verb", choices=["weights", "tetrahedralize", "both", "none"], default="both")
    parser.add_argument("--accuracy", type=int, nargs="?", const=40, default=0, metavar="N",
                        help="also compare the weights of N (40) models with those on well-shaped tets")
    parser.add_argument("--jobs", type=int, default=1, help="models at once (default: 1)")
    parser.add_argument("--threads", type=int, default=0, help="threads of each run, 0: all cores (default: 0)")
    parser.add_argument("--time-limit", type=float, default=180, metavar="SECONDS", help="of each run (default: 180)")
    parser.add_argument("--csv", type=pathlib.Path, help="default: real_meshes.csv beside this script")
    parser.add_argument("--markdown", type=pathlib.Path, help="default: real_meshes.md beside this script")
    parser.add_argument("--resume", action="store_true", help="keep the rows that the .csv file has")
    parser.add_argument("--compare", type=pathlib.Path, metavar="OLD.csv", help="percentiles before and after")
    parser.add_argument("--check", nargs="*", metavar="NAME<=NUMBER",
                        help="exit code 1 if a model fails, or one of these goals is missed")
    options = parser.parse_args()
    options.program = options.build.resolve() / "bin" / "bindpose"
    options.prefixes = [prefix for prefix, verb in VERBS.items() if options.verb in (verb, "both")]
    if options.set != "furniture" and not (options.csv and options.markdown):
        parser.error(f"--set {options.set}: --csv and --markdown are required, real_meshes.* are the package's")
    options.csv = options.csv or TESTS / "real_meshes.csv"
    options.markdown = options.markdown or TESTS / "real_meshes.md"
    check_goal_names(parser, options)
    if not options.program.exists():
        parser.error(f"--build: {options.program} does not exist")
    if options.compare and not options.compare.exists():
        parser.error(f"--compare: {options.compare} does not exist")
    return options


def run(options, models):
    """Run the models, write the files and print the summary. Return sentences about broken guarantees and missed goals.
    """
    old = read_rows(options.compare) if options.compare else {}
    rows = []
    if options.prefixes:
        chosen = sample(models, options.sample) if options.sample else models
        found = run_models(options, chosen)
        rows = [found[name] for name in sorted(model.name for model in chosen)]
    accuracy = run_accuracy(options, models) if options.accuracy else None
    options.markdown.write_text(markdown(options, rows, old, accuracy), encoding="utf-8")
    print("\n".join(outcome_lines(rows, options.prefixes)[2:]))
    return broken_goals(options, rows, accuracy)


def main():
    options = parse_options()
    signal.signal(signal.SIGTERM, signal.default_int_handler)  # SIGTERM raises KeyboardInterrupt, like Ctrl-C
    with tempfile.TemporaryDirectory(prefix="real_meshes_") as folder:
        models = named_models(options, folder)
        if not models:
            print(f"no models: install the Debian package {PACKAGE}, or choose other names for --only", file=sys.stderr)
            return 2
        broken = run(options, models)
    print("\n".join(f"BROKEN {sentence}" for sentence in broken))
    return 1 if broken and options.check is not None else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        end_all()
        sys.exit("interrupted: the rows so far are in the .csv file, --resume continues")
