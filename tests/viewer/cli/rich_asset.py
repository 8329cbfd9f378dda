"""Write an asset with one of everything that glTF allows: several meshes and primitives, two sets of texture coordinates,
tangents, colors, morph targets, sparse accessors, images, materials with extensions, lights, cameras, animations of all
interpolations, two scenes, an unknown extension, and extras on every kind of object.
"""

import base64
import json
import math
import struct

import shapes
from gltf_file import glb_bytes

PICTURES = [shapes.png(4, 4, lambda x, y: (60 * x, 60 * y, 0, 255)), shapes.png(2, 2, lambda x, y: (0, 90 * x, 90 * y, 255))]
CODES = {"b": 5120, "B": 5121, "h": 5122, "H": 5123, "I": 5125, "f": 5126}
ARRAY, ELEMENT_ARRAY = 34962, 34963
TYPES = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}
# Numbers and texts that a writer of JSON can change: integers above 2^53, the shortest decimal form, signed zeros, types.
DIFFICULT = {"z": 9007199254740993, "a": [0.1, 1e-7, 1.0, 1, -0.0, 123456789.123456789, 5e-324, 1.7976931348623157e308],
             "text": "Kopf \u00df \u4eba \U0001f9b4 \"\\/\n\u0001", "none": None, "yes": True, "empty": [{}, [], ""]}


def extras(name):
    """Return the extras of one object. Integers in extras are no references."""
    return {"of": name, **DIFFICULT, "bufferView": 99, "indices": 77}


class Writer:
    """Collects the buffers, buffer views and accessors of a glTF file. Consecutive views are in different buffers."""

    def __init__(self, buffers):
        self.buffers = [b""] * buffers
        self.views, self.accessors = [], []

    def view(self, data, target=None, stride=None):
        buffer = len(self.views) % len(self.buffers)
        self.buffers[buffer] += b"\0" * (-len(self.buffers[buffer]) % 8)
        view = {"buffer": buffer, "byteOffset": len(self.buffers[buffer]), "byteLength": len(data),
                "name": f"view {len(self.views)}", "extras": extras("view")}
        if target:
            view["target"] = target
        if stride:
            view["byteStride"] = stride
        self.views.append(view)
        self.buffers[buffer] += data
        return len(self.views) - 1

    def accessor(self, rows, code="f", *, view=None, offset=0, target=ARRAY, unit=False, sparse=None):
        """Add an accessor. view: the rows are part of a view that exists. sparse: {index: row}, rows that replace others;
        then `rows` may be the number of zero rows, of which no bytes are stored."""
        first = sparse[min(sparse)] if isinstance(rows, int) else rows[0]
        columns = len(first)
        accessor = {"componentType": CODES[code], "count": rows if isinstance(rows, int) else len(rows), "type": TYPES[columns],
                    "name": f"accessor {len(self.accessors)}", "extras": extras("accessor")}
        if not isinstance(rows, int):
            accessor["bufferView"] = self.view(pack(rows, code), target) if view is None else view
            if offset:
                accessor["byteOffset"] = offset
        if unit:
            accessor["normalized"] = True
        all_rows = [[0] * columns] * rows if isinstance(rows, int) else list(rows)
        if sparse:
            ids = sorted(sparse)
            for id in ids:
                all_rows[id] = sparse[id]
            accessor["sparse"] = {
                "count": len(ids), "extras": extras("sparse"),
                "indices": {"bufferView": self.view(pack([[id] for id in ids], "H")), "componentType": CODES["H"]},
                "values": {"bufferView": self.view(pack([sparse[id] for id in ids], code))}}
        if columns in (1, 3) and not unit:
            stored = [struct.unpack(f"<{columns}{code}", pack([row], code)) for row in all_rows]
            accessor["min"] = [min(column) for column in zip(*stored)]
            accessor["max"] = [max(column) for column in zip(*stored)]
        self.accessors.append(accessor)
        return len(self.accessors) - 1


def pack(rows, code):
    return struct.pack(f"<{sum(len(row) for row in rows)}{code}", *(x for row in rows for x in row))


def unit(*vector):
    length = math.sqrt(sum(x * x for x in vector))
    return [x / length for x in vector]


