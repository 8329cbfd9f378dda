"""Failures of bindpose tetrahedralize: helper program killed or missing, full disk, out of memory, Ctrl-C. No partial
file may be left.
"""

import contextlib
import os
import pathlib
import resource
import signal
import subprocess
import threading
import time

import pytest
import shapes
from driver import PROGRAM
from processes import children, limited, runs, stand_in, start, wait_for_end, wait_for_helper

HELPER = pathlib.Path(PROGRAM).parent / "bindpose-mesher"
pytestmark = pytest.mark.usefixtures("empty_temporary_folder")
needs_helper = pytest.mark.skipif(not HELPER.exists(), reason="built without bindpose-mesher")


# ---- The helper ------------------------------------------------------------------------------------


@needs_helper
def test_helper_can_leave_no_file(tmp_path):
    # If CGAL cannot process a mesh, it writes the mesh into the working folder.
    with subprocess.Popen([HELPER, "refine"], cwd=tmp_path, stdin=subprocess.PIPE, stderr=subprocess.PIPE) as helper:
        folder = pathlib.Path("/proc", str(helper.pid), "cwd")
        give_up = time.monotonic() + 60
        while os.readlink(folder) == str(tmp_path) and time.monotonic() < give_up:
            time.sleep(0.002)
        with pytest.raises(OSError):
            (folder / "dump-bug.mesh").write_text("")
        helper.kill()
    assert os.listdir(tmp_path) == []


def test_missing_helper(folder):
    folder.off("s.off", shapes.sphere())
    nowhere = {"BINDPOSE_MESHER": "/nowhere/bindpose-mesher"}
    words = ["tetrahedralize", "s.off", "-o", "s.vtu", "--report", "-"]
    folder.run(*words, "--method", "cdt", environment=nowhere).is_refused("/nowhere/bindpose-mesher")
    run = folder.run(*words, environment=nowhere).is_good()
    assert run.report["method"] == "remesh" and run.report["volume"] == pytest.approx(4.1, rel=0.05)
    assert "replaced method cdt" in run.err
    assert folder.run(*words, "--overwrite", "--method", "embed", environment=nowhere).is_good().report["method"] == "embed"


@needs_helper
def test_a_helper_killed_once(folder):
    """Kill the first helper process. The program must then succeed with a second one."""
    folder.off("s.off", shapes.sphere(100, 60))
    process = start(folder, "tetrahedralize", "s.off", "-o", "s.vtu", "--report", "-")
    os.kill(wait_for_helper(process), signal.SIGKILL)
    out, err = process.communicate(timeout=300)
    assert process.returncode == 0, err
    assert "signal 9" in out and sorted(os.listdir(folder.path)) == ["s.off", "s.vtu"]


@needs_helper
@pytest.mark.parametrize("method, code", [("auto", 0), ("remesh", 0), ("cdt", 5)])
def test_a_helper_killed_again_and_again(folder, method, code):
    """Kill every helper process. The lattice methods still work, because they need no helper. Method cdt ends with
    one sentence that lists all attempts.
    """
    folder.off("s.off", shapes.sphere(60, 40))
    process = start(folder, "tetrahedralize", "s.off", "--method", method, "-o", "s.vtu", "--report", "r.json")
    stop = threading.Event()

    def kill():
        while not stop.is_set():
            for child in children(process.pid):
                with contextlib.suppress(ProcessLookupError):
                    os.kill(child, signal.SIGKILL)

    killer = threading.Thread(target=kill)
    killer.start()
    try:
        _out, err = process.communicate(timeout=300)
    finally:
        stop.set()
        killer.join()
    assert process.returncode == code, err
    assert sorted(os.listdir(folder.path)) == ["r.json", "s.off"] + (["s.vtu"] if code == 0 else [])
    report = (folder / "r.json").read_text()
    assert "signal 9" in report and '"self_intersections": 0' in report
    if code == 0:
        assert '"method": "remesh"' in report
    else:
        assert err.count("\n") == 1 and "signal 9" in err


# ---- Full disk -------------------------------------------------------------------------------------


@pytest.mark.parametrize("ending", ["vtu", "vtk", "mesh"])
@pytest.mark.parametrize("size", [500, 20000])
def test_a_full_disk(folder, ending, size):
    """Limit the size of files, which has the effect of a full disk."""
    folder.off("s.off", shapes.sphere())
    process = start(folder, "tetrahedralize", "s.off", "--method", "embed", "-o", f"s.{ending}",
                    preexec_fn=limited(resource.RLIMIT_FSIZE, size))
    _out, err = process.communicate(timeout=300)
    assert process.returncode == 2, err
    assert err.startswith(f"bindpose tetrahedralize: cannot write s.{ending}") and err.count("\n") == 1, err
    assert os.listdir(folder.path) == ["s.off"]


