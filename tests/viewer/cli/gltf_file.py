"""Read a glTF file: its JSON text, and the bytes and numbers to which it refers. Write a .glb file."""

import base64
import json
import struct

import numpy as np

NUMBERS = {5121: "u1", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
COMPONENTS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}


def slerp(p, q, u):
    """Return the rotation between two unit quaternions on the shorter path."""
    q = q if p @ q >= 0 else -q
    angle = np.arccos(min(1.0, p @ q))
    if angle < 1e-6:
        return (1 - u) * p + u * q
    return (np.sin((1 - u) * angle) * p + np.sin(u * angle) * q) / np.sin(angle)


def glb_bytes(file, buffer):
    """Return the bytes of a .glb file with a JSON text and a buffer."""
    text = json.dumps(file, ensure_ascii=False).encode()
    text += b" " * (-len(text) % 4)
    buffer += b"\0" * (-len(buffer) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(buffer), b"BIN\0") + buffer
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


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

    def key_times(self, animation):
        """Return the times of all keys of an animation, in seconds."""
        samplers = self.json["animations"][animation]["samplers"]
        return np.unique(np.concatenate([self.numbers(sampler["input"]).ravel() for sampler in samplers])).astype(float)

    def sampled(self, sampler, path, time):
        """Return the value of an animated property at a time, as glTF defines it."""
        times, values = self.numbers(sampler["input"]).ravel().astype(float), self.numbers(sampler["output"]).astype(float)
        cubic = sampler.get("interpolation", "LINEAR") == "CUBICSPLINE"
        values = values.reshape(len(times), 3 if cubic else 1, -1)  # key; in-tangent, value and out-tangent; component
        key = max(0, np.searchsorted(times, time, side="right") - 1)
        after = min(key + 1, len(times) - 1)
        length = times[after] - times[key]
        u = max(0.0, (time - times[key]) / length) if length > 0 else 0.0
        if cubic:
            (_, p, out_slope), (in_slope, q, _) = values[key], values[after]
            value = ((2 * u ** 3 - 3 * u ** 2 + 1) * p + length * (u ** 3 - 2 * u ** 2 + u) * out_slope
                     + (3 * u ** 2 - 2 * u ** 3) * q + length * (u ** 3 - u ** 2) * in_slope)
        elif sampler.get("interpolation") == "STEP":
            value = values[key, 0]
        elif path == "rotation":
            value = slerp(values[key, 0], values[after, 0], u)
        else:
            value = (1 - u) * values[key, 0] + u * values[after, 0]
        return value / np.linalg.norm(value) if path == "rotation" else value

    def skinned_points(self, animation=None, time=0.0):
        """Return the vertices of all skinned meshes, in the order of the nodes, at a time of an animation or at rest."""
        moved, known = {}, {}
        motion = {"channels": []} if animation is None else self.json["animations"][animation]
        for channel in motion["channels"]:
            sampler, path = motion["samplers"][channel["sampler"]], channel["target"]["path"]
            key = (sampler["input"], sampler["output"], sampler.get("interpolation"), path)  # many joints have the same keys
            if key not in known:
                known[key] = self.sampled(sampler, path, time)
            moved[channel["target"]["node"], path] = known[key]
        matrices = self.scene_matrices(moved)
        skin_maps, parts = {}, []
        for id, node in enumerate(self.json["nodes"]):
            if "mesh" not in node or "skin" not in node:
                continue
            if node["skin"] not in skin_maps:
                skin = self.json["skins"][node["skin"]]
                inverse = self.numbers(skin["inverseBindMatrices"]).astype(float).reshape(-1, 4, 4).transpose(0, 2, 1)
                skin_maps[node["skin"]] = np.stack([matrices[joint] for joint in skin["joints"]]) @ inverse
            maps = skin_maps[node["skin"]]
            for primitive in self.json["meshes"][node["mesh"]]["primitives"]:
                attributes = primitive["attributes"]
                points = self.numbers(attributes["POSITION"]).astype(float)
                rest = node.get("weights", self.json["meshes"][node["mesh"]].get("weights", []))
                for weight, target in zip(moved.get((id, "weights"), rest), primitive.get("targets", [])):
                    points = points + weight * self.numbers(target["POSITION"])
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
