"""Return the content of files that bindpose-importer converts: 3DS and 3MF."""

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
