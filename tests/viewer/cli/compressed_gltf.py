"""Return glTF files that require decompression. Their compressed data is not valid, so that every library refuses it."""

import json

import foreign_rig


def _file(buffer, attributes, indices, extension, primitive_extensions=None):
    primitive = {"attributes": attributes, "indices": indices, **(primitive_extensions or {})}
    return buffer.complete({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
                            "meshes": [{"primitives": [primitive]}], "extensionsUsed": [extension],
                            "extensionsRequired": [extension]})


def _buffer():
    """Return a buffer with the accessors of a triangle."""
    buffer = foreign_rig.Buffer()
    position = buffer.add([[0, 0, 0], [1, 0, 0], [0, 1, 0]], "VEC3")
    return buffer, {"POSITION": position}, buffer.add([0, 1, 2], "SCALAR", "H")


def draco_text():
    """Return a triangle whose primitive is compressed by Draco."""
    name = "KHR_draco_mesh_compression"
    buffer, attributes, indices = _buffer()
    extension = {"bufferView": 0, "attributes": {"POSITION": 0}}
    file = _file(buffer, attributes, indices, name, {"extensions": {name: extension}})
    for accessor in file["accessors"]:
        del accessor["bufferView"]
    return json.dumps(file)


def meshopt_text():
    """Return a triangle whose positions are in a buffer view that is compressed by meshopt."""
    name = "EXT_meshopt_compression"
    file = _file(*_buffer(), name)
    view = file["bufferViews"][0]
    view["extensions"] = {name: {**view, "byteStride": 12, "count": 3, "mode": "ATTRIBUTES"}}
    return json.dumps(file)
