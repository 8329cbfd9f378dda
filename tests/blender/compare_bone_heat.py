#!/usr/bin/env python3
"""Compare the weights of the Blender add-on with Blender's bone heat (`ARMATURE_AUTO`).

Each surface is bound twice to the skeleton that the add-on finds: surfaces of the Debian package libcgal-demo, three of
them as separate triangles, and real furniture models of the package sweethome3d-furniture. The script writes a table and
exits with 1 if the add-on leaves a vertex without weights or a weight is not between 0 and 1.
"""

import argparse
import os
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path[:0] = [str(HERE.parent), str(HERE.parent / "support")]

SURFACES = ["armadillo", "bear", "camel", "cow", "dino", "elephant", "elephant-with-holes", "hand", "homer", "man", "pig",
            "triceratops"]
SEPARATED = ["hand", "man", "pig"]  # also as separate triangles, as in an STL file
FURNITURE = ["scopia/bar_chair", "scopia/simple_sofa", "scopia/dog", "scopia/cat", "blendswap-cc-by/foldingChair",
             "katorlegaz/dining-chair", "scopia/hospital-bed", "scopia/coconutTree", "reallusion/holdingFemale01"]
PERSISTENCE = 0.05  # a maximum counts if it is higher than its saddle by more than this


def extra_maxima(points, triangles, weights):
    """Return the height of each local maximum above the saddle that connects it to a higher one, for all columns and all
    maxima that are higher by more than PERSISTENCE. Smooth weights of a bone have one maximum in each part."""
    from separate_parts import Groups, weld
    _, joined, ids = weld(points, triangles)
    count = ids.max() + 1
    rows = np.zeros((count, weights.shape[1]))
    np.maximum.at(rows, ids, weights)
    edges = np.concatenate([joined[:, [0, 1]], joined[:, [1, 2]], joined[:, [2, 0]]])
    edges = np.unique(np.sort(edges, axis=1), axis=0)
    both = np.concatenate([edges, edges[:, ::-1]])
    both = both[np.argsort(both[:, 0], kind="stable")]
    begin = np.searchsorted(both[:, 0], np.arange(count + 1))
    heights = []
    for values in rows.T:
        groups, summit = Groups(count), {}
        for vertex in np.argsort(-values, kind="stable"):
            if values[vertex] <= 0:
                break
            summit[vertex] = values[vertex]
            for other in both[begin[vertex]:begin[vertex + 1], 1]:
                if other not in summit:
                    continue
                first, second = groups.find(vertex), groups.find(other)
                if first == second:
                    continue
                low, high = sorted((first, second), key=lambda root: summit[root])
                heights.append(summit[low] - values[vertex])
                groups.join(low, high)
    return [height for height in heights if height > PERSISTENCE]


def numbers_of(points, triangles, weights):
    sums = weights.sum(axis=1)
    heights = extra_maxima(points, triangles, weights)
    return {"unbound": float((sums < 1e-3).mean()), "empty": int((weights.max(axis=0) <= 0).sum()),
            "sum_error": float(np.abs(sums[sums >= 1e-3] - 1).max(initial=0)),
            "lowest": float(weights.min()), "highest": float(weights.max()),
            "maxima": len(heights), "leak": max(heights, default=0.0)}


def read_triangles(path):
    import bindpose
    from bindpose.meshes import points_of, triangles_of
    from vtkmodules.vtkFiltersCore import vtkTriangleFilter
    triangulate = vtkTriangleFilter()
    triangulate.PassLinesOff()
    triangulate.PassVertsOff()
    triangulate.SetInputData(bindpose.read(path))
    triangulate.Update()
    return points_of(triangulate.GetOutput()), triangles_of(triangulate.GetOutput())


def surfaces(folder):
    """Yield name, points and triangles of each surface."""
    from all_surfaces import real_surfaces
    from real_meshes import real_models
    found = {pathlib.Path(surface.name).stem: surface.path for surface in real_surfaces(folder, 4_000_000)}
    for name in SURFACES:
        points, triangles = read_triangles(found[name])
        yield name, points, triangles
        if name in SEPARATED:
            yield f"{name}, separate triangles", points[triangles].reshape(-1, 3), np.arange(triangles.size).reshape(-1, 3)
    models = {model.name: model for model in real_models()}
    for name in FURNITURE:
        yield name, *read_triangles(models[name].copy_to(folder))


