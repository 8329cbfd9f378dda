#!/usr/bin/env python3
"""Measure waiting times of the window: the first picture of a sphere of 100,000 and of 500,000 triangles, and
the time from a click on Auto-rig until the shape can be dragged and until its weights are certified.

The machine must be quiet. Without a display the window runs under xvfb-run.
"""

import argparse
import json
import math
import pathlib
import statistics
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
CAMEL = ROOT / "build" / "tests" / "demo_meshes" / "data" / "meshes" / "camel.off"
LOOKS = 100  # number of screenshots after the click on Auto-rig
PAUSE = 0.2  # seconds between screenshots


def write_sphere(path, rings):
    """Write a sphere of `rings` rings of 2 `rings` points each; return its number of triangles."""
    around = 2 * rings
    points = [(0.0, 0.0, 1.0)]
    for i in range(1, rings + 1):
        polar = math.pi * i / (rings + 1)
        points += [(math.sin(polar) * math.cos(2 * math.pi * k / around),
                    math.sin(polar) * math.sin(2 * math.pi * k / around), math.cos(polar)) for k in range(around)]
    points.append((0.0, 0.0, -1.0))
    last = len(points) - 1
    triangles = []
    for k in range(around):
        following = (k + 1) % around
        triangles.append((0, 1 + k, 1 + following))
        triangles.append((last, last - around + following, last - around + k))
        for i in range(rings - 1):
            a, b = 1 + i * around + k, 1 + i * around + following
            triangles += [(a, a + around, b), (b, a + around, b + around)]
    with open(path, "w", encoding="ascii") as file:
        file.write(f"OFF\n{len(points)} {len(triangles)} 0\n")
        file.writelines(f"{x:.6f} {y:.6f} {z:.6f}\n" for x, y, z in points)
        file.writelines(f"3 {a} {b} {c}\n" for a, b, c in triangles)
    return len(triangles)


def play(program, folder, steps, *files):
    """Let the window perform the steps. Return the content of tour.json: durations, screenshots and values."""
    tour = folder / "tour_to_play.json"
    tour.write_text(json.dumps({"tour": {"schema": 1, "seconds": 600}, "steps": steps}))
    subprocess.run([program, "view", *files, "--play", tour, "--screenshot-dir", folder, "--overwrite"], check=True,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return json.loads((folder / "tour.json").read_text())


def first_picture(program, folder, rings, runs):
    mesh = folder / "sphere.off"
    count = write_sphere(mesh, rings)
    steps = [{"wait": "idle"}, {"screenshot": "first", "of": "view"}]
    seconds = sorted(play(program, folder, steps, mesh)["first_picture_seconds"] for _ in range(runs))
    print(f"first picture of {count:,} triangles: {seconds[0]:.2f} to {seconds[-1]:.2f} s, "
          f"median {statistics.median(seconds):.2f} s of {runs}")


def auto_rig(program, folder, mesh):
    steps = [{"open": str(mesh)}, {"wait": 1.0}, {"push": "Auto-rig"}]
    for k in range(LOOKS):
        steps += [{"wait": PAUSE}, {"screenshot": f"look{k}", "of": "view", "width": 100}]
    record = play(program, folder, steps)
    since_click, draggable, certified, values = None, None, None, {}
    for step in record["steps"]:
        if step["verb"] == "push":
            since_click = 0.0
        elif since_click is not None:
            since_click += step["seconds"]
        if step["verb"] == "screenshot":
            values = record["screenshots"][step["about"]]["values"]
            draggable = draggable or (since_click if values["bound"] else None)
            certified = certified or (since_click if values["bound"] and not values["binding"] else None)
    print(f"auto-rig of {mesh.name}, {values['triangles']:,} triangles, {values['handles']} handles: can be dragged after "
          f"{draggable:.1f} s, certified after {certified:.1f} s")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build" / "bin" / "bindpose")
    parser.add_argument("--mesh", type=pathlib.Path, default=CAMEL,
                        help="mesh for Auto-rig (default: camel.off of libcgal-demo)")
    parser.add_argument("--runs", type=int, default=5, help="number of runs for each first-picture time (default: 5)")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        for rings in (158, 354):
            first_picture(options.program, folder, rings, options.runs)
        auto_rig(options.program, folder, options.mesh.resolve())


if __name__ == "__main__":
    main()
