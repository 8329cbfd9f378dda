#!/usr/bin/env python3
"""Every surface of the Debian package libcgal-demo through `bindpose tetrahedralize`.

Prints a table (method, tets, seconds, volume beside the winding number's, smallest dihedral angle) and
fails where the program crashes, hangs, or claims tets that do not hold the volume: more than 10 % off
without the warning that says so, or by a factor of two at all. A surface that encloses nothing may be
refused with a sentence.
"""

import argparse
import json
import pathlib
import subprocess
import sys
import tarfile
import tempfile
import time

ARCHIVE = pathlib.Path("/usr/share/doc/libcgal-dev/data.tar.gz")
SECONDS = 120


def has_faces(path):
    words = []
    for line in path.read_text(errors="replace").splitlines():
        words += line.split("#")[0].split()
        if len(words) >= 4:
            break
    return len(words) >= 3 and words[0].endswith("OFF") and words[2].isdigit() and int(words[2]) > 0


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--build", type=pathlib.Path, required=True)
    parser.add_argument("--largest", type=int, default=20_000_000, help="bytes; larger files are left out")
    options = parser.parse_args()
    program = options.build.resolve() / "bin" / "bindpose"
    if not ARCHIVE.exists():
        print(f"{ARCHIVE} is missing: install libcgal-demo")
        return 1
    failures, made, warned, refused = [], 0, 0, 0
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)
        with tarfile.open(ARCHIVE) as archive:
            archive.extractall(scratch, members=[m for m in archive if m.name.endswith(".off") and m.isfile()])
        meshes = sorted(p for p in scratch.rglob("*.off") if has_faces(p) and p.stat().st_size <= options.largest)
        print(f"{'surface':44} {'method':8} {'tets':>8} {'s':>6} {'volume':>11} {'winding':>11} {'angle':>6}")
        for mesh in meshes:
            name = mesh.relative_to(scratch).as_posix().replace("data/", "", 1)
            start = time.monotonic()
            try:
                run = subprocess.run(
                    [program, "tetrahedralize", mesh, "-o", scratch / "out.vtu", "--overwrite", "--quiet", "--report", "-"],
                    capture_output=True, text=True, timeout=2 * SECONDS, check=False)
            except subprocess.TimeoutExpired:
                failures.append(f"{name}: no answer in {2 * SECONDS} s")
                print(f"{name:44} hangs")
                continue
            seconds = time.monotonic() - start
            if run.returncode == 0:
                report = json.loads(run.stdout)
                volume, winding = report["volume"], report["winding_volume"]
                made += 1
                print(f"{name:44} {report['method']:8} {report['counts']['tets']:8} {seconds:6.1f} {volume:11.4g} "
                      f"{winding:11.4g} {report.get('min_dihedral_angle', float('nan')):6.2f}", flush=True)
                told = any("but the winding number encloses" in w for w in report.get("warnings", []))
                off_by_10_percent = not 0.9 <= volume / winding <= 1.1
                warned += off_by_10_percent and told
                if (off_by_10_percent and not told) or not 0.5 <= volume / winding <= 2.0:
                    failures.append(f"{name}: volume {volume:g}, but the winding number encloses {winding:g}")
            else:
                refused += 1
                sentence = run.stderr.strip()
                print(f"{name:44} exit {run.returncode}, {seconds:.1f} s: {sentence}", flush=True)
                if run.returncode != 2 or sentence.count("\n") or not sentence:
                    failures.append(f"{name}: exit {run.returncode}: {sentence}")
    print(f"{len(meshes)} surfaces: {made} meshed ({warned} with a volume off by 10 % and a warning), {refused} refused with a sentence, {len(failures)} failures")
    for failure in failures:
        print("  " + failure)
    return 1 if failures or not meshes else 0


if __name__ == "__main__":
    sys.exit(main())
