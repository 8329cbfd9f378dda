#!/usr/bin/env python3
"""Run `bindpose tetrahedralize` on every surface of the Debian package libcgal-demo and on the synthetic surfaces of
horrors.py.

The script prints a table and summary lines for each requested method. If requested, it writes a summary as markdown and
all rows as CSV. It fails if a result is wrong:
- the program crashes or hangs, or takes more than 120 s for up to 100,000 triangles;
- a tet is flat, inverted or duplicated, or the boundary is not closed;
- the volume is wrong and no warning reports it;
- the program refuses a surface that encloses a volume;
- a point of the surface is outside of the tets (method embed only).
Only remesh may refuse a surface because the enclosed volume is too thin for its tets.

The script reads the tets from the output file and checks them with its own code. To check a refusal, the script
evaluates `bindpose winding` at four million points.
"""

import argparse
import collections
import csv
import dataclasses
import json
import math
import pathlib
import subprocess
import sys
import tarfile
import tempfile
import time

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

import horrors

ARCHIVE = pathlib.Path("/usr/share/doc/libcgal-dev/data.tar.gz")
SECONDS = 120
TRIANGLES = 100_000  # the time limit SECONDS applies to surfaces with at most this many triangles
SPECK = 1e-6  # fraction of the bounding box; a volume below this may be missed
DEFECTS = ["duplicate_vertices", "degenerate_triangles", "duplicate_triangles", "boundary_edges", "nonmanifold_edges",
           "misoriented_edges", "inward_components", "self_intersections", "triangulated_cells"]
FACETS = np.array([[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]])


@dataclasses.dataclass
class Surface:
    name: str
    path: pathlib.Path
    horror: horrors.Horror = None  # None for a real surface


@dataclasses.dataclass
class Row:
    """Result of one method for one surface."""

    surface: Surface
    seconds: float
    code: int
    sentence: str = ""
    report: dict = dataclasses.field(default_factory=dict)
    broken: list = dataclasses.field(default_factory=list)  # list of str: one sentence per failed check

    @property
    def tries(self):
        """Number of meshing attempts that failed before an attempt succeeded."""
        return sum(rung["outcome"] != "ok" and not rung["name"].startswith(("vertices inside", "graph cut"))
                   for rung in self.report.get("rungs", []))

    @property
    def answered(self):
        return self.code == 0

    @property
    def too_thin(self):
        """True if the method refused the surface as too thin. Another method may still succeed."""
        return self.code == 2 and "too thin" in self.sentence

    @property
    def rung(self):
        return self.report.get("method", "") if self.answered else "-"

    @property
    def triangles(self):
        return self.report.get("counts", {}).get("triangles", 0)

    @property
    def volume_error(self):
        winding = self.report.get("winding_volume", 0)
        return 100 * (self.report["volume"] / winding - 1) if self.answered and winding > 0 else math.nan

    def cells(self):
        def number(value, pattern):
            return "-" if value is None or math.isnan(value) else format(value, pattern)
        get = self.report.get if self.answered else lambda key, default=None: default
        tets = get("counts", {}).get("tets")
        return [self.surface.name, str(self.triangles or "-"), self.rung, str(self.tries), str(tets or "-"),
                f"{self.seconds:.1f}", number(self.volume_error if self.rung != "embed" else None, "+.2f"),
                number(get("distance_max"), ".3f"), number(get("distance_mean"), ".4f"),
                number(get("min_dihedral_angle"), ".1f")]


SHOWN = 10  # number of rows in the markdown file
HEADS = ["surface", "triangles", "rung", "left", "tets", "s", "volume %", "far %", "mean %", "angle"]


# ---- Surfaces --------------------------------------------------------------------------------------


def has_faces(path):
    words = []
    for line in path.read_text(errors="replace").splitlines():
        words += line.split("#")[0].split()
        if len(words) >= 4:
            break
    return len(words) >= 3 and words[0].endswith("OFF") and words[2].isdigit() and int(words[2]) > 0


