#ifndef bindpose_tests_support_bars_h
#define bindpose_tests_support_bars_h

// Small meshes with handles and smooth weights, for tests of posing methods.

#include "geometry/mesh.h"
#include "handles/handles.h"

namespace bindpose::test
{

struct Rig
{
  TetMesh mesh;
  Handles handles;
  /// Weights, #V x #handles. Rows sum to 1. A weight is 1 at its own handle and 0 at other handles.
  Weights weights;
};

/// Compute weights that minimize the biharmonic energy. The rows of the given vertices are fixed.
Weights biharmonic(
  const TetMesh& mesh, const std::vector<Index>& vertices, const std::vector<Index>& handles);

/// Return the bar [0, 4] x [0, 1] x [0, 1]. Three point handles named "left", "middle" and "right"
/// are on its axis at x = 0, 2 and 4. Each handle constrains the whole cross section at its x.
Rig bar(int cells = 8);

/// Return the unit cube with five point handles: the origin, the three corners next to the origin
/// on the axes, and the center of the cube.
Rig box(int cells = 4);

} // namespace bindpose::test

#endif
