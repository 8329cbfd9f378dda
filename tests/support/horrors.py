#!/usr/bin/env python3
"""Surfaces that are difficult for a mesher ("horrors"), each with known facts about its inside.

`horrors.py FOLDER` writes all surfaces as .off files. Random parts have fixed seeds, so the files are always the same.
The script all_surfaces.py and tests of the program use this module.
"""

import dataclasses
import math
import pathlib
import sys

import numpy as np


@dataclasses.dataclass
class Horror:
    """A surface and known facts about it."""

    vertices: np.ndarray  # positions, #V x 3
    triangles: np.ndarray  # vertex ids, #F x 3
    volume: float = None  # volume of the inside, None if no formula gives it
    tolerance: float = 1e-9  # relative tolerance of the volume
    encloses: bool = True  # False: the surface encloses no volume, so the program must refuse it; None: unknown


# ---- Clean parts -----------------------------------------------------------------------------------


def cube(lower=(-1.0, -1.0, -1.0), upper=(1.0, 1.0, 1.0)):
    """Return a cube of 12 triangles, oriented outwards. The triangles of face k are 2k and 2k + 1 in the order -x +x -y
    +y -z +z.
    """
    corners = np.array([[(upper if v >> k & 1 else lower)[k] for k in range(3)] for v in range(8)], float)
    faces = [[0, 4, 6], [0, 6, 2], [1, 3, 7], [1, 7, 5], [0, 1, 5], [0, 5, 4],
             [2, 6, 7], [2, 7, 3], [0, 2, 3], [0, 3, 1], [4, 5, 7], [4, 7, 6]]
    return corners, np.array(faces)


def wrapped_grid(rows, columns, place, close_rows=True, reverse_from=None):
    """Return a grid with the points place(s, t). Each square of the grid is split into two triangles.

    The grid has `rows` values of s and `columns` values of t, both in [0, 1). In each row, the last column is joined to the
    first one. If `close_rows` is true, the last row is joined to the first row; otherwise s ranges over [0, 1]. If
    `reverse_from` is a column, the first row is joined in reverse order, starting at this column.
    """
    points = [place(i / rows if close_rows else i / (rows - 1), j / columns) for i in range(rows) for j in range(columns)]
    faces = []
    for i in range(rows if close_rows else rows - 1):
        for j in range(columns):
            def vertex(di, dj, i=i, j=j):
                row, column = i + di, (j + dj) % columns
                if reverse_from is not None and row == rows:
                    column = (reverse_from - column) % columns
                return row % rows * columns + column
            a, b, c, d = vertex(0, 0), vertex(1, 0), vertex(1, 1), vertex(0, 1)
            faces += [[a, b, c], [a, c, d]]
    return np.array(points, float), np.array(faces)


def torus(around=48, across=24, radius=1.0, tube=0.4):
    def place(s, t):
        a, b = 2 * math.pi * s, 2 * math.pi * t
        r = radius + tube * math.cos(b)
        return r * math.cos(a), r * math.sin(a), tube * math.sin(b)
    return wrapped_grid(around, across, place)


def sphere(levels=3, radius=1.0, center=(0.0, 0.0, 0.0)):
    """Return a subdivided icosahedron of 20 * 4^levels triangles, oriented outwards."""
    g = (1 + math.sqrt(5)) / 2
    points = [(-1, g, 0), (1, g, 0), (-1, -g, 0), (1, -g, 0), (0, -1, g), (0, 1, g),
              (0, -1, -g), (0, 1, -g), (g, 0, -1), (g, 0, 1), (-g, 0, -1), (-g, 0, 1)]
    faces = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2), (10, 7, 6),
             (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10),
             (8, 6, 7), (9, 8, 1)]
    points = [np.array(p, float) / np.linalg.norm(p) for p in points]
    for _ in range(levels):
        middles, finer = {}, []

        def middle(a, b, middles=middles):
            key = (min(a, b), max(a, b))
            if key not in middles:
                p = points[a] + points[b]
                middles[key] = len(points)
                points.append(p / np.linalg.norm(p))
            return middles[key]

        for a, b, c in faces:
            ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
            finer += [(a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)]
        faces = finer
    return radius * np.array(points) + np.array(center), np.array(faces)