def real_surfaces(folder, largest):
    with tarfile.open(ARCHIVE) as archive:
        archive.extractall(folder, members=[m for m in archive if m.name.endswith(".off") and m.isfile()])
    return [Surface(path.relative_to(folder).as_posix().replace("data/", "", 1).replace("meshes/", "", 1), path)
            for path in sorted(folder.rglob("*.off")) if has_faces(path) and path.stat().st_size <= largest]


def synthetic_surfaces(folder):
    folder.mkdir()
    return [Surface(name, folder / f"{name}.off", horror) for name, horror in horrors.write_all(folder).items()]


# ---- Independent checks ----------------------------------------------------------------------------


def read_tets(path):
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    grid = reader.GetOutput()
    return grid, vtk_to_numpy(grid.GetPoints().GetData()).astype(float), vtk_to_numpy(
        grid.GetCells().GetConnectivityArray()).reshape(-1, 4)


def volumes_of(points, tets):
    a, b, c, d = (points[tets[:, k]] for k in range(4))
    return np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a) / 6


def open_edges(tets):
    """Return 0 if the boundary's triangles have opposite directions at every edge, -1 if more than two tets share a
    facet, and a positive number otherwise.
    """
    facets = tets[:, FACETS].reshape(-1, 3)
    _, first, count = np.unique(np.sort(facets, axis=1), axis=0, return_index=True, return_counts=True)
    if count.max() > 2:
        return -1
    skin = facets[first[count == 1]].astype(np.int64)
    edges = np.vstack([skin[:, [0, 1]], skin[:, [1, 2]], skin[:, [2, 0]]])
    size = int(tets.max()) + 1
    forward, backward = edges[:, 0] * size + edges[:, 1], edges[:, 1] * size + edges[:, 0]
    keys, counts = np.unique(forward, return_counts=True)
    back, back_counts = np.unique(backward, return_counts=True)
    return 0 if np.array_equal(keys, back) and np.array_equal(counts, back_counts) else int(
        np.setxor1d(keys, back).size) or 1


def read_off(mesh):
    """Read vertices and faces, and split each face into a fan of triangles. Each vertex or face is one line of the file.
    Colors and normals at the end of a line are ignored."""
    lines = [words for words in (line.split("#")[0].split() for line in mesh.read_text(errors="replace").splitlines()) if words]
    head = lines[0][1:] or lines.pop(1)
    vertices, faces = int(head[0]), int(head[1])
    points = np.array([words[:3] for words in lines[1:1 + vertices]], float)
    triangles = []
    for words in lines[1 + vertices:1 + vertices + faces]:
        ids = [int(word) for word in words[1:1 + int(words[0])]]
        triangles += [(ids[0], a, b) for a, b in zip(ids[1:-1], ids[2:])]
    return points, np.array(triangles).reshape(-1, 3)


def used_points(mesh):
    points, triangles = read_off(mesh)
    return points[np.unique(triangles)]


def outside(grid, points):
    """Count the points that are in no cell of the grid."""
    data = vtk.vtkPolyData()
    holder = vtk.vtkPoints()
    holder.SetData(numpy_to_vtk(np.ascontiguousarray(points), deep=True))
    data.SetPoints(holder)
    probe = vtk.vtkProbeFilter()
    probe.SetInputData(data)
    probe.SetSourceData(grid)
    probe.Update()
    return int((vtk_to_numpy(probe.GetOutput().GetPointData().GetArray("vtkValidPointMask")) == 0).sum())


def broken_tets(row, path, method):
    grid, points, tets = read_tets(path)
    volumes = volumes_of(points, tets)
    report, broken = row.report, []
    if not volumes.min() > 0:
        broken.append(f"a tet of volume {volumes.min():g}")
    if len(np.unique(np.sort(tets, axis=1), axis=0)) < len(tets):
        broken.append("a tet is there twice")
    if abs(volumes.sum() - report["volume"]) > 1e-9 * report["volume"]:
        broken.append(f"the report's volume is {report['volume']:g}, that of the file {volumes.sum():g}")
    if method == "embed":
        if report["min_dihedral_angle"] < 30:
            broken.append(f"a dihedral angle of {report['min_dihedral_angle']:g} degrees")
        missed = outside(grid, used_points(row.surface.path))
        if missed:
            broken.append(f"{missed} points of the surface lie in no tet")
        return broken
    if open_edges(tets) != 0:
        broken.append("the boundary is not closed")
    return broken


