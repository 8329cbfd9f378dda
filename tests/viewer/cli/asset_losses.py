"""Read glTF files without code of Bindpose, and list what one file has and another one lacks."""

import base64
import collections
import hashlib
import json
import struct
import urllib.parse

SIZES = {5120: 1, 5121: 1, 5122: 2, 5123: 2, 5125: 4, 5126: 4}
COMPONENTS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
ACCESSOR_KEYS = ("indices", "input", "output", "inverseBindMatrices", "accessor")


class Asset:
    """The JSON text of a .glb or .gltf file, and the bytes to which it refers."""

    def __init__(self, path):
        data = path.read_bytes()
        self.folder, chunk = path.parent, b""
        if data[:4] == b"glTF":
            size = struct.unpack_from("<I", data, 12)[0]
            text = data[20:20 + size]
            if len(data) > 20 + size:
                chunk = data[28 + size:28 + size + struct.unpack_from("<I", data, 20 + size)[0]]
        else:
            text = data
        self.json = json.loads(text.decode())
        self.buffers = [self.bytes_of(buffer["uri"]) if "uri" in buffer else chunk for buffer in self.json.get("buffers", [])]

    def bytes_of(self, uri):
        """Return the bytes of a URI, which is a file or base64."""
        if uri.startswith("data:"):
            return base64.b64decode(uri.split(",", 1)[1])
        return (self.folder / urllib.parse.unquote(uri)).read_bytes()

    def view_bytes(self, id):
        view = self.json["bufferViews"][id]
        begin = view.get("byteOffset", 0)
        data = self.buffers[view["buffer"]][begin:begin + view["byteLength"]]
        assert len(data) == view["byteLength"], f"buffer view {id} is cut off"
        return data

    def elements(self, accessor):
        """Return the bytes of each element of an accessor, with its sparse elements."""
        size = SIZES[accessor["componentType"]] * COMPONENTS[accessor["type"]]

        def part(owner, count, size):
            data, begin = self.view_bytes(owner["bufferView"]), owner.get("byteOffset", 0)
            stride = self.json["bufferViews"][owner["bufferView"]].get("byteStride", size)
            result = [data[begin + k * stride:begin + k * stride + size] for k in range(count)]
            assert all(len(element) == size for element in result), "an accessor is cut off"
            return result

        result = part(accessor, accessor["count"], size) if "bufferView" in accessor else [bytes(size)] * accessor["count"]
        if "sparse" in accessor:
            sparse = accessor["sparse"]
            ids = part(sparse["indices"], sparse["count"], SIZES[sparse["indices"]["componentType"]])
            for id, element in zip(ids, part(sparse["values"], sparse["count"], size)):
                result[int.from_bytes(id, "little")] = element
        return result

    def view(self, id):
        """Return the properties of a buffer view, and a digest of its bytes instead of their position."""
        view = self.json["bufferViews"][id]
        kept = {key: value for key, value in view.items() if key not in ("buffer", "byteOffset", "byteLength")}
        return {"bytes": digest([self.view_bytes(id)]), **kept}

    def accessor(self, id):
        """Return the properties of an accessor, and a digest of its elements instead of their position."""
        accessor = self.json["accessors"][id]
        kept = {key: value for key, value in accessor.items() if key not in ("bufferView", "byteOffset", "sparse")}
        view = self.json["bufferViews"][accessor["bufferView"]] if "bufferView" in accessor else {}
        of_view = {key: view[key] for key in ("name", "extras", "extensions", "target") if key in view}
        of_sparse = {key: value for key, value in accessor.get("sparse", {}).items() if key not in ("indices", "values")}
        return {"elements": digest(self.elements(accessor)), **kept, "sparse": of_sparse, "view": of_view}

    def image(self, image):
        """Return the properties of an image, and a digest of its bytes instead of their position."""
        data = self.view_bytes(image["bufferView"]) if "bufferView" in image else self.bytes_of(image["uri"])
        return {"bytes": digest([data]), **{key: value for key, value in image.items() if key not in ("bufferView", "uri")}}

    def resolved(self, value, key=None):
        """Return a JSON value with the contents of the accessors and buffer views to which it refers."""
        if key == "extras":
            return value
        if isinstance(value, dict):
            if key == "attributes" or key == "targets[]":
                return {name: self.accessor(id) for name, id in value.items()}
            return {name: self.resolved(item, name) for name, item in value.items()}
        if isinstance(value, list):
            return [self.resolved(item, f"{key}[]") for item in value]
        if not isinstance(value, int) or isinstance(value, bool):
            return value
        return self.view(value) if key == "bufferView" else self.accessor(value) if key in ACCESSOR_KEYS else value

    def nodes_of_scene(self):
        """Return the ids of the nodes in the default scene."""
        waiting = list(self.json["scenes"][self.json.get("scene", 0)]["nodes"])
        for id in waiting:
            waiting += self.json["nodes"][id].get("children", [])
        return waiting

    def replaced_accessors(self):
        """Return the ids of joints, weights and matrices of the skins in the default scene, which a rig replaces."""
        nodes = [self.json["nodes"][id] for id in self.nodes_of_scene()]
        ids = {self.json["skins"][node["skin"]].get("inverseBindMatrices") for node in nodes if "skin" in node}
        for node in nodes:
            for primitive in self.json["meshes"][node["mesh"]]["primitives"] if "mesh" in node else []:
                ids |= {id for name, id in primitive["attributes"].items() if name.startswith(("JOINTS_", "WEIGHTS_"))}
        return ids

    def content(self):
        """Return the JSON text with the contents of accessors, buffer views and images, without the skins, joints and
        weights of the default scene. Several buffers count as one, which has the properties of the first."""
        replaced = self.replaced_accessors()
        tree = json.loads(json.dumps(self.json))
        for mesh in tree["meshes"]:
            for primitive in mesh["primitives"]:
                primitive["attributes"] = {name: id for name, id in primitive["attributes"].items() if id not in replaced}
        skins = self.resolved(tree.pop("skins", []), "skins")
        del tree["bufferViews"], tree["accessors"]
        tree["images"] = [self.image(image) for image in tree.get("images", [])]
        buffers = tree.pop("buffers", [])
        tree = self.resolved(tree)
        for buffer in buffers:
            buffer.pop("uri", None), buffer.pop("byteLength")
        tree["buffers"] = buffers[:1]
        of_scene = self.nodes_of_scene()
        for id, node in enumerate(tree["nodes"]):
            if "mesh" in node:  # a mesh that two nodes use may become two meshes with different weights
                node["mesh"] = tree["meshes"][node["mesh"]]
            if "skin" in node:
                node["skin"] = None if id in of_scene else skins[node["skin"]]
            if node.get("skin") is None:
                node.pop("skin", None)
        return tree

    def accessors(self):
        """Count the accessors with equal contents, except for those that a rig replaces."""
        replaced = self.replaced_accessors()
        ids = [id for id in range(len(self.json["accessors"])) if id not in replaced]
        return collections.Counter(json.dumps(self.accessor(id)) for id in ids)


