"""Failures of bindpose-importer, which converts and decompresses files: it crashes, hangs, is missing or killed, or needs
too much memory. The program must end with one sentence and leave no file and no process.
"""

import os
import pathlib
import re
import resource
import signal
import time

import asset_files
import compressed_gltf
import numpy as np
import pytest
import shapes
from gltf_file import GltfFile
from processes import children, limited, runs, stand_in, start, wait_for_end, wait_for_helper

pytestmark = pytest.mark.usefixtures("empty_temporary_folder")

VARIABLE = "BINDPOSE_IMPORTER"
# Per use of the importer: the verb and its options, and the file that the importer reads.
USES = {"asset": (["rig", "bar.3ds", "-o", "out.glb"], "bar.3ds"),
        "mesh": (["info", "bar.3ds"], "bar.3ds"),
        "picture": (["render", "bar.3ds", "-o", "out.png"], "bar.3ds"),
        "look": (["render", "bar.off", "--look", "bar.3ds", "-o", "out.png"], "bar.3ds"),
        "motion": (["deform", "bar.off", "--handles", "points.tgf", "--method", "mls", "--pose", "walk.bvh",
                    "-o", "out.vtp"], "walk.bvh"),
        "compressed file": (["rig", "draco.gltf", "-o", "out.glb"], "draco.gltf")}


@pytest.fixture
def files(folder):
    """A folder with the input files of USES."""
    folder.write("bar.3ds", asset_files.three_ds(("bar", shapes.bar(), (255, 0, 0))))
    folder.off("bar.off", shapes.bar())
    folder.write("points.tgf", shapes.TWO_POINTS)
    folder.write("walk.bvh", "HIERARCHY\n")
    folder.write("draco.gltf", compressed_gltf.draco_text())
    return folder


# ---- Stand-ins -------------------------------------------------------------------------------------

# Scripts that fail, and the words that follow the name of the file.
FAILURES = {
    "crash": ("kill -SEGV $$", " cannot be read: bindpose-importer was terminated by signal 11"),
    "assertion": ("echo 'assertion failed' >&2; kill -ABRT $$", "last output: assertion failed"),
    "exit code": ("exit 7", " cannot be read: bindpose-importer failed with exit code 7"),
    "reason": ("echo 'error chunk 3 is damaged' >&2; exit 1", " cannot be read: bindpose-importer: chunk 3 is damaged"),
    "memory": ("echo 'error out of memory' >&2; exit 1", "importer: out of memory under a memory limit of 1000 MiB"),
    "no data": ("exit 0", " cannot be read: the importer returned no data"),
    "other data": ("echo once upon a time", ": the file is not valid"),
    "cut data": ("printf 'glTF\\002\\000\\000\\000\\377\\377\\000\\000'", ": the file is not valid")}


@pytest.mark.parametrize("use", USES)
@pytest.mark.parametrize("failure", FAILURES)
def test_an_importer_that_fails(files, use, failure):
    words, name = USES[use]
    script, sentence = FAILURES[failure]
    files.run(*words, environment=stand_in(files, VARIABLE, script)).is_refused(name, sentence)


def test_the_program_uses_the_data_of_the_importer(files):
    """A stand-in prints a .glb file."""
    files.run("rig", "bar.3ds", "--handles", "auto:2", "-o", "bar.glb").is_good()
    environment = stand_in(files, VARIABLE, f"cat '{files / 'bar.glb'}'; echo 'warning the paint is left out' >&2")
    words = ("--handles", "auto:2", "-o", "out.glb", "--overwrite")
    for name in ("draco.gltf", "bar.3ds"):
        run = files.run("rig", name, *words, environment=environment).is_good()
        points = GltfFile(files / "out.glb").attribute(0, "POSITION")
        np.testing.assert_array_equal(points, GltfFile(files / "bar.glb").attribute(0, "POSITION"))
        assert run.err.count("warning: the paint is left out") == 1


@pytest.mark.parametrize("use", USES)
def test_missing_importers(files, use):
    """The variable names a file that does not exist, is not executable, is a folder, or is no program."""
    words, _ = USES[use]
    files.write("text", "")
    os.mkdir(files / "folder")
    for name in ("none", "text", "folder"):
        path = str(files / name)
        files.run(*words, environment={VARIABLE: path}).is_refused(VARIABLE, f"is set to {path}")
    os.chmod(files / "text", 0o755)
    files.run(*words, environment={VARIABLE: str(files / "text")}).is_refused("text cannot be started")


# ---- Time ------------------------------------------------------------------------------------------

# The script starts a second process and writes both process ids to a file.
SLEEP = 'sleep 100 & echo $$ $! >"$0.ids"; wait'


