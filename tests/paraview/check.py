"""Check the results of tests/paraview.sh outside of ParaView: check.py BUILD MESH FOLDER.

FOLDER/1 and FOLDER/2 contain the results of in_paraview.py on one and on two MPI ranks, and FOLDER/N.log the log of
ParaView. The fields of both runs must have the same bits. They must also equal those of `bindpose winding`, which is
built with another VTK. Weights and points that are computed by pieces must have the same bits in both runs, too.
"""

import json
import pathlib
import re
import subprocess
import sys

import bindpose.BindposeFilters
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLImageDataReader

FAST_ERROR = 1e-3  # default tolerance of the method Fast of winding numbers
# PrintSelf also prints these lines. They describe the last run and are not parameters.
NO_PARAMETER = {"Status", "StatusMessage", "Report"}
# Properties whose defaults in ParaView differ from those of the C++ class on purpose. Overwrite is on, because
# ParaView's file dialog has already asked about overwriting. Domain is "auto", which works for any surface; in C++ the
# default is to solve on the triangles of the input surface.
OTHER_DEFAULTS = {("vtkMeshFileWriter", "Overwrite"), ("vtkVDBWriter", "Overwrite"),
                  ("vtkGLTFSkinWriter", "Overwrite"), ("vtkBoundedBiharmonicWeights", "Domain"),
                  ("vtkMonotoneWeights", "Domain"), ("vtkUnconstrainedWeights", "Domain")}


def shape_of(extent):
    return tuple(extent[2 * k + 1] - extent[2 * k] + 1 for k in (2, 1, 0))


def load(folder, name, ranks):
    """Return the parts of a field, one per rank, as pairs of metadata and values."""
    parts = []
    for rank in range(ranks):
        about = json.loads((folder / f"{name}.{rank}.json").read_text())
        values = np.load(folder / f"{name}.{rank}.npy").reshape(shape_of(about["extent"]))
        assert (about["piece"], about["pieces"]) == (rank, ranks), about
        assert about["computed"] == values.size, f"rank {rank} computed {about['computed']} of {values.size} samples"
        parts.append((about, values))
    return parts


def place(whole, extent):
    """Return the array slices that select an extent in the array of the whole extent."""
    return tuple(slice(extent[2 * k] - whole[2 * k], extent[2 * k + 1] - whole[2 * k] + 1) for k in (2, 1, 0))


def compare_ranks(folder, name):
    """Check that two ranks computed different halves that share one plane of samples, and that all their samples equal
    those of one rank.
    """
    ((alone, all_values),) = load(folder / "1", name, 1)
    assert alone["extent"] == alone["whole"]
    seen = np.zeros(all_values.shape, int)
    for about, values in load(folder / "2", name, 2):
        for key in ("whole", "origin", "spacing", "method"):
            assert about[key] == alone[key], f"{name}: {key}"
        assert values.tobytes() == all_values[place(alone["whole"], about["extent"])].tobytes(), f"{name}: other bits"
        assert 0.4 < values.size / all_values.size < 0.6, f"{name}: no half"
        seen[place(alone["whole"], about["extent"])] += 1
    planes = [axis for axis in range(3) if (seen == 2).sum() * seen.shape[axis] == seen.size]
    assert seen.min() == 1 and planes, f"{name}: the halves share more than a plane"
    return alone, all_values


def load_pieces(folder, name, ranks):
    """Return the arrays that each rank has saved."""
    parts = []
    for rank in range(ranks):
        with np.load(folder / str(ranks) / f"{name}.{rank}.npz") as file:
            part = dict(file)
        assert part["piece"].tolist() == [rank, ranks], f"{name}: rank {rank} has another piece"
        assert part["status"] == "ok" or len(part["points"]) == 0, f"{name}: rank {rank} has status {part['status']}"
        parts.append(part)
    return parts


def compare_pieces(folder, name, inexact=None, error=0.0):
    """Check that the points of two ranks are those of one rank, with the same bits in all arrays, and that no rank has
    much more than half of them. The values of the array `inexact` may differ by `error`. Return the arrays of one rank."""
    (alone,) = load_pieces(folder, name, 1)
    count = len(alone["Id"])
    assert np.array_equal(alone["Id"], np.arange(count)), name
    seen = np.zeros(count, bool)
    for part in load_pieces(folder, name, 2):
        if len(part["points"]) == 0:
            continue
        ids = part["Id"]
        assert len(ids) <= max(1, 0.6 * count), f"{name}: one rank has {len(ids)} of {count} points"
        assert part.keys() == alone.keys(), f"{name}: other arrays"
        for key in part.keys() - {"piece", "status"}:
            assert part[key].dtype == alone[key].dtype, f"{name}: {key}"
            same = part[key].tobytes() == alone[key][ids].tobytes()
            assert same or key == inexact, f"{name}: other bits in {key}"
            assert same or np.abs(part[key] - alone[key][ids]).max() <= error, f"{name}: other values in {key}"
        seen[ids] = True
    assert seen.all(), f"{name}: {count - seen.sum()} points are missing"
    return alone