def broken_volume(row):
    report = row.report
    volume, winding = report["volume"], report["winding_volume"]
    warned = any("enclosed volume by winding number" in warning for warning in report.get("warnings", []))
    ratio = volume / winding if winding > 0 else math.inf
    if (not 0.9 <= ratio <= 1.1 and not warned) or not 0.5 <= ratio <= 2.0:
        return [f"volume {volume:g}, but the winding number encloses {winding:g}"]
    broken = []
    # Only clean triangle meshes are compared, because polygons can be triangulated in more than one way.
    if row.rung == "cdt" and not any(report["counts"].get(defect) for defect in DEFECTS) and report["counts"]["components"] == 1:
        true = horrors.volume(read_off(row.surface.path))
        if abs(volume / true - 1) > 1e-10:
            broken.append(f"volume {volume:.15g}, by the divergence theorem {true:.15g}")
    horror = row.surface.horror
    if horror and horror.volume and row.rung == "cdt" and abs(volume / horror.volume - 1) > horror.tolerance:
        broken.append(f"volume {volume:.12g}, known to be {horror.volume:.12g}")
    if horror and horror.encloses is False:
        broken.append("tets of a surface that encloses nothing")
    return broken


def enclosed_share(program, mesh, folder):
    """Return the fraction of four million sample points in the bounding box whose winding number is at least 0.5. If more
    points have a winding number of at most -0.5, return the fraction of those points."""
    points = used_points(mesh)
    lower, size = points.min(axis=0), np.ptp(points, axis=0)
    if not size.min() > 0:
        return 0.0
    step = np.array([0.8191725133961645, 0.6710436067037893, 0.5497004779019703])
    count = 4_000_000
    holder = vtk.vtkPoints()
    holder.SetData(numpy_to_vtk(lower + size * np.modf(0.31 + np.arange(1, count + 1)[:, None] * step)[0], deep=True))
    data = vtk.vtkPolyData()
    data.SetPoints(holder)
    writer = vtk.vtkXMLPolyDataWriter()
    writer.SetFileName(str(folder / "samples.vtp"))
    writer.SetInputData(data)
    writer.SetCompressorTypeToNone()
    writer.Write()
    # Winding numbers of closed surfaces are integers, so the threshold 0.5 is unambiguous.
    subprocess.run([program, "winding", mesh, "--points", folder / "samples.vtp", "--orient-patches", "-o",
                    folder / "w.vtp", "--overwrite", "--quiet"], check=True, timeout=600)
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(str(folder / "w.vtp"))
    reader.Update()
    winding = vtk_to_numpy(reader.GetOutput().GetPointData().GetArray("WindingNumber"))
    return max((winding >= 0.5).sum(), (winding <= -0.5).sum()) / count


# ---- One run ---------------------------------------------------------------------------------------


def run(program, surface, method, folder):
    output = folder / "out.vtu"
    before = set(folder.iterdir()) | {output}
    start = time.monotonic()
    try:
        done = subprocess.run([program, "tetrahedralize", surface.path, "--method", method, "-o", output, "--overwrite",
                               "--quiet", "--report", "-"], capture_output=True, text=True, timeout=2 * SECONDS, check=False)
    except subprocess.TimeoutExpired:
        return Row(surface, 2 * SECONDS, -1, broken=[f"no answer in {2 * SECONDS} s"])
    row = Row(surface, time.monotonic() - start, done.returncode, done.stderr.strip())
    try:
        row.report = json.loads(done.stdout)
    except ValueError:
        row.broken.append("no report")
        return row
    if row.answered:
        row.broken += broken_tets(row, output, method)
        row.broken += broken_volume(row) if method != "embed" else []
    else:
        row.broken += broken_refusal(program, row, method, folder)
    if row.seconds > SECONDS and row.triangles <= TRIANGLES:
        row.broken.append(f"{row.seconds:.0f} s")
    left = set(folder.iterdir()) - before - {folder / "samples.vtp", folder / "w.vtp"}
    if left:
        row.broken.append("left behind: " + ", ".join(path.name for path in left))
    return row


