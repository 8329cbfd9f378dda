"""Every verb is run twice with one thread and once with two threads. All runs must write the same bytes."""

import json
import math
import pathlib
import subprocess

import bindpose
import numpy as np
import pytest
import shapes
from bindpose.meshes import add_point_array, points_of, to_dataset
from driver import PROGRAM
from test_smooth import square, waves

HELPER = pathlib.Path(PROGRAM).parent / "bindpose-mesher"
needs_helper = pytest.mark.skipif(not HELPER.exists(), reason="built without bindpose-mesher")
BEND = {"frames": [{"handles": {"b2": {"rotate": {"axis": [0, 0, 1], "degrees": 20 * k}, "stretch": 1 + 0.1 * k}}}
                   for k in range(3)], "fps": 8}


def expect_same_bytes(folder, verb, *words, outputs):
    """For each output, run a verb twice with one thread and once with two threads, and compare the files. `outputs` is
    a list of the names after -o. The .glb files remain, because the nightly run validates them.
    """
    for output in outputs:
        files = []
        for threads in ("1", "1", "2"):
            run = folder.run(verb, *words, "-o", output, "--threads", threads, "--overwrite", "--report", "r.json")
            assert run.code in (0, 3), run.err
            written = {name: (folder / name).read_bytes() for name in run.new_files if name != "r.json"}
            report = json.loads((folder / "r.json").read_text())
            # Times and memory are only in the report, because they differ between runs.
            assert report["seconds"]["total"] > 0 and report["peak_memory_bytes"] > 0
            for name in run.new_files:
                (folder / name).unlink()
            files.append(written)
        for name, content in files[0].items():
            if name.endswith(".glb"):
                folder.write(name, content)
        assert files[0], output
        for again in files[1:]:
            assert again.keys() == files[0].keys()
            for name, content in files[0].items():
                assert again[name] == content, f"{verb} {' '.join(words)}: {name} differs"


@pytest.fixture
def bar(folder):
    mesh = to_dataset(shapes.bar())
    x = points_of(mesh)[:, 0] / 6
    add_point_array(mesh, "Weights", np.stack([1 - x, x], axis=1), ["b1", "b2"])
    bindpose.write(mesh, folder / "bar.vtp")
    folder.off("bar.off", shapes.bar())
    folder.write("h.tgf", shapes.TWO_BONES)
    folder.write("seq.json", json.dumps(BEND))
    folder.write("pose.json", json.dumps(BEND["frames"][2]))
    return folder


def test_info(folder):
    folder.off("open.off", shapes.open_cube())
    found = []
    for threads in ("1", "2"):
        folder.run("info", "open.off", "--defects", "d.vtp", "--threads", threads, "--overwrite").is_good()
        found.append((folder / "d.vtp").read_bytes())
    assert found[0] == found[1]


def test_winding(folder):
    folder.off("open.off", shapes.open_cube())
    folder.off("at.off", shapes.cube(-0.5, 0.5))
    for method in ("fast", "exact"):
        expect_same_bytes(folder, "winding", "open.off", "--resolution", "16", "--method", method, outputs=["w.vti"])
    expect_same_bytes(folder, "winding", "open.off", "--points", "at.off", outputs=["w.vtp"])


@needs_helper
@pytest.mark.parametrize("method", ["auto", "cdt", "embed", "remesh", "wrap"])
def test_tetrahedralize(folder, method):
    folder.off("sphere.off", shapes.sphere(12, 6))
    expect_same_bytes(folder, "tetrahedralize", "sphere.off", "--method", method, outputs=["t.vtu", "t.mesh"])


def test_outline(folder):
    folder.write("disc.png", shapes.png(80, 60, lambda x, y: (255, 128, 0, 255 * (math.hypot(x - 40, y - 30) < 20))))
    expect_same_bytes(folder, "outline", "disc.png", outputs=["o.vtp"])


@needs_helper
def test_handles(bar):
    expect_same_bytes(bar, "handles", "bar.off", outputs=["s.vtp", "s.tgf"])
    expect_same_bytes(bar, "handles", "bar.off", "--method", "points", "--number-of-points", "4", outputs=["p.vtp"])


@pytest.mark.parametrize("domain", ["embedding", "surface"])
@pytest.mark.parametrize("method", ["bounded-biharmonic", "monotone", "harmonic", "bone-heat"])
def test_weights(bar, method, domain):
    names = ["w.vtp", "w.glb"] if domain == "surface" else ["w.vtp", "w.vtu", "w.dmat", "w.glb", "w.gltf"]
    expect_same_bytes(bar, "weights", "bar.off", "--handles", "h.tgf", "--domain", domain, "--method", method,
                      outputs=names if method == "bounded-biharmonic" else names[:1])


def test_smooth(folder):
    folder.write("square.vtk", square(waves))
    expect_same_bytes(folder, "smooth", "square.vtk", "--array", "Height", outputs=["s.vtp"])


@pytest.mark.parametrize("method", ["lbs", "dqs", "stbs", "cor", "reduced-arap", "full-arap", "mls"])
def test_deform(bar, method):
    words = ("bar.vtp", "--handles", "h.tgf", "--method", method, "--pose")
    expect_same_bytes(bar, "deform", *words, "pose.json", outputs=["p.vtp"])
    expect_same_bytes(bar, "deform", *words, "seq.json", outputs=["f.vtp", "f.glb"])


def test_dynamics(bar):
    expect_same_bytes(bar, "deform", "bar.vtp", "--handles", "h.tgf", "--pose", "pose.json", "--dynamics", "--frames", "4",
                      outputs=["d.vtp"])


def test_render(bar):
    expect_same_bytes(bar, "render", "bar.vtp", "--component", "b1", "--size", "200x150", outputs=["r.png"])


@needs_helper
def test_the_helper_is_not_linked_with_fast_algebra():
    """Check the libraries of the helper. If it used CHOLMOD, OpenBLAS and METIS, the last bits of skeletons would
    differ.
    """
    libraries = subprocess.run(["ldd", HELPER], capture_output=True, text=True, check=True).stdout
    assert "libgmp" in libraries
    assert not [name for name in ("cholmod", "blas", "metis") if name in libraries], libraries