def sheet(n=8, lower=(0.0, 0.0), upper=(1.0, 1.0), height=0.0):
    """Return n x n squares in the plane z = height, oriented upwards."""
    points = [[lower[0] + (upper[0] - lower[0]) * i / n, lower[1] + (upper[1] - lower[1]) * j / n, height]
              for j in range(n + 1) for i in range(n + 1)]
    faces = []
    for j in range(n):
        for i in range(n):
            a, b = j * (n + 1) + i, j * (n + 1) + i + 1
            faces += [[a, b, b + n + 1], [a, b + n + 1, a + n + 1]]
    return np.array(points, float), np.array(faces)


# ---- Modifications ---------------------------------------------------------------------------------


def join(*meshes):
    vertices, faces, before = [], [], 0
    for points, triangles in meshes:
        vertices.append(points)
        faces.append(triangles + before)
        before += len(points)
    return np.vstack(vertices), np.vstack(faces)


def moved(mesh, *by):
    return mesh[0] + np.array(by, float), mesh[1]


def flipped(mesh):
    return mesh[0], mesh[1][:, ::-1].copy()


def unwelded(mesh):
    """Give each triangle its own vertices."""
    return mesh[0][mesh[1].ravel()], np.arange(mesh[1].size).reshape(-1, 3)


def chosen(mesh, share, seed):
    """Return a random mask that selects about the fraction `share` of the triangles."""
    return np.random.RandomState(seed).uniform(size=len(mesh[1])) < share


def jittered(mesh, size, seed):
    return mesh[0] + size * np.random.RandomState(seed).uniform(-1, 1, mesh[0].shape), mesh[1]


def volume(mesh):
    a, b, c = (mesh[0][mesh[1][:, k]] for k in range(3))
    return float(np.einsum("ij,ij->i", np.cross(a, b), c).sum() / 6)


def solid(mesh, of=None, tolerance=1e-9):
    """Return a horror whose inside has the volume of the clean mesh `of` (default: the mesh itself)."""
    return Horror(*mesh, volume(of or mesh), tolerance)


# ---- The horrors -----------------------------------------------------------------------------------


def open_cube():
    points, faces = cube()
    return Horror(points, faces[:10], 8.0)


def internal_wall():
    points, faces = cube()
    return Horror(points, np.vstack([faces, [[0, 3, 7], [0, 7, 4]]]), 8.0)


def cubes_half_overlapping():
    return Horror(*join(cube(), moved(cube(), 1, 0, 0)), 12.0)


def cubes_crossing():
    return Horror(*join(cube(), moved(cube(), 1.03, 0.9, 0.85)), 16 - 0.97 * 1.1 * 1.15)


def two_overlapping_spheres():
    return Horror(*join(sphere(), sphere(center=(0.7, 0.31, 0.17))))


def torus_through_sphere():
    return Horror(*join(sphere(), moved(torus(), 0.9, 0, 0.1)))


def doubled_faces():
    mesh = sphere()
    return solid((mesh[0], np.vstack([mesh[1], mesh[1]])), mesh)


def flipped_face():
    points, faces = sphere()
    faces[100] = faces[100][::-1]
    return solid((points, faces), sphere())


def flipped_side():
    points, faces = cube()
    faces[10:] = faces[10:, ::-1]
    return Horror(points, faces, 8.0)


def inside_out():
    return solid(flipped(torus()), torus())


def fifth_removed():
    mesh = sphere(4)
    return Horror(mesh[0], mesh[1][~chosen(mesh, 0.2, 5)], volume(mesh), 0.03)


