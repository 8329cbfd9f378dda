#!/usr/bin/env python3
"""Check the weights that `bindpose weights` computes for real surfaces.

The script uses twenty surfaces of the Debian package libcgal-demo, with fifteen handles spread over each surface. It
computes bounded biharmonic weights with a default and with a tight tolerance, and monotone weights with the default
tolerance. The certificate in the report, which is computed only from the data of the problem, must be within the
tolerance. The script also checks the content of the output file. It exits with 1 if a check fails.
"""

import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

from all_surfaces import real_surfaces

HANDLES = 15
# The surfaces are small enough for one hour in total. They are of all types: closed, open, with sharp edges, of higher
# genus, and with several parts.
SURFACES = ["anchor.off", "armadillo.off", "bear.off", "cactus.off", "couplingdown.off", "cow.off", "cross.off", "dragknob.off",
            "elephant.off", "elephant-with-holes.off", "hand.off", "handle.off", "helmet.off", "homer.off", "joint.off",
            "knot1.off", "knot2.off", "man.off", "mushroom.off", "pig.off", "pinion.off", "pipe.off", "rotor.off", "sphere.off",
            "star.off", "triceratops.off"]
WANTED = 20
CASES = [("bounded-biharmonic", "default"), ("monotone", "default"), ("bounded-biharmonic", "tight")]
TOLERANCES = {"default": 1e-6, "tight": 1e-9}


def weights(program, surface, method, certificate, out):
    words = [program, "weights", surface, "--handles", f"auto:{HANDLES}", "--method", method, "--tolerance", str(TOLERANCES[certificate]),
             "--domain", "auto", "-o", out, "--overwrite", "--quiet", "--report", "-"]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    return done.returncode, json.loads(done.stdout) if done.stdout.strip() else {}, done.stderr.strip()


def rows_of(path):
    """Return the rows of a .dmat file. Such a file contains "columns rows", and then the values column by column."""
    words = path.read_text(encoding="ascii").split()
    columns, rows = int(words[0]), int(words[1])
    values = [float(word) for word in words[2:]]
    return [[values[c * rows + r] for c in range(columns)] for r in range(rows)]


def broken_promises(code, report, error, method, bound, rows):
    """Return one sentence per failed check."""
    if code != 0:
        return [f"exit code {code}: {error}"]
    wrong = [f"{key} {report[key]:.1e}" for key in ("relative_gap", "kkt_residual") if not report[key] <= bound]
    if report["bounds_violation"] > 0:
        wrong.append(f"bounds_violation {report['bounds_violation']:.1e}")
    if method == "monotone":
        extrema = sum(handle["interior_extrema"] for handle in report["handles"])
        if extrema:
            wrong.append(f"{extrema} interior extrema")
    sums = max(abs(sum(row) - 1) for row in rows)
    if not sums <= 1e-9 or min(map(min, rows)) < 0 or max(map(max, rows)) > 1:
        wrong.append(f"rows sum to one within {sums:.1e} only, or leave [0, 1]")
    return wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, required=True)
    parser.add_argument("--surface", action="append", help="only these")
    parser.add_argument("--markdown", type=pathlib.Path, help="write the table to this file, too")
    options = parser.parse_args()
    program = options.build.resolve() / "bin" / "bindpose"
    table = [["surface", "domain", "tets", "method", "certificate", "s", "gap", "residual", "extrema", "broken"]]
    broken = columns = 0
    with tempfile.TemporaryDirectory() as folder:
        scratch = pathlib.Path(folder)
        there = {surface.path.name: surface.path for surface in real_surfaces(scratch, 20_000_000)}
        names = [name for name in options.surface or SURFACES if name in there]
        names = names if options.surface else names[:WANTED]
        for name in names:
            for method, certificate in CASES:
                out = scratch / "out.dmat"
                code, report, error = weights(program, there[name], method, certificate, out)
                bound = TOLERANCES[certificate]
                wrong = broken_promises(code, report, error, method, bound, rows_of(out) if code == 0 else [])
                broken += bool(wrong)
                columns += HANDLES
                extrema = sum(handle["interior_extrema"] for handle in report.get("handles", []))
                table.append([name, report.get("domain", ""), str(report.get("counts", {}).get("tets", "")), method, certificate,
                              f"{report.get('seconds', {}).get('total', 0):.1f}", f"{report.get('relative_gap', -1):.1e}",
                              f"{report.get('kkt_residual', -1):.1e}", str(extrema), "; ".join(wrong)])
                print(" | ".join(table[-1]), flush=True)
    summary = f"{len(names)} surfaces, {columns} columns, {broken} runs that break a promise"
    print(summary)
    if options.markdown:
        lines = ["# Weights of real surfaces", "", "By", "", "    /usr/bin/python3 " + " ".join(sys.argv), "", summary + ".", "",
                 "| " + " | ".join(table[0]) + " |", "|---" * len(table[0]) + "|",
                 *("| " + " | ".join(row) + " |" for row in table[1:])]
        options.markdown.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return 1 if broken or not names else 0


if __name__ == "__main__":
    sys.exit(main())
