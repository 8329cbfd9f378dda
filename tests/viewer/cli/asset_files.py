"""Return the content of files that bindpose-importer converts: 3DS, 3MF, and Collada with a mesh or a motion."""

import io
import struct
import zipfile

import numpy as np

# ---- 3DS -----------------------------------------------------------------------------------------

MAIN, EDIT, MATERIAL, MATERIAL_NAME, DIFFUSE, COLOR = 0x4D4D, 0x3D3D, 0xAFFF, 0xA000, 0xA020, 0x0011
NAMED_OBJECT, TRIANGLE_MESH, POINT_ARRAY, FACE_ARRAY, FACE_MATERIAL = 0x4000, 0x4100, 0x4110, 0x4120, 0x4130


def _chunk(kind, *parts):
    """Return a chunk: its kind, its size with this header, its content."""
    content = b"".join(parts)
    return struct.pack("<HI", kind, 6 + len(content)) + content


def _text(text):
    return text.encode() + b"\0"


def three_ds(*objects):
    """Return the bytes of a 3DS file. An object is (name, mesh, color); the color is three numbers from 0 to 255."""
    parts = []
    for name, _, color in objects:
        parts.append(_chunk(MATERIAL, _chunk(MATERIAL_NAME, _text(f"{name} paint")),
                            _chunk(DIFFUSE, _chunk(COLOR, bytes(color)))))
    for name, (vertices, faces), _ in objects:
        points = _chunk(POINT_ARRAY, struct.pack("<H", len(vertices)), *(struct.pack("<3f", *v) for v in vertices))
        ids = struct.pack(f"<{len(faces) + 1}H", len(faces), *range(len(faces)))
        all_edges_visible = 7
        triangles = _chunk(FACE_ARRAY, struct.pack("<H", len(faces)),
                           *(struct.pack("<4H", *face, all_edges_visible) for face in faces),
                           _chunk(FACE_MATERIAL, _text(f"{name} paint"), ids))
        parts.append(_chunk(NAMED_OBJECT, _text(name), _chunk(TRIANGLE_MESH, points, triangles)))
    return _chunk(MAIN, _chunk(EDIT, *parts))


# ---- 3MF -----------------------------------------------------------------------------------------

CONTENT_TYPES = """<?xml version="1.0" encoding="UTF-8"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">
<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>
<Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>"""
RELATIONSHIPS = """<?xml version="1.0" encoding="UTF-8"?>
<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">
<Relationship Id="model" Target="/3D/3dmodel.model" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>
</Relationships>"""
MODEL = """<?xml version="1.0" encoding="UTF-8"?>
<model unit="millimeter" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"><resources>
<basematerials id="1000"><base name="paint" displaycolor="{color}"/></basematerials>
{objects}</resources><build>
{items}</build></model>"""
OBJECT = """<object id="{id}" type="model" pid="1000" pindex="0"><mesh><vertices>
{vertices}</vertices><triangles>
{triangles}</triangles></mesh></object>
"""


def three_mf_model(*meshes, items, color="#808080"):
    """Return the XML text of the model in a 3MF file. Mesh k has the id k + 1.

    `items` are pairs of an id and a 4 x 4 matrix that places the mesh.
    """
    objects = [OBJECT.format(
        id=k + 1, vertices="".join(f'<vertex x="{x}" y="{y}" z="{z}"/>\n' for x, y, z in vertices),
        triangles="".join(f'<triangle v1="{a}" v2="{b}" v3="{c}"/>\n' for a, b, c in faces))
        for k, (vertices, faces) in enumerate(meshes)]
    # The file stores the matrix of row vectors, without its last column.
    lines = [f'<item objectid="{id}" transform="{" ".join(str(float(x)) for x in np.array(matrix).T[:, :3].ravel())}"/>\n'
             for id, matrix in items]
    return MODEL.format(color=color, objects="".join(objects), items="".join(lines))


def three_mf(model):
    """Return the bytes of a 3MF file: an archive with the text of the model."""
    archive = io.BytesIO()
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as file:
        for name, text in (("[Content_Types].xml", CONTENT_TYPES), ("_rels/.rels", RELATIONSHIPS),
                           ("3D/3dmodel.model", model)):
            file.writestr(name, text)
    return archive.getvalue()


# ---- Collada -------------------------------------------------------------------------------------

COLLADA_MESH = """<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit meter="1"/><up_axis>Y_UP</up_axis></asset>
<library_geometries><geometry id="mesh"><mesh>
{points}<vertices id="vertices"><input semantic="POSITION" source="#points"/></vertices>
<triangles count="{count}"><input semantic="VERTEX" source="#vertices" offset="0"/><p>{corners}</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="scene"><node id="node"><instance_geometry url="#mesh"/></node></visual_scene>
</library_visual_scenes><scene><instance_visual_scene url="#scene"/></scene></COLLADA>"""

