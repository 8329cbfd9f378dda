#!/usr/bin/env python3
"""Compare the time of `bindpose tetrahedralize` with TetGen alone (plain_tetgen.cpp, compiled here).

The script prints four tables:
1. clean closed surfaces, with the time of TetGen for the same switches. The volume of the tets is compared with the
   volume that the divergence theorem gives for the surface;
2. unclean surfaces of about 50,000 triangles;
3. embeddings of surfaces of about 100,000 triangles;
4. two surfaces of a million triangles.

The script fails if the program fails. The time of Bindpose in seconds is that of its report (diagnosis, winding numbers,
meshing, checks), without reading and writing. The time of TetGen is that of the call. Runs of the two programs alternate,
so that other load on the machine affects them equally. The script compares medians.
"""

import argparse
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile

import horrors
from all_surfaces import ARCHIVE, read_off, real_surfaces

HERE = pathlib.Path(__file__).resolve().parent
CLEAN = ["elephant.off", "bunny00.off", "refined_elephant.off"]
WORK = ["repair", "winding", "tetrahedralize", "check"]


def compile_tetgen(folder):
    program = folder / "plain_tetgen"
    subprocess.run(["g++", "-O2", HERE / "plain_tetgen.cpp", "-ltet", "-o", program], check=True)
    return program


def tetgen(program, surface, switches):
    done = subprocess.run([program, surface, switches], capture_output=True, text=True, check=True)
    words = done.stdout.split("seconds")[-1].split()
    return float(words[0]), int(words[2]), float(words[4])


def bindpose(program, surface, folder, *words):
    done = subprocess.run([program, "tetrahedralize", surface, "-o", folder / "out.vtu", "--overwrite", "--quiet",
                           "--report", "-", *words], capture_output=True, text=True, check=True)
    report = json.loads(done.stdout)
    return sum(report["seconds"].get(phase, 0.0) for phase in WORK), report


def repeated(options, surface, folder, *words):
    """Run the program repeatedly. Return the seconds and the reports of all runs."""
    return zip(*(bindpose(options.program, surface, folder, *words) for _ in range(options.runs)))


def spread(seconds):
    return f"{statistics.median(seconds):.2f} ({min(seconds):.2f} to {max(seconds):.2f})"


def volume_bound(mesh):
    """Return the largest volume of a tet that interior_edge = 0.04 allows; see CdtTets::volume_bound."""
    points, faces = mesh
    edges = [((points[faces[:, k]] - points[faces[:, (k + 1) % 3]])**2).sum(axis=1)**0.5 for k in range(3)]
    diagonal = ((points.max(axis=0) - points.min(axis=0))**2).sum()**0.5
    return 0.11785113019775793 * max(0.04 * diagonal, float(sum(edges).mean()) / 9)**3


def clean_table(options, surfaces, plain, scratch):
    rows = [["clean surface", "triangles", "inside", "TetGen s", "Bindpose s", "ratio", "volume error"]]
    for name, path in surfaces.items():
        mesh = read_off(path)
        true = horrors.volume(mesh)
        for inside, switches, words in (
                ("as it is", "pYQ", ["--bare"]),
                ("filled", f"pYq1.414/10a{volume_bound(mesh):.9g}Q", ["--interior-edge", "0.04"])):
            alone, ours, report = [], [], {}
            for _ in range(options.runs):
                alone.append(tetgen(plain, path, switches)[0])
                seconds, report = bindpose(options.program, path, scratch, *words)
                ours.append(seconds)
            ratio = statistics.median(ours) / statistics.median(alone)
            rows.append([name, str(len(mesh[1])), inside, spread(alone), spread(ours), f"{ratio:.2f}",
                         f"{abs(report['volume'] / true - 1):.1e}"])
            print(rows[-1], flush=True)
    return rows


def unclean_table(options, surfaces, scratch):
    rows = [["unclean surface", "triangles", "rung", "tets", "s", "volume %"]]
    for name, path in surfaces.items():
        ours, reports = repeated(options, path, scratch)
        report = reports[-1]
        rows.append([name, str(report["counts"]["triangles"]), report["method"], str(report["counts"]["tets"]), spread(ours),
                     f"{100 * (report['volume'] / report['winding_volume'] - 1):+.2f}"])
        print(rows[-1], flush=True)
    return rows


