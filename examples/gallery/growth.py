#!/usr/bin/env python3
"""Cost per point as a mesh is subdivided: it is linear for the plain sum, and hardly grows for Bindpose's methods.

Each triangle of a dinosaur is cut into 4, 16 and 64, which changes neither the surface nor its field. The surface is
closed, or has a few or many holes; the number of open edges doubles with each step. The points are random. The time is
processor time of one thread, without the build; medians of repeated measurements, bars from the fastest to the slowest.

- The plain sum over all triangles is the package's own compiled code. The triangles are shrunk a little, so that no two
  triangles share an edge; the method `exact` then uses the sum ("direct" in its report). The triangles are processed in
  blocks of 8,192, which fit into the processor's cache.
- `exact` chooses one of two algorithms. The first counts the crossings of a ray and adds a sum over open edges
  ("crossings"). If there are many open edges, the second is used: the tree of Jacobson et al. 2013 ("hierarchical").
  The legend states the chosen algorithm.
- `fast` keeps its error within 1e-3; for closed surfaces it equals `exact`.

Numbers: exponents p of time ~ triangles^p, fitted over all sizes; microseconds per point; the largest ratio of
slowest to fastest; the largest difference of all three methods from the direct sum in numpy.
"""

import time

import common
import bindpose
import numpy as np
from bindpose.meshes import point_array, to_dataset, to_vtk_points
from vtkmodules.vtkChartsCore import vtkChartLegend
from vtkmodules.vtkCommonDataModel import vtkPolyData

import charts
import meshes

TOLERANCE = 1e-3
COLORS = {"plain sum": charts.VIOLET, "exact": charts.BLUE, "fast": charts.ORANGE}


class Field:
    """The winding number of one surface, or the sum of those of several surfaces. The acceleration structure of each
    surface is built once, and the evaluation uses one thread."""

    def __init__(self, surfaces, method):
        self.filters = []
        for surface in surfaces:
            field = bindpose.vtkWindingNumberField()
            field.SetInputData(to_dataset(surface))
            field.SetMethod({"exact": field.EXACT, "fast": field.FAST}[method])
            field.SetTolerance(TOLERANCE)
            field.SetNumberOfThreads(1)
            self.filters.append(field)
        self.seconds(np.zeros((1, 3)))  # the first evaluation builds the structure

    def seconds(self, points):
        """Return the processor seconds for these points; store `values`, `chosen` and `open_edges`."""
        cloud = vtkPolyData()
        cloud.SetPoints(to_vtk_points(points))
        self.values, seconds = 0.0, 0.0
        for field in self.filters:
            field.SetInputData(1, cloud)
            start = time.process_time()
            field.Update()
            seconds += time.process_time() - start
            report = bindpose.run(field)  # like Update(), but raises an exception on failure
            self.values = self.values + point_array(field.GetOutput(), "WindingNumber")
        self.chosen, self.open_edges = report["method"], report["counts"]["open_edges"]
        return seconds


def apart(mesh, block=8192):
    """Return the triangles, shrunk a little so that no edges are shared, in blocks."""
    corners = mesh[0][mesh[1]]
    corners = corners + 1e-3 * (corners.mean(axis=1, keepdims=True) - corners)
    return [(part.reshape(-1, 3), np.arange(3 * len(part)).reshape(-1, 3))
            for part in np.split(corners, range(block, len(corners), block))]


def with_holes(mesh, every):
    """Cut one hole per `every` vertices. Each hole is two rings of triangles wide."""
    marked = np.arange(0, len(mesh[0]), every)
    for _ in range(2):
        gone = np.isin(mesh[1], marked).any(axis=1)
        marked = np.unique(mesh[1][gone])
    return meshes.without(mesh, gone)


def make(options):
    whole = meshes.triangles_of(common.demo_mesh(options, "dino.off"))
    starts = {"closed": whole, "few holes": with_holes(whole, 600), "many holes": with_holes(whole, 60)}
    box = whole[0].min(axis=0), whole[0].max(axis=0)
    random = np.random.default_rng(11)
    repeats, less = (5, 4) if options.small else (9, 1)
    panels, numbers, differences = [], {}, []
    for title, start in starts.items():
        sizes, spreads, chosen = [], {}, {}
        for times in range(3 if options.small else 4):
            mesh = meshes.subdivided(start, times)
            sizes.append(len(mesh[1]))
            textbook = random.uniform(*box, (5, 3))
            for name, surfaces, method, count in (
                    ("plain sum", apart(mesh), "exact", max(20, 200 // 4 ** times)),
                    ("exact", [mesh], "exact", 100000 if title == "closed" else 500),
                    ("fast", [mesh], "fast", 0 if title == "closed" else 1000000)):
                if count == 0:
                    continue
                field = Field(surfaces, method)
                field.seconds(textbook)
                truth = meshes.plain_winding_number(meshes.joined(*surfaces), textbook)
                differences.append(np.abs(field.values - truth).max() - (TOLERANCE if method == "fast" else 0))
                count = max(10, count // less)
                # Evaluate points before the measurement: some structures are built only after many points, and until
                # then a point costs more.
                for _ in range(0 if name == "plain sum" else 60 if name == "exact" else 3):
                    field.seconds(random.uniform(*box, (count, 3)))
                seconds = [field.seconds(random.uniform(*box, (count, 3))) / count for _ in range(repeats)]
                spreads.setdefault(name, []).append(np.quantile(seconds, [0, 0.5, 1]))
                chosen.setdefault(name, []).append(field.chosen)
                if name == "exact":
                    edges = field.open_edges
        panel = charts.Panel(f"{title}, {edges:,} open edges in the largest mesh" if edges else title,
                             ("triangles", 5e3, 8e5), ("time per point", 1e-8, 1), log=True,
                             x_names={1e4: "10,000", 1e5: "100,000"},
                             y_names={1e-8: "10 ns", 1e-7: "100 ns", 1e-6: "1 µs", 1e-5: "10 µs", 1e-4: "100 µs",
                                      1e-3: "1 ms", 1e-2: "10 ms"})
        for name, spread in spreads.items():
            fastest, median, slowest = np.array(spread).T
            power = float(np.polyfit(np.log(sizes), np.log(median), 1)[0])
            how = "" if name == "fast" else f" ({', then '.join(dict.fromkeys(chosen[name]))})"
            panel.line(f"{name}{how}: exponent {power:.2f}", sizes, median, COLORS[name], dots=True)
            for ends in zip(sizes, sizes, fastest, slowest):
                panel.line("", ends[:2], ends[2:], COLORS[name], 2)
            numbers[f"{title}, {name}: exponent p of time ~ triangles^p"] = power
            numbers[f"{title}, {name}: µs per point"] = [float(m) for m in 1e6 * median]
            numbers[f"{title}, {name}: largest ratio of slowest to fastest run"] = float((slowest / fastest).max())
        numbers[f"{title}: triangles"] = sizes
        numbers[f"{title}: open edges of the largest mesh"] = edges
        panels.append(panel)
    numbers["largest difference from the direct sum in numpy"] = float(max(differences))
    charts.draw(options.picture, panels, (1900, 640), legends=[(vtkChartLegend.LEFT, vtkChartLegend.TOP)] * 3)
    return numbers


if __name__ == "__main__":
    common.main(__file__, __doc__, make)
