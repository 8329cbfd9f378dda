"""bindpose rig: a glTF file gets joints and weights and keeps everything else."""

import base64
import json
import struct

import foreign_rig
import numpy as np
import pytest
import shapes
from gltf_file import GltfFile, glb_bytes


@pytest.fixture
def character(folder):
    """A character of 15 meshes with a picture, materials, a camera and animations of its joints."""
    foreign_rig.write_foreign_rig(folder / "c.gltf", animations=3)
    folder.picture = shapes.png(4, 4, lambda x, y: (50 * x, 50 * y, 0, 255))
    folder.write("skin.png", folder.picture)
    return folder


def write_statue(folder):
    """Write a bar without a skin. Its two ends have different materials, and the texture has a seam in the middle, where
    vertices occur twice."""
    vertices, faces = shapes.bar()
    left = [face for face in faces if sum(vertices[v][0] for v in face) < 9]
    right = [face for face in faces if face not in left]
    buffer = foreign_rig.Buffer()
    primitives = []
    for k, part in enumerate((left, right)):
        used = sorted({v for face in part for v in face})
        primitives.append({
            "attributes": {"POSITION": buffer.add([vertices[v] for v in used], "VEC3"),
                           "TEXCOORD_0": buffer.add([[vertices[v][0] / 6, k] for v in used], "VEC2")},
            "indices": buffer.add([used.index(v) for face in part for v in face], "SCALAR", "H"), "material": k})
    file = {"asset": {"version": "2.0", "extras": {"author": "somebody"}}, "scene": 0,
            "scenes": [{"nodes": [0]}],
            "nodes": [{"name": "statue", "mesh": 0, "rotation": [0, 0, 0.6, 0.8], "extras": {"price": 0.1}}],
            "meshes": [{"name": "bar", "primitives": primitives}],
            "materials": [{"name": "gold", "pbrMetallicRoughness": {"metallicFactor": 0.9}}, {"name": "wood"}],
            "extensionsUsed": ["ACME_unknown"], "extensions": {"ACME_unknown": {"list": [1, 2.5, None]}}}
    folder.write("statue.gltf", json.dumps(buffer.complete(file)))


def expect_kept(before, after, new_nodes):
    """Expect that `after` has the text of `before`, with more nodes at the end of the list and one more root."""
    old, new = before.without_skins(), after.without_skins()
    assert len(new["nodes"]) == len(old["nodes"]) + new_nodes
    del new["nodes"][len(old["nodes"]):]
    assert new["scenes"][0]["nodes"].pop() == len(old["nodes"])  # the parent of the joints
    assert new == old
    count = len(before.json["accessors"])
    for k in range(count):
        np.testing.assert_array_equal(after.numbers(k), before.numbers(k))


def test_a_statue_gets_a_skeleton(folder):
    write_statue(folder)
    run = folder.run("rig", "statue.gltf", "-o", "out.glb", "--report", "r.json").is_good()
    report = json.loads((folder / "r.json").read_text())
    joints = report["gltf"]["counts"]["joints"]
    assert joints >= 1 and report["gltf"]["pose_error"] < 1e-6 and report["gltf"]["sets"] == 1
    assert "losses" not in report["gltf"] and run.err.count("warning") == 0
    before, after = GltfFile(folder / "statue.gltf"), GltfFile(folder / "out.glb")
    expect_kept(before, after, joints + 1)
    assert after.json["nodes"][0]["skin"] == 0


def test_vertices_at_a_seam_get_equal_weights(folder):
    write_statue(folder)
    folder.run("rig", "statue.gltf", "--handles", "auto:4", "--influences", "2", "-o", "out.gltf").is_good()
    after = GltfFile(folder / "out.gltf")
    rows = {}
    for primitive in (0, 1):
        points = after.attribute(0, "POSITION", primitive)
        joints, weights = after.attribute(0, "JOINTS_0", primitive), after.attribute(0, "WEIGHTS_0", primitive)
        assert (np.count_nonzero(weights, axis=1) <= 2).all()
        assert weights.sum(axis=1) == pytest.approx(np.ones(len(weights)), abs=1e-6)
        for point, *row in zip(points, joints, weights):
            rows.setdefault(tuple(point), []).append([list(part) for part in row])
    shared = [both for both in rows.values() if len(both) == 2]
    assert len(shared) > 0
    assert all(first == second for first, second in shared)


