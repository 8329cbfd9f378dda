"""Compare the default weights of real models with weights solved on well-shaped tets that conform to the surface.

The reference weights are solved for the same handles on tets of `bindpose tetrahedralize --method remesh`, and
interpolated at the surface's vertices by this script's own code. The reference is also compared with a coarse
reference, from which the tets that bridge gaps are removed. If the two references differ, the reference is not accurate
enough for a comparison. Models are drawn in a seeded random order until enough models are measured. A model is skipped
- if its reference tets have angles below GOOD_ANGLE;
- if the reference tets miss a part of the surface (remesh has no tets for open sheets), or more than FILMS of the
  surface's area has the outside on both sides;
- if the boundary of the reference tets is too far from the surface, because the tets bridge a gap, or if the tets
  bridge a gap of at most FAR anywhere;
- if the reference tets and the default tets have different numbers of connected parts;
- if the two references differ by more than AGREE.

This module is a part of real_meshes.py, which calls its functions. Only accuracy_checks.py uses VTK and numpy.
"""

import concurrent.futures
import json
import pathlib
import random
import tempfile

from limited_process import run_limited

SEED = 15
GOOD_ANGLE = 10.0  # degrees: smallest dihedral angle of a reference; remesh aims at 12
CUBES = 40  # number of cubes along the longest side of the bounding box, for the reference
COARSE_CUBES = 27
AGREE = 0.01  # largest rms difference between the two references
FAR = 0.5  # percent of the bounding-box diagonal: largest distance between a reference's boundary and the surface
COVERED = 0.99  # fraction of the vertices that must be near the reference tets
FILMS = 0.01  # largest fraction of the surface's area that has the outside on both sides
RMS = 0.015
LEAK = 0.01  # a weight on a separate part is a leak if it is larger than this
COLUMNS = ["triangles", "domain", "tets", "angle", "reference tets", "references", "rms", "largest", "warned", "leak",
           "s", "reference s"]
WARNING = "are not resolved"  # part of the warning that the weights of two lattices differ


def run(options, verb, words, folder):
    """Run a verb of the program. Return its report, or a sentence if it failed."""
    report = folder / "accuracy.json"
    report.unlink(missing_ok=True)
    done = run_limited([options.program, verb, *words, "--report", report, "--overwrite", "--quiet",
                        "--threads", str(options.threads)], options.time_limit, folder / "errors.txt")
    if done.over_limit:
        return f"{verb}: stopped after {done.seconds:.0f} s"
    if done.exit_code != 0:
        return done.message.replace("\n", " / ") or f"{verb}: exit code {done.exit_code}"
    return {**json.loads(report.read_text(encoding="utf-8")), "wall": done.seconds}


def remesh(options, path, folder, name, cubes):
    return run(options, "tetrahedralize",
               [path, "--method", "remesh", "--resolution", str(cubes), "-o", folder / f"{name}.vtu"], folder)


def prepare(options, check, path, folder, handles):
    """Write the handles and reference tets of one model. Return the quality of the tets, or the reason to skip the
    model."""
    if not check("write_handles", path, folder / "handles.tgf", handles):
        return "fewer vertices than handles"
    report = remesh(options, path, folder, "reference", CUBES)
    if isinstance(report, str):
        return report
    if report["distance_max"] > FAR:
        return f"the reference bridges a gap: its boundary is up to {report['distance_max']:.2f} % of the diagonal off"
    quality = check("tets_quality", path, folder / "reference.vtu")
    if quality["covered"] < COVERED:
        return f"{100 * (1 - quality['covered']):.1f} % of the vertices are not near the tets: open sheets"
    if quality["angle"] < GOOD_ANGLE:
        return f"a dihedral angle of the reference is {quality['angle']:.1f} degrees"
    missing = check("surface_without_tets", options.program, path, folder / "reference.vtu", FAR / 100)
    if missing["films"] > FILMS:
        return f"{100 * missing['films']:.1f} % of the area has the outside on both sides: open sheets"
    if missing["bridged"] > 0:
        return f"the reference bridges a narrow gap on {100 * missing['bridged']:.3f} % of the area"
    return quality


