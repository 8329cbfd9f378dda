"""Sequences of poses: strips of pictures and films, and failures that leave no files."""

import json
import os
import shutil
import signal
import subprocess
import tempfile
import time

import bindpose
import numpy as np
import pytest
import shapes
from bindpose.meshes import add_point_array, points_of, to_dataset
from driver import PROGRAM


@pytest.fixture
def frames(folder):
    """Write bar.pvd, a series of five frames of a bar whose second bone rises."""
    mesh = to_dataset(shapes.bar())
    x = points_of(mesh)[:, 0] / 6
    add_point_array(mesh, "Weights", np.stack([1 - x, x], axis=1), ["b1", "b2"])
    bindpose.write(mesh, folder / "rest.vtp")
    folder.write("h.tgf", shapes.TWO_BONES)
    poses = [{"handles": {"b2": {"translate": [0, k, 0]}}} for k in range(5)]
    folder.write("seq.json", json.dumps({"fps": 5, "frames": poses}))
    folder.run("deform", "rest.vtp", "--handles", "h.tgf", "--pose", "seq.json", "-o", "bar.vtp").is_good()
    return folder


def scratch():
    return {name for name in os.listdir(tempfile.gettempdir()) if "bindpose" in name and "frames" in name}


def test_a_sequence_of_one_frame_has_a_collection(folder, frames):
    folder.write("one.json", '{"frames": [{"handles": {}}]}')
    run = folder.run("deform", "rest.vtp", "--handles", "h.tgf", "--pose", "one.json", "-o", "one.vtp").is_good()
    assert run.new_files == ["one.pvd", "one_0000.vtp"]


def test_a_strip_has_a_tile_a_frame(frames):
    report = frames.run("render", "bar.pvd", "-o", "strip.png", "--report", "-").is_good().report
    assert report["picture"]["tiles"] == 5
    report = frames.run("render", "bar.pvd", "--frames", "3", "-o", "three.png", "--report", "-").is_good().report
    assert report["picture"]["tiles"] == 3
    frames.run("render", "bar.pvd", "bar_0001.vtp", "-o", "x.png").is_refused("only FILE")
    frames.write("no.pvd", "<VTKFile/>")
    frames.run("render", "no.pvd", "-o", "x.png").is_refused("no.pvd")
    frames.write("gone.pvd", (frames / "bar.pvd").read_text().replace("bar_0002", "gone"))
    frames.run("render", "gone.pvd", "-o", "x.png").is_refused("gone.vtp")


def test_without_ffmpeg_there_is_one_sentence(frames, tmp_path):
    empty = tmp_path / "empty"
    empty.mkdir()
    run = frames.run("render", "bar.pvd", "-o", "bar.gif", environment={"PATH": str(empty)})
    run.new_files = [name for name in run.new_files if name != "empty"]
    run.is_refused("apt-get install ffmpeg")


# This script replaces ffmpeg, so that the tests do not need the real program. It writes its arguments and the names of
# its input files to the output file.
FAKE = """#!/bin/sh
for last; do :; done
folder=$(dirname "$(echo "$*" | sed 's/.*-i \\([^ ]*\\) .*/\\1/')")
{ echo "$@"; ls "$folder"; } > "${last#file:}"
"""


def with_ffmpeg(frames, script):
    folder = frames / "bin"
    folder.mkdir(exist_ok=True)
    (folder / "ffmpeg").write_text(script)
    (folder / "ffmpeg").chmod(0o755)
    return {"PATH": f"{folder}:{os.environ['PATH']}"}


def test_frames_go_to_ffmpeg_and_away(frames):
    before = scratch()
    run = frames.run("render", "bar.pvd", "--size", "160x120", "-o", "bar.mp4", "--report", "r.json",
                     environment=with_ffmpeg(frames, FAKE)).is_good()
    assert run.new_files == ["bar.mp4", "r.json"]
    words = (frames / "bar.mp4").read_text().split()
    assert words[words.index("-framerate") + 1] == "5"
    assert words[-5:] == [f"00000{k}.png" for k in range(5)]
    assert json.loads((frames / "r.json").read_text())["counts"]["frames"] == 5
    assert scratch() == before
    frames.run("render", "bar.pvd", "--size", "160x120", "-o", "no.gif",
               environment=with_ffmpeg(frames, "#!/bin/sh\necho no such codec >&2\nexit 1\n")).is_refused("no such codec")
    assert scratch() == before


def test_cancel_leaves_nothing(frames):
    before = scratch()
    names = set(os.listdir(frames.path)) | {"bin"}
    environment = with_ffmpeg(frames, "#!/bin/sh\ntouch started\nsleep 60\n")
    program = subprocess.Popen([PROGRAM, "render", "bar.pvd", "--size", "160x120", "-o", "bar.webm"],
                               cwd=frames.path, env={**os.environ, **environment}, stderr=subprocess.PIPE, text=True)
    for _ in range(600):
        if (frames / "started").exists() or program.poll() is not None:
            break
        time.sleep(0.1)
    program.send_signal(signal.SIGINT)
    _, said = program.communicate(timeout=60)
    assert program.returncode == 4, said
    assert scratch() == before
    assert set(os.listdir(frames.path)) - {"started"} == names


@pytest.mark.parametrize("ending", ["gif", "webm", "mp4", "apng"])
def test_the_real_ffmpeg(frames, ending):
    if not shutil.which("ffmpeg"):
        return  # without ffmpeg, only the tests with the script FAKE check the call
    frames.run("render", "bar.pvd", "--size", "161x121", "-o", f"bar.{ending}").is_good()
    probe = ["ffprobe", "-v", "error", "-count_frames", "-select_streams", "v", "-show_entries",
             "stream=nb_read_frames,r_frame_rate", "-of", "json", f"bar.{ending}"]
    stream = json.loads(subprocess.run(probe, cwd=frames.path, capture_output=True, check=True).stdout)["streams"][0]
    assert stream["nb_read_frames"] == "5"