def body(writer):
    """Return two primitives of a bar along x, one per half, with all attributes and two morph targets."""
    vertices, faces = shapes.bar(8, 2, 2)
    primitives = []
    for half in (0, 1):
        part = [face for face in faces if (sum(vertices[v][0] for v in face) < 9) == (half == 0)]
        used = sorted({v for face in part for v in face})
        points = [vertices[v] for v in used]
        normals = [unit(0, y - 0.5 + 0.01, z - 0.5) for _, y, z in points]
        both = writer.view(pack([[*p, *n] for p, n in zip(points, normals)], "f"), ARRAY, 24)
        attributes = {
            "POSITION": writer.accessor(points, view=both),
            "NORMAL": writer.accessor(normals, view=both, offset=12),
            "TANGENT": writer.accessor([[*unit(n[2], 0, 0.1 - n[0]), 1.0 if half else -1.0] for n in normals]),
            "TEXCOORD_0": writer.accessor([[p[0] / 7, p[1] / 3] for p in points]),
            "TEXCOORD_1": writer.accessor([[int(9000 * p[0]), int(65535 * p[2])] for p in points], "H", unit=True),
            "COLOR_0": writer.accessor([[int(40 * p[0]), int(255 * p[1]), 7, 255] for p in points], "B", unit=True),
            "_TEMPERATURE": writer.accessor([[p[0] / 3 - p[1]] for p in points]),
            "JOINTS_0": writer.accessor([[0, 1, 0, 0]] * len(points), "B"),
            "WEIGHTS_0": writer.accessor([[0.875 - p[0] / 8, 0.125 + p[0] / 8, 0, 0] for p in points])}
        targets = [{name: writer.accessor([[scale * p[k] * (k + 1) / 7 for k in range(3)] for p in points])
                    for name in ("POSITION", "NORMAL", "TANGENT")} for scale in (0.3, -0.2)]
        primitives.append({
            "attributes": attributes, "targets": targets, "material": half, "mode": 4,
            "indices": writer.accessor([[used.index(v)] for face in part for v in face], "HI"[half], target=ELEMENT_ARRAY),
            "extras": extras("primitive"),
            "extensions": {"ACME_unknown": {"accessor": writer.accessor([[0.1 * k] for k in range(5)], target=None)},
                           "KHR_materials_variants": {"mappings": [{"material": 2, "variants": [half]}]}}})
    return primitives


def ball(writer):
    """Return a primitive whose points and morph target are sparse."""
    vertices, faces = shapes.sphere(8, 6, 0.7)
    moved = {1: [0, 0, -0.8], 5: [x * 1.1 for x in vertices[5]], 20: [x * 0.9 for x in vertices[20]]}
    return {"attributes": {"POSITION": writer.accessor(vertices, sparse=moved),
                           "TEXCOORD_0": writer.accessor([[int(127 + 120 * v[0]), 9] for v in vertices], "H", unit=True),
                           "COLOR_0": writer.accessor([[0.5, v[0] ** 2, 1 / 3] for v in vertices])},
            "targets": [{"POSITION": writer.accessor(len(vertices), sparse={2: [0, 0.5, 1 / 3], 7: [0.1, 0, 0]})}],
            "indices": writer.accessor([[v] for face in faces for v in face], "B", target=ELEMENT_ARRAY), "material": 2}


def strip(writer, mode):
    """Return a primitive without indices."""
    points = [[0.1 * k, k % 2 - 3.0, 0.01 * k * k] for k in range(9)]
    return {"attributes": {"POSITION": writer.accessor(points)}, "mode": mode, "material": 1}


def materials():
    def texture(index, **more):
        return {"index": index, "extras": extras("texture info"), **more}

    transform = {"KHR_texture_transform": {"offset": [0.1, 0.7], "rotation": 0.3, "scale": [2, 1.5], "texCoord": 0}}
    return [
        {"name": "skin", "extras": extras("material"), "emissiveFactor": [0.1, 1, 0.3], "doubleSided": True,
         "pbrMetallicRoughness": {"baseColorFactor": [0.8, 0.7, 0.6, 1], "metallicFactor": 0.1, "extras": extras("pbr"),
                                  "baseColorTexture": texture(0, texCoord=1, extensions=transform),
                                  "metallicRoughnessTexture": texture(1)},
         "normalTexture": texture(1, scale=0.7), "occlusionTexture": texture(2, strength=0.9), "emissiveTexture": texture(0),
         "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 3.3},
                        "KHR_materials_clearcoat": {"clearcoatFactor": 0.6, "clearcoatTexture": texture(2)},
                        "ACME_unknown": DIFFICULT}},
        {"name": "glass", "alphaMode": "BLEND", "extensions": {"KHR_materials_transmission": {"transmissionFactor": 0.9},
                                                               "KHR_materials_ior": {"ior": 1.33}}},
        {"name": "paper", "alphaMode": "MASK", "alphaCutoff": 0.3, "pbrMetallicRoughness": {"baseColorTexture": {"index": 2}},
         "extensions": {"KHR_materials_unlit": {}}},
        {"name": "unused"}]


