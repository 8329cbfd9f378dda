#!/usr/bin/env python3
"""Preview weights and certified weights: how different are they?

One column of an elephant's weights, computed in three ways: a preview (biharmonic, clamped, in a lattice that contains
the surface), the certified bounded biharmonic weights of the same lattice, and those of tets that have the surface's
own triangles as their boundary. Below are the differences between successive pictures, drawn by `bindpose render
--minus`. This elephant is small and easy to fill, so the conforming tets are even the fastest way. A lattice is useful
for surfaces that are dense or cannot be filled. A preview is useful until the weights of the lattice are solved.

Numbers: seconds; largest and rms difference over all points, for the shown column by the program and for all columns;
fraction of points whose strongest handle differs.
"""

import time

import common
import bindpose
import numpy as np
from bindpose.meshes import point_array

WAYS = {"preview": dict(domain="embedding", stage="preview"), "lattice": dict(domain="embedding"),
        "conforming": dict(domain="volume")}
PAIRS = (("preview", "lattice"), ("lattice", "conforming"))


def make(options):
    surface = common.demo_mesh(options, "elephant.off")
    handles = bindpose.handle_sets.to_handles("auto:6", surface)
    bindpose.write(handles, options.scratch / "handles.vtp")
    numbers, found = {}, {}
    for name, way in WAYS.items():
        began = time.perf_counter()
        if options.small and way["domain"] == "embedding":
            way = {**way, "embedding_resolution": 20}
        weighted = bindpose.weights(surface, handles, **way)
        numbers[f"{name}: seconds"] = time.perf_counter() - began
        bindpose.write(weighted, options.scratch / f"{name}.vtp")
        found[name] = point_array(weighted, "Weights")
    look = ["--component", bindpose.report(weighted)["handles"][SHOWN]["name"], "--handles", "handles.vtp", *VIEW]
    pictures = [options.scratch / f"{k}.png" for k in range(3)]
    common.render(options, *(f"{name}.vtp" for name in WAYS), *look, "--columns", 3, "--size", "1560x520",
                  "--labels", "preview,certified weights on a lattice,certified weights on conforming tets",
                  picture=options.scratch / "ways.png")
    for (name, other), picture in zip(PAIRS, pictures):
        shown = common.render(options, f"{name}.vtp", "--minus", f"{other}.vtp", *look, "--size", "780x560", "--range",
                              "-0.05,0.05", "--labels", f"{name} minus {other}", picture=picture)
        difference = found[name] - found[other]
        numbers[f"{name} minus {other}, shown handle: largest and rms difference"] = [shown["difference"]["largest"],
                                                                                     shown["difference"]["rms"]]
        numbers[f"{name} minus {other}, all handles: largest and rms difference"] = [
            float(abs(difference).max()), float(np.sqrt((difference ** 2).mean()))]
        numbers[f"{name} minus {other}: fraction of vertices with another strongest handle"] = float(
            (found[name].argmax(axis=1) != found[other].argmax(axis=1)).mean())
        if abs(difference[:, SHOWN]).max() - shown["difference"]["largest"] > 1e-12:
            raise common.Stop("the difference that the program reports does not match the difference of the arrays")
    halves = options.picture
    options.picture = options.scratch / "below.png"
    common.side_by_side(options, pictures[:2], 2)
    options.picture = halves
    common.side_by_side(options, [options.scratch / "ways.png", options.scratch / "below.png"], 1)
    return numbers


SHOWN = 1
VIEW = ["--azimuth", "0"]

if __name__ == "__main__":
    common.main(__file__, __doc__, make)
