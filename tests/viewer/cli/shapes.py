"""Meshes and handles as text, so small that their exact numbers are known."""

import itertools
import math
import struct
import zlib


def cube(lower=-1.0, upper=1.0):
    vertices = [[upper if v & 1 else lower, upper if v & 2 else lower, upper if v & 4 else lower] for v in range(8)]
    faces = [[0, 4, 6], [0, 6, 2], [1, 3, 7], [1, 7, 5], [0, 1, 5], [0, 5, 4],
             [2, 6, 7], [2, 7, 3], [0, 2, 3], [0, 3, 1], [4, 5, 7], [4, 7, 6]]
    return vertices, faces


def open_cube():
    vertices, faces = cube()
    return vertices, faces[:10]


def flipped(mesh):
    return mesh[0], [face[::-1] for face in mesh[1]]


def doubled(mesh):
    return mesh[0], mesh[1] + mesh[1]


def quads():
    """Return the cube as six squares."""
    return cube()[0], [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]]


def flat():
    return [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]]


def one_triangle():
    return [[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]


def bar(nx=12, ny=2, nz=2, size=(6.0, 1.0, 1.0)):
    """Return the surface of a box along x, with a corner at the origin. It is cut into squares of two triangles each.
    """
    counts = (nx, ny, nz)
    ids, vertices, faces = {}, [], []

    def vertex(*at):
        if at not in ids:
            ids[at] = len(vertices)
            vertices.append([size[k] * at[k] / counts[k] for k in range(3)])
        return ids[at]

    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for side, i, j in itertools.product((0, counts[axis]), range(counts[u]), range(counts[v])):
            corner = []
            for du, dv in ((0, 0), (1, 0), (1, 1), (0, 1)):
                at = [0, 0, 0]
                at[axis], at[u], at[v] = side, i + du, j + dv
                corner.append(vertex(*at))
            if side == 0:
                corner.reverse()
            faces += [[corner[0], corner[1], corner[2]], [corner[0], corner[2], corner[3]]]
    return vertices, faces


def sphere(around=24, across=12, radius=1.0):
    vertices = [[0, 0, radius], [0, 0, -radius]]
    faces = []
    for i in range(1, across):
        for j in range(around):
            a, b = math.pi * i / across, 2 * math.pi * j / around
            vertices.append([radius * math.sin(a) * math.cos(b), radius * math.sin(a) * math.sin(b), radius * math.cos(a)])

    def vertex(i, j):
        return 0 if i == 0 else 1 if i == across else 2 + (i - 1) * around + j % around

    for i in range(across):
        for j in range(around):
            a, b, c, d = vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)
            if i > 0:
                faces.append([a, b, d])
            if i < across - 1:
                faces.append([b, c, d])
    return vertices, faces


def off(mesh):
    vertices, faces = mesh
    lines = ["OFF", f"{len(vertices)} {len(faces)} 0"]
    lines += [" ".join(repr(float(x)) for x in v) for v in vertices]
    lines += [" ".join(map(str, [len(f), *f])) for f in faces]
    return "\n".join(lines) + "\n"


# Two bones along the bar share a joint in its middle.
TWO_BONES = "1 0.5 0.5 0.5\n2 3 0.5 0.5\n3 5.5 0.5 0.5\n#\n1 2 1 0 0\n2 3 1 0 0\n"
TWO_POINTS = "1 0.5 0.5 0.5 left\n2 5.5 0.5 0.5\n#\n"
BENT = '{"handles": {"b2": {"rotate": {"axis": [0, 0, 1], "degrees": 90}}}}'


def png(columns, rows, color):
    """Return a picture as the bytes of a PNG file. color(x, y) is (red, green, blue, alpha), row 0 is at the top."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    lines = b"".join(b"\0" + b"".join(bytes(color(x, y)) for x in range(columns)) for y in range(rows))
    head = struct.pack(">IIBBBBB", columns, rows, 8, 6, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(lines)) + chunk(b"IEND", b"")


def huge_png():
    """Return a PNG file whose header states 100,000 x 100,000 pixels."""
    picture = bytearray(png(2, 2, lambda x, y: (0, 0, 0, 255)))
    picture[16:24] = (100000).to_bytes(4, "big") * 2
    picture[29:33] = zlib.crc32(picture[12:29]).to_bytes(4, "big")
    return bytes(picture)
