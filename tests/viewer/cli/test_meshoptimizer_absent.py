"""In a build without meshoptimizer, the program names the missing package when it reads a glTF file that is compressed by
meshopt.
"""

import compressed_gltf


def test_compressed_buffer_views(folder):
    folder.write("meshopt.gltf", compressed_gltf.meshopt_text())
    compressed_gltf.expect_missing_library(folder, "meshopt.gltf", "buffer view 0", "meshoptimizer (Debian package libmeshoptimizer-dev)")


def test_optional_compression_is_not_used(folder):
    folder.write("both.gltf", compressed_gltf.meshopt_text(is_required=False))
    compressed_gltf.expect_uncompressed_data(folder, "both.gltf")