def animations(writer):
    times = [writer.accessor([[t] for t in row], target=None) for row in ([0.0, 0.3, 1.0], [0.1, 0.25])]
    half = math.sqrt(0.5)
    turns = [[0, 0, 0, 1], [0, 0, 0.6, 0.8], [0, half, 0, half]]
    rows = {"turns": turns, "steps": [[0.1, 1, 0], [0.3, 2, 0], [0, 1.5, 0]],
            "sizes": [[1 + 0.1 * k, 1, 1 - 0.03 * k] for k in range(6)], "cubic turns": [[0, 0.01 * k, 0, 1] for k in range(6)],
            "two weights": [[0.1], [0.9], [0.3], [0.2], [1], [0]], "cubic weight": [[k / 7] for k in range(6)]}
    outputs = {name: writer.accessor(row, target=None) for name, row in rows.items()}
    tracks = [
        ("walk", [(1, "rotation", "LINEAR", 0, "turns"), (2, "translation", "STEP", 0, "steps"),
                  (2, "scale", "CUBICSPLINE", 1, "sizes"), (7, "rotation", "CUBICSPLINE", 1, "cubic turns"),
                  (7, "translation", None, 0, "steps")]),
        ("talk", [(3, "weights", "LINEAR", 0, "two weights"), (4, "weights", "CUBICSPLINE", 1, "cubic weight")]),
        ("blink", [(3, "weights", "STEP", 0, "two weights")])]
    result = []
    for name, channels in tracks:
        samplers = []
        for _, _, interpolation, input, output in channels:
            samplers.append({"input": times[input], "output": outputs[output], "extras": extras("animation sampler")})
            if interpolation:
                samplers[-1]["interpolation"] = interpolation
        result.append({"name": name, "extras": extras("animation"), "samplers": samplers, "channels": [
            {"sampler": k, "extras": extras("channel"), "target": {"node": node, "path": path, "extras": extras("target")}}
            for k, (node, path, *_) in enumerate(channels)]})
    return result


