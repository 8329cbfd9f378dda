#!/usr/bin/env python3
"""A cut-out cartoon bends like the drawn shape, not like the rectangle around it.

A generated picture with alpha becomes a mesh of its opaque part with outline and holes. Every bone is a chain of
edges. Weights and a pose then deform the picture. Left: the picture. Middle: the mesh and its bones. Right: the posed
mesh with the picture as its texture.

Numbers: distance of the mesh's outline from the drawn outline, in pixels; the smallest angle; the seconds of outline
and mesh; the largest difference between the picture and the unposed mesh drawn pixel on pixel; triangles that the
pose turns over.
"""

import time

import common
import bindpose
import numpy as np

import planar

POSE = {"arm": 18, "hand": 30, "head": -14, "other arm": 0, "left leg": -12, "right leg": 16, "tail": -8, "tip": -55}


def farthest_from_drawing(points, edges, size):
    """Return the largest distance of the outline from the zeros of the drawing's distance function, in pixels."""
    share = np.linspace(0, 1, 9)[:, None, None]
    along = ((1 - share) * points[edges[:, 0]] + share * points[edges[:, 1]]).reshape(-1, 2)
    x, y = ((along + 0.5) / size).T
    return float(np.abs(planar.cat_distance(x, y)).max() * size)


def make(options):
    size = 256 if options.small else 1024
    pixels = planar.cat(size)
    handles = planar.bones_of(size)
    picture = planar.write_png(pixels, options.scratch / "cat.png")
    start = time.perf_counter()
    cut_out = bindpose.planar_shape(picture, handles=handles)
    seconds = time.perf_counter() - start
    report = bindpose.report(cut_out)
    triangles, points = planar.triangles_of(cut_out), planar.points_of(cut_out)
    outline = planar.outline_of(triangles)

    weighted = bindpose.weights(cut_out, handles, domain="surface")
    turned = {name: {"rotate": {"axis": [0, 0, 1], "degrees": degrees}} for name, degrees in POSE.items()}
    # The hand is a child of the arm, and the tip a child of the tail.
    for child, parent in (("hand", "arm"), ("tip", "tail")):
        at, joint = (np.array([x, y]) * size - 0.5 for x, y in (planar.BONES[child][0], planar.BONES[parent][0]))
        angle = np.radians(POSE[parent])
        spin = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
        turned[child]["translate"] = [*(joint + spin @ (at - joint) - at), 0.0]
        turned[child]["rotate"]["degrees"] += POSE[parent]
    posed = bindpose.deform(weighted, handles, {"handles": turned})

    texture = planar.to_texture(pixels)
    alpha = pixels[..., 3:] / 255
    on_paper = np.rint(pixels[..., :3] * alpha + planar.paper(size) * (1 - alpha)).astype(np.uint8)
    whole = bindpose.planar_shape(picture, rectangle=True, edge=0, min_angle=0)
    box = (-0.06 * size, 1.06 * size, -0.03 * size, 1.03 * size)
    window = planar.show([
        ("a picture with alpha", [planar.textured(whole, planar.to_texture(on_paper))]),
        (f"mesh: {len(triangles)} triangles, smallest angle {report['min_angle']:.0f}°",
         [planar.textured(cut_out, texture), planar.wires(cut_out), *planar.handle_actors(handles, 0.011 * size)]),
        ("posed", [planar.textured(posed, texture)])], box, title="A cut-out picture bent as a mesh")
    common.write_picture(window, options.picture)
    x, y = planar.pixel_centers(size)
    return {
        "pixels": pixels.shape[0] * pixels.shape[1],
        "outline points": report["counts"]["outline_points"],
        "loops": report["counts"]["loops"],
        "triangles": len(triangles),
        "smallest angle in degrees": report["min_angle"],
        "largest distance of the outline from the drawing in pixels": farthest_from_drawing(points, outline, size),
        "area of the mesh relative to the area of the drawing": report["area"] / float(
            (planar.cat_distance(x, y) < 0).sum()),
        "seconds for outline and mesh": seconds,
        "largest difference of the unposed mesh from the picture (0 to 255)": planar.difference(
            cut_out, pixels, planar.cat_distance(x, y) < -2 / size),
        "flipped triangles": int((planar.signed_areas(planar.points_of(posed), triangles) <= 0).sum()),
    }


if __name__ == "__main__":
    common.main(__file__, __doc__, make)
