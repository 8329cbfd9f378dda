"""In a build without assimp, the program names the missing package when it reads a file that assimp converts."""

import pytest
import shapes

PACKAGE = "Bindpose was built without assimp (Debian package libassimp-dev)"


@pytest.mark.parametrize("ending", ["fbx", "dae", "3ds", "3mf"])
def test_meshes(folder, ending):
    name = f"mesh.{ending}"
    folder.write(name, "any content")
    folder.run("rig", name, "-o", "out.glb").is_refused(f"{name} cannot be read", PACKAGE)
    folder.run("render", name, "-o", "out.png").is_refused(f"{name} cannot be read", PACKAGE)
    folder.run("info", name).is_refused(f"{name} cannot be read", PACKAGE)


@pytest.mark.parametrize("ending", ["bvh", "fbx", "dae"])
def test_motions(folder, ending):
    name = f"motion.{ending}"
    folder.write(name, "any content")
    folder.off("bar.off", shapes.bar())
    folder.write("points.tgf", shapes.TWO_POINTS)
    words = ("deform", "bar.off", "--handles", "points.tgf", "--method", "mls", "--pose", name)
    folder.run(*words, "-o", "out.vtp").is_refused(f"{name} cannot be read", PACKAGE)


def test_a_missing_file_is_named_first(folder):
    folder.run("rig", "none.fbx", "-o", "out.glb").is_refused("none.fbx cannot be read: there is no such file")
