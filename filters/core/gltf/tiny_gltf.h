#ifndef bindpose_gltf_tiny_gltf_h
#define bindpose_gltf_tiny_gltf_h

// Configuration of the library tinygltf: no file access except through callbacks. It does not
// decode images.
#define TINYGLTF_NO_FS
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#include <tiny_gltf.h>

#endif
