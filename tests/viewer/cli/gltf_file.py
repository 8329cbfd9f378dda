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

    def scene_matrices(self, moved=None):
        """Return the node-to-scene matrices. `moved` replaces properties of nodes: {(node, "rotation"): value}."""
        moved = moved or {}
        matrices = {}
        roots = self.json["scenes"][self.json.get("scene", 0)]["nodes"]
        waiting = [(node, np.eye(4)) for node in roots]
        while waiting:
            node, above = waiting.pop()
            values = self.json["nodes"][node]

            def value(name, default, node=node, values=values):
                return np.array(moved.get((node, name), values.get(name, default)), dtype=float)

            local = np.eye(4)
            if "matrix" in values:
                local = np.array(values["matrix"], dtype=float).reshape(4, 4).T
            else:
                x, y, z, w = value("rotation", [0, 0, 0, 1])
                rotation = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])
                local[:3, :3] = rotation * value("scale", [1, 1, 1])
                local[:3, 3] = value("translation", [0, 0, 0])
            matrices[node] = above @ local
            waiting += [(child, matrices[node]) for child in values.get("children", [])]
        return matrices

    def skinned_points(self, animation=None, key=0):
        """Return the vertices of all skinned meshes, in the order of the nodes, at a key of an animation or at rest."""
        moved = {}
        if animation is not None:
            motion = self.json["animations"][animation]
            moved = {(channel["target"]["node"], channel["target"]["path"]):
                     self.numbers(motion["samplers"][channel["sampler"]]["output"])[key] for channel in motion["channels"]}
        matrices = self.scene_matrices(moved)
        parts = []
        for node in self.json["nodes"]:
            if "mesh" not in node or "skin" not in node:
                continue
            skin = self.json["skins"][node["skin"]]
            inverse = self.numbers(skin["inverseBindMatrices"]).astype(float).reshape(-1, 4, 4).transpose(0, 2, 1)
            maps = np.stack([matrices[joint] @ bind for joint, bind in zip(skin["joints"], inverse)])
            for primitive in self.json["meshes"][node["mesh"]]["primitives"]:
                attributes = primitive["attributes"]
                points = self.numbers(attributes["POSITION"]).astype(float)
                points = np.concatenate([points, np.ones((len(points), 1))], axis=1)
                posed = np.zeros((len(points), 3))
                for k in range(sum(name.startswith("JOINTS_") for name in attributes)):
                    joints, weights = self.numbers(attributes[f"JOINTS_{k}"]), self.numbers(attributes[f"WEIGHTS_{k}"])
                    for column in range(4):
                        posed += weights[:, column, None] * np.einsum("vij,vj->vi", maps[joints[:, column]], points)[:, :3]
                parts.append(posed)
        return np.concatenate(parts)

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
