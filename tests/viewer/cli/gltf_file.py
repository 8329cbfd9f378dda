"""Read a glTF file: its JSON text, and the bytes and numbers to which it refers."""

import base64
import json
import struct

import numpy as np

NUMBERS = {5121: "u1", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
COMPONENTS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}


class GltfFile:
    """A .glb file, or a .gltf file with its buffer as base64 text."""

    def __init__(self, path):
        content = path.read_bytes()
        if content[:4] == b"glTF":
            size = struct.unpack("<I", content[12:16])[0]
            self.json = json.loads(content[20:20 + size])
            self.buffer = content[28 + size:]
        else:
            self.json = json.loads(content)
            self.buffer = base64.b64decode(self.json["buffers"][0]["uri"].split(",", 1)[1])

    def view(self, view):
        """Return the bytes of a buffer view."""
        view = self.json["bufferViews"][view]
        begin = view.get("byteOffset", 0)
        return self.buffer[begin:begin + view["byteLength"]]

    def numbers(self, accessor):
        """Return the values of an accessor, one row per element."""
        accessor = self.json["accessors"][accessor]
        columns = COMPONENTS[accessor["type"]]
        values = np.frombuffer(self.view(accessor["bufferView"]), NUMBERS[accessor["componentType"]],
                               accessor["count"] * columns, accessor.get("byteOffset", 0))
        return values.reshape(-1, columns)

    def attribute(self, mesh, name, primitive=0):
        """Return an attribute of a mesh."""
        return self.numbers(self.json["meshes"][mesh]["primitives"][primitive]["attributes"][name])

    def weights(self, mesh):
        """Return the weights of a mesh: a matrix #V x #joints of its skin."""
        skin = next(node["skin"] for node in self.json["nodes"] if node.get("mesh") == mesh)
        joints, values = self.attribute(mesh, "JOINTS_0"), self.attribute(mesh, "WEIGHTS_0")
        result = np.zeros((len(joints), len(self.json["skins"][skin]["joints"])))
        for column in range(4):
            result[np.arange(len(joints)), joints[:, column]] += values[:, column]
        return result

    def without_skins(self):
        """Return a copy of the JSON text without skins, joints, weights and binary data."""
        text = json.loads(json.dumps(self.json))
        for key in ("skins", "accessors", "bufferViews", "buffers"):
            text.pop(key, None)
        for node in text["nodes"]:
            node.pop("skin", None)
        for mesh in text["meshes"]:
            for primitive in mesh["primitives"]:
                for name in [name for name in primitive["attributes"] if name.startswith(("JOINTS_", "WEIGHTS_"))]:
                    del primitive["attributes"][name]
        return text
