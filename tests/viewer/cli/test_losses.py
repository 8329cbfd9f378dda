"""bindpose rig: a glTF file that comes back loses nothing. The test prints the list of losses, which is empty."""

import json

import pytest
import rich_asset
from asset_losses import Asset, list_additions, list_losses


@pytest.mark.parametrize("handles", ["auto:3", "own"])
@pytest.mark.parametrize("name, output", [("rich.glb", "out.glb"), ("rich.gltf", "out.glb"), ("rich.gltf", "out.gltf")])
def test_a_file_loses_nothing(folder, name, output, handles):
    """All joints are replaced, or keep their nodes and get new weights."""
    rich_asset.write(folder / name)
    own = handles == "own"
    words = ("--handles", name if own else handles, "--domain", "surface", "--report", "-")
    report = folder.run("rig", name, "-o", output, *words).is_good().report["gltf"]
    assert report["kept_joints"] == ("yes" if own else "no")
    assert report.get("losses", []) == ([] if own else ["1 animation of the old joints"])
    before, after = Asset(folder / name), Asset(folder / output)
    assert len(before.json["animations"]) == 3 and len(before.json["images"]) == 2
    losses = list_losses(before, after)
    assert losses == [], "\n".join([f"{output} lost:", *losses])
    roots = len(before.json["scenes"][0]["nodes"])
    added = [] if own else [f"scenes[0].nodes[{roots}]: {len(before.json['nodes'])}"]  # the parent of the new joints
    added += ['images[1].mimeType: "image/png"'] if name == "rich.gltf" else []  # of a picture that was a file
    assert list_additions(before, after) == added
    for node in (3, 4, 5, 6):  # those with triangles
        primitives = after.json["meshes"][after.json["nodes"][node]["mesh"]]["primitives"]
        assert all({"JOINTS_0", "WEIGHTS_0"} <= set(primitive["attributes"]) for primitive in primitives)


def remove_extras(file):
    del file.json["meshes"][0]["primitives"][1]["extras"]


def round_number(file):
    file.json["nodes"][4]["extensions"]["ACME_unknown"]["list"]["z"] -= 1


def change_type(file):
    file.json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"][3] = 1.0


def swap_keys(file):
    file.json["extras"] = dict(reversed(file.json["extras"].items()))


def remove_channel(file):
    file.json["animations"][0]["channels"].pop()


def replace_attribute(file):
    attributes = file.json["meshes"][0]["primitives"][0]["attributes"]
    attributes["TEXCOORD_1"] = attributes["TEXCOORD_0"]


def remove_sparse_elements(file):
    target, = file.json["meshes"][1]["primitives"][0]["targets"]
    del file.json["accessors"][target["POSITION"]]["sparse"]


def forget_instance(file):
    file.json["nodes"][6]["mesh"] = 3


def change_bit(file, view):
    view = file.json["bufferViews"][view]
    data = bytearray(file.buffers[view["buffer"]])
    data[view.get("byteOffset", 0) + view["byteLength"] - 1] ^= 1
    file.buffers[view["buffer"]] = bytes(data)


def change_picture(file):
    change_bit(file, file.json["images"][1]["bufferView"])


def change_keys(file):
    change_bit(file, file.json["accessors"][file.json["animations"][1]["samplers"][1]["output"]]["bufferView"])


def change_extension_bytes(file):
    change_bit(file, file.json["extensions"]["ACME_unknown"]["bufferView"])


@pytest.mark.parametrize("change, path", [
    (remove_extras, "meshes[0].primitives[1].extras"), (round_number, "nodes[4].extensions.ACME_unknown"),
    (change_type, "materials[0].pbrMetallicRoughness.baseColorFactor[3]"), (swap_keys, "extras"),
    (remove_channel, "animations[0].channels[4].sampler"), (replace_attribute, "meshes[0].primitives[0].attributes.TEXCOORD_1"),
    (remove_sparse_elements, "meshes[1].primitives[0].targets[0].POSITION.elements"), (forget_instance, "nodes[6].mesh.name"),
    (change_picture, "images[1].bytes"), (change_keys, "animations[1].samplers[1].output.elements"),
    (change_extension_bytes, "extensions.ACME_unknown")])
def test_the_list_names_each_loss(tmp_path, change, path):
    """Check the comparison itself, with files that lost one thing."""
    rich_asset.write(tmp_path / "rich.glb")
    before, after = Asset(tmp_path / "rich.glb"), Asset(tmp_path / "rich.glb")
    assert list_losses(before, after) == []
    change(after)
    losses = list_losses(before, after)
    assert losses and any(line.startswith(path) for line in losses), losses


def test_a_scene_with_the_old_skin_of_an_edited_mesh(folder):
    """Only the default scene gets new joints. A node of another scene that has the same mesh keeps its skin and weights."""
    rich_asset.write(folder / "rich.gltf")
    before = Asset(folder / "rich.gltf")
    before.json["scenes"][1]["nodes"].insert(0, 0)  # the joints
    before.json["nodes"][9].update(mesh=0, skin=0)
    folder.write("two.gltf", json.dumps(before.json))
    folder.run("rig", "two.gltf", "-o", "out.glb", "--handles", "auto:3", "--domain", "surface").is_good()
    after = Asset(folder / "out.glb")

    def skinned_content(file):
        node = file.json["nodes"][9]
        attributes = file.json["meshes"][node["mesh"]]["primitives"][0]["attributes"]
        return (file.json["skins"][node["skin"]]["joints"],
                [file.accessor(attributes[name])["elements"] for name in ("POSITION", "JOINTS_0", "WEIGHTS_0")])

    assert skinned_content(after) == skinned_content(before)


def test_a_skin_whose_joints_are_kept(folder):
    """A skin that gets new weights for its own joints keeps its name and extras."""
    rich_asset.write(folder / "rich.gltf")
    before = Asset(folder / "rich.gltf")
    before.json["skins"][0].update(name="body rig", extras=rich_asset.extras("skin"))
    folder.write("named.gltf", json.dumps(before.json))
    folder.run("rig", "named.gltf", "-o", "out.glb", "--handles", "named.gltf", "--domain", "surface").is_good()
    after = Asset(folder / "out.glb")
    skin = after.json["skins"][after.json["nodes"][3]["skin"]]
    assert (skin["name"], skin.get("extras")) == ("body rig", rich_asset.extras("skin"))
