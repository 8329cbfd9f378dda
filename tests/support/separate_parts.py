"""Find the separate parts of a surface, and measure how much the weights of one part leak into another part.

Components that share no vertex belong to the same part if they touch, cross, or contain each other. Two components
touch if they have points in the same cube of a grid. Components nearer than 1/500 of the bounding-box diagonal always
touch, and components farther apart than 1/144 of the diagonal never touch. Open components, such as a bottle with an open
neck and its cap, can also be connected through the inside of the surface. In this case a straight line between them is
completely inside, and they belong to the same part.
"""

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy

from weights_accuracy import LEAK

NEAR = 1 / 500  # in bounding-box diagonals: the spacing of sample points on the surface, and half the size of the cubes
MOST_SAMPLES = 2_000_000
LINES = 300  # number of straight lines that are tested between two parts
SEED = 11


# ---- Components ------------------------------------------------------------------------------------


def weld(points, triangles):
    """Merge points of equal coordinates. Return the points, the triangles with an area, and the new id of each
    point."""
    welded, ids = np.unique(points, axis=0, return_inverse=True)
    ids = ids.reshape(-1)
    joined = ids[triangles].reshape(-1, 3)
    distinct = (joined[:, 0] != joined[:, 1]) & (joined[:, 1] != joined[:, 2]) & (joined[:, 2] != joined[:, 0])
    return welded, joined[distinct], ids


def poly_data(points, triangles):
    data, holder, cells = vtk.vtkPolyData(), vtk.vtkPoints(), vtk.vtkCellArray()
    holder.SetData(numpy_to_vtk(np.ascontiguousarray(points, float), deep=True))
    cells.SetData(numpy_to_vtkIdTypeArray(np.arange(0, 3 * len(triangles) + 1, 3), deep=True),
                  numpy_to_vtkIdTypeArray(np.ascontiguousarray(triangles, np.int64).ravel(), deep=True))
    data.SetPoints(holder)
    data.SetPolys(cells)
    return data


def components(points, triangles):
    """Return the component (0, 1, …) of each triangle; triangles with a common vertex are in one component."""
    connectivity = vtk.vtkConnectivityFilter()
    connectivity.SetInputData(poly_data(points, triangles))
    connectivity.SetExtractionModeToAllRegions()
    connectivity.ColorRegionsOn()
    connectivity.Update()
    return vtk_to_numpy(connectivity.GetOutput().GetCellData().GetArray("RegionId")).astype(int)


class Groups:
    """Disjoint sets of components (union-find)."""

    def __init__(self, count):
        self.parent = list(range(count))

    def find(self, k):
        while self.parent[k] != k:
            self.parent[k] = self.parent[self.parent[k]]
            k = self.parent[k]
        return k

    def join(self, a, b):
        self.parent[self.find(a)] = self.find(b)

    def labels(self):
        return np.array([self.find(k) for k in range(len(self.parent))])


# ---- Components in contact -------------------------------------------------------------------------


def turned(corners):
    """Reorder the corners of each triangle cyclically, so that its longest edge comes first. Also return the length of
    the longest edge and the height of the triangle above this edge."""
    edges = np.stack([corners[:, (k + 1) % 3] - corners[:, k] for k in range(3)], axis=1)
    lengths = np.linalg.norm(edges, axis=2)
    first = lengths.argmax(axis=1)
    rows = np.arange(len(corners))
    corners = np.stack([corners[rows, (first + k) % 3] for k in range(3)], axis=1)
    longest = lengths[rows, first]
    doubled_area = np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1)
    return corners, longest, doubled_area / np.maximum(longest, 1e-300)


def sample_triangles(points, triangles, spacing):
    """Sample the triangles, corners included, with points at most `spacing` apart. Also return the triangle of each
    point."""
    corners, longest, height = turned(points[triangles])
    along, up = np.ceil(longest / spacing).astype(int) + 1, np.ceil(height / spacing).astype(int) + 1
    found, owners = [], []
    for s_count, t_count in np.unique(np.stack([along, up], axis=1), axis=0):
        chosen = np.flatnonzero((along == s_count) & (up == t_count))
        steps = np.meshgrid(np.linspace(0, 1, s_count), np.linspace(0, 1, t_count))
        s, t = (grid.ravel()[None, :, None] for grid in steps)
        a, b, c = (corners[chosen, k][:, None] for k in range(3))
        found.append(((1 - t) * (a + s * (b - a)) + t * c).reshape(-1, 3))
        owners.append(np.repeat(chosen, s_count * t_count))
    return np.vstack(found), np.concatenate(owners)


def spacing_of(points, triangles):
    """Return a spacing of NEAR bounding-box diagonals, or a larger spacing that limits the points to MOST_SAMPLES."""
    size = np.linalg.norm(np.ptp(points, axis=0))
    _, longest, height = turned(points[triangles])
    spacing = NEAR * size
    while ((np.ceil(longest / spacing) + 1) * (np.ceil(height / spacing) + 1)).sum() > MOST_SAMPLES:
        spacing *= 1.5
    return spacing


