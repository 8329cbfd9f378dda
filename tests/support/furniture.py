#!/usr/bin/env python3
"""Write synthetic furniture with the defects of real models, and hostile models with worse defects.

`furniture.py FOLDER` writes the furniture as .obj files, and `furniture.py FOLDER --hostile` writes the hostile models
instead. The files are always the same. They replace the Debian package sweethome3d-furniture if the package is too
large: see real_meshes.py, --set made and --set hostile.

A part is a pair of points (#V x 3) and faces, which are lists of three or more point ids.
"""

import argparse
import math
import pathlib

import numpy as np

import horrors

# ---- Parts -----------------------------------------------------------------------------------------

BOX = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]]  # quads, oriented outwards


def box(lower, upper):
    points, _ = horrors.cube(lower, upper)
    return points, [list(face) for face in BOX]


def triangles(part):
    """Convert a part of horrors.py. Its faces are an array; the result has a list of faces."""
    return part[0], part[1].tolist()


def sheet(n, origin, along, up):
    """Return n x n quads that span a parallelogram."""
    steps = np.linspace(0, 1, n + 1)
    points = [np.add(origin, s * np.array(along) + t * np.array(up)) for t in steps for s in steps]
    ids = [j * (n + 1) + i for j in range(n) for i in range(n)]
    return np.array(points, float), [[k, k + 1, k + n + 2, k + n + 1] for k in ids]


def lathe(profile, around=24):
    """Return a surface of revolution about the z axis. The profile is a list of pairs (radius, height)."""
    def place(s, t):
        radius, height = profile[round(s * (len(profile) - 1))]
        return radius * math.cos(2 * math.pi * t), radius * math.sin(2 * math.pi * t), height
    return triangles(horrors.wrapped_grid(len(profile), around, place, close_rows=False))


def tube(start, end, radius, around=10, along=6):
    """Return an open cylinder from point `start` to point `end`."""
    start, end = np.array(start, float), np.array(end, float)
    axis = end - start
    side = np.cross(axis, [0.31, 0.17, 0.93])
    side /= np.linalg.norm(side)
    other = np.cross(axis, side) / np.linalg.norm(axis)

    def place(s, t):
        angle = 2 * math.pi * t
        return start + s * axis + radius * (math.cos(angle) * side + math.sin(angle) * other)
    return triangles(horrors.wrapped_grid(along + 1, around, place, close_rows=False))


def join(*parts):
    points, faces, before = [], [], 0
    for part, polygons in parts:
        points.append(part)
        faces += [[before + v for v in face] for face in polygons]
        before += len(part)
    return np.vstack(points), faces


def doubled(part, reverse=False):
    """Add a copy of each face on the same points. If `reverse` is true, the copies are reversed."""
    return part[0], part[1] + [face[::-1] if reverse else list(face) for face in part[1]]


def reversed_part(part):
    return part[0], [face[::-1] for face in part[1]]


def unwelded(part):
    """Give each face its own points."""
    points = np.vstack([part[0][face] for face in part[1]])
    ends = np.cumsum([len(face) for face in part[1]])
    return points, [list(range(end - len(face), end)) for face, end in zip(part[1], ends)]


def welded(part):
    """Merge points with the same coordinates."""
    points, ids = np.unique(np.round(part[0], 12), axis=0, return_inverse=True)
    ids = ids.reshape(-1)
    return points, [[int(ids[v]) for v in face] for face in part[1]]


# ---- Furniture -------------------------------------------------------------------------------------


def table():
    """Return a table. The faces of its top and legs are doubled. Legs end inside the top and are coplanar with aprons."""
    legs = [box((x, y, 0), (x + 0.08, y + 0.08, 0.74)) for x in (0, 1.52) for y in (0, 0.82)]
    aprons = [box((0, y, 0.6), (1.6, y + 0.03, 0.72)) for y in (0, 0.87)]
    top = doubled(box((-0.05, -0.05, 0.72), (1.65, 0.95, 0.76)), reverse=True)
    return join(top, *(doubled(part) for part in legs), *aprons)


def open_shelf():
    """Return a shelf of sheets without thickness. The sheets meet at non-manifold edges."""
    uprights = [sheet(5, (x, 0, 0), (0, 0.3, 0), (0, 0, 2)) for x in (0, 0.5, 1)]
    boards = [sheet(5, (x, 0, z), (0.5, 0, 0), (0, 0.3, 0)) for x in (0, 0.5) for z in np.linspace(0, 2, 6)]
    return welded(join(*uprights, *boards, sheet(5, (0, 0.3, 0), (1, 0, 0), (0, 0, 2))))


def lathe_lamp():
    """Return a lamp whose foot, stem and shade are one profile. Disks inside make all edges on their rims non-manifold.
    """
    profile = [(0, 0), (0.15, 0), (0.16, 0.02), (0.03, 0.05), (0.02, 0.4), (0.02, 0.5), (0.18, 0.45), (0.1, 0.75)]
    disks = [lathe([(0.0, height), (radius, height)]) for radius, height in ((0.02, 0.4), (0.02, 0.5), (0.15, 0.0))]
    return welded(join(lathe(profile), *disks))


