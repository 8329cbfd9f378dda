#!/usr/bin/env python3
"""Armor gets the weights of the character that wears it.

Plates cover the limbs and the chest of a body with automatic bones: each is a shell with an inner and an outer side, a
small distance from the skin. If each point of a plate gets the weights of the nearest point of the body, a plate on the arm
takes weights from the hip next to it, and its inner and outer side take weights of different bones. Inpainting uses the
nearest point only where distance and normal match, and solves for the rest. The second row shows a pose.

Numbers: the leak of the skin below a plate, that is the sum of the weights of all bones that do not touch the bone below the
plate, at the worst point. For both methods: the largest leak of a plate; the fraction of points whose leak is more than 0.01
above the largest leak of the skin below; the largest difference of the weights along an edge; the stretch of the edges in
the pose, at the 99th percentile and at most. For inpainting: the fraction of matched points, the largest relative gap of the
certificates, seconds.
"""

import common
import numpy as np
import worn_shapes
from bindpose.meshes import point_array, points_of, to_dataset, triangles_of
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkConnectivityFilter

GAP, THICKNESS = 0.012, 0.012  # the body is 1 high
LEAST_WEIGHT = 0.75  # weight of a bone on the skin below its plate
LEAST_TRIANGLES = 100  # of a plate


def vertex_normals(points, triangles):
    a, b, c = points[triangles].transpose(1, 0, 2)
    normals = np.zeros_like(points)
    for corner in triangles.T:
        np.add.at(normals, corner, np.cross(b - a, c - a))
    return normals / np.maximum(np.linalg.norm(normals, axis=1), 1e-300)[:, None]


def largest_part(points, triangles):
    """Return the triangles of the largest connected part."""
    parts = vtkConnectivityFilter()
    parts.SetInputData(to_dataset((points, triangles)))
    parts.SetExtractionModeToAllRegions()
    parts.ColorRegionsOn()
    parts.Update()
    of_triangle = vtk_to_numpy(parts.GetOutput().GetCellData().GetArray("RegionId"))
    return triangles[of_triangle == np.bincount(of_triangle).argmax()]


def plate(points, normals, triangles):
    """Return a closed shell over triangles of the skin."""
    used, local = np.unique(triangles, return_inverse=True)
    inner = local.reshape(-1, 3)
    count = len(used)
    edges = np.concatenate([inner[:, [0, 1]], inner[:, [1, 2]], inner[:, [2, 0]]]).tolist()
    twins = {(b, a) for a, b in edges}
    a, b = np.array([edge for edge in edges if tuple(edge) not in twins]).T
    rim = np.concatenate([np.stack([a, b, b + count], axis=1), np.stack([a, b + count, a + count], axis=1)])
    shell = np.concatenate([points[used] + GAP * normals[used], points[used] + (GAP + THICKNESS) * normals[used]])
    return shell, np.concatenate([inner[:, ::-1], inner + count, rim])


def plates(skin, skin_triangles, weights):
    """Return the points and triangles of all plates, the bone below the plate of each point, and the covered skin of each
    bone."""
    normals = vertex_normals(skin, skin_triangles)
    points, triangles = np.empty((0, 3)), np.empty((0, 3), int)
    bones, skins = [], {}
    for bone in range(weights.shape[1]):
        covered = skin_triangles[(weights[skin_triangles, bone] > LEAST_WEIGHT).all(axis=1)]
        covered = largest_part(skin, covered) if len(covered) else covered
        if len(covered) >= LEAST_TRIANGLES:
            shell, faces = plate(skin, normals, covered)
            triangles = np.concatenate([triangles, faces + len(points)])
            points = np.concatenate([points, shell])
            bones += [bone] * len(shell)
            skins[bone] = np.unique(covered)
    return points, triangles, np.array(bones), skins


def make(options):
    weighted, handles, names = worn_shapes.body_with_bones(options)
    ends = worn_shapes.ends_of(handles)
    touches = np.array([[np.abs(one[:, None] - other[None]).max(axis=2).min() < 1e-6 for other in ends] for one in ends])
    weights_of_skin = point_array(weighted, "Weights")
    points, triangles, bones, skins = plates(points_of(weighted), triangles_of(weighted), weights_of_skin)
    leaks_of_skin = np.zeros(len(names))
    for bone, skin in skins.items():
        leaks_of_skin[bone] = (weights_of_skin[skin] * ~touches[bone]).sum(axis=1).max()
    middles = ends.mean(axis=1)
    arm = max(range(len(names)), key=lambda k: middles[k][0] if middles[k][2] > 0 else -1)
    leg = max((k for k in range(len(names)) if middles[k][0] > 0 and -0.3 < middles[k][2] < -0.05),
              key=lambda k: np.linalg.norm(ends[k][1] - ends[k][0]))
    pose = {"handles": {names[arm]: {"rotate": {"axis": [0, 1, 0], "degrees": -60}},
                        names[leg]: {"rotate": {"axis": [1, 0, 0], "degrees": -45}}}}

    def leak(weights):
        leaks = (weights * ~touches[bones]).sum(axis=1)
        return {"largest leak of a plate": leaks.max(),
                "points with more leak than the skin": (leaks > leaks_of_skin[bones] + 0.01).mean()}

    numbers = {"bones": len(names), "plates": len(skins), "triangles of the plates": len(triangles),
               "largest leak of the skin": float(leaks_of_skin.max())}
    numbers.update(worn_shapes.compare_methods(options, (points, triangles), weighted, handles, pose, leak))
    worn_shapes.render_methods(options, "a pose", "The largest bone at each point of the armor")
    return numbers


if __name__ == "__main__":
    common.main(__file__, __doc__, make)
