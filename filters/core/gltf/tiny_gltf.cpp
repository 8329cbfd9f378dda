// tinygltf is a header-only library; this file compiles its implementation.
#include <fstream> // needed by tinygltf, which does not include it

#define TINYGLTF_IMPLEMENTATION
#include "gltf/tiny_gltf.h"