@needs_helper
def test_no_room_for_the_helper(folder):
    """Limit the size of files. The helper's meshes are files in memory, to which the limit also applies."""
    folder.off("s.off", shapes.sphere(60, 40))
    process = start(folder, "tetrahedralize", "s.off", "--method", "cdt", "-o", "s.vtu",
                    preexec_fn=limited(resource.RLIMIT_FSIZE, 10000))
    _out, err = process.communicate(timeout=300)
    assert process.returncode == 5 and "cannot write the temporary mesh for bindpose-mesher" in err, err
    assert err.count("\n") == 1 and os.listdir(folder.path) == ["s.off"]


def test_a_report_that_nobody_can_read(folder):
    folder.off("c.off", shapes.cube())
    with open("/dev/full", "w", encoding="ascii") as full:
        done = subprocess.run([PROGRAM, "tetrahedralize", "c.off", "--method", "embed", "-o", "c.vtu", "--report", "-"],
                              cwd=folder.path, stdout=full, stderr=subprocess.PIPE, text=True, check=False, timeout=300)
    assert done.returncode == 2 and "cannot write the report" in done.stderr


# ---- Out of memory ---------------------------------------------------------------------------------


@needs_helper
def test_the_memory_limit_of_the_helper(folder):
    folder.off("s.off", shapes.sphere(60, 40))
    words = ["tetrahedralize", "s.off", "-o", "s.vtu", "--memory-limit", "10", "--report", "-"]
    run = folder.run(*words, "--method", "cdt")
    run.is_refused("memory limit of 10 MiB", code=5)
    run = folder.run(*words).is_good()
    assert run.report["method"] == "remesh" and "memory limit of 10 MiB" in run.err


@pytest.mark.parametrize("mebibytes", [400, 700])
def test_little_memory_for_all(folder, mebibytes):
    """Check that with ulimit -v, the program either makes tets or ends with one sentence."""
    folder.off("s.off", shapes.sphere(240, 160))
    process = start(folder, "tetrahedralize", "s.off", "--method", "embed", "-o", "s.vtu",
                    preexec_fn=limited(resource.RLIMIT_AS, mebibytes << 20), env={**os.environ, "OPENBLAS_NUM_THREADS": "1"})
    _out, err = process.communicate(timeout=60)
    if "shared librar" in err:
        pytest.skip("the libraries alone need more")
    assert process.returncode in (0, 5), err
    assert sorted(os.listdir(folder.path)) == ["s.off"] + (["s.vtu"] if process.returncode == 0 else [])
    assert process.returncode == 0 or err == "bindpose tetrahedralize: out of memory\n"


# ---- Canceled --------------------------------------------------------------------------------------


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_cancel_kills_the_helper(folder, number):
    folder.off("s.off", shapes.sphere())
    environment = stand_in(folder, "BINDPOSE_MESHER", "exec sleep 60")
    before = sorted(os.listdir(folder.path))
    process = start(folder, "tetrahedralize", "s.off", "-o", "s.vtu", env={**os.environ, **environment})
    helper = wait_for_helper(process)
    process.send_signal(number)
    wait_for_end(helper)  # 20 ms on an idle machine
    _out, err = process.communicate(timeout=60)
    assert process.returncode == 4 and err == "bindpose tetrahedralize: canceled\n"
    assert sorted(os.listdir(folder.path)) == before


@needs_helper
@pytest.mark.parametrize("age", [0.0, 0.001, 0.01, 0.3])
def test_no_helper_outlives_the_program(folder, age):
    """Kill the program `age` seconds after it has started the helper: before the first line of the helper runs, and
    while the helper works.
    """
    folder.off("s.off", shapes.sphere(400, 240))
    process = start(folder, "tetrahedralize", "s.off", "-o", "s.vtu")
    helper = wait_for_helper(process)
    time.sleep(age)
    assert runs(helper)
    process.kill()
    process.communicate(timeout=60)
    wait_for_end(helper)


# ---- Sizes -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("scale", [1e-9, 1e9])
@pytest.mark.parametrize("method", ["auto", "remesh", "embed"])
def test_tiny_and_huge_coordinates(folder, scale, method):
    vertices, faces = shapes.sphere()
    folder.off("s.off", ([[scale * x for x in v] for v in vertices], faces))
    report = folder.run("tetrahedralize", "s.off", "--method", method, "-o", "s.vtu", "--report", "-").is_good().report
    assert report["winding_volume"] == pytest.approx(4.1 * scale**3, rel=0.02)
    assert method == "embed" or report["volume"] == pytest.approx(4.1 * scale**3, rel=0.03)