def compare_distributed_data(folder):
    """Compare transferred weights, posed points, crowds and winding numbers of one rank with those of two. Return the
    number of compared points."""
    count = 0
    for name in ("cloud", "tube", "point"):
        weights = compare_pieces(folder, f"{name}-weights")
        assert weights["Weights"].shape == (len(weights["Id"]), 5)
        assert np.abs(weights["Weights"].sum(axis=1) - 1.0).max() < 1e-9
        posed = {method: compare_pieces(folder, f"{name}-{method}") for method in ("lbs", "dqs")}
        if name != "point":
            for points in (posed["lbs"]["points"], posed["dqs"]["points"]):
                assert np.linalg.norm(points - weights["points"], axis=1).max() > 0.1, f"{name} has not moved"
            assert np.abs(posed["lbs"]["points"] - posed["dqs"]["points"]).max() > 1e-3, f"{name}: equal methods"
        if name == "tube":
            assert np.abs(posed["dqs"]["Normals"] - weights["Normals"]).max() > 0.1, "the normals have not turned"
        count += 3 * len(weights["Id"])
    (alone,) = load_pieces(folder, "crowd", 1)
    parts = [part["points"] for part in load_pieces(folder, "crowd", 2)]
    assert [len(part) for part in parts] == [3, 4], "the ranks have other instances"
    assert np.concatenate(parts).tobytes() == alone["points"].tobytes(), "crowd: other bits"
    winding = compare_pieces(folder, "queries-winding")["WindingNumber"]
    compare_pieces(folder, "queries-fast", "WindingNumber", 2 * FAST_ERROR)
    assert np.isfinite(winding).all() and winding.max() > 0.9 and winding.min() < 0.1
    return count + alone["points"].shape[0] * alone["points"].shape[1] + len(winding)


def compare_builds(build, folder, name, surface, alone, values, *options):
    """Check that the command-line program computes the same values on the same surface and grid."""
    output = folder / f"{name}.vti"
    subprocess.run([build / "bin" / "bindpose", "winding", surface, *options, "-o", output, "--overwrite"],
                   check=True, stdout=subprocess.DEVNULL)
    reader = vtkXMLImageDataReader()
    reader.SetFileName(str(output))
    reader.Update()
    image = reader.GetOutput()
    assert list(image.GetExtent()) == alone["whole"] and list(image.GetOrigin()) == alone["origin"]
    assert vtk_to_numpy(image.GetPointData().GetArray("WindingNumber")).tobytes() == values.tobytes(), name


def parameters(printed):
    """Return the `Name: value` lines that Bindpose's own classes print, which follow the lines of VTK's classes."""
    own = printed[printed.index("NumberOfThreads:"):]
    found = dict(re.findall(r"^ *(\w+): *(.*?) *$", own, re.MULTILINE))
    return {name: "" if value == "(none)" else value for name, value in found.items() if name not in NO_PARAMETER}


def compare_panels(panels):
    """Check that every parameter of a class is a property of its proxy, with the same default."""
    compared = 0
    for name, panel in panels.items():
        instance = getattr(bindpose.BindposeFilters, name)()
        here, there = parameters(str(instance)), parameters(panel["printed"])
        assert here.keys() == there.keys(), name
        for key, value in here.items():
            no_property = key == "NumberOfThreads" and name.endswith(("Reader", "Writer"))
            if not hasattr(instance, "Set" + key) or no_property:
                continue
            assert key in panel["properties"], f"{name} has no property {key}"
            if (name, key) not in OTHER_DEFAULTS:
                assert there[key] == value, f"{name}: {key} is {there[key]} in ParaView, {value} in C++"
            compared += 1
    return compared


def compare_log(log, sentences):
    """Check that the log contains each of the sentences and no other error."""
    errors = [line for line in log.read_text().splitlines() if "ERR|" in line]
    for name, sentence in sentences.items():
        assert any(sentence in line for line in errors), f"{name}: '{sentence}' is not in the log"
    for line in errors:
        assert any(sentence in line for sentence in sentences.values()), line
    return len(errors)


def main():
    build, mesh, folder = (pathlib.Path(word) for word in sys.argv[1:4])
    one, two = (json.loads((folder / ranks / "run.json").read_text()) for ranks in ("1", "2"))
    assert (one["ranks"], two["ranks"]) == (1, 2)
    assert one["numbers"] == two["numbers"], "tets and weights depend on the ranks"
    samples = in_both_builds = 0
    for name, surface, options in (
        ("spheres", folder / "1" / "spheres.vtp", ("--resolution", "40")),
        ("mesh", mesh, ("--resolution", "48")),
        ("exact", mesh, ("--resolution", "24", "--method", "exact")),
        ("points", None, ()),
    ):
        alone, values = compare_ranks(folder, name)
        assert np.isfinite(values).all() and values.max() > 0.9 and np.abs(values).min() < 0.1, name
        if surface:
            compare_builds(build, folder, name, surface, alone, values, *options)
            in_both_builds += values.size
        samples += values.size
    print(f"{samples} winding numbers: same bits on 1 rank and on 2, each its half; "
          f"{in_both_builds} of them: same bits as bindpose winding")
    print(f"{one['numbers']['tets']} tets, posed; the same on 2 ranks")
    print(f"{compare_distributed_data(folder)} points of distributed data, with transferred weights, posed, in a crowd or with "
          "winding numbers: same bits on 1 rank and on 2, each its piece")
    print(f"{compare_panels(one['panels'])} parameters of {len(one['panels'])} proxies: same defaults as in C++")
    print(f"{len(one['sentences'])} kinds of bad input: each told, nothing else "
          f"({compare_log(folder / '1.log', one['sentences']) + compare_log(folder / '2.log', {})} errors in the logs)")


if __name__ == "__main__":
    main()
