"""bindpose winding with a .vdb output. The file is checked with OpenVDB's program vdb_print (package libopenvdb-tools).
"""

import subprocess

import bindpose
import numpy as np
import pytest
import shapes
from bindpose.meshes import add_point_array, point_array
from vtkmodules.vtkCommonDataModel import vtkImageData


def vdb_print(path):
    """Return the long output of vdb_print as a dict: {"class": "fog volume", …}, and the voxel-to-world matrix as
    "matrix".
    """
    done = subprocess.run(["vdb_print", "-l", str(path)], capture_output=True, text=True, check=True)
    lines = [line.strip() for line in done.stdout.splitlines()]
    facts = dict(line.split(": ", 1) for line in lines if ": " in line)
    at = lines.index("index to world:")
    facts["matrix"] = np.array([[float(x) for x in line.strip("[]").split(",")] for line in lines[at + 1:at + 5]])
    return facts


def number(text):
    return float(text.replace(",", ""))


def bounding_box(values, extent):
    """Return the bounding box of the true values in an array [k, j, i], in the notation of vdb_print."""
    corners = [[int(f(np.nonzero(values)[axis])) + extent[2 * (2 - axis)] for axis in (2, 1, 0)] for f in (np.min, np.max)]
    return f"{corners[0]} -> {corners[1]}"


def winding(folder, mesh, *words, name="field"):
    """Write the winding number field of a surface as .vdb and as .vti. Return the image, and its values as an array [k,
    j, i].
    """
    folder.off("mesh.off", mesh)
    for ending, more in ((".vti", ()), (".vdb", words)):
        folder.run("winding", "mesh.off", "--resolution", "48", "-o", name + ending, "--overwrite", *more).is_good()
    image = bindpose.read(folder / (name + ".vti"))
    return image, point_array(image, "WindingNumber").reshape(image.GetDimensions()[::-1])


def test_a_closed_surface_is_a_fog_volume(folder):
    image, values = winding(folder, shapes.sphere())
    facts = vdb_print(folder / "field.vdb")
    active = np.abs(values) > 1e-6
    assert number(facts["Number of active voxels"]) == active.sum() > 10000
    assert facts["Bounding box of active voxels"] == bounding_box(active, image.GetExtent())
    assert facts["name"] == "winding_number" and facts["class"] == "fog volume"
    assert facts["Type"] == "Tree_float_5_4_3"
    assert (facts["Background value"], facts["Min value"], facts["Max value"]) == ("0", "1", "1")
    # vdb_print prints numbers with three digits.
    assert facts["matrix"][:3, :3] == pytest.approx(np.diag(image.GetSpacing()), rel=5e-3)
    assert facts["matrix"][3] == pytest.approx([*image.GetOrigin(), 1], rel=5e-3)
    # Large parts of the inside are stored as tiles (blocks of equal voxels). The .vdb file therefore needs less than
    # one byte per sample, while the .vti file needs eight.
    assert number(facts["Number of active tiles"]) > 0
    assert (folder / "field.vdb").stat().st_size < values.size


def test_an_open_surface_keeps_its_values(folder):
    _, values = winding(folder, shapes.open_cube())
    facts = vdb_print(folder / "field.vdb")
    assert number(facts["Number of active voxels"]) == (np.abs(values) > 1e-6).sum()
    assert number(facts["Max value"]) == pytest.approx(values.max(), rel=1e-4)
    assert number(facts["Min value"]) == pytest.approx(values.min(), rel=1e-3)