def fifth_flipped():
    points, faces = torus()
    turned = chosen((points, faces), 0.2, 6)
    faces[turned] = faces[turned, ::-1]
    return solid((points, faces), torus())


def unwelded_soup():
    return solid(unwelded(torus()), torus())


def unwelded_and_jittered():
    """Return loose triangles with small gaps between their corners."""
    mesh = torus()
    return Horror(*jittered(unwelded(mesh), 1e-3, 7), volume(mesh), 0.03)


def sheet_beside_solid():
    return Horror(*join(cube(), sheet(8, (1.5, -1.0), (3.5, 1.0), 0.2)), 8.0)


def sheet_through_solid():
    return Horror(*join(cube(), sheet(5, (-1.7, -1.6), (1.8, 1.5), 0.123)), 8.0)


def solids_a_millionth_apart():
    return Horror(*join(cube(), moved(cube(), 2 + 1e-6, 0, 0)), 16.0)


def spheres_a_millionth_apart():
    return Horror(*join(sphere(), sphere(center=(2 + 1e-6, 0, 0))), 2 * volume(sphere()))


def touching_spheres():
    return Horror(*join(sphere(), sphere(center=(2.0 * sphere()[0][:, 0].max(), 0, 0))), 2 * volume(sphere()))


def nested_and_reversed_shells():
    outer, middle, inner = sphere(3), sphere(3, 0.7), sphere(2, 0.3)
    return Horror(*join(outer, flipped(middle), inner), volume(outer) - volume(middle) + volume(inner))


def nearly_coincident_copy():
    mesh = sphere()
    return Horror(*join(mesh, moved(mesh, 1e-9, -2e-9, 1e-9)), volume(mesh), 1e-3)


def copies_a_thousandth_apart():
    """Return three copies of nearly the same sphere, which cross each other everywhere."""
    return Horror(*join(*(jittered(sphere(), 1e-3, seed) for seed in range(3))), volume(sphere()), 0.01)


def quantised():
    """Return a sphere rounded to a coarse grid, so that vertices coincide and triangles lose their area."""
    points, faces = sphere(4)
    return Horror(np.round(points * 12) / 12, faces)


def needle():
    """Return a bipyramid with 40 sides whose length is 1000 times its width."""
    around = [[math.cos(math.pi * k / 20), math.sin(math.pi * k / 20), 0] for k in range(40)]
    points = np.array(around + [[0, 0, 1000], [0, 0, -1000]])
    faces = [[k, (k + 1) % 40, 40] for k in range(40)] + [[(k + 1) % 40, k, 41] for k in range(40)]
    return solid((points, np.array(faces)))


def plate():
    """Return a box whose height is 1e-5 of its width."""
    return Horror(*cube((0, 0, 0), (1, 1, 1e-5)), 1e-5)


def fan():
    """Return a thousand triangles that share one edge, like the pages of a book. They enclose no volume."""
    points = [[0, 0, 0], [0, 0, 1]] + [[math.cos(2 * math.pi * k / 1000), math.sin(2 * math.pi * k / 1000), 0.5]
                                     for k in range(1000)]
    return Horror(np.array(points), np.array([[0, 1, k + 2] for k in range(1000)]), encloses=False)


def wedges_around_an_edge():
    """Return 100 tets that share one edge, with equal gaps between them."""
    ring = [[math.cos(math.pi * k / 100), math.sin(math.pi * k / 100), 0.5] for k in range(200)]
    faces = []
    for k in range(0, 200, 2):
        a, b = k + 2, k + 3
        faces += [[0, 1, b], [0, a, 1], [0, b, a], [1, a, b]]
    points = np.array([[0, 0, 0], [0, 0, 1], *ring])
    return solid(flipped((points, np.array(faces))) if volume((points, np.array(faces))) < 0 else (points, np.array(faces)))


