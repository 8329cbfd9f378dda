#!/usr/bin/env python3
"""Depth order of limbs by weights.

A cat bends its arm over its face. In the plane the depth is undefined. Each bone has a layer, and blending the layers
by the weights of the pose defines a depth. This depth is smooth over the shape, and different on limbs that cross. From
left to right: the depth at rest; the arm with its layer in front; with its layer behind; with equal layers, where the
later bone is in front.

Numbers: visible pixels of the arm in front and behind; lowest and highest depth with equal layers; pixels of the
whole picture that change with the layer. Weights and pose are always the same.
"""

import common
import bindpose
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkRenderingCore import vtkRenderer

import planar

LIMB = ("arm", "hand")
DEGREES = {"arm": -38, "hand": -62}  # rotations that move the arm in front of the face


def pose_of(size):
    """Rotate the arm about its shoulder, and the hand about its wrist and with the arm."""
    turned = {}
    for name in LIMB:
        turned[name] = {"rotate": {"axis": [0, 0, 1], "degrees": DEGREES[name]}}
    shoulder, joint = (np.array(place) * size - 0.5 for place in planar.BONES["arm"])
    angle = np.radians(DEGREES["arm"])
    spin = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    turned["hand"]["translate"] = [*(shoulder + spin @ (joint - shoulder) - joint), 0.0]
    turned["hand"]["rotate"]["degrees"] += DEGREES["arm"]
    return {"handles": turned}


def seen(shape, is_arm, box, size):
    """Return the pixels that show the arm. To find them, draw the arm and the rest of the shape in two colors, without
    lights, through the depth buffer. Also return the window, because a virtual display does not restart while a window
    is open."""
    flags = vtkPolyData()
    flags.ShallowCopy(shape)
    colors = np.where(is_arm[:, None], np.array([[255, 0, 0]]), np.array([[0, 0, 255]])).astype(np.uint8)
    array = numpy_to_vtk(colors, deep=True)
    array.SetName("Flag")
    flags.GetCellData().SetScalars(array)
    actor = planar.flat_actor(flags)
    actor.GetMapper().ScalarVisibilityOn()
    actor.GetMapper().SetScalarModeToUseCellData()
    renderer = vtkRenderer()
    renderer.AddActor(actor)
    planar.look_at(renderer, box, (size, size))
    drawn, window = planar.snapshot(renderer, size)
    return drawn[..., 0] > 128, window


def make(options):
    size = 256 if options.small else 1024
    pixels = planar.cat(size)
    handles = planar.bones_of(size)
    picture = planar.write_png(pixels, options.scratch / "cat.png")
    shape = bindpose.planar_shape(picture, handles=handles)
    weighted = bindpose.weights(shape, handles, domain="surface")
    posed = bindpose.deform(weighted, handles, pose_of(size))

    names = list(planar.BONES)
    array = vtk_to_numpy(weighted.GetPointData().GetArray("Weights"))
    triangles = planar.triangles_of(weighted)
    is_arm = np.isin(array[triangles].mean(axis=1).argmax(axis=1), [names.index(name) for name in LIMB])
    layers = {"in front": dict.fromkeys(LIMB, 1), "behind": dict.fromkeys(LIMB, -1), "equal": {}}
    ordered = {caption: bindpose.depth_order(posed, handles, layer) for caption, layer in layers.items()}
    box = (-0.06 * size, 1.06 * size, -0.05 * size, 1.07 * size)
    drawn = {caption: seen(mesh, is_arm, box, size) for caption, mesh in ordered.items()}
    owned = {caption: pixels_of_arm for caption, (pixels_of_arm, _window) in drawn.items()}

    rest = bindpose.depth_order(weighted, handles, layers["in front"], displace=False)
    depth = vtk_to_numpy(rest.GetPointData().GetArray("Depth"))
    texture = planar.to_texture(pixels)
    scale = ((0, (0.93, 0.95, 0.98)), (0.5, (0.45, 0.68, 0.85)), (1, (0.05, 0.25, 0.55)))
    tiles = [("depth: arm and hand 1, all else 0", [planar.bands(weighted, np.clip(depth, 0, 1), scale, 10),
                                                    *planar.handle_actors(handles, 0.010 * size)])]
    tiles += [(f"the arm {caption}" if caption != "equal" else "equal layers: the later bone is in front",
               [planar.textured(mesh, texture), *planar.edges(mesh, shape, width=1.5)]) for caption, mesh in ordered.items()]
    window = planar.show(tiles, box, tile=(480, 480), title="One pose and one set of weights, different layers")
    common.write_picture(window, options.picture)
    equal = vtk_to_numpy(ordered["equal"].GetPointData().GetArray("Depth"))
    return {
        "triangles": len(triangles),
        "visible pixels of the arm when it is in front": int(owned["in front"].sum()),
        "visible pixels of the arm when it is behind": int(owned["behind"].sum()),
        "pixels that change with the layers": int((owned["in front"] ^ owned["behind"]).sum()),
        "changed pixels that show the arm when it is in front": int((owned["in front"] & ~owned["behind"]).sum()),
        "equal layers: lowest and highest depth": [float(equal.min()), float(equal.max())],
        "layer 1: lowest and highest depth": [float(depth.min()), float(depth.max())],
    }


if __name__ == "__main__":
    common.main(__file__, __doc__, make)