@pytest.mark.parametrize("width, share", [(1, 0.2), (3, 0.4)])
def test_a_narrow_band_is_near_the_surface(folder, width, share):
    image, values = winding(folder, shapes.open_cube(), "--vdb-band", "narrow", "--vdb-band-width", str(width))
    facts = vdb_print(folder / "field.vdb")
    inside = np.pad(values >= 0.5, width)  # positions beyond the grid count as outside
    n = values.shape
    windows = [inside[k:k + n[0], j:j + n[1], i:i + n[2]] for k in range(2 * width + 1)
               for j in range(2 * width + 1) for i in range(2 * width + 1)]
    band = np.any(windows, axis=0) & ~np.all(windows, axis=0)
    assert number(facts["Number of active voxels"]) == band.sum() < share * values.size
    assert facts["Bounding box of active voxels"] == bounding_box(band, image.GetExtent())
    assert number(facts["Max value"]) == pytest.approx(values[band].max(), rel=1e-4)
    assert facts["class"] == "unknown"
    assert facts["Background value"] == "0"


def test_the_background_is_typed(folder):
    _, values = winding(folder, shapes.flipped(shapes.sphere()), "--vdb-background", "-1")
    facts = vdb_print(folder / "field.vdb")
    assert facts["Background value"] == "-1"
    assert number(facts["Number of active voxels"]) == (np.abs(values + 1) > 1e-6).sum()


def test_the_same_bytes_every_time(folder):
    folder.off("mesh.off", shapes.open_cube())
    for name, threads in (("a.vdb", "1"), ("b.vdb", "2")):
        folder.run("winding", "mesh.off", "--resolution", "32", "--threads", threads, "-o", name).is_good()
    assert (folder / "a.vdb").read_bytes() == (folder / "b.vdb").read_bytes()


def test_points_of_a_volume(folder):
    image, _ = winding(folder, shapes.open_cube())
    folder.run("winding", "mesh.off", "--points", "field.vti", "-o", "again.vdb").is_good()
    assert (folder / "again.vdb").read_bytes() == (folder / "field.vdb").read_bytes()
    folder.run("winding", "mesh.off", "--points", "mesh.off", "-o", "no.vdb").is_refused("no.vdb", "file name extension")


def test_refusals(folder):
    folder.off("mesh.off", shapes.cube())
    run = ["winding", "mesh.off", "--resolution", "8"]
    folder.run(*run, "-o", "no/field.vdb").is_refused("no/field.vdb", "No such file")
    folder.run(*run, "-o", "f.vdb", "--vdb-band", "narrow", "--vdb-background", "0.5").is_refused("threshold")
    folder.run(*run, "-o", "f.vdb").is_good()
    folder.run(*run, "-o", "f.vdb").is_refused("f.vdb", "the file exists")
    assert "expected an integer (voxels, at least 1)" in folder.run(*run, "-o", "g.vdb", "--vdb-band-width", "0").err
    assert "expected full|narrow" in folder.run(*run, "-o", "g.vdb", "--vdb-band", "wide").err


def test_from_python(folder):
    """Write an image with bindpose.write. Its extent begins below 0, and its array has another name."""
    image = vtkImageData()
    image.SetExtent(-5, 4, -20, -12, 7, 30)
    image.SetOrigin(1, -2, 3)
    image.SetSpacing(0.5, 0.25, 0.125)
    values = np.random.default_rng(3).random((24, 9, 10)) * (np.arange(10) % 3 == 0)
    add_point_array(image, "density", values.ravel())
    image.GetPointData().SetActiveScalars("density")
    bindpose.write(image, folder / "density.vdb")
    facts = vdb_print(folder / "density.vdb")
    assert facts["name"] == "density"
    assert facts["Bounding box of active voxels"] == "[-5, -20, 7] -> [4, -12, 30]"
    assert number(facts["Number of active voxels"]) == (values > 1e-6).sum()
    assert np.array_equal(facts["matrix"], [[0.5, 0, 0, 0], [0, 0.25, 0, 0], [0, 0, 0.125, 0], [1, -2, 3, 1]])
    with pytest.raises(bindpose.InvalidInput, match="the file exists"):
        bindpose.write(image, folder / "density.vdb")
    with pytest.raises(bindpose.InvalidInput, match="vtkPolyData"):
        bindpose.write(shapes.cube(), folder / "cube.vdb")
    assert not (folder / "cube.vdb").exists()
