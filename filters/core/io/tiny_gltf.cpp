// tinygltf is a header: its code is compiled here.
#include <fstream> // which tinygltf forgets

#define TINYGLTF_IMPLEMENTATION
#include "io/tiny_gltf.h"
