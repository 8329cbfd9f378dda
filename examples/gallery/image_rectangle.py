#!/usr/bin/env python3
"""A whole image as a deformable rectangle.

If an image has no alpha, or on request, the filter uses the whole rectangle of the image as the shape. Points become
vertices of the mesh at any position. Moved points warp the picture smoothly, and the points at the border fix it. Left:
the mesh and its points. Right: the warped picture.

Numbers: the mesh's area relative to that of the pixels; its smallest angle; points that are not vertices; the largest
difference between the picture and the unposed mesh drawn pixel on pixel; triangles that the warp turns over.
"""

import common
import bindpose
import numpy as np

import planar

# Position and displacement of each point, as fractions of the image size. Points with displacement 0 keep their
# surroundings in place.
MOVES = {"eye": ((0.438, 0.76), (-0.035, 0.02)), "other eye": ((0.562, 0.76), (0.035, 0.02)),
         "mouth": ((0.5, 0.645), (0.0, -0.035)), "hand": ((0.13, 0.80), (0.03, -0.07)), "belly": ((0.5, 0.33), (0.0, 0.0)),
         "hip": ((0.66, 0.36), (0.05, 0.02)), "tail": ((0.82, 0.45), (-0.03, 0.09))}
# points on the border of the image, which do not move
HOLD = [(x / 6, y / 6) for x in range(7) for y in range(7) if x in (0, 6) or y in (0, 6)]


def landscape(size):
    """Draw the cat in front of sky and meadow, with lines that show the warp; without alpha."""
    x, y = planar.pixel_centers(size)
    sky = (1 - y)[..., None] * np.array((215, 235, 250)) + y[..., None] * np.array((120, 180, 235))
    hill = 0.22 + 0.05 * np.sin(5 * x + 1)
    ground = np.where((y < hill)[..., None], np.array((150, 195, 110)), sky)
    lines = (np.minimum(np.abs(x * 12 % 1 - 0.5), np.abs(y * 12 % 1 - 0.5)) < 0.022)[..., None]
    ground = np.where(lines, 0.8 * ground + 0.2 * 255, ground)
    drawing = planar.cat(size)
    alpha = drawing[..., 3:] / 255
    return np.rint(alpha * drawing[..., :3] + (1 - alpha) * ground).astype(np.uint8)


def make(options):
    size = 256 if options.small else 1024
    pixels = landscape(size)
    places = np.array([[*place, 0] for place, _move in MOVES.values()] + [[*place, 0] for place in HOLD]) * size - [0.5, 0.5, 0]
    handles = bindpose.handles(points=places, names=[*MOVES, *[f"hold {k + 1}" for k in range(len(HOLD))]])
    image = planar.write_png(pixels, options.scratch / "landscape.png")
    rectangle = bindpose.planar_shape(image, handles=handles, edge=0.03 if options.small else 0.02)
    report = bindpose.report(rectangle)
    triangles = planar.triangles_of(rectangle)

    weighted = bindpose.weights(rectangle, handles, domain="surface")
    moves = {name: {"translate": [move[0] * size, move[1] * size, 0.0]} for name, (_place, move) in MOVES.items()}
    warped = bindpose.deform(weighted, handles, {"handles": moves})
    moved = planar.posed_points(handles, places + np.array([[*move, 0] for _place, move in MOVES.values()] + [[0, 0, 0]] * len(HOLD)) * size)

    texture = planar.to_texture(pixels)
    radius = 0.012 * size
    box = (-0.04 * size, 1.04 * size, -0.02 * size, 1.02 * size)
    window = planar.show([
        (f"the whole image: {len(triangles)} triangles, smallest angle {report['min_angle']:.0f}°",
         [planar.textured(rectangle, texture), planar.wires(rectangle, opacity=0.45), *planar.handle_actors(handles, radius)]),
        ("points moved", [planar.textured(warped, texture), *planar.handle_actors(moved, radius)])],
        box, tile=(700, 700), title="A whole image bent as a rectangle mesh")
    common.write_picture(window, options.picture)
    return {
        "pixels": size * size,
        "triangles": len(triangles),
        "area of the mesh relative to the area of the pixels": report["area"] / size ** 2,
        "smallest angle in degrees": report["min_angle"],
        "points that are not vertices": report["counts"]["outside_handles"],
        "largest difference of the unposed mesh from the picture (0 to 255)": planar.difference(
            rectangle, pixels, np.ones((size, size), dtype=bool)),
        "flipped triangles": int((planar.signed_areas(planar.points_of(warped), triangles) <= 0).sum()),
    }


if __name__ == "__main__":
    common.main(__file__, __doc__, make)
