"""glTF files with compressed meshes, and what a build without the libraries does with them. The compressed data is not valid,
so that the libraries refuse it.
"""

import json

import foreign_rig


def _triangle(extension, is_required):
    """Return the JSON object of a file with a triangle that is not compressed."""
    buffer = foreign_rig.Buffer()
    attributes = {"POSITION": buffer.add([[0, 0, 0], [1, 0, 0], [0, 1, 0]], "VEC3")}
    primitive = {"attributes": attributes, "indices": buffer.add([0, 1, 2], "SCALAR", "H")}
    file = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [primitive]}], "extensionsUsed": [extension]}
    if is_required:
        file["extensionsRequired"] = [extension]
    return buffer.complete(file)


def draco_text(is_required=True):
    """Return a triangle whose primitive is compressed by Draco. If it is not required, there is uncompressed data, too."""
    name = "KHR_draco_mesh_compression"
    file = _triangle(name, is_required)
    file["meshes"][0]["primitives"][0]["extensions"] = {name: {"bufferView": 0, "attributes": {"POSITION": 0}}}
    for accessor in file["accessors"] if is_required else []:
        del accessor["bufferView"]
    return json.dumps(file)


def meshopt_text(is_required=True):
    """Return a triangle whose positions are in a buffer view that is compressed by meshopt. The uncompressed view is not
    used if the compression is required.
    """
    name = "EXT_meshopt_compression"
    file = _triangle(name, is_required)
    view = file["bufferViews"][0]
    view["extensions"] = {name: {**view, "byteStride": 12, "count": 3, "mode": "ATTRIBUTES"}}
    return json.dumps(file)


def expect_missing_library(folder, name, place, package):
    """Expect that no verb reads a compressed file, because Bindpose was built without a library. `place` is the first
    compressed object of the file."""
    sentence = f"{name} cannot be read: bindpose-importer: {place}: Bindpose was built without {package}"
    folder.run("rig", name, "-o", "out.glb").is_refused(sentence)
    folder.run("render", name, "-o", "out.png").is_refused(sentence)
    folder.run("info", name).is_refused(sentence)


def expect_uncompressed_data(folder, name):
    """Expect that the uncompressed triangle of a file is read."""
    assert folder.run("info", name, "--report", "-").is_good().report["bounds"] == [0, 1, 0, 1, 0, 0]
