"""3DS and 3MF files, which bindpose-importer converts: their meshes arrive unchanged, and damaged files are refused."""

import asset_files
import numpy as np
import pytest
import shapes
from gltf_file import GltfFile
from test_look import pixels_of

# A quarter turn about z with a shift, and a scale.
TURNED = np.array([[0, -1, 0, 10], [1, 0, 0, 20], [0, 0, 1, 30], [0, 0, 0, 1]])
LARGE = np.diag([2, 2, 2, 1])
# A red bar in both formats.
MODEL = asset_files.three_mf_model(shapes.bar(), items=((1, np.eye(4)),), color="#FF0000")
CONTENT = {"bar.3ds": asset_files.three_ds(("bar", shapes.bar(), (255, 0, 0))), "bar.3mf": asset_files.three_mf(MODEL)}


def corners(points, triangles):
    """Return the positions of the corners of triangles, #F x 3 x 3."""
    return np.array(points, dtype=float)[np.array(triangles)]


def moved(matrix, positions):
    return positions @ np.array(matrix)[:3, :3].T + np.array(matrix)[:3, 3]


def converted_meshes(path):
    """Return the corners of the triangles of each mesh node of a glTF file: as stored, and in the scene."""
    file = GltfFile(path)
    scene = file.skinned_points()
    result, begin = [], 0
    for node in file.json["nodes"]:
        if "mesh" in node:
            primitive, = file.json["meshes"][node["mesh"]]["primitives"]
            points = file.attribute(node["mesh"], "POSITION")
            triangles = file.numbers(primitive["indices"]).reshape(-1, 3)
            result.append((corners(points, triangles), corners(scene[begin:begin + len(points)], triangles)))
            begin += len(points)
    return result


def base_colors(path):
    return [material["pbrMetallicRoughness"]["baseColorFactor"] for material in GltfFile(path).json["materials"]]


def expect_closed(folder, name, components, volume, bounds):
    """Expect that `info` finds closed parts in a file: triangles share their vertices."""
    report = folder.run("info", name, "--report", "-").is_good().report
    assert report["counts"]["components"] == components and report["counts"]["boundary_edges"] == 0
    assert report["volume"] == pytest.approx(volume, rel=1e-6)
    assert report["bounds"] == pytest.approx(bounds, abs=1e-5)


def test_a_3ds_file_keeps_its_meshes(folder):
    """3DS files have z up, glTF files y up: (x, y, z) becomes (x, z, -y)."""
    bar, cube = shapes.bar(), shapes.cube(8.0, 10.0)
    folder.write("two.3ds", asset_files.three_ds(("bar", bar, (255, 51, 0)), ("cube", cube, (51, 102, 204))))
    run = folder.run("rig", "two.3ds", "--handles", "auto:2", "-o", "two.glb", "--report", "-").is_good()
    assert "warning" not in run.err
    assert run.report["counts"]["triangles"] == len(bar[1]) + len(cube[1])
    meshes = converted_meshes(folder / "two.glb")
    for (stored, scene), mesh in zip(meshes, (bar, cube), strict=True):
        expected = corners(*mesh)
        np.testing.assert_array_equal(stored, expected)
        assert scene == pytest.approx(expected[..., [0, 2, 1]] * [1, 1, -1], abs=1e-5)
    first, second = base_colors(folder / "two.glb")
    assert first == pytest.approx([1, 0.2, 0, 1], abs=1e-6) and second == pytest.approx([0.2, 0.4, 0.8, 1], abs=1e-6)
    expect_closed(folder, "two.3ds", components=2, volume=6 + 8, bounds=[0, 10, 0, 10, -10, 0])
    # A skin maps the stored positions, which are those of the file.
    expect_closed(folder, "two.glb", components=2, volume=6 + 8, bounds=[0, 10, 0, 10, 0, 10])


