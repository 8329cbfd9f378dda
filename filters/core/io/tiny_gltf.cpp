// tinygltf is a header-only library; this file compiles its implementation.
#include <fstream> // needed by tinygltf, which does not include it

#define TINYGLTF_IMPLEMENTATION
#include "io/tiny_gltf.h"
