#!/usr/bin/env python3
"""Bones that stretch and twist along themselves.

Above is a mallet with one bone in its shaft, which becomes twice as long. A scale along the bone (linear blend) deforms
the head to an egg and moves it away; a stretchable bone translates it. A twist rotates the tail by 180 degrees, and the
shaft winds. Below is a cat's arm that points at the viewer: its bone is drawn half as long, and the hand follows.
Linear blend has only rigid bones and folds the skin; stretchable bones shorten it smoothly.

Numbers: position of the middle of the mallet's head, 1.3 at rest, and length of the head, 0.6 at rest; the twist's
angle at the middle of the shaft, and the change of radii; the arm's length, relative to rest, and inverted triangles.
"""

import warnings

import common
import bindpose
import numpy as np
from bindpose.handle_sets import with_cell_values
from bindpose.meshes import points_of, to_dataset

import planar

WIDE = 1440


def mallet(around, along):
    """Return points and triangles of a fluted shaft from 0 to 1 along x with a ball of radius 0.3 at 1.3, and
    the ball's widest ring."""
    shaft = np.linspace(0, 1.02, along)
    half = along // 3
    turn = np.concatenate([np.linspace(np.arccos(0.28 / 0.3), np.pi / 2, half), np.linspace(np.pi / 2, np.pi, half)[1:]])
    x = np.concatenate([shaft, 1.3 - 0.3 * np.cos(turn)])
    radius = np.concatenate([np.full(along, 0.1), 0.3 * np.sin(turn)])
    radius[0] = 0.001
    fluted = np.concatenate([np.full(along, 0.3), np.zeros(len(turn))])
    angle = np.arange(around) * 2 * np.pi / around
    r = radius[:, None] * (1 + fluted[:, None] * np.cos(3 * angle))
    points = np.stack([np.repeat(x, around), (r * np.cos(angle)).ravel(), (r * np.sin(angle)).ravel()], axis=1)
    a = (np.arange(len(x) - 1)[:, None] * around + np.arange(around)).ravel()
    b = (np.arange(len(x) - 1)[:, None] * around + (np.arange(around) + 1) % around).ravel()
    triangles = np.concatenate([np.stack([a, b, b + around], axis=1), np.stack([a, b + around, a + around], axis=1)])
    return points, triangles, (along + half - 1) * around + np.arange(around)


def mallets(options, numbers):
    points, triangles, widest = mallet(24, 24) if options.small else mallet(48, 60)
    bone = bindpose.handles(bones=[[(0, 0, 0), (1, 0, 0)]])
    scaled = with_cell_values(bone, "Transform", np.diag([2.0, 1, 1, 1])[None, :3].reshape(1, 12), 12)
    ones = np.ones((len(points), 1))
    cases = {"at rest": ("lbs", bone, {}), "scaled": ("lbs", scaled, {}), "stretched": ("stbs", bone, {"b1": {"stretch": 2.0}}),
             "twisted": ("stbs", bone, {"b1": {"twist": [0, 180]}})}
    files = []
    for name, (method, handles, pose) in cases.items():
        posed = bindpose.deform((points, triangles), handles, {"handles": pose}, method=method, weights=ones)
        files.append(f"{name}.vtp".replace(" ", "-"))
        bindpose.write(to_dataset((posed, triangles)), options.scratch / files[-1])
        middle = posed[widest, 0].mean()
        numbers[f"{name}: center and length of the mallet's head"] = [
            float(middle), float(2 * (posed[:, 0].max() - middle))]
        numbers[f"{name}: largest stretch"] = bindpose.report(posed)["largest_stretch"]
    halfway = np.abs(points[:, 0] - 0.5) < 0.05
    spun = np.degrees(np.angle((posed[halfway, 1:] @ [1, 1j]) / (points[halfway, 1:] @ [1, 1j])))
    numbers["twisted: rotation at the middle of the shaft in degrees"] = float(
        np.polyval(np.polyfit(points[halfway, 0], spun, 1), 0.5))
    radii = np.hypot(posed[:, 1], posed[:, 2]) - np.hypot(points[:, 1], points[:, 2])
    numbers["twisted: largest change of a vertex's distance from the axis"] = float(np.abs(radii).max())
    picture = options.scratch / "mallets.png"
    common.render(options, *files, "--columns", 2, "--size", f"{WIDE}x640", "--edges", "--azimuth", 10, "--elevation", 15,
                  "--labels", "at rest,bone scaled (linear blend),bone stretched,bone twisted by 180 degrees",
                  picture=picture)
    return picture


def cats(options, numbers):
    size = 256 if options.small else 1024
    pixels = planar.cat(size)
    handles = planar.bones_of(size)
    shape = bindpose.planar_shape(planar.write_png(pixels, options.scratch / "cat.png"), handles=handles)
    weighted = bindpose.weights(shape, handles, domain="surface")
    (shoulder, wrist), (_, fingers) = (np.array([(*p, 0) for p in planar.BONES[name]]) * size - [0.5, 0.5, 0]
                                       for name in ("arm", "hand"))
    shorter = shoulder + 0.5 * (wrist - shoulder)
    pose = {"handles": {"arm": {"head": shoulder.tolist(), "tail": shorter.tolist()},
                        "hand": {"head": shorter.tolist(), "tail": (fingers + shorter - wrist).tolist()}}}
    rest = points_of(weighted)
    # Choose vertices along the arm before the wrist, where the hand has no influence.
    near = [int(np.linalg.norm(rest - (shoulder + share * (wrist - shoulder)), axis=1).argmin()) for share in (0.2, 0.8)]
    texture = planar.to_texture(pixels)
    tiles = [("at rest", [planar.textured(weighted, texture), *planar.handle_actors(handles, 0.01 * size)])]
    for method, name in (("lbs", "linear blend"), ("stbs", "stretchable bones")):
        with warnings.catch_warnings():
            if method == "lbs":  # linear blend ignores the stretch and warns; the picture shows this on purpose
                warnings.simplefilter("ignore", bindpose.BindposeWarning)
            posed = bindpose.deform(weighted, handles, pose, method=method)
        ends = points_of(posed)[near]
        length = np.linalg.norm(ends[1] - ends[0]) / np.linalg.norm(rest[near[1]] - rest[near[0]])
        numbers[f"arm, {name}: length relative to rest"] = float(length)
        numbers[f"arm, {name}: inverted triangles"] = bindpose.report(posed)["counts"]["inverted_elements"]
        tiles.append((f"arm bone shortened to half: {name}", [planar.textured(posed, texture)]))
    window = planar.show(tiles, (-0.06 * size, 1.06 * size, -0.05 * size, 1.07 * size), tile=(WIDE // 3, WIDE // 3))
    picture = options.scratch / "cats.png"
    common.write_picture(window, picture)
    return picture, window


def make(options):
    # ignore warnings about inverted tets; the result contains their number
    warnings.filterwarnings("ignore", "the pose inverts", bindpose.BindposeWarning)
    numbers = {}
    above = mallets(options, numbers)
    below, _window = cats(options, numbers)
    common.side_by_side(options, [above, below], 1)
    return numbers


if __name__ == "__main__":
    common.main(__file__, __doc__, make)