def test_a_3mf_file_keeps_its_meshes_and_their_transforms(folder):
    """Two objects are placed three times. The axes and units of the file are kept."""
    bar, cube = shapes.bar(), shapes.cube()
    items = ((1, TURNED), (2, np.eye(4)), (1, LARGE))
    folder.write("three.3mf", asset_files.three_mf(asset_files.three_mf_model(bar, cube, items=items, color="#FF3300")))
    run = folder.run("rig", "three.3mf", "--handles", "auto:3", "-o", "three.glb", "--report", "-").is_good()
    assert run.report["counts"]["triangles"] == 2 * len(bar[1]) + len(cube[1])
    meshes = converted_meshes(folder / "three.glb")
    for (stored, scene), (mesh, matrix) in zip(meshes, ((bar, TURNED), (cube, np.eye(4)), (bar, LARGE)), strict=True):
        expected = corners(*mesh)
        np.testing.assert_array_equal(stored, expected)
        assert scene == pytest.approx(moved(matrix, expected), abs=1e-5)
    assert base_colors(folder / "three.glb") == [pytest.approx([1, 0.2, 0, 1], abs=1e-6)]
    expect_closed(folder, "three.3mf", components=3, volume=6 + 8 + 8 * 6, bounds=[-1, 12, -1, 26, -1, 31])


@pytest.mark.parametrize("name", ["bar.3ds", "bar.3mf"])
def test_rendered_colors(folder, name):
    """A red bar is drawn in red."""
    folder.write(name, CONTENT[name])
    run = folder.run("render", name, "--size", "200x160", "-o", "bar.png").is_good()
    assert run.err == ""
    colors = pixels_of(folder / "bar.png").reshape(-1, 3).astype(int)
    drawn = colors[(colors != 255).any(axis=1)]
    red, green, blue = drawn.mean(axis=0)
    assert len(drawn) > 1000 and red > 100 and red > 2 * green and red > 2 * blue


@pytest.mark.parametrize("verb, output", [("rig", "out.glb"), ("render", "out.png")])
@pytest.mark.parametrize("name", CONTENT)
def test_half_of_a_binary_file(folder, name, verb, output):
    content = CONTENT[name]
    for size in (0, 10, len(content) // 2, 9 * len(content) // 10):
        folder.write(name, content[:size])
        folder.run(verb, name, "-o", output).is_refused(f"{name} cannot be read")


def test_a_3mf_file_without_a_model(folder):
    """The archive is valid, but its model is cut, or contains no mesh."""
    folder.write("cut.3mf", asset_files.three_mf(MODEL[:len(MODEL) // 2]))
    folder.run("rig", "cut.3mf", "-o", "out.glb").is_refused("cut.3mf cannot be read")
    folder.write("other.3mf", asset_files.three_mf(MODEL.replace('objectid="1"', 'objectid="7"')))
    folder.run("rig", "other.3mf", "-o", "out.glb").is_refused("other.3mf", "no triangles")


def test_values_of_a_3mf_file_that_are_not_valid(folder):
    model = asset_files.three_mf_model(shapes.cube(), items=((1, np.eye(4)),))
    folder.write("index.3mf", asset_files.three_mf(model.replace('v2="4"', 'v2="5000"', 1)))
    folder.run("rig", "index.3mf", "-o", "out.glb").is_refused("refers to vertex 5000, but it has 8 vertices")
    folder.write("infinite.3mf", asset_files.three_mf(model.replace('x="-1.0"', 'x="-1e400"', 1)))
    folder.run("rig", "infinite.3mf", "-o", "out.glb").is_refused("a coordinate that is not finite")


def test_a_3mf_object_that_contains_itself(folder):
    """The library recurses without end. Only the separate process crashes."""
    model = MODEL.replace('item objectid="1"', 'item objectid="2"')
    cycle = '<object id="2"><components><component objectid="2"/></components></object>'
    folder.write("cycle.3mf", asset_files.three_mf(model.replace("</resources>", cycle + "</resources>")))
    folder.run("rig", "cycle.3mf", "-o", "out.glb").is_refused("cycle.3mf cannot be read", "bindpose-importer")