COLLADA_MOTION = """<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit meter="{meter}"/><up_axis>{up}</up_axis></asset>
<library_animations>
{animations}</library_animations>
<library_visual_scenes><visual_scene id="scene">
{nodes}
</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#scene"/></scene></COLLADA>"""
SOURCE = """<source id="{id}"><{kind} id="{id} array" count="{count}">{values}</{kind}><technique_common>
<accessor source="#{id} array" count="{rows}" stride="{stride}">{parameters}</accessor></technique_common></source>
"""
ANIMATION = """<animation id="{id}">
{sources}<sampler id="{id} sampler"><input semantic="INPUT" source="#{id} times"/>
<input semantic="OUTPUT" source="#{id} values"/><input semantic="INTERPOLATION" source="#{id} kinds"/></sampler>
<channel source="#{id} sampler" target="{target}"/></animation>
"""


def _numbers(values):
    return " ".join(repr(float(x)) for x in np.ravel(values))


def _source(id, values, names, type, kind="float_array", stride=1):
    """Return an array. Each parameter of a row has one of the names."""
    text = " ".join(values) if kind == "Name_array" else _numbers(values)
    parameters = "".join(f'<param name="{name}" type="{type}"/>' for name in names)
    return SOURCE.format(id=id, kind=kind, count=np.size(values), values=text, rows=np.size(values) // stride,
                         stride=stride, parameters=parameters)


def collada_mesh(mesh):
    """Return the text of a Collada file with a mesh."""
    vertices, faces = mesh
    return COLLADA_MESH.format(points=_source("points", vertices, "XYZ", "float", stride=3), count=len(faces),
                               corners=" ".join(str(v) for face in faces for v in face))


def _animation(target, times, values):
    """Return the keys of a number, or of a matrix."""
    id = target.replace("/", " ").replace(".", " ")
    output = (["TRANSFORM"], "float4x4", "float_array", 16) if np.ndim(values) == 3 else (["VALUE"], "float")
    sources = [_source(f"{id} times", times, ["TIME"], "float"), _source(f"{id} values", values, *output),
               _source(f"{id} kinds", ["LINEAR"] * len(times), ["INTERPOLATION"], "name", "Name_array")]
    return ANIMATION.format(id=id, sources="".join(sources), target=target)


def collada_motion(joints, times, in_parts, meter=1.0, up="Y_UP"):
    """Return the text of a Collada file with a skeleton and its motion, without a mesh.

    `joints` maps a name to (name of the parent or None, axis, offsets, degrees). The joint turns about the axis (x, y or
    z). It has one offset from its parent and one angle per time. If `in_parts` is true, the file animates coordinates and
    angles, otherwise matrices.
    """
    animations, elements = [], {}
    for name, (_, axis, offsets, degrees) in joints.items():
        direction = [float(axis == other) for other in "xyz"]
        if in_parts:
            elements[name] = (f'<translate sid="move">{_numbers(offsets[0])}</translate>'
                              f'<rotate sid="turn">{_numbers([*direction, degrees[0]])}</rotate>')
            animations.append(_animation(f"{name}/turn.ANGLE", times, degrees))
            animations += [_animation(f"{name}/move.{'XYZ'[k]}", times, [offset[k] for offset in offsets])
                           for k in range(3)]
        else:
            matrices = np.array([transform(axis, angle, offset) for angle, offset in zip(degrees, offsets)])
            elements[name] = f'<matrix sid="transform">{_numbers(matrices[0])}</matrix>'
            animations.append(_animation(f"{name}/transform", times, matrices))

    def node(name):
        children = "".join(node(child) for child, joint in joints.items() if joint[0] == name)
        return f'<node id="{name}" sid="{name}" name="{name}" type="JOINT">{elements[name]}{children}</node>'

    return COLLADA_MOTION.format(meter=meter, up=up, animations="".join(animations),
                                 nodes="\n".join(node(name) for name, joint in joints.items() if joint[0] is None))


def transform(axis, degrees, offset):
    """Return the 4 x 4 matrix of a rotation about an axis (x, y or z) through the origin, then a translation."""
    matrix = np.eye(4)
    i, j = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
    cosine, sine = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    matrix[i, i] = matrix[j, j] = cosine
    matrix[i, j], matrix[j, i] = -sine, sine
    matrix[:3, 3] = offset
    return matrix