def cones_tip_to_tip():
    ring = [[math.cos(math.pi * k / 32), math.sin(math.pi * k / 32)] for k in range(64)]
    points = [[0, 0, 0], [0, 0, 1], [0, 0, -1]] + [[x, y, 1] for x, y in ring] + [[x, y, -1] for x, y in ring]
    faces = []
    for k in range(64):
        a, b = 3 + k, 3 + (k + 1) % 64
        faces += [[0, b, a], [1, a, b], [0, a + 64, b + 64], [2, b + 64, a + 64]]
    return solid((np.array(points, float), np.array(faces)))


def checkerboard():
    """Return every second cube of a 4 x 4 x 4 lattice. The cubes touch at edges and vertices."""
    cubes = [cube((x, y, z), (x + 1, y + 1, z + 1)) for x in range(4) for y in range(4) for z in range(4)
             if (x + y + z) % 2 == 0]
    return Horror(*join(*cubes), 32.0)


def cubes_side_by_side():
    """Return 3 x 3 x 3 cubes with all walls between them. Each wall occurs twice."""
    cubes = [cube((x, y, z), (x + 1, y + 1, z + 1)) for x in range(3) for y in range(3) for z in range(3)]
    return Horror(*join(*cubes), 27.0)


def hanging_vertices():
    """Return a cube with one finer face, so that vertices of this face are inside of edges of the other faces."""
    parts = [unwelded((cube()[0], cube()[1][:10])), sheet(7, (-1.0, -1.0), (1.0, 1.0), 1.0)]
    return Horror(*join(*parts), 8.0)


def klein_bottle():
    """Return a closed tube that passes through its own wall. The surface is one-sided, so it has no outside."""
    def place(s, t):
        u, v = 2 * math.pi * s, 2 * math.pi * t
        r = 4 * (1 - math.cos(u) / 2)
        if u < math.pi:
            return (6 * math.cos(u) * (1 + math.sin(u)) + r * math.cos(u) * math.cos(v),
                    16 * math.sin(u) + r * math.sin(u) * math.cos(v), r * math.sin(v))
        return (6 * math.cos(u) * (1 + math.sin(u)) + r * math.cos(v + math.pi), 16 * math.sin(u), r * math.sin(v))
    return Horror(*wrapped_grid(60, 24, place, reverse_from=12), encloses=None)


def figure_eight_klein_bottle():
    def place(s, t):
        u, v = 2 * math.pi * s, 2 * math.pi * t
        r = 2 + math.cos(u / 2) * math.sin(v) - math.sin(u / 2) * math.sin(2 * v)
        return r * math.cos(u), r * math.sin(u), math.sin(u / 2) * math.sin(v) + math.cos(u / 2) * math.sin(2 * v)
    return Horror(*wrapped_grid(48, 24, place, reverse_from=0), encloses=None)


def moebius_strip():
    points, faces, n = [], [], 80
    for i in range(n):
        u = 2 * math.pi * i / n
        for v in (-0.4, 0.0, 0.4):
            r = 1 + v * math.cos(u / 2)
            points.append([r * math.cos(u), r * math.sin(u), v * math.sin(u / 2)])
    for i in range(n):
        for j in range(2):
            a, b = 3 * i + j, 3 * i + j + 1
            c, d = (a + 3, b + 3) if i < n - 1 else (2 - j, 1 - j)
            faces += [[a, c, d], [a, d, b]]
    return Horror(np.array(points), np.array(faces), encloses=None)


def roman_surface():
    """Return Steiner's Roman surface. It is one-sided. Its three lines of self-intersection share a triple point."""
    def place(s, t):
        u, v = math.pi * s, 2 * math.pi * t
        x, y, z = math.sin(u) * math.cos(v), math.sin(u) * math.sin(v), math.cos(u)
        return x * y, y * z, z * x
    return Horror(*wrapped_grid(31, 60, place, close_rows=False), encloses=None)


