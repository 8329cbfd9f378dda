"""In a build without Draco, the program names the missing package when it reads a glTF file that is compressed by Draco."""

import compressed_gltf

PACKAGE = "Bindpose was built without Draco (Debian package libdraco-dev)"


def test_compressed_meshes(folder):
    folder.write("draco.gltf", compressed_gltf.draco_text())
    sentence = f"draco.gltf cannot be read: bindpose-importer: mesh 0: primitive 0: {PACKAGE}"
    folder.run("rig", "draco.gltf", "-o", "out.glb").is_refused(sentence)
    folder.run("render", "draco.gltf", "-o", "out.png").is_refused(sentence)
    folder.run("info", "draco.gltf").is_refused(sentence)


def test_optional_compression_is_not_used(folder):
    """The uncompressed data of the same file is read."""
    folder.write("both.gltf", compressed_gltf.draco_text(is_required=False))
    assert folder.run("info", "both.gltf", "--report", "-").is_good().report["bounds"] == [0, 1, 0, 1, 0, 0]