def tube_chair():
    """Return open tubes that cross each other, and a seat that the tubes pierce."""
    feet = [(x, y) for x in (-0.25, 0.25) for y in (-0.25, 0.25)]
    legs = [tube((x, y, 0), (0.9 * x, 0.9 * y, 0.5 if y < 0 else 1.0), 0.02) for x, y in feet]
    bars = [tube((-0.25, y, z), (0.25, y, z), 0.015) for y, z in ((-0.24, 0.2), (0.24, 0.2), (0.23, 0.8), (0.23, 0.95))]
    braces = [tube((-0.25, -0.24, 0.1), (0.25, 0.24, 0.4), 0.01), tube((0.25, -0.24, 0.1), (-0.25, 0.24, 0.4), 0.01)]
    return join(*legs, *bars, *braces, box((-0.26, -0.26, 0.45), (0.26, 0.26, 0.48)))


def leaf_plant():
    """Return a pot and 300 loose leaves of two quads and two triangles each. Every third leaf occurs twice, with opposite
    orientations.
    """
    draw = np.random.RandomState(21)
    leaves = []
    for k in range(300):
        turn, _ = np.linalg.qr(draw.normal(size=(3, 3)))
        leaf = np.array([[0, -1, 0], [1, -1, 0.2], [2, 0, 0], [0, 1, 0], [1, 1, 0.2], [0, 0, 0], [1, 0, 0.1]], float)
        leaf[:, 2] *= draw.uniform(0.5, 1.5)
        middle = draw.normal(size=3) * (0.15, 0.15, 0.2) + (0, 0, 0.7)
        part = leaf * 0.03 @ turn.T + middle, [[5, 6, 4, 3], [0, 1, 6, 5], [1, 2, 6], [6, 2, 4]]
        leaves.append(doubled(part, reverse=True) if k % 3 == 0 else part)
    pot = lathe([(0.0, 0.0), (0.12, 0.0), (0.16, 0.3), (0.14, 0.3), (0.11, 0.02), (0.0, 0.02)])
    return join(pot, tube((0, 0, 0), (0.02, 0.01, 0.8), 0.012), *leaves)


def keys():
    """Return twelve keys on a ring. Each key is made of thin plates. The largest plate is 60 times as wide as thick."""
    ring = horrors.torus(24, 8, 0.3, 0.015)
    plates = []
    for k in range(12):
        angle = 2 * math.pi * k / 12
        c, s = math.cos(angle), math.sin(angle)
        blade = join(box((0.25, -0.06, -0.001), (0.38, 0.06, 0.001)), box((0.37, -0.015, -0.001), (0.7, 0.015, 0.001)),
                     *(box((0.5 + 0.04 * t, -0.03, -0.0011), (0.52 + 0.04 * t, -0.01, 0.0011)) for t in range(5)))
        points = blade[0] @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])
        plates.append((points + (0, 0, 0.004 * k), blade[1]))
    return join(triangles(ring), *plates)


def car_body():
    """Return an open sheet with holes and slivers. It consists of panels with a gap of 1e-4 between them."""
    n, m = 30, 12

    def height(s, t):
        return 0.6 + 0.7 * math.exp(-((s - 0.55) / 0.22) ** 4) - 1.2 * abs(t - 0.5) ** 3
    points = [[4 * i / n, 1.6 * (j / m - 0.5), height(i / n, j / m)] for j in range(m + 1) for i in range(n + 1)]
    quads = [[j * (n + 1) + i, j * (n + 1) + i + 1, (j + 1) * (n + 1) + i + 1, (j + 1) * (n + 1) + i]
             for j in range(m) for i in range(n) if not (j in (2, 9) and 12 <= i < 20)]
    hood = [face for face in quads if points[face[0]][0] < 1.2]
    body = np.array(points, float), [face for face in quads if face not in hood]
    # The sill is a fan of 200 slivers. Their common vertex is 1e-3 away from the line of the other vertices.
    line = np.linspace([0, 0.8, 0.45], [4, 0.8, 0.45], 201)
    sill = np.vstack([line, [[2, 0.801, 0.45]]]), [[k, k + 1, 201] for k in range(200)]
    return join(body, (np.array(points, float) - (1e-4, 0, 0), hood), sill)


def coincident_sheets():
    """Return curtains: four sheets on the same surface. Two of them have another tessellation, and one is reversed."""
    def curtain(n, reverse=False):
        part = sheet(n, (0, 0, 0), (1, 0, 0), (0, 0, 1.5))
        part[0][:, 1] = 0.05 * np.abs(12 * part[0][:, 0] % 2 - 1)
        return reversed_part(part) if reverse else part
    rail = box((-0.1, -0.1, 1.5), (1.1, 0.15, 1.55))
    return join(curtain(12), curtain(12, reverse=True), curtain(24), curtain(6), rail)


