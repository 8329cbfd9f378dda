"""bindpose transfer: weights of one mesh on another, as a mesh file or as a rigged glTF file."""

import json

import foreign_rig
import pytest
import shapes
from gltf_file import GltfFile

@pytest.fixture
def body(folder):
    """A bar with weights of two bones, and a sleeve around its left half."""
    folder.off("bar.off", shapes.bar())
    folder.write("h.tgf", shapes.TWO_BONES)
    folder.run("weights", "bar.off", "--handles", "h.tgf", "-o", "bar.vtp").is_good()
    vertices, faces = shapes.bar(8, 3, 3, (3.0, 1.1, 1.1))
    folder.sleeve = [[x, y - 0.05, z - 0.05] for x, y, z in vertices], faces
    folder.off("sleeve.off", folder.sleeve)
    return folder


def test_a_sleeve_gets_the_weights_of_the_bar(body):
    run = body.run("transfer", "bar.vtp", "sleeve.off", "-o", "sleeve.vtp", "--report", "-").is_good()
    report = run.report
    assert report["transfer"] == "inpaint" and report["counts"]["vertices"] == len(body.sleeve[0])
    counts = report["counts"]
    assert counts["matched"] + counts["inpainted"] + counts["nearest"] == counts["vertices"]
    # The right end of the sleeve is inside of the bar and matches nothing.
    assert counts["matched"] > 0 and counts["inpainted"] > 0
    assert max(report["relative_gap"], report["kkt_residual"]) <= 1e-6
    assert "Weights" in body.run("info", "sleeve.vtp").is_good().out
    nearest = body.run("transfer", "bar.vtp", "sleeve.off", "--method", "nearest", "-o", "n.dmat", "--report", "-").is_good()
    assert nearest.report["transfer"] != "inpaint"
    assert body.path.joinpath("n.dmat").stat().st_size > 0


def test_the_file_of_the_target_is_kept(body):
    body.run("weights", "bar.off", "--handles", "h.tgf", "-o", "bar.glb").is_good()
    vertices, faces = body.sleeve
    buffer = foreign_rig.Buffer()
    primitive = {"attributes": {"POSITION": buffer.add(vertices, "VEC3")}, "material": 0,
                 "indices": buffer.add([v for face in faces for v in face], "SCALAR", "H")}
    file = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
            "nodes": [{"name": "sleeve", "mesh": 0}], "meshes": [{"name": "sleeve", "primitives": [primitive]}],
            "materials": [{"name": "wool", "pbrMetallicRoughness": {"roughnessFactor": 0.9}}]}
    body.write("sleeve.gltf", json.dumps(buffer.complete(file)))
    body.run("transfer", "bar.glb", "sleeve.gltf", "-o", "out.glb").is_good()
    result = GltfFile(body / "out.glb")
    assert result.json["materials"] == file["materials"]
    source = GltfFile(body / "bar.glb")
    names = lambda gltf: [gltf.json["nodes"][node]["name"] for node in gltf.json["skins"][0]["joints"]]  # noqa: E731
    assert names(result) == names(source)
    attributes = result.json["meshes"][0]["primitives"][0]["attributes"]
    weights = result.numbers(attributes["WEIGHTS_0"])
    assert len(weights) == len(vertices)
    assert weights.sum(axis=1) == pytest.approx(1, abs=1e-6)


def test_bad_input_is_one_sentence(body):
    body.run("transfer", "bar.off", "sleeve.off", "-o", "x.vtp").is_refused("no point array 'Weights'")
    body.run("transfer", "bar.vtp", "sleeve.off", "-o", "x.glb").is_refused("--handles is required")
    body.run("transfer", "bar.vtp", "none.off", "-o", "x.vtp").is_refused("none.off")
    body.run("transfer", "bar.vtp", "sleeve.off", "-o", "x.stl").is_refused("x.stl")
    body.run("transfer", "bar.vtp", "sleeve.off", "--maximum-angle", "200", "-o", "x.vtp").is_refused("0 to 180", code=1)
    body.run("transfer", "bar.vtp", "sleeve.off", "--method", "nearest", "--maximum-angle", "20", "-o", "x.vtp").is_refused(
        "--maximum-angle", code=1)
    body.run("transfer", "bar.vtp", "h.tgf", "-o", "x.vtp").is_refused("h.tgf")
    body.run("transfer", "bar.vtp", "sleeve.off", "-o", "x.vtu").is_refused("the output must be .vtp")
    body.run("transfer", "bar.vtp", "sleeve.off", "--handles", "h.tgf", "-o", "x.vtp").is_refused("--handles")
    body.run("winding", "bar.off", "--resolution", "8", "-o", "image.vti").is_good()
    body.run("transfer", "bar.vtp", "image.vti", "-o", "x.vtp").is_refused("image.vti must contain a surface or tets")
    body.run("transfer", "image.vti", "sleeve.off", "-o", "x.vtp").is_refused("image.vti must contain a surface or tets")
    body.write("three.tgf", "1 0 0 0\n2 1 0 0\n3 2 0 0\n#\n")
    body.run("transfer", "bar.vtp", "sleeve.off", "--handles", "three.tgf", "-o", "x.glb").is_refused("three.tgf has 3 handles")