def compare(blender, program, folder, points, triangles):
    """Bind a surface twice in Blender. Return the numbers of both methods and the number of bones, or an error."""
    np.savez(folder / "mesh.npz", points=points, triangles=triangles)
    result = folder / "result.npz"
    result.unlink(missing_ok=True)
    environment = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
    try:
        done = subprocess.run([blender, "-b", "--factory-startup", "--python-exit-code", "3", "--python",
                               HERE / "bone_heat_in_blender.py", "--", ROOT / "examples" / "blender" / "bindpose_addon.py",
                               program, folder / "mesh.npz", result],
                              capture_output=True, text=True, timeout=1200, check=False, env=environment)
    except subprocess.TimeoutExpired:
        return {"error": "not done after 1200 s"}
    if not result.exists():
        return {"error": f"Blender ended with code {done.returncode}: {done.stderr.strip()[-200:]}"}
    with np.load(result) as found:
        if "error" in found:
            return {"error": str(found["error"]).strip()}
        return {"bones": found["heat"].shape[1],
                **{method: {**numbers_of(points, triangles, found[method]), "seconds": float(found[f"{method}_seconds"])}
                   for method in ("heat", "bindpose")}}


def row_of(name, triangles, found):
    cells = [name, str(len(triangles))]
    if "error" in found:
        return cells + [found["error"]] + [""] * 8
    cells.append(str(found["bones"]))
    for method in ("heat", "bindpose"):
        numbers = found[method]
        cells += [f"{100 * numbers['unbound']:.3g} %", str(numbers["empty"]), f"{numbers['maxima']} ({numbers['leak']:.2f})",
                  f"{numbers['seconds']:.1f}"]
    return cells


def document(rows, numbers):
    both = [found for found in numbers if "error" not in found]
    heads = ["surface", "triangles", "bones", *(f"{method}: {column}" for method in ("heat", "Bindpose") for column in (
        "unbound", "empty groups", "extra maxima", "s"))]
    lines = ["# Weights in Blender: bone heat and Bindpose", "",
             "    /usr/bin/python3 tests/blender/compare_bone_heat.py --build build --markdown tests/bone_heat.md", "",
             "Each surface is bound twice to the skeleton that the add-on finds (at most 12 bones): by Blender's",
             "`ARMATURE_AUTO` (bone heat) and by the add-on. `unbound`: vertices without a weight. `empty groups`: bones",
             "without a vertex. `extra maxima`: local maxima of a bone's weights that are more than "
             f"{PERSISTENCE} above the saddle to", "a higher maximum of the same part, in parentheses the largest height. "
             "`s`: seconds of the operator.", "", "| " + " | ".join(heads) + " |", "|" + "---|" * len(heads)]
    lines += ["| " + " | ".join(row) + " |" for row in rows]
    lines += ["", f"- Surfaces bound by both methods without an error: {len(both)} of {len(numbers)}."]
    for method, title in (("heat", "Bone heat"), ("bindpose", "Bindpose")):
        found = [each[method] for each in both]
        complete = sum(each["unbound"] == 0 for each in found)
        seconds = sorted(each["seconds"] for each in found)
        lines.append(f"- {title}: every vertex has weights on {complete} of {len(found)} surfaces; weights from "
                     f"{min((each['lowest'] for each in found), default=0):.3g} to "
                     f"{max((each['highest'] for each in found), default=0):.7g}; median "
                     f"{seconds[len(seconds) // 2] if seconds else 0:.1f} s, slowest {seconds[-1] if seconds else 0:.1f} s.")
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build")
    parser.add_argument("--blender", default="blender")
    parser.add_argument("--only", metavar="NAME", action="append", help="run these surfaces only")
    parser.add_argument("--slice", metavar="K/N", default="1/1", help="run part K of N of the surfaces only")
    parser.add_argument("--markdown", type=pathlib.Path)
    options = parser.parse_args()
    build = options.build.resolve()
    sys.path.insert(0, str(build / "lib" / "python3" / "dist-packages"))
    rows, numbers, wrong = [], [], 0
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        part, parts = map(int, options.slice.split("/"))
        for number, (name, points, triangles) in enumerate(surfaces(folder)):
            if (options.only and name not in options.only) or number % parts != part - 1:
                continue
            found = compare(options.blender, build / "bin" / "bindpose", folder, points, triangles)
            rows.append(row_of(name, triangles, found))
            numbers.append(found)
            print(" | ".join(rows[-1]), flush=True)
            ours = found.get("bindpose", {"unbound": 1, "lowest": 0, "highest": 0})
            wrong += ours["unbound"] > 0 or ours["lowest"] < 0 or ours["highest"] > 1 + 1e-6
    text = document(rows, numbers)
    if options.markdown:
        options.markdown.write_text(text, encoding="utf-8")
    print(text[text.rindex("|\n") + 2:])
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
