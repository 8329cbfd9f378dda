"""Weights of a body on shapes that it wears, by the nearest point and by inpainting: files for a picture, and numbers."""

import time
import warnings

import bindpose
import common
import numpy as np
from bindpose.handle_sets import cell_names
from bindpose.meshes import point_array, points_of, to_dataset
from meshes import edges_of


def body_with_bones(options):
    """Return a body with weights, its bones, and their names."""
    body = common.demo_mesh(options, "man.off")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", bindpose.BindposeWarning)  # fingers are finer than the lattice
        handles = bindpose.automatic_handles(body, maximum_bones=20)
        weighted = bindpose.weights(body, handles, embedding_resolution=20 if options.small else 0)
    return weighted, handles, cell_names(handles)


def ends_of(handles):
    """Return the ends of the bones, #bones x 2 x 3."""
    return points_of(handles)[-2 * handles.GetNumberOfLines():].reshape(-1, 2, 3)


def compare_methods(options, shape, weighted, handles, pose, leak):
    """Transfer the weights of a body to a shape by both methods, and pose them.

    Writes body.vtp, METHOD.vtp, body_posed.vtp and METHOD_posed.vtp. Returns numbers: `leak(weights)` returns those of the
    weights, as {name: number}."""
    points, triangles = shape
    edges = edges_of(triangles)
    lengths = np.linalg.norm(points[edges[:, 0]] - points[edges[:, 1]], axis=1)
    bindpose.write(weighted, options.scratch / "body.vtp")
    bindpose.write(bindpose.deform(weighted, handles, pose), options.scratch / "body_posed.vtp")
    numbers = {}
    for method in ("nearest", "inpaint"):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", bindpose.BindposeWarning)  # points of the shape are far from the body
            begun = time.perf_counter()
            result = bindpose.transfer_weights(to_dataset(shape), weighted, method=method)
            seconds = time.perf_counter() - begun
        values = point_array(result, "Weights")
        posed = bindpose.deform(result, handles, pose)
        moved = points_of(posed)
        stretch = np.linalg.norm(moved[edges[:, 0]] - moved[edges[:, 1]], axis=1) / lengths
        found = {**leak(values), "largest difference along an edge": np.abs(values[edges[:, 0]] - values[edges[:, 1]]).max(),
                 "stretch of edges, 99 %": np.percentile(stretch, 99), "stretch of edges, largest": stretch.max()}
        if method == "inpaint":
            report = bindpose.report(result)
            found.update({"matched fraction": report["matched_fraction"], "largest relative gap": report["relative_gap"],
                          "seconds": seconds})
        numbers.update({f"{method}: {name}": float(number) for name, number in found.items()})
        bindpose.write(result, options.scratch / f"{method}.vtp")
        bindpose.write(posed, options.scratch / f"{method}_posed.vtp")
    return numbers


def render_methods(options, pose, title):
    """Draw the files of compare_methods(): the body and the shape at rest, and below in the pose."""
    common.render(options, "body.vtp", "nearest.vtp", "inpaint.vtp", "body_posed.vtp", "nearest_posed.vtp", "inpaint_posed.vtp",
                  "--color", "handle", "--columns", 3, "--size", "1500x1300", "--up", "z", "--azimuth", 0, "--elevation", 10,
                  "--labels", f"body,nearest point,matched and inpainted,{pose},nearest point,matched and inpainted",
                  "--title", title)
