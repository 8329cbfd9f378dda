#ifndef bindpose_tests_support_bars_h
#define bindpose_tests_support_bars_h

// Small meshes with handles and smooth weights, for tests of posing.

#include "base/mesh.h"
#include "weights/handles.h"

namespace bindpose::test
{

struct Rig
{
  TetMesh mesh;
  Handles handles;
  /// #V x #handles; rows sum to 1; 1 at the column's own handle, 0 at the other handles.
  Weights weights;
};

/// Compute weights that minimize the biharmonic energy with the rows of the given vertices fixed.
Weights biharmonic(
  const TetMesh& mesh, const std::vector<Index>& vertices, const std::vector<Index>& handles);

/// Return the bar [0, 4] x [0, 1] x [0, 1] with point handles left, middle and right on its axis.
/// Each handle constrains the whole cross section at x = 0, 2 or 4.
Rig bar(int cells = 8);

/// Return the unit cube with point handles at four corners that span it, and one in the middle.
Rig box(int cells = 4);

} // namespace bindpose::test

#endif