def test_a_character_keeps_everything_but_its_skin(character):
    run = character.run("rig", "c.gltf", "-o", "out.glb", "--handles", "skeleton:10", "--report", "-").is_good()
    assert run.report["gltf"]["losses"] == ["3 animations of the old joints"]
    assert run.err.count("3 animations of the old joints no longer move the meshes") == 1
    before, after = GltfFile(character / "c.gltf"), GltfFile(character / "out.glb")
    image = after.json["images"][0]
    assert after.view(image.pop("bufferView")) == character.picture and image.pop("mimeType") == "image/png"
    image["uri"] = "skin.png"
    expect_kept(before, after, run.report["gltf"]["counts"]["joints"] + 1)
    for mesh in range(len(after.json["meshes"])):
        assert after.weights(mesh).sum(axis=1) == pytest.approx(np.ones(len(after.attribute(mesh, "POSITION"))))
    skins = {node["skin"] for node in after.json["nodes"] if "mesh" in node}
    assert len({tuple(after.json["skins"][skin]["joints"]) for skin in skins}) == 1  # one skeleton


def test_a_character_gets_new_weights_for_its_own_joints(character):
    run = character.run("rig", "c.gltf", "-o", "out.glb", "--handles", "c.gltf", "--report", "-").is_good()
    report = run.report["gltf"]
    assert report["kept_joints"] == "yes" and "losses" not in report and report["pose_error"] < 1e-5
    before, after = GltfFile(character / "c.gltf"), GltfFile(character / "out.glb")
    old, new = before.without_skins(), after.without_skins()
    old.pop("images"), new.pop("images")
    assert new == old
    joints = {joint for skin in after.json["skins"] for joint in skin["joints"]}
    assert joints <= set(before.json["skins"][0]["joints"])
    for mesh in range(len(after.json["meshes"])):
        assert after.weights(mesh).sum(axis=1) == pytest.approx(np.ones(len(after.attribute(mesh, "POSITION"))))


def test_poses_become_an_animation(folder):
    write_statue(folder)
    folder.write("h.tgf", "1 0.5 0.5 0.5\n2 3 0.5 0.5\n#\n1 2 1 0 0\n")
    folder.write("poses.json", json.dumps({"version": 2, "fps": 8, "frames": [
        {"handles": {"b1": {"rotate": {"axis": [0, 0, 1], "degrees": 20 * k}}}} for k in range(3)]}))
    report = folder.run("rig", "statue.gltf", "--handles", "h.tgf", "--pose", "poses.json", "-o", "out.glb",
                        "--report", "-").is_good().report
    assert report["gltf"]["counts"]["frames"] == 3 and report["gltf"]["animation_error"] < 1e-6
    after = GltfFile(folder / "out.glb")
    assert len(after.json["animations"]) == 1
    info = folder.run("info", "out.glb").is_good().out
    assert "3 frames, 8 per second" in info


def write_obj(folder):
    """Write a bar of quads as an OBJ file with two groups, a texture, and a material file."""
    lines = ["mtllib bar.mtl"]
    vertices, faces = shapes.bar()
    lines += [f"v {x} {y} {z}" for x, y, z in vertices]
    lines += [f"vt {x / 6} {y}" for x, y, _ in vertices]
    squares = [(*a, b[2]) for a, b in zip(faces[::2], faces[1::2])]
    for group, material in (("left", "wood"), ("right", "steel")):
        lines += [f"g {group}", f"usemtl {material}"]
        for square in squares:
            if (sum(vertices[v][0] for v in square) < 12) == (group == "left"):
                lines.append("f " + " ".join(f"{v + 1}/{v + 1}" for v in square))
    folder.write("bar.obj", "\n".join(lines) + "\n")
    folder.write("bar.mtl", "newmtl wood\nKd 0.5 0.25 1\nmap_Kd wood.png\nnewmtl steel\nKd 0.5 0.5 0.5\nPm 1\n")
    picture = shapes.png(4, 4, lambda x, y: (50 * x, 50 * y, 0, 255))
    folder.write("wood.png", picture)
    return picture


