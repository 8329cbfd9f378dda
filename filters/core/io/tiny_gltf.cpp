// tinygltf is a header-only library; this file compiles its implementation.
#include <fstream> // missing in tinygltf

#define TINYGLTF_IMPLEMENTATION
#include "io/tiny_gltf.h"
