"""In a build without meshoptimizer, the program names the missing package when it reads a glTF file that is compressed by
meshopt.
"""

import compressed_gltf

PACKAGE = "Bindpose was built without meshoptimizer (Debian package libmeshoptimizer-dev)"


def test_compressed_buffer_views(folder):
    folder.write("meshopt.gltf", compressed_gltf.meshopt_text())
    sentence = f"meshopt.gltf cannot be read: bindpose-importer: buffer view 0: {PACKAGE}"
    folder.run("rig", "meshopt.gltf", "-o", "out.glb").is_refused(sentence)
    folder.run("render", "meshopt.gltf", "-o", "out.png").is_refused(sentence)
    folder.run("info", "meshopt.gltf").is_refused(sentence)


def test_optional_compression_is_not_used(folder):
    """The uncompressed data of the same file is read."""
    folder.write("both.gltf", compressed_gltf.meshopt_text(is_required=False))
    assert folder.run("info", "both.gltf", "--report", "-").is_good().report["bounds"] == [0, 1, 0, 1, 0, 0]
