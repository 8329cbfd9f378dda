#!/usr/bin/env python3
"""Surfaces with defects that most meshers reject, and tets of the same surfaces.

Crossing triangles, edges of three and more triangles, open boundaries, several components: a scan with a hole and a
cone through it, an elephant full of holes, and a generated house with all four defects, whose counts are known in
advance. Above are the surfaces with their defects, below their tets, cut open.

Numbers: the number of defects of each type (vtkSurfaceDefects; crossings by pairs of triangles). For the tets: their
number, the method, the smallest volume of a tet (which is positive), and their total volume relative to the volume in
which the winding number is at least 1/2.
"""

import warnings

import common
import bindpose
import numpy as np
from bindpose.meshes import to_dataset

import meshes

SHAPES = {"mask and cone": "mask_cone.off", "elephant": "elephant-with-holes.off"}
KINDS = {"self-intersections": "self_intersections", "non-manifold edges": "nonmanifold_edges",
         "boundary edges": "boundary_edges", "components": "components"}


def house(around):
    """Return a box and a ring that crosses the box. The box has a wall inside and a square opening in its top face."""
    box = meshes.subdivided(meshes.cube(), 4)  # 16 x 16 squares per face
    middle = meshes.centers(box)
    window = (middle[:, 1] > 0.99) & (np.abs(middle[:, 0] - 0.5) < 0.25) & (np.abs(middle[:, 2] - 0.5) < 0.25)
    square = meshes.cube()[0] * [0, 1, 1], meshes.cube()[1][:2]  # the face of the cube at x = -1, moved to x = 0
    # The wall meets the box along 64 edges. After equal vertices are merged, three triangles share each of these edges.
    # The opening has 16 boundary edges.
    vertices, triangles = meshes.joined(meshes.without(box, window), meshes.subdivided(square, 4))
    vertices, ids = np.unique(vertices[triangles].reshape(-1, 3), axis=0, return_inverse=True)
    ring = meshes.tube(meshes.circle(1.1, 2 * around), 0.3, around)
    return meshes.joined((vertices, ids.reshape(-1, 3)), meshes.moved(ring, (0.13, 0.07, 0.21)))


def to_unit_size(mesh):
    """Scale the mesh to a box of size 1 around the origin, so that one camera shows all meshes."""
    vertices, triangles = mesh
    lower, upper = vertices.min(axis=0), vertices.max(axis=0)
    return (vertices - (lower + upper) / 2) / (upper - lower).max(), triangles


def make(options):
    surfaces = {name: meshes.triangles_of(common.demo_mesh(options, file)) for name, file in SHAPES.items()}
    surfaces["house"] = house(16 if options.small else 32)
    numbers, labels, files, tet_files = {}, [], [], []
    for name, surface in surfaces.items():
        surface = to_dataset(to_unit_size(surface))
        finder = bindpose.vtkSurfaceDefects()
        finder.SetInputData(0, surface)
        counts = bindpose.run(finder)["counts"]
        for words, key in KINDS.items():
            numbers[f"{name}: {words}"] = counts[key]
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", bindpose.BindposeWarning)  # ignore warnings about flipped patches
            tets = bindpose.tetrahedralize(surface)
        report = bindpose.report(tets)
        numbers[f"{name}: method"] = report["method"]
        numbers[f"{name}: tets"] = report["counts"]["tets"]
        numbers[f"{name}: volume of the tets relative to the volume enclosed by the winding number"] = (
            report["volume"] / report["winding_volume"])
        numbers[f"{name}: smallest volume of a tet"] = float(meshes.tet_volumes(tets).min())
        stem = name.replace(" ", "_")
        files.append(f"{stem}.vtp")
        tet_files.append(f"{stem}.vtu")
        bindpose.write(surface, options.scratch / files[-1])
        bindpose.write(tets, options.scratch / tet_files[-1])
        labels.append(f"{name}: {counts['triangles']} triangles")
    labels += [f"{numbers[f'{name}: tets']} tets" for name in surfaces]
    common.render(options, *files, *tet_files, "--defects", "--columns", len(files), "--labels", ",".join(labels),
                  "--size", "1700x1000", "--section", "0.52",
                  "--title", "Surfaces with defects (above) and their tets (below)")
    return numbers


if __name__ == "__main__":
    common.main(__file__, __doc__, make)