def test_an_obj_file_keeps_its_look(folder):
    picture = write_obj(folder)
    run = folder.run("rig", "bar.obj", "-o", "bar.glb").is_good()
    assert "warning" not in run.err
    file = GltfFile(folder / "bar.glb")
    assert [mesh["name"] for mesh in file.json["meshes"]] == ["left", "right"]
    assert [material["name"] for material in file.json["materials"]] == ["wood", "steel"]
    assert file.view(file.json["images"][0]["bufferView"]) == picture
    assert file.json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] == [0.5, 0.25, 1, 1]
    triangles = 0
    for mesh in (0, 1):
        points, texture = file.attribute(mesh, "POSITION"), file.attribute(mesh, "TEXCOORD_0")
        assert texture == pytest.approx(np.stack([points[:, 0] / 6, 1 - points[:, 1]], axis=1), abs=1e-6)
        primitive = file.json["meshes"][mesh]["primitives"][0]
        assert primitive["material"] == mesh
        triangles += len(file.numbers(primitive["indices"])) // 3
        assert file.weights(mesh).sum(axis=1) == pytest.approx(np.ones(len(points)), abs=1e-6)
    assert triangles == len(shapes.bar()[1])


def test_obj_files_with_missing_materials(folder):
    write_obj(folder)
    (folder / "wood.png").unlink()
    run = folder.run("rig", "bar.obj", "--handles", "auto:2", "-o", "bar.glb").is_good()
    assert "the picture 'wood.png' is left out" in run.err
    (folder / "bar.mtl").unlink()
    run = folder.run("rig", "bar.obj", "--handles", "auto:2", "-o", "gray.glb").is_good()
    assert "the materials of 'bar.mtl' are left out" in run.err
    assert [material["name"] for material in GltfFile(folder / "gray.glb").json["materials"]] == ["default"]
    folder.write("out.obj", (folder / "bar.obj").read_text().replace("bar.mtl", "../secret.mtl"))
    secret = folder.path.parent / "secret.mtl"
    secret.write_text("newmtl wood")
    folder.run("rig", "out.obj", "--handles", "auto:2", "-o", "o.glb").is_refused("'../secret.mtl' is not in the folder")
    secret.unlink()


def write_ply(folder):
    """Write a bar as a PLY file with a texture and colors."""
    vertices, faces = shapes.bar()
    names = ("x", "y", "z", "red", "green", "blue", "u", "v")
    lines = ["ply", "format ascii 1.0", "comment TextureFile wood.png", f"element vertex {len(vertices)}"]
    lines += [f"property {'uchar' if name in ('red', 'green', 'blue') else 'float'} {name}" for name in names]
    lines += [f"element face {len(faces)}", "property list uchar int vertex_indices", "end_header"]
    lines += [f"{x} {y} {z} {int(255 * x / 6)} 0 255 {x / 6} {y}" for x, y, z in vertices]
    lines += ["3 " + " ".join(map(str, face)) for face in faces]
    folder.write("bar.ply", "\n".join(lines) + "\n")
    picture = shapes.png(4, 4, lambda x, y: (50 * x, 50 * y, 0, 255))
    folder.write("wood.png", picture)
    return picture


