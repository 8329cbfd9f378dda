#ifndef bindpose_tests_support_bars_h
#define bindpose_tests_support_bars_h

// Small meshes with handles and smooth weights, for tests of what happens at pose time.

#include "base/mesh.h"
#include "weights/handles.h"

namespace bindpose::test
{

struct Rig
{
  TetMesh mesh;
  Handles handles;
  Weights weights; ///< #V x #handles, rows sum to one, 1 at the own handle and 0 at others
};

/// Weights that minimise the biharmonic energy with the given vertices' rows fixed.
Weights biharmonic(
  const TetMesh& mesh, const std::vector<Index>& vertices, const std::vector<Index>& handles);

/// [0, 4] x [0, 1] x [0, 1] with point handles left, middle and right on the axis; the whole cross
/// sections at x = 0, 2 and 4 belong to them.
Rig bar(int cells = 8);

/// The unit cube with point handles at four corners that span it and one in the middle.
Rig box(int cells = 4);

} // namespace bindpose::test

#endif