def broken_refusal(program, row, method, folder):
    """Check a refusal. Methods cdt and remesh may fail (exit code 5), and method remesh may report that the volume is too
    thin. Method embed must never refuse. Any other refusal is justified only if the surface encloses nothing.
    """
    broken = []
    if "\n" in row.sentence or not row.sentence or row.code not in (2, 5):
        broken.append(f"exit {row.code}: {row.sentence}")
    elif method == "embed":
        broken.append("no embedding")
    elif method == "auto" or (row.code == 2 and not (method == "remesh" and row.too_thin)):
        share = enclosed_share(program, row.surface.path, folder)
        if share > SPECK:
            broken.append(f"refused, but {share:.2g} of its box is enclosed: {row.sentence}")
    return broken


# ---- Tables ----------------------------------------------------------------------------------------


def share_text(count, total, goal=None):
    text = f"{count} of {total} ({100 * count / total:.1f} %" if total else "0 of 0 ("
    return text + (f", goal {goal})" if goal else ")")


def summary(method, rows, surfaces):
    answered = [row for row in rows if row.answered]
    thin = [row for row in rows if method == "remesh" and row.too_thin]
    refused = [row for row in rows if row.code == 2 and row not in thin]
    worth = [row for row in rows if row not in refused]  # refused surfaces enclose no volume and are not counted
    slowest = max(rows, key=lambda row: row.seconds)
    angles = [row.report["min_dihedral_angle"] for row in answered]
    lines = [f"{len(rows)} surfaces ({surfaces}): {len(answered)} answered, {len(refused)} refused, "
             f"{sum(bool(row.broken) for row in rows)} with a broken promise"]
    if method in ("auto", "cdt"):
        cdt = [row for row in answered if row.rung == "cdt"]
        at_once = sum(row.tries == 0 for row in cdt)
        lines += [f"rung 1 at once: {share_text(at_once, len(worth), '95 %')}",
                  f"rung 1 with its retries: {share_text(len(cdt), len(worth), '99 %')}"]
    if method == "auto":
        lines += [f"remesh: {share_text(sum(row.rung == 'remesh' for row in answered), len(worth))}",
                  f"cdt or remesh: {share_text(len(answered), len(worth), '100 %')}"]
    else:
        total = rows if method == "embed" else worth
        lines.append(f"answered: {share_text(len(answered), len(total), '100 %' if method == 'embed' else None)}")
    if method == "remesh":
        lines.append(f"refused as too thin: {len(thin)}" + "".join(f", {row.surface.name}" for row in thin))
    if method != "embed":
        lines.append("refused because nothing is enclosed: " + (", ".join(row.surface.name for row in refused) or "none"))
        warned = [row.surface.name for row in answered if not abs(row.volume_error) <= 10]
        lines.append("volume off by more than 10 %, with a warning: " + (", ".join(warned) or "none"))
    else:
        lines.append(f"points of the surface outside: {sum('lie in no tet' in text for row in rows for text in row.broken)} "
                     "surfaces (goal 0)")
    lines.append(f"worst dihedral angle: {min(angles):.2f} degrees, median {np.median(angles):.1f}" if angles else "no tets")
    lines.append(f"slowest: {slowest.surface.name}, {slowest.seconds:.1f} s; all: {sum(row.seconds for row in rows):.0f} s")
    if method == "embed":
        large = [row for row in answered if 5e4 <= row.triangles <= 1.5e5]
        lines += [f"{row.surface.name}, {row.triangles} triangles: {row.report['seconds']['total']:.2f} s (goal 1 s at 100,000)"
                  for row in large]
    return lines


def as_text(cells):
    widths = [44, 9, 6, 4, 8, 6, 9, 7, 8, 6]
    return " ".join(cell.ljust(w) if k in (0, 2) else cell.rjust(w) for k, (cell, w) in enumerate(zip(cells, widths)))


def percentiles(name, values):
    middle, high, highest = np.percentile(values, [50, 95, 100])
    return f"| {name} | {middle:.3g} | {high:.3g} | {highest:.3g} |"


