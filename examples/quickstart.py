#!/usr/bin/env python3
"""The main part of examples/quickstart.sh: from a mesh to posed shapes.

The script runs the `bindpose` program step by step and prints each command, so that users can repeat it. Then it
collects the reports in report.json. All files are written to a temporary folder, which replaces the output folder at
the end.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import pathlib
import shlex
import shutil
import signal
import subprocess
import sys
import tarfile
import tempfile
import time
from typing import Any

ROOT = pathlib.Path(__file__).resolve().parent.parent
DATA = ROOT / "examples" / "data"
DEMO_PACKAGE = "libcgal-demo"
DEMO_MESH = "elephant-with-holes.off"

Handle = tuple[str, int, Any, Any]  # name, kind, head, tail


class Stop(Exception):
    """Ends the quickstart with a message and an exit code."""

    def __init__(self, message: str, code: int = 2) -> None:
        super().__init__(message)
        self.code = code


def demo_mesh(folder: pathlib.Path, name: str = DEMO_MESH) -> pathlib.Path:
    """Return a mesh from the installed package's archive of example data."""
    target = folder / name
    if target.exists():
        return target
    folder.mkdir(parents=True, exist_ok=True)
    listed = subprocess.run(["dpkg", "-L", DEMO_PACKAGE], capture_output=True, text=True, check=False)
    archives = [line for line in listed.stdout.splitlines() if line.endswith("data.tar.gz")]
    with tempfile.TemporaryDirectory() as scratch:
        if archives and not os.path.exists(archives[0]):
            # The data of the Debian package is in /usr/share/doc. Minimal systems do not install this folder. In this
            # case, download and unpack the package.
            subprocess.run(["apt-get", "download", DEMO_PACKAGE], cwd=scratch, check=False,
                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            for package in pathlib.Path(scratch).glob("*.deb"):
                subprocess.run(["dpkg-deb", "-x", package, scratch], check=True)
            archives = [scratch + archives[0]]
        if not archives or not os.path.exists(archives[0]):
            raise Stop(f"the default mesh is in the Debian package {DEMO_PACKAGE}; install it or give a MESH")
        with tarfile.open(archives[0]) as archive:
            for member in archive:
                if member.name.endswith("/" + name):
                    partial = target.with_suffix(".partial")
                    source = archive.extractfile(member)
                    if source is None:
                        raise Stop(f"{member.name} in {archives[0]} is no file")
                    partial.write_bytes(source.read())
                    partial.rename(target)
                    return target
    raise Stop(f"{name} is not in {archives[0]}")


class Program:
    """Runs `bindpose` commands, prints them, and stores their reports."""

    def __init__(self, build: pathlib.Path, folder: pathlib.Path) -> None:
        self.path = build / "bin" / "bindpose"
        self.folder = folder
        self.reports: dict[str, dict[str, Any]] = {}
        self.child: subprocess.Popen[bytes] | None = None

    def end(self, *_: object) -> None:
        """Handle SIGTERM like Ctrl-C: send SIGINT to the child process and to this process, as a terminal does."""
        if self.child:
            self.child.send_signal(signal.SIGINT)
        signal.raise_signal(signal.SIGINT)

    def run(self, title: str, *words: object, report: str | None = None) -> dict[str, Any]:
        arguments = [str(word) for word in words]
        print(f"\n{title}\n  bindpose {shlex.join(arguments)}", flush=True)
        if report:
            arguments += ["--report", f".{report}.json"]
        child = self.child = subprocess.Popen([self.path, *arguments], cwd=self.folder)
        code = child.wait()
        self.child = None
        if report:
            path = self.folder / f".{report}.json"
            if path.exists():
                self.reports[report] = json.loads(path.read_text())
                path.unlink()
        if code == 3:
            print("  (not converged: the result is kept, its residuals are in report.json)")
        elif code != 0:
            raise Stop(f"'bindpose {arguments[0]}' ended with exit code {code}", code if code > 0 else 5)
        return self.reports.get(report, {}) if report else {}


def handle_list(bindpose: Any, path: pathlib.Path) -> list[Handle]:
    """Return (name, kind, head, tail) of the handles in a file, in the order of the weights' columns."""
    data = bindpose.read_handles(path)
    names = data.GetCellData().GetAbstractArray("HandleName")
    kinds = data.GetCellData().GetArray("HandleKind")
    handles = []
    for cell in range(data.GetNumberOfCells()):
        points = data.GetCell(cell).GetPoints()
        head = points.GetPoint(0)
        tail = points.GetPoint(points.GetNumberOfPoints() - 1)
        handles.append((names.GetValue(cell), int(kinds.GetValue(cell)), head, tail))
    return handles


def invented_poses(handles: list[Handle], diagonal: float, frames: int = 10) -> dict[str, Any]:
    """Return a swaying motion for handles without a pose: points move outwards and back, one after the other; bones
    swing about their heads, each in the frame of its parent."""
    middle = [sum(h[2][k] for h in handles) / len(handles) for k in range(3)]
    poses = []
    for frame in range(frames):
        turn = 2.0 * math.pi * frame / frames
        pose: dict[str, Any] = {}
        for number, (name, kind, head, _tail) in enumerate(handles):
            wave = 0.5 - 0.5 * math.cos(turn + 2.0 * math.pi * number / len(handles))
            if kind == 1:
                pose[name] = {"rotate": {"axis": [0, 0, 1], "degrees": 25.0 * math.sin(turn)}}
            else:
                out = [head[k] - middle[k] for k in range(3)]
                length = math.sqrt(sum(x * x for x in out)) or 1.0
                pose[name] = {"mode": "position", "translate": [0.12 * diagonal * wave * x / length for x in out]}
        poses.append({"handles": pose})
    return {"version": 2, "fps": 8, "frames": poses}


def diagonal_of(dataset: Any) -> float:
    b = dataset.GetBounds()
    return math.dist((b[0], b[2], b[4]), (b[1], b[3], b[5]))


def write_json(path: pathlib.Path, content: Any) -> None:
    partial = path.with_name(path.name + ".partial")
    partial.write_text(json.dumps(content, indent=2) + "\n")
    partial.rename(path)


def spread(count: int, wanted: int) -> list[int]:
    """Return at most `wanted` numbers of range(count), evenly spread."""
    if count <= wanted:
        return list(range(count))
    return sorted({round(k * (count - 1) / (wanted - 1)) for k in range(wanted)})


def main_job(options: argparse.Namespace, program: Program, bindpose: Any) -> tuple[pathlib.Path, list[str]]:
    folder = program.folder
    mesh = options.mesh.resolve() if options.mesh else demo_mesh(options.build / "demo-meshes")
    surface = bindpose.read(mesh)
    handles_from = options.handles or ("auto" if options.mesh else str(DATA / "elephant.tgf"))
    if handles_from.startswith("auto"):
        wanted = handles_from.partition(":")[2] or "8"
        if not wanted.isdigit() or int(wanted) < 1:
            raise Stop(f"--handles auto:N needs an integer N of at least 1 (got {wanted!r})", 1)
        bindpose.write(bindpose.farthest_point_handles(surface, int(wanted)), folder / "handles.vtp")
    else:
        bindpose.write(bindpose.read_handles(handles_from), folder / "handles.vtp")
    handles = handle_list(bindpose, folder / "handles.vtp")
    if options.pose:
        shutil.copyfile(options.pose, folder / "pose.json")
    elif handles_from == str(DATA / "elephant.tgf"):
        shutil.copyfile(DATA / "elephant_pose.json", folder / "pose.json")
    else:
        write_json(folder / "pose.json", invented_poses(handles, diagonal_of(surface)))

    program.run("Inspect the mesh.", "info", mesh, report="info")

    program.run("Compute the winding number on a grid: 1 inside, 0 outside.",
                "winding", mesh, "--resolution", "96", "-o", "winding.vti", report="winding")
    program.run("Draw a slice through the grid.", "render", "winding.vti", "-o", "winding.png")

    program.run("Fill the inside with tets.", "tetrahedralize", mesh, "-o", "tets.vtu", report="tetrahedralize")
    program.run("Draw a section through the tets.", "render", "tets.vtu", "-o", "tets.png")

    program.run("Compute smooth bounded weights, one function per handle.",
                "weights", mesh, "--handles", "handles.vtp", "-o", "weights.vtp", report="weights")
    pictures = []
    for number in spread(len(handles), 4):
        name = handles[number][0]
        picture = f"weights_{name}.png"
        program.run(f"Draw the weights of handle {name}.", "render", "weights.vtp", "--handles", "handles.vtp",
                    "--array", "Weights", "--component", name, "-o", picture)
        pictures.append(picture)

    frames = {}
    for method, stem in (("lbs", "posed_lbs"), ("reduced-arap", "posed_arap")):
        program.run(f"Pose the mesh with method {method}.", "deform", "weights.vtp", "--handles", "handles.vtp",
                    "--pose", "pose.json", "--method", method, "-o", f"{stem}.vtp", report=f"deform_{method}")
        frames[method] = sorted(p.name for p in folder.glob(f"{stem}*.vtp"))
    chosen = spread(len(frames["lbs"]), 8)
    tiles = [frames["lbs"][k] for k in chosen] + [frames["reduced-arap"][k] for k in chosen]
    labels = [f"{method} {k}" for method in frames for k in chosen]
    program.run("Draw all poses: linear blend skinning above, reduced as-rigid-as-possible below.",
                "render", *tiles, "--labels", ",".join(labels), "--columns", len(chosen), "--size", "2000x700",
                "-o", "poses.png")
    return mesh, pictures


def summary(options: argparse.Namespace, mesh: pathlib.Path, program: Program, pictures: list[str],
            seconds: float) -> None:
    reports = program.reports
    output = options.output
    tets, weights = reports.get("tetrahedralize", {}), reports.get("weights", {})
    pose = reports.get("deform_reduced-arap", {})
    print(f"\nDone in {seconds:.0f} s: {mesh.name} in {output}/")
    print(f"  winding.vti, winding.png     inside and outside, enclosed volume {reports['winding'].get('winding_volume', 0):.4g}")
    print(f"  tets.vtu, tets.png           {tets.get('counts', {}).get('tets', 0)} tets by {tets.get('method')}")
    print(f"  weights.vtp, {pictures[0]} …  certified to {weights.get('relative_gap', 0):.1e} (gap), "
          f"{weights.get('kkt_residual', 0):.1e} (residual)")
    print("  posed_lbs_*.vtp, posed_arap_*.vtp, poses.png"
          f"   {pose.get('microseconds_per_iteration', 0):.0f} µs per iteration")
    print("  handles.vtp, pose.json       edit them and run deform again")
    print("  report.json                  all reports")
    program_path = os.path.relpath(program.path)
    print("\nTry next:")
    print(f"  {program_path} deform {output}/weights.vtp --handles {output}/handles.vtp \\")
    print(f"    --pose {output}/pose.json --method dqs -o dqs.vtp")
    print(f"  {program_path} view {output}/weights.vtp {output}/handles.vtp")
    print(f"  {os.path.relpath(pathlib.Path(__file__).with_suffix('.sh'))} YOUR-MESH.obj --handles auto:12")


def main() -> None:
    parser = argparse.ArgumentParser(prog="quickstart.sh", add_help=False)
    parser.add_argument("mesh", nargs="?", type=pathlib.Path)
    parser.add_argument("--handles")
    parser.add_argument("--pose", type=pathlib.Path)
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("quickstart-output"))
    parser.add_argument("--headless", action="store_true")
    parser.add_argument("--build", type=pathlib.Path, required=True)
    options = parser.parse_args()
    if options.handles and not options.handles.startswith("auto"):
        options.handles = str(pathlib.Path(options.handles).resolve())
    for given in (options.mesh, options.pose, options.handles):
        if given and not str(given).startswith("auto") and not os.path.isfile(given):
            raise Stop(f"the file {given} does not exist")
    if options.output.exists() and not (options.output.is_dir() and
                                        ((options.output / "report.json").exists() or not any(options.output.iterdir()))):
        raise Stop(f"{options.output} already exists and was not written by this script; choose another --output")

    sys.path.insert(0, str(options.build / "lib" / "python3" / "dist-packages"))
    import bindpose  # pylint: disable=import-outside-toplevel,import-error

    start = time.monotonic()
    options.output.absolute().parent.mkdir(parents=True, exist_ok=True)
    staging = pathlib.Path(tempfile.mkdtemp(prefix=f".{options.output.name}-", dir=options.output.absolute().parent))
    staging.chmod(0o755)
    program = Program(options.build, staging)
    signal.signal(signal.SIGTERM, program.end)
    try:
        mesh, pictures = main_job(options, program, bindpose)
        write_json(staging / "report.json", {"mesh": mesh.name, "seconds": round(time.monotonic() - start, 2), **program.reports})
        if options.output.exists():
            shutil.rmtree(options.output)
        staging.rename(options.output)
    except KeyboardInterrupt:
        if program.child:
            program.child.wait()
        raise Stop("canceled; nothing was written", 4) from None
    except bindpose.BindposeError as error:
        raise Stop(str(error)) from None
    finally:
        shutil.rmtree(staging, ignore_errors=True)
    program.folder = options.output
    summary(options, mesh, program, pictures, time.monotonic() - start)
    if os.environ.get("DISPLAY") and not options.headless:
        print("\nOpening the viewer (close its window to end) …", flush=True)
        subprocess.run([program.path, "view", options.output / "weights.vtp", options.output / "handles.vtp"], check=False)


if __name__ == "__main__":
    try:
        main()
    except Stop as stop:
        print(f"quickstart.sh: {stop}", file=sys.stderr)
        sys.exit(stop.code)