def test_a_ply_file_keeps_its_colors_and_picture(folder):
    picture = write_ply(folder)
    folder.run("rig", "bar.ply", "--handles", "auto:3", "-o", "bar.glb").is_good()
    file = GltfFile(folder / "bar.glb")
    points = file.attribute(0, "POSITION")
    red = np.floor(255 * points[:, 0] / 6) / 255
    linear = np.where(red <= 0.04045, red / 12.92, ((red + 0.055) / 1.055) ** 2.4)
    assert file.attribute(0, "COLOR_0") == pytest.approx(np.stack([linear, 0 * linear, 1 + 0 * linear], axis=1), abs=2e-2)
    assert file.attribute(0, "TEXCOORD_0") == pytest.approx(np.stack([points[:, 0] / 6, 1 - points[:, 1]], axis=1), abs=1e-6)
    texture = file.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"]
    assert file.view(file.json["images"][file.json["textures"][texture]["source"]]["bufferView"]) == picture


COLLADA = """<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit meter="0.5"/><up_axis>Z_UP</up_axis></asset>
<library_images><image id="picture"><init_from>wood.png</init_from></image></library_images>
<library_effects><effect id="effect"><profile_COMMON>
<newparam sid="surface"><surface type="2D"><init_from>picture</init_from></surface></newparam>
<newparam sid="sampler"><sampler2D><source>surface</source></sampler2D></newparam>
<technique sid="common"><phong><emission><color>0 0 0 1</color></emission>
<diffuse><texture texture="sampler" texcoord="UV"/></diffuse></phong></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="wood" name="wood"><instance_effect url="#effect"/></material></library_materials>
<library_geometries><geometry id="bar"><mesh>
<source id="points"><float_array id="p" count="{3n}">{points}</float_array><technique_common>
<accessor source="#p" count="{n}" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<source id="texture"><float_array id="t" count="{2n}">{texture}</float_array><technique_common>
<accessor source="#t" count="{n}" stride="2"><param name="S" type="float"/><param name="T" type="float"/></accessor>
</technique_common></source>
<vertices id="vertices"><input semantic="POSITION" source="#points"/></vertices>
<triangles count="{faces}" material="m"><input semantic="VERTEX" source="#vertices" offset="0"/>
<input semantic="TEXCOORD" source="#texture" offset="0" set="0"/><p>{corners}</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="scene"><node id="arm" name="arm"><translate>0 0 2</translate>
<instance_geometry url="#bar"><bind_material><technique_common><instance_material symbol="m" target="#wood"/>
</technique_common></bind_material></instance_geometry></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#scene"/></scene></COLLADA>
"""


def write_collada(folder):
    """Write a bar with a texture, in units of half a meter and with z up."""
    vertices, faces = shapes.bar()
    text = COLLADA
    for key, value in {"3n": 3 * len(vertices), "2n": 2 * len(vertices), "n": len(vertices), "faces": len(faces),
                       "points": " ".join(f"{x} {y} {z}" for x, y, z in vertices),
                       "texture": " ".join(f"{x / 6} {y}" for x, y, _ in vertices),
                       "corners": " ".join(str(v) for face in faces for v in face)}.items():
        text = text.replace("{" + key + "}", str(value))
    folder.write("bar.dae", text)
    picture = shapes.png(4, 4, lambda x, y: (50 * x, 50 * y, 0, 255))
    folder.write("wood.png", picture)
    return picture