def as_markdown(results, command):
    lines = ["# Every surface to tets", "", "Measured by", "", f"    {command}", "",
             "on a machine with 2 cores. `--csv FILE` writes a row for each surface. The seconds are those of the whole program, from",
             "reading to writing. Columns: *rung*, the method that succeeded; *left*, the number of attempts that failed before;",
             "*volume %*, the difference of the tets' volume from that of {winding number >= 0.5}, which is sampled to about 1 % for",
             "unclean surfaces; *far* and *mean*, the distance to the surface in % of its diagonal, if the method measures it (remesh;",
             "cdt keeps the triangles); *angle*, the smallest dihedral angle in degrees."]
    for method, (rows, text) in results.items():
        answered = [row for row in rows if row.answered]
        lines += ["", f"## --method {method}", "", *(f"- {line}" for line in text), "",
                  "| | median | 95 % | largest |", "|---|--:|--:|--:|",
                  percentiles("seconds", [row.seconds for row in rows])]
        if answered:
            lines.append(percentiles("tets per triangle", [row.report["counts"]["tets"] / row.triangles for row in answered]))
        lines += ["", f"The {SHOWN} slowest:", "", "| " + " | ".join(HEADS) + " |", "|---|--:|---|" + "--:|" * 7]
        lines += ["| " + " | ".join(row.cells()) + " |" for row in sorted(rows, key=lambda row: -row.seconds)[:SHOWN]]
        sentences = collections.defaultdict(list)
        for row in rows:
            if not row.answered:
                sentences[row.sentence.removeprefix("bindpose tetrahedralize: ")].append(row.surface.name)
        lines += ["", "Refusals:" if sentences else "No refusals.", "",
                  *(f"- {', '.join(names)}: {sentence}" for sentence, names in sentences.items())]
    return "\n".join(lines).rstrip() + "\n"


def write_csv(path, results):
    with open(path, "w", newline="", encoding="utf-8") as file:
        table = csv.writer(file)
        table.writerow(["method", *HEADS, "exit", "sentence"])
        for method, (rows, _) in results.items():
            table.writerows([method, *row.cells(), row.code, row.sentence] for row in rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, required=True)
    parser.add_argument("--method", action="append", choices=["auto", "cdt", "remesh", "embed"],
                        help="may be given several times (default: auto)")
    parser.add_argument("--only", default="", help="surfaces whose names contain this")
    parser.add_argument("--largest", type=int, default=20_000_000, help="bytes; larger files are left out")
    parser.add_argument("--markdown", type=pathlib.Path, help="write the summary to this file, too")
    parser.add_argument("--csv", type=pathlib.Path, help="write a row for each surface and method to this file")
    options = parser.parse_args()
    program = options.build.resolve() / "bin" / "bindpose"
    if not ARCHIVE.exists():
        print(f"{ARCHIVE} is missing: install libcgal-demo")
        return 1
    results, failures = collections.OrderedDict(), 0
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)
        surfaces = real_surfaces(scratch / "real", options.largest) + synthetic_surfaces(scratch / "horrors")
        surfaces = [surface for surface in surfaces if options.only in surface.name]
        kinds = f"{sum(not s.horror for s in surfaces)} real, {sum(bool(s.horror) for s in surfaces)} synthetic"
        for method in options.method or ["auto"]:
            print(f"\n--method {method}\n{as_text(HEADS)}")
            rows = []
            for surface in surfaces:
                row = run(program, surface, method, scratch)
                rows.append(row)
                print(as_text(row.cells()) + ("" if row.answered else f"  exit {row.code}: {row.sentence}"), flush=True)
                for text in row.broken:
                    print(f"    BROKEN: {text}", flush=True)
            results[method] = (rows, summary(method, rows, kinds) if rows else ["no surfaces"])
            failures += sum(bool(row.broken) for row in rows) + (not rows)
    for method, (rows, text) in results.items():
        print(f"\n--method {method}")
        print("\n".join("  " + line for line in text))
        print("\n".join(f"  BROKEN {row.surface.name}: {text}" for row in rows for text in row.broken))
    if options.csv:
        write_csv(options.csv, results)
    if options.markdown:
        words = " ".join(f"--method {method}" for method in results)
        options.markdown.write_text(as_markdown(results, f"/usr/bin/python3 tests/support/all_surfaces.py --build build {words}"))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
