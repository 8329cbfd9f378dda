#!/usr/bin/env python3
"""Measure `bindpose rig --handles skeleton` on textured characters of 10,000 and 100,000 triangles.

The characters are surfaces of the Debian package libcgal-demo, subdivided or simplified to the number of triangles. Each
is a .glb file with normals, texture coordinates and a picture, and its texture has a seam: each vertex on one side has a
twin on the other. The time is that of the whole program, from the file to the rigged file, as the median of some runs.

With --check, the script fails if a median is above 1.5 times the limit of its size, because a machine may be busy.
"""

import argparse
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "viewer" / "cli"))

from all_surfaces import read_off, real_surfaces  # noqa: E402
from gltf_file import glb_bytes  # noqa: E402
from scale_surfaces import as_polydata, points_and_triangles, through  # noqa: E402

CHARACTERS = ("man.off", "armadillo.off", "elephant.off")
LIMITS = {10_000: 6.0, 100_000: 15.0}  # seconds by triangles
LARGEST = 100_000_000  # file size in bytes; larger files are skipped
PICTURE = 1024  # pixels along a side


def resized(surface, count):
    """Return the surface with about `count` triangles, and with normals."""
    while surface.GetNumberOfPolys() < count:
        surface = through(surface, vtk.vtkLoopSubdivisionFilter())
    coarser = vtk.vtkQuadricDecimation()
    coarser.SetTargetReduction(1 - count / surface.GetNumberOfPolys())
    normals = vtk.vtkPolyDataNormals()
    normals.SplittingOff()
    return through(through(surface, coarser), normals)


def png():
    row, column = np.mgrid[0:PICTURE, 0:PICTURE]
    noise = np.random.default_rng(1).integers(0, 60, (PICTURE, PICTURE))
    colors = np.stack([row // 5 + noise, column // 5 + noise, 120 + noise], axis=-1).clip(0, 255).astype(np.uint8)
    image = vtk.vtkImageData()
    image.SetDimensions(PICTURE, PICTURE, 1)
    image.GetPointData().SetScalars(numpy_to_vtk(colors.reshape(-1, 3), deep=True))
    writer = vtk.vtkPNGWriter()
    writer.WriteToMemoryOn()
    writer.SetInputData(image)
    writer.Write()
    return vtk_to_numpy(writer.GetResult()).tobytes()


def write_glb(surface, path):
    """Write a textured mesh. The texture is projected from the front and from the back, with a seam between."""
    points, triangles = points_and_triangles(surface)
    points = points.astype(np.float32)
    normals = vtk_to_numpy(surface.GetPointData().GetNormals()).astype(np.float32)
    is_back = normals[triangles].mean(axis=1)[:, 1] > 0
    sides = [triangles[~is_back], triangles[is_back]]
    used = [np.unique(side) for side in sides]
    origin, size = points.min(axis=0), np.ptp(points, axis=0)
    texture = [((points[ids] - origin) / size)[:, [0, 2]] * [0.5, 1] + [0.5 * k, 0] for k, ids in enumerate(used)]
    indices = np.concatenate([np.searchsorted(used[0], sides[0]), np.searchsorted(used[1], sides[1]) + len(used[0])])
    ids = np.concatenate(used)
    arrays = [points[ids], normals[ids], np.concatenate(texture).astype(np.float32), indices.astype(np.uint32).ravel()]
    buffer, views = b"", []
    for data in [*(array.tobytes() for array in arrays), png()]:
        views.append({"buffer": 0, "byteOffset": len(buffer), "byteLength": len(data)})
        buffer += data + b"\0" * (-len(data) % 4)
    kinds = [("VEC3", 5126), ("VEC3", 5126), ("VEC2", 5126), ("SCALAR", 5125)]
    accessors = [{"bufferView": k, "componentType": number, "type": kind, "count": len(arrays[k])}
                 for k, (kind, number) in enumerate(kinds)]
    accessors[0].update(min=points[ids].min(axis=0).tolist(), max=points[ids].max(axis=0).tolist())
    file = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "indices": 3, "material": 0}]}],
            "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}], "textures": [{"source": 0}],
            "images": [{"bufferView": 4, "mimeType": "image/png"}], "bufferViews": views, "accessors": accessors,
            "buffers": [{"byteLength": len(buffer)}]}
    path.write_bytes(glb_bytes(file, buffer))
    return len(triangles)


def rig(options, path):
    """Return the seconds of each run, and the report of the last."""
    seconds = []
    for _ in range(options.runs):
        begun = time.perf_counter()
        done = subprocess.run([options.program, "rig", path, "-o", path.with_suffix(".rigged.glb"), "--handles", "skeleton",
                               "--overwrite", "--quiet", "--report", "-"], capture_output=True, text=True, check=False)
        seconds.append(time.perf_counter() - begun)
        if done.returncode:
            sys.exit(f"{path.name}: exit code {done.returncode}: {done.stderr.strip()}")
    return seconds, json.loads(done.stdout)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, required=True)
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--check", action="store_true", help="fail above 1.5 times the limits")
    parser.add_argument("--markdown", type=pathlib.Path, help="write the table to this file, too")
    options = parser.parse_args()
    options.program = options.build.resolve() / "bin" / "bindpose"
    rows, slow = [], []
    with tempfile.TemporaryDirectory() as folder:
        scratch = pathlib.Path(folder)
        surfaces = {surface.path.name: surface.path for surface in real_surfaces(scratch, LARGEST)}
        for name in CHARACTERS:
            for count, limit in LIMITS.items():
                path = scratch / f"{pathlib.Path(name).stem}-{count}.glb"
                triangles = write_glb(resized(as_polydata(*read_off(surfaces[name])), count), path)
                seconds, report = rig(options, path)
                median = statistics.median(seconds)
                rows.append([name, triangles, report["counts"]["handles"], report["tetrahedralize"]["method"],
                             f"{median:.1f} ({min(seconds):.1f} to {max(seconds):.1f})", f"{limit:.0f}",
                             f"{report['relative_gap']:.1e}"])
                print(rows[-1], flush=True)
                slow += [f"{path.stem}: {median:.1f} s, limit {limit:.0f} s"] if median > 1.5 * limit else []
    if options.markdown:
        head = ["character", "triangles", "joints", "tets by", "seconds", "limit", "relative gap"]
        text = ["# Seconds from an asset to a rigged asset", "", "Measured by", "", "    /usr/bin/python3 " + " ".join(sys.argv), "",
                f"as median (shortest to longest) of {options.runs} runs of the whole program on a machine with 2 cores. Each character",
                "has normals, texture coordinates with a seam, and a picture.", "",
                "| " + " | ".join(head) + " |", "|---" * len(head) + "|",
                *("| " + " | ".join(map(str, row)) + " |" for row in rows)]
        options.markdown.write_text("\n".join(text) + "\n", encoding="utf-8")
    if options.check and slow:
        sys.exit("\n".join(slow))


if __name__ == "__main__":
    main()
