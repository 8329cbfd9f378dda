#!/usr/bin/env python3
"""Automatic rigging: find handles, compute weights, and apply a pose.

Mean curvature flow contracts the armadillo to a curve, which becomes bones: limbs, hands, ears and tail. The second
picture shows the armadillo bent at every joint, with bounded biharmonic weights of these bones. Below is an elephant
full of holes; its skeleton is computed from the inside that the winding number defines. The last picture shows points
that are spread along the surface and moved into the middle of the shape.

Numbers: bones, junctions, joints that are outside; cut cycles (the elephant's trunk and tusks touch its head);
processor seconds from mesh to bones; the largest error of a row sum of the weights. For points that are spread over the
surface by straight distance: the smallest distance between two points, divided by the largest distance of a vertex from
its nearest point. This ratio is at least 1.
"""

import os
import warnings

import common
import bindpose
import numpy as np
from bindpose.meshes import point_array, points_of


def processor_seconds():
    """Return the processor seconds of this process and of terminated helpers."""
    spent = os.times()
    return spent.user + spent.system + spent.children_user + spent.children_system


def found(mesh, numbers, name, **how):
    """Return automatic handles of a mesh, and add the time and the counts of the computation to `numbers`."""
    begun = processor_seconds()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", bindpose.BindposeWarning)  # ignore warnings about cut cycles; the numbers contain them
        handles = bindpose.automatic_handles(mesh, **how)
    numbers[f"{name}: processor seconds"] = processor_seconds() - begun
    counts = bindpose.report(handles)["counts"]
    numbers[f"{name}: bones"] = counts["handles"]
    for key in ("junctions", "joints_outside", "cut_cycles"):
        numbers[f"{name}: {key.replace('_', ' ')}"] = counts[key]
    return handles


def bent(handles, degrees):
    """Rotate every bone with a parent sideways, alternately to the left and right."""
    pose = {}
    for cell in range(handles.GetNumberOfCells()):
        if handles.GetCellData().GetArray("Parent").GetValue(cell) >= 0:
            name = handles.GetCellData().GetAbstractArray("HandleName").GetValue(cell)
            pose[name] = {"rotate": {"axis": [0, 0, 1], "degrees": degrees * (-1) ** cell}}
    return {"handles": pose}


def make(options):
    triangles = 3000 if options.small else 10000
    numbers = {}
    armadillo = common.demo_mesh(options, "armadillo.off")
    elephant = common.demo_mesh(options, "elephant-with-holes.off")
    bones = found(armadillo, numbers, "armadillo", skeleton_triangles=triangles)
    others = found(elephant, numbers, "elephant with holes", skeleton_triangles=triangles)

    with warnings.catch_warnings():
        # ignore warnings about toes and fingers that are finer than the lattice
        warnings.simplefilter("ignore", bindpose.BindposeWarning)
        weighted = bindpose.weights(armadillo, bones, domain="embedding", embedding_resolution=20 if options.small else 0)
    sums = point_array(weighted, "Weights").sum(axis=1)
    numbers["armadillo: largest error of a row sum"] = float(np.abs(sums - 1).max())
    posed = bindpose.deform(weighted, bones, bent(bones, 20.0))

    inside = bindpose.automatic_handles(armadillo, method="points", number_of_points=16)
    numbers["points inside"] = bindpose.report(inside)["counts"]["points_inside"]
    on_surface = points_of(bindpose.automatic_handles(armadillo, method="points", number_of_points=16, place_inside=False, distance="straight"))
    apart = np.linalg.norm(on_surface[:, None] - on_surface[None], axis=2) + 1e9 * np.eye(len(on_surface))
    vertices = points_of(armadillo)
    covering = max(np.linalg.norm(vertices[k:k + 4096, None] - on_surface[None], axis=2).min(axis=1).max()
                   for k in range(0, len(vertices), 4096))
    numbers["points on the surface: smallest distance divided by the covering radius"] = float(apart.min() / covering)

    tiles = [("bones", armadillo, bones, "bones along the curve skeleton", ["--azimuth", 20]),
             ("posed", posed, None, "all joints bent; colored by bone", ["--azimuth", 20, "--color", "handle"]),
             ("elephant", elephant, others, "mesh with many holes", ["--azimuth", 40]),
             ("points", armadillo, inside, "sixteen point handles inside", ["--azimuth", 20])]
    pictures = []
    for name, mesh, handles, caption, words in tiles:
        bindpose.write(mesh, options.scratch / f"{name}.vtp")
        if handles is not None:
            bindpose.write(handles, options.scratch / f"{name}_handles.vtp")
            words = [*words, "--handles", f"{name}_handles.vtp"]
        pictures.append(options.scratch / f"{name}.png")
        common.render(options, f"{name}.vtp", *words, "--size", "700x620", "--labels", caption, picture=pictures[-1])
    common.side_by_side(options, pictures, 2)
    return numbers


if __name__ == "__main__":
    common.main(__file__, __doc__, make)