def touching_pairs(points, triangles, component):
    """Return the pairs of components that have points in the same cube of one of eight shifted grids."""
    spacing = spacing_of(points, triangles)
    places, owners = sample_triangles(points, triangles, spacing)
    owner = component[owners]
    count = component.max() + 1
    halves = np.floor((places - points.min(axis=0)) / spacing).astype(np.int64)
    size = halves.max() // 2 + 2  # number of cubes along an edge of the grid; size^3 * count must be below 2^63
    once = np.unique(((halves[:, 0] * 2 * size + halves[:, 1]) * 2 * size + halves[:, 2]) * count + owner)
    key, owner = once // count, once % count
    halves = np.stack([key // (2 * size) ** 2, key // (2 * size) % (2 * size), key % (2 * size)], axis=1)
    pairs = []
    for shift in np.ndindex(2, 2, 2):
        cubes = (halves + shift) // 2
        there = np.unique(((cubes[:, 0] * size + cubes[:, 1]) * size + cubes[:, 2]) * count + owner)
        same = there[1:] // count == there[:-1] // count
        pairs.append(np.stack([there[:-1][same] % count, there[1:][same] % count], axis=1))
    return np.unique(np.vstack(pairs), axis=0)


def winding_numbers(queries, points, triangles):
    """Return the winding number of the surface at each query point."""
    corners = [points[triangles[:, k]] for k in range(3)]
    found = np.empty(len(queries))
    for number, query in enumerate(queries):
        a, b, c = (corner - query for corner in corners)
        la, lb, lc = (np.sqrt(np.einsum("ij,ij->i", v, v)) for v in (a, b, c))
        sine = np.einsum("ij,ij->i", a, np.cross(b, c))
        cosine = la * lb * lc + np.einsum("ij,ij->i", a, b) * lc + np.einsum("ij,ij->i", b, c) * la + np.einsum(
            "ij,ij->i", c, a) * lb
        found[number] = np.arctan2(sine, cosine).sum() / (2 * np.pi)
    return found


def front_sides(points, triangles):
    """Return a mask of the triangles of a welded surface that Bindpose does not ignore as back sides.

    A model for viewing from both sides has each triangle twice, with opposite orientations, so that its winding number is
    0 everywhere. In a component that consists of such pairs and is nearly closed, the first triangle of each pair is kept.
    """
    smallest_first = triangles[np.arange(len(triangles))[:, None], (triangles.argmin(axis=1)[:, None] + np.arange(3)) % 3]
    sign = np.where(smallest_first[:, 1] < smallest_first[:, 2], 1, -1)
    _, first, pair = np.unique(np.sort(triangles, axis=1), axis=0, return_index=True, return_inverse=True)
    pair = pair.reshape(-1)
    cancels = np.bincount(pair, sign)[pair] == 0
    is_first = np.zeros(len(triangles), bool)
    is_first[first] = True
    component = components(points, triangles)
    consists_of_pairs = np.ones(component.max() + 1, bool)
    consists_of_pairs[component[~cancels]] = False
    kept = np.ones(len(triangles), bool)
    for number in np.flatnonzero(consists_of_pairs):
        own = component == number
        a, b, c = (points[triangles[own & is_first, k]] for k in range(3))
        areas = np.cross(b - a, c - a)
        if np.linalg.norm(areas.sum(axis=0)) <= np.linalg.norm(areas, axis=1).sum() / 4:
            kept[own] = is_first[own]
    return kept


def oriented(points, triangles):
    """Return the triangles with consistent orientations in each patch, as Bindpose turns them.

    A patch consists of triangles that are connected by edges with two triangles. Of the two sets of triangles with opposite
    orientations, the one with the smaller area is turned. A patch without consistent orientations stays as it is.
    """
    count = len(triangles)
    edges = np.vstack([triangles[:, [k, (k + 1) % 3]] for k in range(3)])
    owners = np.tile(np.arange(count), 3)
    forward = edges[:, 0] < edges[:, 1]
    _, edge, uses = np.unique(np.sort(edges, axis=1), axis=0, return_inverse=True, return_counts=True)
    edge = edge.reshape(-1)
    paired = np.flatnonzero(uses[edge] == 2)
    paired = paired[np.argsort(edge[paired], kind="stable")].reshape(-1, 2)
    # Item k is triangle k with its own orientation. Item count + k is triangle k with reversed
    # orientation. Items with consistent orientations are in one group.
    groups = Groups(2 * count)
    for one, other in paired:
        shift = count if forward[one] == forward[other] else 0
        groups.join(owners[one], owners[other] + shift)
        groups.join(owners[one] + count, owners[other] + count - shift)
    kept, turned = groups.labels().reshape(2, count)
    area = np.linalg.norm(np.cross(points[triangles[:, 1]] - points[triangles[:, 0]],
                                   points[triangles[:, 2]] - points[triangles[:, 0]]), axis=1)
    area_of = np.bincount(kept, area, 2 * count)
    is_smaller = (area_of[kept] < area_of[turned]) | ((area_of[kept] == area_of[turned]) & (kept < turned))
    return np.where(is_smaller[:, None], triangles[:, ::-1], triangles)


def inside_pairs(points, triangles, component, groups):
    """Return the pairs of components that are not joined in `groups`. The first vertex of the first component is inside
    of the second component.
    """
    order = np.argsort(component, kind="stable")
    parts = np.split(triangles[order], np.cumsum(np.bincount(component))[:-1])
    lower = np.array([points[part.ravel()].min(axis=0) for part in parts])
    upper = np.array([points[part.ravel()].max(axis=0) for part in parts])
    solids = np.flatnonzero([len(part) >= 4 for part in parts])
    for inner, part in enumerate(parts if len(solids) else []):
        query = points[part[0, 0]]
        around = solids[((lower[solids] <= query) & (query <= upper[solids])).all(axis=1)]
        for outer in around:
            if groups.find(inner) != groups.find(outer) and abs(winding_numbers([query], points, parts[outer])[0]) >= 0.5:
                yield inner, outer


def inside_leads(first, second, points, triangles):
    """Return True if a straight line between two sets of points is inside of the surface, as it is or with triangles turned
    to agree with their neighbors. Back sides are ignored.

    Half of the lines end at the nearest point of the second set, the other half at a random point of it. The steps
    along a line are short enough to detect the gap between the sets.
    """
    points, triangles, _ = weld(points, triangles)
    triangles = triangles[front_sides(points, triangles)]
    surfaces = triangles, oriented(points, triangles)
    random = np.random.RandomState(SEED)
    starts, ends = (side[random.randint(len(side), size=LINES)] for side in (first, second))
    for k in range(LINES // 2):
        ends[k] = second[((second - starts[k]) ** 2).sum(axis=1).argmin()]
    lengths = np.linalg.norm(ends - starts, axis=1)
    step = NEAR * np.linalg.norm(np.ptp(points, axis=0)) / 2
    coarse = np.linspace(0, 1, 7)[1:-1, None]
    for start, end, length in sorted(zip(starts, ends, lengths), key=lambda line: line[2]):
        fine = np.linspace(0, 1, int(np.ceil(length / step)) + 2)[1:-1, None]
        if any(all(winding_numbers((1 - steps) * start + steps * end, points, surface).min() >= 0.5 for steps in (coarse, fine))
               for surface in surfaces):
            return True
    return False


def separate_parts(points, triangles):
    """Return the part of each point, -1 for points without a triangle. Components that touch, cross or contain each
    other are one part."""
    welded, joined, ids = weld(points, triangles)
    if len(joined) == 0:
        return np.full(len(points), -1)
    component = components(welded, joined)
    groups = Groups(component.max() + 1)
    if component.max() > 0:
        for a, b in touching_pairs(welded, joined, component):
            groups.join(a, b)
        fronts = front_sides(welded, joined)
        for a, b in list(inside_pairs(welded, joined[fronts], component[fronts], groups)):
            groups.join(a, b)
    part = np.full(len(welded), -1)
    part[joined] = groups.labels()[component][:, None]
    return part[ids]


# ---- Handles and leaks -----------------------------------------------------------------------------


def farthest_points(points, triangles, count):
    """Return the ids of vertices in the order of `--handles auto:N`: the vertex farthest from the mean, then repeatedly
    the vertex farthest from all previous ones."""
    used = np.unique(triangles)
    vertices = points[used]
    # This order of summation makes ties between distances deterministic.
    mean = np.cumsum(vertices / len(vertices), axis=0)[-1]
    chosen = [int(((vertices - mean) ** 2).sum(axis=1).argmax())]
    distance = np.full(len(vertices), np.inf)
    while len(chosen) < count:
        distance = np.minimum(distance, ((vertices - vertices[chosen[-1]]) ** 2).sum(axis=1))
        chosen.append(int(distance.argmax()))
    return used[chosen]


def largest_leak(points, triangles, weights):
    """Return the largest weight that a handle on one part has at a point of another part. Only parts with handles count.

    Two parts with a large leak between them are merged first if they are connected through the inside of the surface.
    Return None if fewer than two parts with handles remain, or if the handles are not at the expected vertices.
    """
    handles = farthest_points(points, triangles, weights.shape[1])
    if not all(weights[vertex, k] > 0.99 for k, vertex in enumerate(handles)):
        return None
    part = separate_parts(points, triangles)
    home = part[handles]
    while len(held := np.unique(home[home >= 0])) > 1:
        leaks = {(own, other): weights[part == own][:, home == other].max()
                 for own in held for other in held if own != other}
        (own, other), leak = max(leaks.items(), key=lambda item: item[1])
        if leak <= LEAK or not inside_leads(points[part == own], points[part == other], points, triangles):
            return float(leak)
        part[part == other] = own
        home[home == other] = own
    return None