def embed_table(options, surfaces, scratch):
    rows = [["embedded surface", "triangles", "tets", "s", "of it embedding", "angle"]]
    for name, path in surfaces.items():
        ours, reports = repeated(options, path, scratch, "--method", "embed")
        inner = [report["seconds"]["tetrahedralize"] for report in reports]
        report = reports[-1]
        rows.append([name, str(report["counts"]["triangles"]), str(report["counts"]["tets"]), spread(ours), spread(inner),
                     f"{report['min_dihedral_angle']:.0f}"])
        print(rows[-1], flush=True)
    return rows


def million_table(options, surfaces, scratch):
    rows = [["a million triangles", "triangles", "rung", "tets", "s", "MiB"]]
    for name, path in surfaces.items():
        seconds, report = bindpose(options.program, path, scratch)
        rows.append([name, str(report["counts"]["triangles"]), report["method"], str(report["counts"]["tets"]),
                     f"{seconds:.1f}", str(report["peak_memory_bytes"] >> 20)])
        print(rows[-1], flush=True)
    return rows


def made(folder, **meshes):
    for name, mesh in meshes.items():
        horrors.write_off(folder / f"{name}.off", *mesh)
    return {name: folder / f"{name}.off" for name in meshes}


def as_markdown(tables, command, runs):
    lines = ["# Seconds for tets", "", "Measured by", "", f"    {command}", "",
             f"as median (shortest to longest) of {runs} runs on a machine with 2 cores that others used, too. Both programs took",
             "turns: compare the ratios, not the seconds."]
    for rows in tables:
        lines += ["", "| " + " | ".join(rows[0]) + " |", "|---" * len(rows[0]) + "|"]
        lines += ["| " + " | ".join(row) + " |" for row in rows[1:]]
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, required=True)
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--table", action="append", choices=["clean", "unclean", "embed", "million"], help="default: all")
    parser.add_argument("--markdown", type=pathlib.Path, help="write the tables to this file, too")
    options = parser.parse_args()
    options.program = options.build.resolve() / "bin" / "bindpose"
    wanted = options.table or ["clean", "unclean", "embed", "million"]
    if not ARCHIVE.exists():
        print(f"{ARCHIVE} is missing: install libcgal-demo")
        return 1
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)
        real = {surface.name: surface.path for surface in real_surfaces(scratch, 20_000_000)}
        elephant, armadillo = read_off(real["refined_elephant.off"]), read_off(real["armadillo.off"])
        size = armadillo[0].max() - armadillo[0].min()
        tables = []
        if "clean" in wanted:
            surfaces = {name: real[name] for name in CLEAN}
            surfaces.update(made(scratch, torus=horrors.torus(250, 100), sphere=horrors.sphere(5)))
            tables.append(clean_table(options, surfaces, compile_tetgen(scratch), scratch))
        if "unclean" in wanted:
            holes = armadillo[0], armadillo[1][~horrors.chosen(armadillo, 0.2, 1)]
            turned = armadillo[1].copy()
            mask = horrors.chosen(armadillo, 0.2, 2)
            turned[mask] = turned[mask, ::-1]
            surfaces = {"armadillo.off": real["armadillo.off"]}
            surfaces.update(made(
                scratch, a_fifth_removed=holes, a_fifth_flipped=(armadillo[0], turned), loose=horrors.unwelded(armadillo),
                jittered=horrors.jittered(armadillo, 1e-3 * size, 3),
                two_tori_cross=horrors.join(horrors.torus(160, 80), horrors.moved(horrors.torus(160, 80), 0.9, 0.1, 0.05))))
            tables.append(unclean_table(options, surfaces, scratch))
        if "embed" in wanted:
            surfaces = {name: real[name] for name in ["armadillo.off", "bunny00.off", "refined_elephant.off"]}
            surfaces.update(made(scratch, torus=horrors.torus(250, 200), crossing=horrors.join(
                horrors.torus(200, 125), horrors.moved(horrors.torus(200, 125), 0.9, 0.1, 0.05))))
            surfaces.update(made(scratch, loose=horrors.unwelded(elephant)))
            tables.append(embed_table(options, surfaces, scratch))
        if "million" in wanted:
            million = horrors.torus(1000, 500)
            tables.append(million_table(options, made(scratch, torus=million, loose=horrors.unwelded(million)), scratch))
    if options.markdown:
        options.markdown.write_text(as_markdown(tables, f"/usr/bin/python3 tests/support/measure_tets.py --build build --runs {options.runs}", options.runs))
    return 0


if __name__ == "__main__":
    sys.exit(main())