def test_a_collada_file_keeps_its_look(folder):
    picture = write_collada(folder)
    run = folder.run("rig", "bar.dae", "--handles", "auto:3", "-o", "bar.glb", "--report", "-").is_good()
    assert run.report["counts"]["triangles"] == len(shapes.bar()[1])
    file = GltfFile(folder / "bar.glb")
    mesh = next(node["mesh"] for node in file.json["nodes"] if "mesh" in node)
    points, texture = file.attribute(mesh, "POSITION"), file.attribute(mesh, "TEXCOORD_0")
    assert points.max(axis=0) - points.min(axis=0) == pytest.approx([6, 1, 1], abs=1e-5)
    assert texture == pytest.approx(np.stack([points[:, 0] / 6, 1 - points[:, 1]], axis=1), abs=1e-5)
    material = file.json["materials"][file.json["meshes"][mesh]["primitives"][0]["material"]]
    source = file.json["textures"][material["pbrMetallicRoughness"]["baseColorTexture"]["index"]]["source"]
    assert file.view(file.json["images"][source]["bufferView"]) == picture
    skinned, = (id for id, node in enumerate(file.json["nodes"]) if "skin" in node)
    assert set(file.json["nodes"][skinned]) == {"name", "mesh", "skin"} and skinned in file.json["scenes"][0]["nodes"]
    # The scene is in meters, with y up.
    handles = [node["extras"]["bindpose"]["head"] for node in file.json["nodes"] if "extras" in node]
    assert all(-0.01 <= x <= 3.01 and 0.99 <= y <= 1.51 and -0.51 <= z <= 0.01 for x, y, z in handles)


def test_missing_pictures_of_the_importer_are_named(folder):
    write_collada(folder)
    (folder / "wood.png").unlink()
    run = folder.run("rig", "bar.dae", "--handles", "auto:3", "-o", "bar.glb").is_good()
    assert run.err.count("the picture 'wood.png' is left out because it is missing") == 1
    assert not {"images", "textures"} & set(GltfFile(folder / "bar.glb").json)
    folder.write("wood.png", "not a picture")
    words = ("rig", "bar.dae", "--handles", "auto:3", "-o", "bar.glb", "--overwrite")
    assert "wood.png" in folder.run(*words).is_good().err
    text = (folder / "bar.dae").read_text()
    for name in ("wood.tga", "C:\\pictures\\wood.tga", "../secret.png"):
        folder.path.parent.joinpath("secret.png").write_bytes(shapes.png(1, 1, lambda x, y: (0, 0, 0, 255)))
        folder.write("bar.dae", text.replace("wood.png", name))
        run = folder.run(*words).is_good()
        assert f"the picture '{name.rsplit('/', 1)[-1].rsplit(chr(92), 1)[-1]}' is left out" in run.err


def test_damaged_files_of_the_importer(folder):
    write_collada(folder)
    folder.write("half.dae", (folder / "bar.dae").read_text()[:2000])
    folder.run("rig", "half.dae", "-o", "o.glb").is_refused("half.dae cannot be read")
    folder.write("text.fbx", "; FBX 7.4.0 project file\n" + 1000 * "{")
    folder.run("rig", "text.fbx", "-o", "o.glb").is_refused("text.fbx cannot be read")
    folder.run("rig", "none.3ds", "-o", "o.glb").is_refused("none.3ds cannot be read: there is no such file")
    folder.run("rig", "bar.dae", "-o", "o.glb", environment={"BINDPOSE_IMPORTER": "/none"}).is_refused("BINDPOSE_IMPORTER")


