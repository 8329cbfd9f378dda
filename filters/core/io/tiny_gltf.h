#ifndef bindpose_io_tiny_gltf_h
#define bindpose_io_tiny_gltf_h

// tinygltf as we use it: it reads and writes nothing but what is handed to it, and no pictures.
#define TINYGLTF_NO_FS
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#include <tiny_gltf.h>

#endif
