#!/usr/bin/env python3
"""A rig as a glTF file, read back: accuracy of the stored animation.

Handles spread over an elephant swing, each in a different way. The strip shows frames of the animation as read from
the file: mesh, joints, weights and poses, all from one .glb. Below each frame is the error of the file with the four
largest weights of each vertex, which many programs require: the largest distance of a vertex from its position with
all weights, as a fraction of the diagonal.

Numbers: bytes of the files; sets of four weights; the largest fraction of a vertex's weights that is lost if only four
weights are stored; the largest error of both files over all frames, as measured by the writer and as read back.
"""

import common
import bindpose
import numpy as np
from bindpose.handle_sets import cell_names
from bindpose.meshes import points_of

FRAMES = 5


def poses(handles, size):
    """Return poses in which handles swing about the middle, each in a different way, with increasing amplitude."""
    names = cell_names(handles)
    frames = []
    for k in range(FRAMES):
        share = k / (FRAMES - 1)
        frame = {}
        for j, name in enumerate(names):
            axis = [0.0, 0.0, 0.0]
            axis[j % 3] = 1.0
            frame[name] = {"rotate": {"axis": axis, "degrees": (-1) ** j * 35 * share},
                           "translate": [0, 0.06 * size * share * np.cos(2.4 * j), 0.04 * size * share * np.sin(j)]}
        frames.append({"handles": frame})
    return {"fps": 8, "frames": frames}


def largest(a, b, size):
    """Return the largest distance of vertices, as a fraction of the diagonal."""
    return float(np.linalg.norm(points_of(a) - points_of(b), axis=1).max() / size)


def make(options):
    surface = common.demo_mesh(options, "elephant.off")
    size = float(np.linalg.norm(np.ptp(points_of(surface), axis=0)))
    handles = bindpose.farthest_point_handles(surface, 6 if options.small else 10)
    weighted = bindpose.weights(surface, handles, domain="embedding")
    pose = poses(handles, size)
    exact = bindpose.deform(weighted, handles, pose)
    numbers, back = {}, {}
    for name, influences in (("all", 0), ("four", 4)):
        path = options.scratch / f"{name}.glb"
        report = bindpose.write_rig(weighted, handles, path, frames=exact, fps=8, maximum_influences=influences)
        rig = bindpose.read_rig(path)
        back[name] = bindpose.deform(rig.mesh, rig.handles, rig.animation)
        numbers[f"{name}: bytes"] = report["file_bytes"]
        numbers[f"{name}: sets of weights"] = report["sets"]
        numbers[f"{name}: largest dropped fraction of a vertex's weights"] = report["dropped_share"]
        numbers[f"{name}: largest error, measured by the writer"] = report["animation_error"]
        numbers[f"{name}: largest error, measured after reading"] = max(
            largest(a, b, size) for a, b in zip(back[name], exact))
    files, labels = [], []
    for k, frame in enumerate(back["all"]):
        files.append(f"frame{k}.vtp")
        bindpose.write(frame, options.scratch / files[-1])
        labels.append(f"largest error with four weights: {largest(back['four'][k], frame, size):.2g}")
    common.render(options, *files, "--columns", FRAMES, "--size", "1500x480", "--color", "handle",
                  "--labels", ",".join(labels),
                  "--title", "An animation read from a glTF file, and the error "
                  "if only four weights per vertex are stored")
    return numbers


if __name__ == "__main__":
    common.main(__file__, __doc__, make)