def wait_for_ids(folder, process):
    """Wait until the stand-in SLEEP runs, and return the ids of its processes."""
    file = folder / "stand_in.sh.ids"
    give_up = time.monotonic() + 60
    while not (file.exists() and file.read_text().endswith("\n")):
        assert time.monotonic() < give_up and process.poll() is None
        time.sleep(0.002)
    ids = [int(number) for number in file.read_text().split()]
    file.unlink()
    assert all(runs(number) for number in ids)
    return ids


def test_the_time_limit(files):
    """The limit is ten seconds, and more for large files."""
    environment = stand_in(files, VARIABLE, SLEEP)
    before = sorted(os.listdir(files.path))
    process = start(files, "rig", "bar.3ds", "-o", "out.glb", env={**os.environ, **environment})
    ids = wait_for_ids(files, process)
    _out, err = process.communicate(timeout=60)
    assert process.returncode == 2
    sentence = r"bindpose rig: bar\.3ds cannot be read: bindpose-importer was stopped at its time limit of 10\.?\d* s\n"
    assert re.fullmatch(sentence, err), err
    for number in ids:
        wait_for_end(number)
    assert sorted(os.listdir(files.path)) == before


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
@pytest.mark.parametrize("use", USES)
def test_cancel_ends_the_importer(files, use, number):
    environment = stand_in(files, VARIABLE, SLEEP)
    before = sorted(os.listdir(files.path))
    words, _ = USES[use]
    process = start(files, *words, env={**os.environ, **environment})
    ids = wait_for_ids(files, process)
    process.send_signal(number)
    asked = time.monotonic()
    _out, err = process.communicate(timeout=60)
    assert time.monotonic() - asked < 5  # 20 ms on an idle machine
    for child in ids:
        wait_for_end(child)
    assert process.returncode == 4 and err == f"bindpose {words[0]}: canceled\n"
    assert sorted(os.listdir(files.path)) == before


# ---- The importer itself ---------------------------------------------------------------------------


@pytest.fixture
def large_file(folder):
    """A folder with a Collada file for which the importer needs more than a second."""
    folder.write("large.dae", asset_files.collada_mesh(shapes.sphere(400, 240)))
    return folder


def test_a_killed_importer(large_file):
    process = start(large_file, "rig", "large.dae", "-o", "out.glb")
    os.kill(wait_for_helper(process), signal.SIGKILL)
    _out, err = process.communicate(timeout=60)
    assert process.returncode == 2 and err.count("\n") == 1
    assert err.startswith("bindpose rig: large.dae cannot be read: bindpose-importer was terminated by signal 9"), err
    assert os.listdir(large_file.path) == ["large.dae"]


@pytest.mark.parametrize("age", [0.0, 0.001, 0.01, 0.3])
def test_no_importer_outlives_the_program(large_file, age):
    """Kill the program `age` seconds after it has started the importer."""
    process = start(large_file, "rig", "large.dae", "-o", "out.glb")
    importer = wait_for_helper(process)
    time.sleep(age)
    assert runs(importer) and children(process.pid) == [importer]
    process.kill()
    process.communicate(timeout=60)
    wait_for_end(importer)
    assert os.listdir(large_file.path) == ["large.dae"]


def test_a_file_that_needs_too_much_memory(folder):
    """The file declares four billion coordinates, for which the library reserves 16 GB."""
    text = asset_files.collada_mesh(shapes.cube())
    assert 'count="24"' in text
    folder.write("cube.dae", text.replace('count="24"', 'count="4000000000"', 1))
    run = folder.run("rig", "cube.dae", "-o", "out.glb")
    run.is_refused("cube.dae cannot be read: bindpose-importer: out of memory under a memory limit of 1000 MiB")


def test_no_room_for_the_data_of_the_importer(folder):
    """Limit the size of files. The importer writes a file in memory, to which the limit also applies."""
    folder.write("bar.dae", asset_files.collada_mesh(shapes.bar()))
    process = start(folder, "rig", "bar.dae", "-o", "out.glb", preexec_fn=limited(resource.RLIMIT_FSIZE, 1000))
    _out, err = process.communicate(timeout=60)
    assert process.returncode == 2
    assert err == "bindpose rig: bar.dae cannot be read: bindpose-importer: the result cannot be written\n"
    assert os.listdir(folder.path) == ["bar.dae"]


def test_the_importer_leaves_the_working_folder(large_file):
    """A library cannot write a file into the working folder of the program."""
    process = start(large_file, "rig", "large.dae", "-o", "out.glb")
    folder = pathlib.Path("/proc", str(wait_for_helper(process)), "cwd")
    give_up = time.monotonic() + 60
    while os.readlink(folder) == str(large_file.path) and time.monotonic() < give_up:
        time.sleep(0.002)
    with pytest.raises(OSError):
        (folder / "dump").write_text("")
    process.kill()
    process.communicate(timeout=60)
    assert os.listdir(large_file.path) == ["large.dae"]
