"""In a build without Draco, the program names the missing package when it reads a glTF file that is compressed by Draco."""

import compressed_gltf


def test_compressed_meshes(folder):
    folder.write("draco.gltf", compressed_gltf.draco_text())
    compressed_gltf.expect_missing_library(folder, "draco.gltf", "mesh 0: primitive 0", "Draco (Debian package libdraco-dev)")


def test_optional_compression_is_not_used(folder):
    folder.write("both.gltf", compressed_gltf.draco_text(is_required=False))
    compressed_gltf.expect_uncompressed_data(folder, "both.gltf")