def compare(options, check, path, folder, quality):
    """Solve the default and the reference weights of one model and compare them. Return columns of the table, or a
    sentence."""
    handles = ["--handles", folder / "handles.tgf"]
    ours = run(options, "weights", [path, *handles, "-o", folder / "default.vtp"], folder)
    if isinstance(ours, str):
        return ours
    parts = ours["counts"].get("tet_components", quality["parts"])
    if parts != quality["parts"]:
        return f"the reference has {quality['parts']} connected parts, the default {parts}"
    report = remesh(options, path, folder, "coarse", COARSE_CUBES)
    if isinstance(report, str):
        return report
    check("open_gaps", options.program, path, folder / "coarse.vtu")
    seconds = {}
    for name in ("coarse", "reference"):
        solved = run(options, "weights",
                     [folder / f"{name}.vtu", *handles, "-o", folder / f"{name}-weights.vtu"], folder)
        if isinstance(solved, str):
            return f"{name}: {solved}"
        seconds[name] = solved["wall"]
    found = check("difference", folder / "default.vtp", folder / "reference-weights.vtu", folder / "coarse-weights.vtu")
    if found["references"] > AGREE:
        return f"references of {COARSE_CUBES} and {CUBES} cubes differ by {found['references']:.3f} rms"
    warned = any(WARNING in warning for warning in ours.get("warnings", []))
    return {**found, "triangles": ours["counts"].get("triangles"), "domain": ours.get("domain"), "warned": warned,
            "tets": ours["counts"].get("tets"), "s": ours["wall"], "reference s": seconds["reference"]}


def measure(options, check, model, handles):
    """Measure one model and return its table row. The entry "skipped" is the reason to skip it, or empty."""
    with tempfile.TemporaryDirectory(prefix="weights_accuracy_") as folder:
        folder = pathlib.Path(folder)
        path = model.copy_to(folder)
        quality = prepare(options, check, path, folder, handles)
        found = quality if isinstance(quality, str) else compare(options, check, path, folder, quality)
    if isinstance(found, str):
        return {"name": model.name, "skipped": found}
    return {"name": model.name, "skipped": "", **quality, **found}


def differences(row):
    warned = ", warned" if row["warned"] else ""
    return f"rms {row['rms']:.4f}, references {row['references']:.4f}{warned}"


def accuracy(options, check, models, handles):
    """Return rows of models in a seeded order, until enough models are measured. The result is the same for any number
    of jobs.
    """
    order = random.Random(SEED).sample(models, len(models))
    rows, measured = [], 0
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as threads:
        for begin in range(0, len(order), options.jobs):
            some = order[begin:begin + options.jobs]
            for row in threads.map(lambda model: measure(options, check, model, handles), some):
                if measured == options.accuracy:
                    return rows
                measured += not row["skipped"]
                rows.append(row)
                print(f"accuracy: {row['name']} | {row['skipped'] or differences(row)}", flush=True)
    return rows


def numbers(rows):
    """Return the numbers of the summary under the names that --check uses."""
    measured = [row for row in rows if not row["skipped"]]
    rms = sorted(row["rms"] for row in measured)
    unwarned = [row["rms"] for row in measured if not row["warned"]]
    return {"accuracy_models": len(measured), "accuracy_rms_median": rms[len(rms) // 2] if rms else 0.0,
            "accuracy_rms_max": max(rms, default=0.0), "accuracy_over_goal": sum(value > RMS for value in rms),
            "accuracy_unwarned_models": len(unwarned), "accuracy_unwarned_rms_max": max(unwarned, default=0.0),
            "accuracy_unwarned_over_goal": sum(value > RMS for value in unwarned)}


def lines(rows, table):
    measured = sorted((row for row in rows if not row["skipped"]), key=lambda row: -row["rms"])
    skipped = [[row["name"], row["skipped"]] for row in rows if row["skipped"]]
    over = numbers(rows)["accuracy_over_goal"]
    text = ["## Accuracy", "",
            "Default weights against weights solved on well-shaped tets that conform to the surface (`tetrahedralize",
            "--method remesh`), for the same handles, at the surface's vertices. `rms` is over vertices and handles;",
            "`references` is that between the reference and a coarser one; `angle` is the smallest dihedral angle of the",
            "reference tets, degrees; `warned`: `bindpose weights` says that its lattice is too coarse; `leak` is the",
            "largest weight, on one separate part, of a handle of another.", "",
            f"Models measured: {len(measured)}; above the goal of {RMS:g} rms: {over}.", ""]
    text += table(["model", *COLUMNS], [[row["name"], *(row[column] for column in COLUMNS)] for row in measured])
    return [*text, "Left out:", "", *table(["model", "reason"], skipped)] if skipped else text