def content(writer):
    """Return the JSON text of the file, except for buffers and images."""
    meshes = [
        {"name": "body", "primitives": body(writer), "weights": [0.25, 0],
         "extras": {"targetNames": ["smile", "frown"], **extras("mesh")}},
        {"name": "ball", "primitives": [ball(writer)], "weights": [0.1]},
        {"name": "strip", "primitives": [strip(writer, 5), strip(writer, 3)]},
        {"name": "dots", "primitives": [strip(writer, 0)]},
        {"name": "elsewhere", "primitives": [strip(writer, 5)]}]
    rigid = {"JOINTS_0": writer.accessor([[0, 0, 0, 0]] * 9, "B"), "WEIGHTS_0": writer.accessor([[1, 0, 0, 0]] * 9)}
    meshes[4]["primitives"][0]["attributes"].update(rigid)
    skins = []
    for joints in ([1, 2], [10]):
        inverse = [[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1 - 2 * joint, -0.5, -0.5, 1] for joint in joints]
        skins.append({"joints": joints, "inverseBindMatrices": writer.accessor(inverse, target=None)})
    skins[0]["skeleton"], skins[1]["name"], skins[1]["extras"] = 1, "second", extras("skin of the second scene")
    nodes = [
        {"name": "root", "children": [1], "extras": extras("node")},
        {"name": "hip", "children": [2], "translation": [1, 0.5, 0.5], "extras": extras("joint")},
        {"name": "knee", "translation": [2, 0, 0]},
        {"name": "body", "mesh": 0, "skin": 0, "weights": [0.5, 0.1]},
        {"name": "ball", "mesh": 1, "translation": [1, 4, 0.1], "rotation": [0.6, 0, 0, 0.8], "scale": [1, 1.1, 0.9],
         "extensions": {"ACME_unknown": {"attributes": {"WIND": writer.accessor([[0.1, 0.2, 0.3]], target=None)},
                                         "list": DIFFICULT}}},
        {"name": "strip A", "mesh": 2, "matrix": [0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0.3, 1, 0.1, 1]},
        {"name": "strip B", "mesh": 2, "translation": [0, 0, 3]},
        {"name": "eye", "camera": 0, "translation": [0, 1, 9], "extensions": {"KHR_lights_punctual": {"light": 0}}},
        {"name": "dots", "mesh": 3},
        {"name": "elsewhere", "mesh": 4, "skin": 1, "camera": 1, "children": [10]},
        {"name": "tail", "translation": [0, 0.1, 0]}]
    return {
        "asset": {"version": "2.0", "generator": "another program", "copyright": "\u00a9 somebody", "extras": extras("asset")},
        "extensionsUsed": ["KHR_texture_transform", "KHR_materials_emissive_strength", "KHR_materials_clearcoat",
                           "KHR_materials_transmission", "KHR_materials_ior", "KHR_materials_unlit", "KHR_materials_variants",
                           "KHR_lights_punctual", "ACME_unknown"],
        "extensionsRequired": ["KHR_texture_transform"],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "color": [1, 0.9, 0.8], "intensity": 12.5}]},
                       "KHR_materials_variants": {"variants": [{"name": "summer"}, {"name": "winter"}]},
                       "ACME_unknown": {"bufferView": writer.view(b"bytes of an unknown extension"), "difficult": DIFFICULT}},
        "extras": extras("file"), "scene": 0,
        "scenes": [{"name": "first", "nodes": [0, 3, 4, 5, 6, 7, 8], "extras": extras("scene")},
                   {"name": "second", "nodes": [9]}],
        "nodes": nodes, "meshes": meshes,
        "skins": skins,
        "cameras": [{"name": "wide", "type": "perspective", "extras": extras("camera"),
                     "perspective": {"yfov": 0.8, "znear": 0.1, "aspectRatio": 1.5, "extras": extras("perspective")}},
                    {"type": "orthographic", "orthographic": {"xmag": 2, "ymag": 1.5, "znear": 0, "zfar": 9.5}}],
        "materials": materials(), "animations": animations(writer),
        "textures": [{"source": 0, "sampler": 0, "extras": extras("texture")}, {"source": 1, "sampler": 1, "name": "rough"},
                     {"source": 1}],
        "samplers": [{"magFilter": 9728, "wrapS": 33071, "extras": extras("sampler")}, {"minFilter": 9987}]}


def image_objects(sources):
    """Return the list of images; each source is a buffer view with a MIME type, or a URI."""
    return [{"name": f"picture {k}", "extras": extras("image"), **source} for k, source in enumerate(sources)]


def write(path):
    """Write the asset as .glb with pictures in buffer views; or as .gltf with one buffer in a file and one as base64, and the
    pictures in two more files."""
    (write_gltf if path.suffix == ".gltf" else write_glb)(path)


def write_glb(path):
    writer = Writer(1)
    file = content(writer)
    file["images"] = image_objects({"bufferView": writer.view(picture), "mimeType": "image/png"} for picture in PICTURES)
    file.update(bufferViews=writer.views, accessors=writer.accessors,
                buffers=[{"byteLength": len(writer.buffers[0]), "name": "buffer", "extras": extras("buffer")}])
    path.write_bytes(glb_bytes(file, writer.buffers[0]))


def write_gltf(path):
    writer = Writer(2)
    file = content(writer)
    (path.parent / "pictures").mkdir()
    (path.parent / "skin.png").write_bytes(PICTURES[0])
    (path.parent / "pictures" / "cloth 1.png").write_bytes(PICTURES[1])
    (path.parent / "first.bin").write_bytes(writer.buffers[0])
    file["images"] = image_objects([{"uri": "skin.png", "mimeType": "image/png"}, {"uri": "pictures/cloth%201.png"}])
    uris = ["first.bin", "data:application/octet-stream;base64," + base64.b64encode(writer.buffers[1]).decode()]
    file.update(bufferViews=writer.views, accessors=writer.accessors,
                buffers=[{"byteLength": len(buffer), "uri": uri} for buffer, uri in zip(writer.buffers, uris)])
    path.write_text(json.dumps(file), encoding="utf-8")