def digest(parts):
    data = b"".join(parts)
    return f"{len(parts)} x {len(data) // max(1, len(parts))} bytes, SHA-1 {hashlib.sha1(data).hexdigest()[:16]}"


def leaves(value, path=""):
    """Yield the path and the text of each value. Extras and unknown extensions are one value, so that the order of their
    keys counts."""
    if isinstance(value, dict) and value and not path.endswith((".extras", ".ACME_unknown")):
        for key, item in value.items():
            yield from leaves(item, f"{path}.{key}")
    elif isinstance(value, list) and value:
        for k, item in enumerate(value):
            yield from leaves(item, f"{path}[{k}]")
    else:
        yield path.lstrip("."), json.dumps(value)


def list_losses(before, after):
    """Return one line for each value and accessor of a file that another file lacks."""
    found = dict(leaves(after.content()))
    lines = [f"{path}: {text} became {found.get(path, 'nothing')}" for path, text in leaves(before.content())
             if found.get(path) != text]
    lines += [f"{count} accessors with {text} are missing" for text, count in (before.accessors() - after.accessors()).items()]
    return lines


def list_additions(before, after):
    """Return one line for each value that a file added to the objects of another file. New objects at the end of lists,
    such as nodes and meshes, are not in the list."""
    known = dict(leaves(before.content()))
    counts = {key: len(value) for key, value in before.json.items() if isinstance(value, list)}

    def is_of_new_object(path):
        name, bracket, rest = path.partition("[")
        return bracket and int(rest.partition("]")[0]) >= counts.get(name, 0)

    return [f"{path}: {text}" for path, text in leaves(after.content())
            if path not in known and not is_of_new_object(path)]
