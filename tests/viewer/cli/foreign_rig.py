"""Write a character as other programs export it: a glTF file of 15 meshes on one skin with helper joints, dozens of
animations whose scales are uneven by round-off, materials with a texture, and a camera.
"""

import base64
import json
import math
import struct

# Each row contains joint, parent and rest position. The joints root and pelvis have the same position as the joint
# hips. The joints target and pole, which control a foot in the exporting program, have the same nearest mesh point.
JOINTS = [("root", None, (0, 1, 0)), ("hips", "root", (0, 1, 0)), ("pelvis", "hips", (0, 1, 0)),
          ("spine", "hips", (0, 1.3, 0)), ("neck", "spine", (0, 1.7, 0)), ("head", "neck", (0, 1.9, 0)),
          ("upper_arm.L", "spine", (0.3, 1.6, 0)), ("forearm.L", "upper_arm.L", (0.7, 1.6, 0)),
          ("hand.L", "forearm.L", (1.1, 1.6, 0)), ("upper_arm.R", "spine", (-0.3, 1.6, 0)),
          ("forearm.R", "upper_arm.R", (-0.7, 1.6, 0)), ("hand.R", "forearm.R", (-1.1, 1.6, 0)),
          ("thigh.L", "hips", (0.15, 0.9, 0)), ("shin.L", "thigh.L", (0.15, 0.5, 0)), ("foot.L", "shin.L", (0.15, 0.1, 0)),
          ("thigh.R", "hips", (-0.15, 0.9, 0)), ("shin.R", "thigh.R", (-0.15, 0.5, 0)), ("foot.R", "shin.R", (-0.15, 0.1, 0)),
          ("target.L", "root", (0.6, -0.4, 0.6)), ("pole.L", "root", (0.8, -0.5, 0.7))]
WITHOUT_WEIGHTS = ("root", "pelvis", "hand.L", "hand.R", "target.L", "pole.L")
UNEVEN = (1.0, 1.0 + 2e-6, 1.0 - 1.8e-6)  # a uniform scale after rounding to single precision

# Each row is one mesh, a box: name, lower and upper corner, joint.
BOXES = [("torso", (-0.3, 1.2, -0.15), (0.3, 1.65, 0.15), "spine"), ("hip", (-0.25, 0.85, -0.15), (0.25, 1.25, 0.15), "hips"),
         ("neck", (-0.08, 1.6, -0.08), (0.08, 1.85, 0.08), "neck"), ("head", (-0.15, 1.8, -0.15), (0.15, 2.15, 0.15), "head"),
         ("hair", (-0.17, 2.1, -0.17), (0.17, 2.2, 0.17), "head")]
for _side, _sign in (("L", 1), ("R", -1)):
    for _name, _from, _to, _joint in (("upper_arm", 0.25, 0.75, "upper_arm"), ("forearm", 0.65, 1.15, "forearm")):
        _x = sorted((_sign * _from, _sign * _to))
        BOXES.append((f"{_name}.{_side}", (_x[0], 1.52, -0.08), (_x[1], 1.68, 0.08), f"{_joint}.{_side}"))
    for _name, _from, _to, _joint in (("thigh", 0.45, 0.95, "thigh"), ("shin", 0.05, 0.55, "shin"), ("foot", 0.0, 0.1, "foot")):
        _x = sorted((_sign * 0.05, _sign * 0.25))
        BOXES.append((f"{_name}.{_side}", (_x[0], _from, -0.1), (_x[1], _to, 0.2 if _name == "foot" else 0.1), f"{_joint}.{_side}"))


def _box(lower, upper, cuts=3):
    """Return the surface of a box as a grid of triangles."""
    ids, points, triangles = {}, [], []

    def vertex(at):
        if at not in ids:
            ids[at] = len(points)
            points.append([lower[k] + (upper[k] - lower[k]) * at[k] / cuts for k in range(3)])
        return ids[at]

    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for side in (0, cuts):
            for i in range(cuts):
                for j in range(cuts):
                    corners = []
                    for di, dj in ((0, 0), (1, 0), (1, 1), (0, 1)):
                        at = [0, 0, 0]
                        at[axis], at[u], at[v] = side, i + di, j + dj
                        corners.append(vertex(tuple(at)))
                    corners = corners if side else corners[::-1]
                    triangles += [corners[:3], [corners[0], corners[2], corners[3]]]
    return points, triangles


class Buffer:
    """Collects the binary data of a glTF file."""

    def __init__(self):
        self.bytes, self.views, self.accessors = b"", [], []

    def add(self, rows, kind, code="f", unit=False):
        flat = [x for row in rows for x in (row if isinstance(row, (list, tuple)) else [row])]
        data = struct.pack(f"<{len(flat)}{code}", *flat)
        self.views.append({"buffer": 0, "byteOffset": len(self.bytes), "byteLength": len(data)})
        self.bytes += data + b"\0" * (-len(data) % 4)
        types = {"f": 5126, "B": 5121, "H": 5123, "I": 5125}
        accessor = {"bufferView": len(self.views) - 1, "componentType": types[code], "count": len(rows), "type": kind}
        if unit:
            accessor["normalized"] = True
        if kind in ("SCALAR", "VEC3") and code == "f":
            columns = list(zip(*[row if isinstance(row, (list, tuple)) else [row] for row in rows]))
            accessor["min"], accessor["max"] = [min(c) for c in columns], [max(c) for c in columns]
        self.accessors.append(accessor)
        return len(self.accessors) - 1

    def complete(self, file):
        """Add the accessors, and the binary data as base64, to the JSON text of a file."""
        data = "data:application/octet-stream;base64," + base64.b64encode(self.bytes).decode()
        return {**file, "bufferViews": self.views, "accessors": self.accessors,
                "buffers": [{"byteLength": len(self.bytes), "uri": data}]}