def knot():
    """Return a trefoil whose tube is thick enough to cross itself."""
    def place(s, t):
        def curve(a):
            return np.array([math.sin(a) + 2 * math.sin(2 * a), math.cos(a) - 2 * math.cos(2 * a), -math.sin(3 * a)])
        a, b = 2 * math.pi * s, 2 * math.pi * t
        along = curve(a + 1e-4) - curve(a - 1e-4)
        side = np.cross(along, [0, 0, 1])
        up = np.cross(side, along)
        return curve(a) + 0.9 * (math.cos(b) * side / np.linalg.norm(side) + math.sin(b) * up / np.linalg.norm(up))
    mesh = wrapped_grid(150, 20, place)
    return Horror(*(flipped(mesh) if volume(mesh) < 0 else mesh))


def spiky_ball():
    """Return a sphere whose vertices are moved at random, along their radius and perpendicular to it. The surface
    crosses itself hundreds of times.
    """
    points, faces = sphere(3)
    random = np.random.RandomState(9)
    return Horror(points * random.uniform(0.3, 1.2, (len(points), 1)) + random.uniform(-0.15, 0.15, points.shape), faces)


def heap_of_triangles():
    """Return 300 unrelated triangles around a cube."""
    random = np.random.RandomState(10)
    loose = random.uniform(-1.5, 1.5, (300, 1, 3)) + random.uniform(-0.3, 0.3, (300, 3, 3))
    return Horror(*join(cube(), (loose.reshape(-1, 3), np.arange(900).reshape(-1, 3))), encloses=None)


def heap_of_cubes():
    """Return 40 rotated cubes of different sizes, some of them inside out."""
    random = np.random.RandomState(11)
    parts = []
    for k in range(40):
        points, faces = cube()
        turn, _ = np.linalg.qr(random.normal(size=(3, 3)))
        turn = turn if np.linalg.det(turn) > 0 else -turn
        part = (points @ turn.T * random.uniform(0.1, 0.5) + random.uniform(-1, 1, 3), faces)
        parts.append(flipped(part) if k % 4 == 0 else part)
    return Horror(*join(*parts))


def pipe():
    """Return a long tube, open at both ends."""
    def place(s, t):
        return 6 * (s - 0.5), math.cos(2 * math.pi * t), math.sin(2 * math.pi * t)
    mesh = wrapped_grid(31, 32, place, close_rows=False)
    return Horror(*flipped(mesh))


def bowl():
    """Return the lower half of a sphere."""
    points, faces = sphere(4)
    return Horror(points, faces[points[faces][:, :, 2].mean(axis=1) < 0])


def house():
    """Return a house: walls and a roof without thickness, a doorway and windows, and no floor."""
    points, faces = [], []
    walls = join(sheet(8, (-1.0, -1.0), (1.0, 1.0), 1.0))
    for turn in range(4):
        x, y, z = walls[0].T
        wall = np.stack([x, -z, y], axis=1)
        c, s = round(math.cos(math.pi / 2 * turn)), round(math.sin(math.pi / 2 * turn))
        wall = np.stack([c * wall[:, 0] - s * wall[:, 1], s * wall[:, 0] + c * wall[:, 1], wall[:, 2]], axis=1)
        centers = walls[0][walls[1]].mean(axis=1)
        hole = (np.abs(centers[:, 0]) < 0.25) & (centers[:, 1] < (0.25 if turn == 0 else 0.5))
        hole &= centers[:, 1] > (-1.0 if turn == 0 else -0.25)
        points.append(wall)
        faces.append(walls[1][~hole])
    roof = sheet(8, (-1.2, -1.2), (1.2, 1.2), 0.0)
    roof[0][:, 2] = 1.9 - 0.75 * np.abs(roof[0][:, 0])
    return Horror(*join(*zip(points, faces), roof))


def thousand_degenerate():
    """Return a sphere and triangles without area: needles between its vertices, and single points."""
    points, faces = sphere()
    random = np.random.RandomState(12)
    flat = random.randint(0, len(points), (1000, 3))
    flat[:, 2] = flat[:, 1]
    flat[::2, 1] = flat[::2, 0]
    return solid((points, np.vstack([faces, flat])), sphere())


