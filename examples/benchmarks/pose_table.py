#!/usr/bin/env python3
"""Run the benchmarks of pose time and print them as the tables of README.md.

With --readme the tables replace the text between `<!-- pose -->` and `<!-- end -->` in the README.md next to this
file.
"""

import argparse
import json
import pathlib
import re
import subprocess
import sys

FOLDER = pathlib.Path(__file__).resolve().parent
FILTER = "^(reduced_arap/|reduced_arap_of_tets|skinning|crowd|stretch)"
METHODS = ("linear blend", "dual quaternions", "stretchable bones")


def table(head, rows):
    if not rows:
        return ""
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(map(str, row)) + " |" for row in rows])


def number(value):
    """Return a number with three digits and without an exponent."""
    if value >= 100:
        return f"{value:,.0f}"
    return f"{value:.3g}"


def arguments(row):
    """Return name and numbers of a row: reduced_arap/triangles:86000/handles:5 …"""
    name, *words = row["name"].split("/")
    return name, {key: int(value) for key, value in (word.split(":") for word in words if ":" in word)}


def reduced(rows):
    lines = []
    for row in rows:
        name, given = arguments(row)
        if name not in ("reduced_arap", "reduced_arap_of_tets"):
            continue
        lines.append([row["label"].replace("_", " "), f"{given.get('triangles', 0):,}" if "triangles" in given else "43k vertices",
                      f"{given['handles']}, {given['clusters']}", number(row["plain_us"]), number(row["us"]),
                      int(row["iterations"]), number(row["converge_us"]), number(row["modes_ms"]), number(row["bind_s"]),
                      number(row["bind_MiB"])])
    head = ["energy", "triangles", "handles, clusters", "µs per iteration", "accelerated", "iterations to convergence",
            "µs to convergence", "ms per change of modes", "bind, s", "bind, MiB"]
    return table(head, lines)


def skinning(rows):
    found = {}
    for row in rows:
        name, given = arguments(row)
        if name == "skinning":
            found.setdefault((given["bounded"], given["method"], given["handles"]), {})[given["single"]] = row
    lines = []
    for (bounded, method, handles), both in sorted(found.items(), reverse=True, key=lambda item: (item[0][0], -item[0][1], -item[0][2])):
        lines.append(["bounded biharmonic" if bounded else "all nonzero", METHODS[method], handles,
                      number(both[0]["weights_each"]), number(both[0]["cpu_time"]), number(both[1]["cpu_time"]),
                      f"{both[0]['error']:.0e}", f"{both[1]['error']:.0e}"])
    head = ["weights", "method", "handles", "weights per vertex", "ms, double", "ms, float", "error, double", "error, float"]
    return table(head, lines)


def others(rows):
    lines = []
    for row in rows:
        name, given = arguments(row)
        if name == "crowd":
            what = f"100 instances of {given['triangles']:,} triangles, {given['handles']} handles, {given['clusters']} clusters"
            lines.append([what, f"{number(row['cpu_time'])} ms per frame, including {number(row['ms_of_solves'])} ms of solves; "
                          f"{number(row['iterations_each'])} iterations each"])
        elif name.startswith("stretch"):
            lines.append([name.replace("_", " "), f"{number(1e6 * row['cpu_time'] / row['elements'])} ns each"])
    return table(["measured", "time"], lines)


def write(readme, text):
    whole, found = re.subn(r"(<!-- pose -->\n).*?(<!-- end -->)", lambda m: m[1] + text + "\n" + m[2],
                           readme.read_text(), flags=re.S)
    if found != 1:
        sys.exit(f"pose_table.py: {readme} has no line <!-- pose -->")
    readme.write_text(whole)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", type=pathlib.Path, default=FOLDER.parents[1] / "build" / "bin" / "bindpose_benchmarks")
    parser.add_argument("--filter", default=FILTER, help="regular expression for the benchmarks to run (default: those of the tables)")
    parser.add_argument("--readme", action="store_true", help="also write the tables to README.md")
    options = parser.parse_args()
    done = subprocess.run([options.program, f"--benchmark_filter={options.filter}", "--benchmark_format=json"],
                          stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=True)
    rows = [row for row in json.loads(done.stdout)["benchmarks"] if not row.get("error_occurred")]
    text = "\n\n".join(filter(None, [reduced(rows), skinning(rows), others(rows)]))
    print(text)
    if options.readme:
        write(FOLDER / "README.md", text)


if __name__ == "__main__":
    main()
