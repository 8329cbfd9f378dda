#!/usr/bin/env python3
"""A rigged asset keeps its materials.

A body is painted: an OBJ file with a picture for the clothes, and gold for the head. It gets automatic bones and weights,
and is written as glTF with its materials. The picture shows the file and a pose of it.

Numbers: materials and bones in the glTF file; whether the picture in it has the same bytes as before; the certificate of
the weights.
"""

import json
import struct
import warnings

import common
import bindpose
import numpy as np
import planar
from bindpose.handle_sets import cell_names
from bindpose.meshes import points_of, triangles_of

SIZE = 256  # of the picture, in pixels
HEAD = 0.36  # height of the chin; the body is 1 high, with z up, and its center is the origin


def cloth():
    """Return a picture: a striped shirt above checkered trousers."""
    row, column = np.mgrid[0:SIZE, 0:SIZE]
    colors = np.empty((SIZE, SIZE, 4), np.uint8)
    colors[..., 3] = 255
    shirt = row < SIZE // 2
    colors[..., :3] = np.where((row // 8 % 2 == 0)[..., None], (235, 235, 225), (40, 70, 150))
    checks = (row // 8 + column // 8) % 2 == 0
    colors[~shirt, :3] = np.where(checks[..., None], (120, 30, 40), (70, 20, 30))[~shirt]
    return colors


def write_painted(mesh, folder):
    """Write an OBJ file with its materials. The picture is projected from the front."""
    points, triangles = points_of(mesh), triangles_of(mesh)
    lower, size = points.min(axis=0), np.ptp(points, axis=0)
    texture = ((points - lower) / size)[:, [0, 2]]
    is_head = points[triangles][:, :, 2].mean(axis=1) > HEAD
    lines = ["mtllib painted.mtl"]
    lines += [f"v {x:.9g} {y:.9g} {z:.9g}" for x, y, z in points] + [f"vt {u:.9g} {v:.9g}" for u, v in texture]
    for name, part in (("cloth", triangles[~is_head]), ("gold", triangles[is_head])):
        lines += [f"usemtl {name}", *("f " + " ".join(f"{v}/{v}" for v in corners) for corners in part + 1)]
    (folder / "painted.obj").write_text("\n".join(lines) + "\n")
    (folder / "painted.mtl").write_text("newmtl cloth\nKd 1 1 1\nPr 0.9\nmap_Kd cloth.png\n"
                                        "newmtl gold\nKd 1 0.75 0.3\nPm 1\nPr 0.35\n")
    planar.write_png(cloth(), folder / "cloth.png")


def make(options):
    write_painted(common.demo_mesh(options, "man.off"), options.scratch)
    asset = bindpose.read_asset(options.scratch / "painted.obj")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", bindpose.BindposeWarning)  # fingers are finer than the lattice
        handles = bindpose.automatic_handles(asset.mesh, maximum_bones=20)
        weighted = bindpose.weights(asset.mesh, handles, embedding_resolution=20 if options.small else 0)
    bindpose.write_rig(weighted, handles, options.scratch / "rigged.glb", asset=options.scratch / "painted.obj")
    names = cell_names(handles)
    middles = dict(zip(names, points_of(handles)[-2 * len(names):].reshape(-1, 2, 3).mean(axis=1)))
    arm = max((name for name in names if middles[name][2] > 0.1), key=lambda name: middles[name][0])
    thigh = max((name for name in names if -0.3 < middles[name][2] < -0.05), key=lambda name: middles[name][0])
    pose = {"handles": {arm: {"rotate": {"axis": [0, 1, 0], "degrees": -75}},
                        thigh: {"rotate": {"axis": [1, 0, 0], "degrees": -50}}}}
    bindpose.write(bindpose.deform(weighted, handles, pose), options.scratch / "posed.vtp")
    common.render(options, "rigged.glb", "posed.vtp", "--look", "rigged.glb", "--up", "z", "--azimuth", -115, "--elevation", 8,
                  "--size", "1200x800", "--labels", "rigged.glb,a pose of it",
                  "--title", "Bones and weights for a painted body")
    content = (options.scratch / "rigged.glb").read_bytes()
    length = struct.unpack("<I", content[12:16])[0]
    file = json.loads(content[20:20 + length])
    report = bindpose.report(weighted)
    return {"materials": len(file["materials"]), "bones": len(file["skins"][0]["joints"]),
            "the picture has the same bytes": (options.scratch / "cloth.png").read_bytes() in content,
            "largest relative gap of the weights": report["relative_gap"]}


if __name__ == "__main__":
    common.main(__file__, __doc__, make)