def collinear_slivers():
    """Return a cube with one face made of 200 slivers between points on a line and a far corner."""
    points, faces = cube()
    line = np.linspace([-1, 1, 1], [-1, -1, 1], 201)[1:-1]
    ids = [6, *range(8, 8 + len(line)), 4]
    slivers = [[a, b, 7] for a, b in zip(ids[:-1], ids[1:])] + [[4, 5, 7]]
    return Horror(np.vstack([points, line]), np.vstack([faces[:10], slivers]), 8.0)


def tiny():
    points, faces = join(cube(), moved(torus(), 0.9, 0, 0.1))
    return Horror(points * 1e-9, faces)


def huge():
    points, faces = join(cube(), moved(torus(), 0.9, 0, 0.1))
    return Horror(points * 1e9, faces)


def far_away():
    mesh = join(sphere(), sphere(center=(0.7, 0.31, 0.17)))
    return Horror(*moved(mesh, 1e6, -2e6, 3e6))


def two_scales():
    """Return a sphere, and a second sphere of 1e-5 of its size that crosses the surface of the first one."""
    return Horror(*join(sphere(), sphere(2, 1e-5, (1.0, 0, 0))), volume(sphere()))


def one_triangle():
    return Horror(np.eye(3), np.array([[0, 1, 2]]), encloses=False)


def flat():
    return Horror(*sheet(), encloses=False)


def wavy_sheet():
    points, faces = sheet(24)
    points[:, 2] = 0.05 * np.sin(9 * points[:, 0]) * np.cos(7 * points[:, 1])
    return Horror(points, faces, encloses=None)  # the winding number reaches 0.5 in the hollows


def there_and_back():
    """Return a sphere and its reversed copy. The winding number is 0 everywhere, but the program ignores such back sides."""
    return Horror(*join(sphere(), flipped(sphere())), volume(sphere()))


HORRORS = [two_overlapping_spheres, open_cube, internal_wall, doubled_faces, flipped_face, torus_through_sphere, unwelded_soup,
           fifth_removed, fifth_flipped, sheet_beside_solid, solids_a_millionth_apart, nested_and_reversed_shells,
           cubes_half_overlapping, cubes_crossing, flipped_side, inside_out, unwelded_and_jittered, sheet_through_solid,
           spheres_a_millionth_apart, touching_spheres, nearly_coincident_copy, copies_a_thousandth_apart, quantised, needle,
           plate, fan, wedges_around_an_edge, cones_tip_to_tip, checkerboard, cubes_side_by_side, hanging_vertices,
           klein_bottle, figure_eight_klein_bottle, moebius_strip, roman_surface, knot, spiky_ball, heap_of_triangles,
           heap_of_cubes, pipe, bowl, house, thousand_degenerate, collinear_slivers, tiny, huge, far_away, two_scales,
           one_triangle, flat, wavy_sheet, there_and_back]


def write_off(path, vertices, triangles):
    with open(path, "w", encoding="ascii") as file:
        file.write(f"OFF\n{len(vertices)} {len(triangles)} 0\n")
        file.writelines("%r %r %r\n" % tuple(p) for p in np.asarray(vertices, float).tolist())
        file.writelines("3 %d %d %d\n" % tuple(t) for t in np.asarray(triangles).tolist())


def write_all(folder):
    """Write NAME.off for every horror. Return the horrors by name."""
    horrors = {make.__name__: make() for make in HORRORS}
    for name, horror in horrors.items():
        write_off(pathlib.Path(folder) / f"{name}.off", horror.vertices, horror.triangles)
    return horrors


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    pathlib.Path(sys.argv[1]).mkdir(parents=True, exist_ok=True)
    print(f"{len(write_all(sys.argv[1]))} surfaces in {sys.argv[1]}")
