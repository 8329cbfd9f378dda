#ifndef bindpose_embedding_atom_connections_h
#define bindpose_embedding_atom_connections_h

#include "base/disjoint_sets.h"
#include "base/execution.h"
#include "embedding/embedding_atoms.h"
#include "embedding/lattice_cover.h"
#include "winding/winding_number.h"

#include <utility>
#include <vector>

namespace bindpose
{

/// Connections between atoms, the indivisible pieces of a surface and its inside (see
/// EmbeddingAtoms). Connections are found along lines between samples and along triangles.
struct AtomConnections
{
  using Id = EmbeddingAtoms::Id;

  DisjointSets<Id> within_tets; ///< classes of connected atoms in the same tet
  std::vector<std::pair<Id, Id>> between_tets; ///< pairs of connected atoms in different tets
  /// #atoms: inside volume that the atom represents, in units of one cell of the sub-grid.
  std::vector<float> inside_volume;
  /// One atom at each vertex of the surface; -1: no triangle uses the vertex.
  std::vector<Id> atom_of_vertex;
};

/// Find the connections of all atoms.
/// Cost: one winding number per interval between two crossings of a line with triangles.
Status connect_atoms(ExecutionContext& context, const LatticeSurface& surface,
  const WindingNumber& winding, double threshold, const LatticeCover& cover,
  const EmbeddingAtoms& atoms, AtomConnections& result);

} // namespace bindpose

#endif
