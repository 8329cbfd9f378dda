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

/// Connections between atoms, by lines between samples and by triangles.
struct AtomConnections
{
  using Id = EmbeddingAtoms::Id;

  DisjointSets<Id> within; ///< atoms of one tet
  std::vector<std::pair<Id, Id>> across; ///< connected atoms of different tets
  std::vector<float> shares; ///< #atoms: amount of the inside, in sample cells
  /// An atom at each vertex of the surface; -1: no triangle uses the vertex.
  std::vector<Id> of_vertex;
};

/// Find the connections.
/// Cost: one winding number per stretch of a line between two crossings.
Status connect_atoms(const LatticeSurface& surface, const WindingNumber& winding, double threshold,
  const LatticeCover& cover, const EmbeddingAtoms& atoms, AtomConnections& result,
  ExecutionContext& context);

} // namespace bindpose

#endif
