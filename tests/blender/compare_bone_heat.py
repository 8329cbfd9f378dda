#!/usr/bin/env python3
"""Compare the weights of the Blender add-on with Blender's bone heat (`ARMATURE_AUTO`).

Each surface is bound twice to the skeleton that the add-on finds: surfaces of the Debian package libcgal-demo, three of
them as separate triangles, and real furniture models of the package sweethome3d-furniture. The script writes a table and
exits with 1 if the add-on leaves a vertex without weights or a bone without vertices, or if a weight is not between 0 and 1.
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
LEAK = 0.01  # smaller weights are no leaks


class Surface:
    """A surface whose vertices at equal positions are merged."""

    def __init__(self, points, triangles):
        from separate_parts import weld
        merged, joined, self.ids = weld(points, triangles)
        self.count = len(merged)
        edges = np.concatenate([joined[:, [0, 1]], joined[:, [1, 2]], joined[:, [2, 0]]])
        self.edges = np.unique(np.sort(edges, axis=1), axis=0)
        self.component = self.regions(np.ones(self.count, bool))

    def merged(self, weights):
        """Return the rows of the merged vertices: the largest weights of the vertices at the same position."""
        rows = np.zeros((self.count, weights.shape[1]))
        np.maximum.at(rows, self.ids, weights)
        return rows

    def regions(self, mask):
        """Return a label per vertex. Vertices in the mask have equal labels if edges in the mask connect them."""
        from separate_parts import Groups
        groups = Groups(self.count)
        for a, b in self.edges[mask[self.edges].all(axis=1)]:
            groups.join(a, b)
        return groups.labels()


def extra_maxima(surface, rows):
    """Return the height of each local maximum above the saddle that connects it to a higher one, for all columns and all
    maxima that are higher by more than PERSISTENCE. Smooth weights of a bone have one maximum in each component."""
    from separate_parts import Groups
    both = np.concatenate([surface.edges, surface.edges[:, ::-1]])
    both = both[np.argsort(both[:, 0], kind="stable")]
    begin = np.searchsorted(both[:, 0], np.arange(surface.count + 1))
    heights = []
    for values in rows.T:
        groups, summit = Groups(surface.count), {}
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


def leaks(surface, rows):
    """Return the largest leaking weight per vertex, 0 for vertices without a leak.

    The vertices of a connected component at which a bone has a weight above LEAK form regions, which edges connect. Weights leak
    in all regions but the one with the largest weight. Components are independent: a bone may move several.
    """
    largest = np.zeros(surface.count)
    for values in rows.T:
        mask = values > LEAK
        region = surface.regions(mask)
        in_component, in_region = np.zeros(surface.count), np.zeros(surface.count)
        np.maximum.at(in_component, surface.component, values)
        np.maximum.at(in_region, region, values)
        is_island = mask & (in_region[region] < in_component[surface.component])
        largest = np.maximum(largest, np.where(is_island, values, 0))
    return largest


def numbers_of(surface, weights):
    sums = weights.sum(axis=1)
    rows = surface.merged(weights)
    heights = extra_maxima(surface, rows)
    leaking = leaks(surface, rows)
    return {"unbound": float((sums < 1e-3).mean()), "empty": int((weights.max(axis=0) <= 0).sum()),
            "sum_error": float(np.abs(sums[sums >= 1e-3] - 1).max(initial=0)),
            "lowest": float(weights.min()), "highest": float(weights.max()),
            "maxima": len(heights), "height": max(heights, default=0.0),
            "leaking": float((leaking > 0).mean()), "leak": float(leaking.max())}


def faults_of(found):
    """Return sentences about the weights of the add-on, an empty list if they are correct."""
    if "error" in found:
        return [found["error"]]
    numbers, faults = found["bindpose"], []
    if numbers["unbound"] > 0:
        faults.append(f"{100 * numbers['unbound']:.3g} % of the vertices have no weights")
    if numbers["empty"] > 0:
        faults.append(f"bones without vertices: {numbers['empty']}")
    if not (numbers["lowest"] >= 0 and numbers["highest"] <= 1 + 1e-6):  # also for a number that is not finite
        faults.append(f"weights are from {numbers['lowest']:.3g} to {numbers['highest']:.7g}")
    return faults


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
        surface = Surface(points, triangles)
        return {"bones": found["heat"].shape[1],
                **{method: {**numbers_of(surface, found[method]), "seconds": float(found[f"{method}_seconds"])}
                   for method in ("heat", "bindpose")}}


def row_of(name, triangles, found):
    cells = [name, str(len(triangles))]
    if "error" in found:
        return cells + [found["error"]] + [""] * 10
    cells.append(str(found["bones"]))
    for method in ("heat", "bindpose"):
        numbers = found[method]
        cells += [f"{100 * numbers['unbound']:.3g} %", str(numbers["empty"]), f"{numbers['maxima']} ({numbers['height']:.2f})",
                  f"{100 * numbers['leaking']:.2g} % ({numbers['leak']:.2f})", f"{numbers['seconds']:.1f}"]
    return cells


def document(rows, numbers):
    both = [found for found in numbers if "error" not in found]
    heads = ["surface", "triangles", "bones", *(f"{method}: {column}" for method in ("heat", "Bindpose") for column in (
        "unbound", "empty groups", "extra maxima", "leak", "s"))]
    lines = ["# Weights in Blender: bone heat and Bindpose", "",
             "    /usr/bin/python3 tests/blender/compare_bone_heat.py --build build --markdown tests/bone_heat.md", "",
             "Each surface is bound twice to the skeleton that the add-on finds (at most 12 bones): by Blender's",
             "`ARMATURE_AUTO` (bone heat) and by the add-on. `unbound`: vertices without a weight. `empty groups`: bones",
             f"without a vertex. `extra maxima`: local maxima of a bone's weights that are more than {PERSISTENCE} above the",
             "saddle to a higher maximum of the same component, in parentheses the largest height. `leak`: vertices at",
             f"which a bone has a weight above {LEAK}, but no path of edges with such weights leads to the bone's largest",
             "weight in the same connected component, in parentheses the largest such weight. `s`: seconds of the",
             "operator.", "",
             "| " + " | ".join(heads) + " |", "|" + "---|" * len(heads)]
    lines += ["| " + " | ".join(row) + " |" for row in rows]
    lines += ["", f"- Surfaces bound by both methods without an error: {len(both)} of {len(numbers)}."]
    for method, title in (("heat", "Bone heat"), ("bindpose", "Bindpose")):
        found = [each[method] for each in both]
        complete = sum(each["unbound"] == 0 for each in found)
        filled = sum(each["empty"] == 0 for each in found)
        seconds = sorted(each["seconds"] for each in found)
        lines.append(f"- {title}: every vertex has weights on {complete} of {len(found)} surfaces, every bone has vertices "
                     f"on {filled}; weights from {min((each['lowest'] for each in found), default=0):.3g} to "
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
    rows, numbers, faults = [], [], []
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
            faults += [f"{name}: {fault}" for fault in faults_of(found)]
    text = document(rows, numbers)
    if options.markdown:
        options.markdown.write_text(text, encoding="utf-8")
    print(text[text.rindex("|\n") + 2:])
    sys.exit("\n".join(faults) or None)


if __name__ == "__main__":
    main()