def bed():
    """Return unwelded boxes that overlap, with faces without area, unused points and a non-planar quad."""
    parts = [box((0, 0, 0), (2, 1.4, 0.3)), box((0.02, 0.02, 0.25), (1.98, 1.38, 0.5)),
             box((-0.05, 0, 0), (0, 1.4, 0.9)), box((0.1, 0.1, 0.5), (0.5, 0.6, 0.6)),
             box((0.1, 0.8, 0.5), (0.5, 1.3, 0.6))]
    points, faces = unwelded(join(*parts))
    blanket = [[0.6, 0.1, 0.51], [1.9, 0.1, 0.51], [0.6, 1.3, 0.61], [1.9, 1.3, 0.75]]
    first = len(points) + 1
    points = np.vstack([points, [[9, 9, 9]], blanket])
    needles = [[k, k + 1, k] for k in range(0, 40, 4)] + [[k, k, k] for k in range(5)]
    return points, faces + needles + [[first, first + 1, first + 3, first + 2]]


def cabinet():
    """Return a cabinet. Its walls are an outer and a reversed inner box, open at the front; its doors are inside out
    and have handles."""
    outer, inner = box((0, 0, 0), (1, 0.5, 1.8)), reversed_part(box((0.02, 0.0, 0.02), (0.98, 0.48, 1.78)))
    without_front = [(part[0], [face for k, face in enumerate(part[1]) if k != 2]) for part in (outer, inner)]
    doors = [reversed_part(box((x, -0.02, 0.01), (x + 0.48, 0, 1.79))) for x in (0.01, 0.51)]
    knobs = [triangles(horrors.sphere(1, 0.02, (x, -0.03, 0.9))) for x in (0.45, 0.55)]
    return join(*without_front, *doors, *knobs)


def rug():
    """Return one flat sheet. It encloses nothing, so its weights are solved on the sheet itself."""
    return sheet(16, (0, 0, 0), (2, 0, 0), (0, 1.2, 0))


def needles_only():
    """Return forty faces without area. No point can be bound to them, and they enclose no volume."""
    points = np.array([[k, 2 * k, -k] for k in range(42)], float)
    return points, [[k, k + 1, k + 2] for k in range(40)]


FURNITURE = [table, open_shelf, lathe_lamp, tube_chair, leaf_plant, keys, car_body, coincident_sheets, bed, cabinet,
             rug, needles_only]


# ---- Hostile models --------------------------------------------------------------------------------


def hundred_thousand_loose_triangles():
    draw = np.random.RandomState(31)
    points = draw.uniform(-1, 1, (100_000, 1, 3)) + draw.uniform(-0.02, 0.02, (100_000, 3, 3))
    return points.reshape(-1, 3), np.arange(300_000).reshape(-1, 3).tolist()


def ten_thousand_components():
    """Return small tets at random positions; a few of them overlap."""
    draw = np.random.RandomState(32)
    corner = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float)
    faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]
    sizes, places = draw.uniform(0.005, 0.02, 10_000), draw.uniform(-1, 1, (10_000, 3))
    return join(*((size * corner + place, faces) for size, place in zip(sizes, places)))


def doubled_three_times():
    """Return a sphere and a torus that cross, with every face repeated eight times."""
    part = join(triangles(horrors.sphere(3)), triangles(horrors.moved(horrors.torus(), 0.9, 0, 0.1)))
    return doubled(doubled(doubled(part)))


def sheets_a_billionth_apart():
    return join(*(sheet(20, (0, 0, 1e-9 * k), (1, 0.1, 0), (0, 1, 0.3)) for k in range(4)))


def a_millionth_of_the_size():
    """Return a sphere of radius 1, and a second sphere of radius 1e-6 next to it."""
    return join(triangles(horrors.sphere(3)), triangles(horrors.sphere(2, 1e-6, (1.5, 0, 0))))


HOSTILE = [hundred_thousand_loose_triangles, ten_thousand_components, doubled_three_times, sheets_a_billionth_apart,
           a_millionth_of_the_size]


# ---- Files -----------------------------------------------------------------------------------------


def normals(points, faces):
    """Return the unit normals of the faces, (0, 0, 1) for a face without area."""
    found = []
    for face in faces:
        corners = points[face]
        normal = np.cross(corners[1:-1] - corners[0], corners[2:] - corners[0]).sum(axis=0)
        length = np.linalg.norm(normal)
        found.append(normal / length if length > 0 else (0.0, 0.0, 1.0))
    return found


def write_obj(path, points, faces):
    """Write points, normals and faces. As in files of modeling programs, each corner has the normal of its face."""
    with open(path, "w", encoding="ascii") as file:
        file.write(f"# {path.stem}\no {path.stem}\n")
        file.writelines("v %r %r %r\n" % tuple(point) for point in points.tolist())
        file.writelines("vn %.4f %.4f %.4f\n" % tuple(normal) for normal in normals(points, faces))
        for k, face in enumerate(faces, 1):
            file.write("f " + " ".join(f"{v + 1}//{k}" for v in face) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--hostile", action="store_true", help="the hostile models instead")
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    for make in HOSTILE if options.hostile else FURNITURE:
        points, faces = make()
        write_obj(options.folder / f"{make.__name__}.obj", points, faces)


if __name__ == "__main__":
    main()