def write_with_image(folder, name, uri):
    """Write a bar as .gltf, .glb, .obj or .ply whose texture is the picture file `uri`."""
    if name == "bar.obj":
        write_obj(folder)
        folder.write("bar.mtl", (folder / "bar.mtl").read_text().replace("wood.png", uri))
    elif name == "bar.ply":
        write_ply(folder)
        folder.write("bar.ply", (folder / "bar.ply").read_text().replace("wood.png", uri))
    else:
        write_statue(folder)
        file = json.loads((folder / "statue.gltf").read_text())
        file.update(images=[{"uri": uri}], textures=[{"source": 0}])
        file["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {"index": 0}
        if name == "bar.glb":
            buffer = base64.b64decode(file["buffers"][0].pop("uri").split(",")[1])
            folder.write(name, glb_bytes(file, buffer))
        else:
            folder.write(name, json.dumps(file))


@pytest.mark.parametrize("name", ["bar.glb", "bar.gltf", "bar.obj", "bar.ply"])
def test_images_outside_of_the_folder_are_refused(folder, name):
    """The image exists, so that only its folder is a reason to refuse it."""
    secret = folder.path.parent / "secret.png"
    secret.write_bytes(shapes.png(1, 1, lambda x, y: (0, 0, 0, 255)))
    (folder / "link.png").symlink_to(secret)
    (folder / "pictures").mkdir()
    uris = ["../secret.png", "./../secret.png", "pictures/../../secret.png", "link.png"]
    for uri in uris + (["%2E%2E/secret.png", "..%2Fsecret.png"] if name.startswith("bar.gl") else []):
        write_with_image(folder, name, uri)
        folder.run("rig", name, "--handles", "auto:2", "--domain", "surface", "-o", "out.glb").is_refused(
            name, f"'{uri}' is not in the folder of the")
    secret.unlink()
    write_with_image(folder, name, "pictures/wood.png")
    folder.write("pictures/wood.png", shapes.png(1, 1, lambda x, y: (0, 0, 0, 255)))
    folder.run("rig", name, "--handles", "auto:2", "--domain", "surface", "-o", "out.glb").is_good()
    assert len(GltfFile(folder / "out.glb").json["images"]) == 1


@pytest.mark.parametrize("name, is_embedded", [
    ("bar.glb", True), ("bar.glb", False), ("bar.gltf", True), ("bar.gltf", False), ("bar.obj", False), ("bar.ply", False)])
def test_pictures_with_a_huge_size_are_refused(folder, name, is_embedded):
    folder.write("huge.png", shapes.huge_png())
    if is_embedded and name == "bar.glb":
        write_with_image(folder, "bar.gltf", "")
        file = json.loads((folder / "bar.gltf").read_text())
        buffer = base64.b64decode(file["buffers"][0].pop("uri").split(",")[1])
        buffer += b"\0" * (-len(buffer) % 4)
        file["images"] = [{"bufferView": len(file["bufferViews"]), "mimeType": "image/png"}]
        file["bufferViews"].append({"buffer": 0, "byteOffset": len(buffer), "byteLength": len(shapes.huge_png())})
        file["buffers"][0]["byteLength"] = len(buffer) + len(shapes.huge_png())
        folder.write(name, glb_bytes(file, buffer + shapes.huge_png()))
    else:
        data = "data:image/png;base64," + base64.b64encode(shapes.huge_png()).decode()
        write_with_image(folder, name, data if is_embedded else "huge.png")
    folder.run("rig", name, "--handles", "auto:2", "--domain", "surface", "-o", "out.glb").is_refused(
        name, "100000 x 100000 pixels")


def test_an_imported_file_with_a_huge_picture_is_refused(folder):
    write_collada(folder)
    folder.write("wood.png", shapes.huge_png())
    folder.run("rig", "bar.dae", "--handles", "auto:2", "--domain", "surface", "-o", "out.glb").is_refused(
        "bar.dae", "100000 x 100000 pixels")


def matrix_is_nan(file):
    view = file["bufferViews"][file["accessors"][file["skins"][0]["inverseBindMatrices"]]["bufferView"]]
    head, text = file["buffers"][0]["uri"].split(",")
    data = bytearray(base64.b64decode(text))
    data[view["byteOffset"]:view["byteOffset"] + 4] = struct.pack("<f", float("nan"))
    file["buffers"][0]["uri"] = f"{head},{base64.b64encode(data).decode()}"


def joint_is_no_node(file):
    file["skins"][0]["joints"][3] = 999


def nodes_are_a_cycle(file):
    file["nodes"][2]["children"] = [0]


def add_sparse_points(file):
    """Give the points of a mesh two sparse elements, which are valid. Return the accessor and the size of a view in bytes."""
    head, text = file["buffers"][0]["uri"].split(",")
    data = base64.b64decode(text)
    accessor = file["accessors"][file["meshes"][0]["primitives"][0]["attributes"]["POSITION"]]
    views = []
    for part in (struct.pack("<2H", 1, 2), struct.pack("<6f", *accessor["min"], *accessor["max"])):
        data += b"\0" * (-len(data) % 4)
        file["bufferViews"].append({"buffer": 0, "byteOffset": len(data), "byteLength": len(part)})
        views.append(len(file["bufferViews"]) - 1)
        data += part
    file["buffers"][0] = {"byteLength": len(data), "uri": f"{head},{base64.b64encode(data).decode()}"}
    ids, values = ({"bufferView": view} for view in views)
    accessor["sparse"] = {"count": 2, "indices": {**ids, "componentType": 5123}, "values": values}
    return accessor, len(part)


def sparse_index_is_too_large(file):
    sparse = add_sparse_points(file)[0]["sparse"]
    sparse["count"], sparse["indices"]["componentType"] = 1, 5125  # two indices of 16 bits are one index of 32 bits


def sparse_values_are_beyond_the_view(file):
    accessor, size = add_sparse_points(file)
    accessor["sparse"]["values"]["byteOffset"] = size - 12  # one of two points


def sparse_values_are_beyond_the_buffer(file):
    accessor, _ = add_sparse_points(file)
    view = file["bufferViews"][accessor["bufferView"]]
    file["bufferViews"].append({**view, "byteOffset": file["buffers"][0]["byteLength"] - 12})
    accessor["sparse"]["values"]["bufferView"] = len(file["bufferViews"]) - 1


def sparse_count_is_larger_than_the_count(file):
    accessor, _ = add_sparse_points(file)
    accessor["sparse"]["count"] = accessor["count"] + 1


def sparse_count_is_negative(file):
    add_sparse_points(file)[0]["sparse"]["count"] = -1


def sparse_values_have_a_negative_offset(file):
    add_sparse_points(file)[0]["sparse"]["values"]["byteOffset"] = -4


def sparse_indices_have_a_negative_offset(file):
    add_sparse_points(file)[0]["sparse"]["indices"]["byteOffset"] = -2


def sparse_values_have_a_huge_offset(file):
    add_sparse_points(file)[0]["sparse"]["values"]["byteOffset"] = 2 ** 31 - 4


def sparse_indices_have_a_huge_offset(file):
    add_sparse_points(file)[0]["sparse"]["indices"]["byteOffset"] = 2 ** 31


def sparse_values_have_an_offset_of_33_bits(file):
    add_sparse_points(file)[0]["sparse"]["values"]["byteOffset"] = 2 ** 32


def sparse_indices_have_an_offset_of_33_bits(file):
    add_sparse_points(file)[0]["sparse"]["indices"]["byteOffset"] = 2 ** 32


def sparse_count_has_33_bits(file):
    add_sparse_points(file)[0]["sparse"]["count"] = 2 ** 32 + 1


def points_have_a_negative_offset(file):
    file["accessors"][file["meshes"][0]["primitives"][0]["attributes"]["POSITION"]]["byteOffset"] = -4


def sparse_view_is_missing(file):
    add_sparse_points(file)[0]["sparse"]["values"]["bufferView"] = 999


def buffer_is_outside(file):
    file["buffers"][0]["uri"] = "../secret.bin"


@pytest.mark.parametrize("change, words", [
    (matrix_is_nan, ("inverse bind matrices", "finite")), (joint_is_no_node, ("999",)), (nodes_are_a_cycle, ("cycle",)),
    (sparse_index_is_too_large, ("POSITION", "sparse")), (sparse_values_are_beyond_the_view, ("POSITION", "beyond the end")),
    (sparse_values_are_beyond_the_buffer, ("POSITION", "beyond the end")),
    (sparse_count_is_larger_than_the_count, ("POSITION", "sparse")), (sparse_count_is_negative, ("count is -",)),
    (sparse_values_have_a_negative_offset, ("byteOffset is -",)),
    (sparse_indices_have_a_negative_offset, ("byteOffset is -",)),
    (sparse_values_have_a_huge_offset, ("POSITION", "beyond the end")),
    (sparse_indices_have_a_huge_offset, ("POSITION", "sparse")), (sparse_view_is_missing, ("buffer view 999",)),
    (sparse_values_have_an_offset_of_33_bits, ("byteOffset is 4294967296",)), (sparse_indices_have_an_offset_of_33_bits, ("byteOffset is 4294967296",)),
    (sparse_count_has_33_bits, ("count is 4294967297",)), (points_have_a_negative_offset, ("byteOffset is -4",)),
    (buffer_is_outside, ("secret.bin",))])
def test_bad_assets_are_one_sentence(character, change, words):
    character.path.parent.joinpath("secret.bin").write_bytes(bytes(100000))
    file = json.loads((character / "c.gltf").read_text())
    change(file)
    character.write("bad.gltf", json.dumps(file))
    character.run("rig", "bad.gltf", "-o", "out.glb").is_refused("bad.gltf", *words)
    assert not (character / "out.glb").exists()


def test_sparse_points_are_read(character):
    """Check the file from which the previous test makes files with sparse values out of range."""
    file = json.loads((character / "c.gltf").read_text())
    add_sparse_points(file)
    character.write("good.gltf", json.dumps(file))
    character.run("rig", "good.gltf", "-o", "out.glb", "--handles", "auto:2", "--domain", "surface").is_good()


def test_a_chain_of_a_million_nodes(folder):
    write_statue(folder)
    file = json.loads((folder / "statue.gltf").read_text())
    count = 1_000_000
    file["nodes"] += [{"children": [k + 2]} for k in range(count - 1)] + [{}]
    file["scenes"][0]["nodes"].append(1)
    folder.write("long.gltf", json.dumps(file))
    folder.run("rig", "long.gltf", "--handles", "auto:2", "--domain", "surface", "-o", "chain.glb").is_good()
    assert len(GltfFile(folder / "chain.glb").json["nodes"]) > count


def test_the_weights_of_the_surface(folder):
    write_statue(folder)
    folder.run("rig", "statue.gltf", "--handles", "auto:3", "--domain", "surface", "-o", "out.glb").is_good()
    assert GltfFile(folder / "out.glb").attribute(0, "WEIGHTS_0").shape[1] == 4


def test_refusals(folder):
    write_statue(folder)
    folder.off("cube.off", shapes.cube())
    folder.run("rig", "cube.off", "-o", "out.glb").is_refused("cube.off", ".glb, .gltf, .obj, .ply, .fbx, .dae, .3ds, .3mf")
    folder.run("rig", "statue.gltf", "-o", "out.vtp").is_refused("out.vtp", "glb")
    folder.run("rig", "statue.gltf", "--handles", "bones", "-o", "out.glb").is_refused("--handles 'bones'")
    folder.run("rig", "statue.gltf", "--handles", "statue.gltf", "-o", "out.glb").is_refused("statue.gltf has no joints")
    folder.run("rig", "statue.gltf", "--influences", "-1", "-o", "out.glb").is_refused("--influences", code=1)
    folder.run("rig", "statue.gltf", "--keep-raw", "-o", "out.glb").is_refused("--keep-raw", code=1)
    folder.run("rig", "statue.gltf", "--pose", "none.json", "-o", "out.glb").is_refused("none.json")
    folder.write("cut.gltf", (folder / "statue.gltf").read_bytes()[:200])
    folder.run("rig", "cut.gltf", "-o", "out.glb").is_refused("cut.gltf")
    folder.write("empty.gltf", '{"asset": {"version": "2.0"}}')
    folder.run("rig", "empty.gltf", "-o", "out.glb").is_refused("empty.gltf", "no triangles")
    folder.run("rig", "statue.gltf", "--handles", "auto:4", "-o", "out.glb").is_good()
    folder.run("rig", "statue.gltf", "-o", "out.glb").is_refused("out.glb", "the file exists")