def _fingers(count):
    """Return a chain of finger joints for each hand."""
    return [(f"finger{k}.{side}", f"finger{k - 1}.{side}" if k else f"hand.{side}", (sign * (1.12 + 0.01 * k), 1.6, 0.02 * k))
            for side, sign in (("L", 1), ("R", -1)) for k in range(count)]


def _weights(names, joint, vertex, fingers):
    """Return the joints and weights of a vertex. Forearms also follow the fingers, if there are any."""
    if joint.startswith("forearm") and fingers:
        finger = names.index(f"finger{vertex % fingers}{joint[-2:]}")
        return [names.index(joint), finger, 0, 0], [0.625, 0.375, 0.0, 0.0]
    return [names.index(joint), 0, 0, 0], [1.0, 0.0, 0.0, 0.0]


def _with_tangents(rows, interpolation):
    """Return the values of a sampler. For CUBICSPLINE, each key has an in-tangent and an out-tangent, which differ."""
    if interpolation != "CUBICSPLINE":
        return rows
    result = []
    for k, row in enumerate(rows):
        slopes = [(-1) ** (k + c) * (2.0 + c) for c in range(len(row))]
        result += [slopes, row, [1.5 * slope for slope in slopes]]
    return result


def write_foreign_rig(path, animations=76, keys=5, placeholder=False, fingers=0, interpolation="LINEAR", morph_targets=0):
    """Write the character as text (.gltf) with embedded binary data. If `placeholder` is true, all vertices belong to
    hips. Each hand has `fingers` more joints. `interpolation` is that of the joints. Each mesh has `morph_targets` targets,
    whose weights are animated by LINEAR interpolation.
    """
    all_joints = JOINTS + _fingers(fingers)
    names = [name for name, _, _ in all_joints]
    places = {name: place for name, _, place in all_joints}
    buffer = Buffer()
    nodes = []
    for name, parent, place in all_joints:
        above = places.get(parent, (0, 0, 0))
        nodes.append({"name": name, "translation": [place[k] - above[k] for k in range(3)], "scale": list(UNEVEN)})
        children = [k for k, (_, up, _) in enumerate(all_joints) if up == name]
        if children:
            nodes[-1]["children"] = children
    inverse = buffer.add([[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, *(-x for x in places[name]), 1] for name in names], "MAT4")
    meshes = []
    for k, (name, lower, upper, joint) in enumerate(BOXES):
        points, triangles = _box(lower, upper)
        rows = [_weights(names, "hips" if placeholder else joint, v, fingers) for v in range(len(points))]
        primitive = {
            "attributes": {
                "POSITION": buffer.add(points, "VEC3"),
                "TEXCOORD_0": buffer.add([[p[0] % 1, p[1] % 1] for p in points], "VEC2"),
                "JOINTS_0": buffer.add([joints for joints, _ in rows], "VEC4", "B"),
                "WEIGHTS_0": buffer.add([weights for _, weights in rows], "VEC4")},
            "indices": buffer.add([x for t in triangles for x in t], "SCALAR", "H"),
            "material": k % 2}
        if morph_targets:
            shifts = [[[0.2 * x * ((v + target) % 3) for x in p] for v, p in enumerate(points)] for target in range(morph_targets)]
            primitive["targets"] = [{"POSITION": buffer.add(rows, "VEC3")} for rows in shifts]
        meshes.append({"name": name, "primitives": [primitive]})
        nodes.append({"name": f"{name} mesh", "mesh": k, "skin": 0})
    nodes.append({"name": "camera", "camera": 0})
    times = buffer.add([k / 24 for k in range(keys)], "SCALAR")
    scales = buffer.add(_with_tangents([list(UNEVEN)] * keys, interpolation), "VEC3")
    morph_weights = buffer.add([abs(math.sin(k + 1)) for k in range(keys * morph_targets)], "SCALAR") if morph_targets else None
    tracks = []
    for swing in (0.2, 0.4):
        half = [0.5 * swing * math.sin(2 * math.pi * k / (keys - 1)) for k in range(keys)]
        turns = [[math.sin(h), 0.0, 0.0, math.cos(h)] for h in half]
        tracks.append(buffer.add(_with_tangents(turns, interpolation), "VEC4"))
    motions = []
    for which in range(animations):
        samplers, channels = [], []
        for node in range(len(all_joints)):
            for values, target in ((tracks[(which + node) % 2], "rotation"), (scales, "scale")):
                channels.append({"sampler": len(samplers), "target": {"node": node, "path": target}})
                samplers.append({"input": times, "output": values, "interpolation": interpolation})
        for node in range(len(all_joints), len(all_joints) + len(meshes) if morph_targets else 0):
            channels.append({"sampler": len(samplers), "target": {"node": node, "path": "weights"}})
        if morph_targets:
            samplers.append({"input": times, "output": morph_weights, "interpolation": "LINEAR"})
        motions.append({"name": f"Motion {which}", "samplers": samplers, "channels": channels})
    file = {
        "asset": {"version": "2.0", "generator": "another program"}, "scene": 0,
        "scenes": [{"nodes": [0, *range(len(all_joints), len(nodes))]}], "nodes": nodes, "meshes": meshes,
        "skins": [{"joints": list(range(len(all_joints))), "inverseBindMatrices": inverse, "skeleton": 0}],
        "animations": motions,
        "materials": [{"name": "skin", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}, {"name": "cloth"}],
        "textures": [{"source": 0}], "images": [{"uri": "skin.png"}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}]}
    with open(path, "w", encoding="utf-8") as out:
        json.dump(buffer.complete(file), out)
