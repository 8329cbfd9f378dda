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

/// Which atoms are connected by lines between samples and by triangles.
struct AtomConnections
{
  using Id = EmbeddingAtoms::Id;

  DisjointSets<Id> within; ///< atoms of one tet
  std::vector<std::pair<Id, Id>> across; ///< connected atoms of different tets
  std::vector<float> shares; ///< of the atoms: how much is inside, in cells of a sample
  std::vector<Id> of_vertex; ///< an atom at each vertex of the surface, -1: no triangle uses it
};

/// Cost: a winding number for every stretch of such a line between two crossings.
Status connect_atoms(const LatticeSurface& surface, const WindingNumber& winding, double threshold,
  const LatticeCover& cover, const EmbeddingAtoms& atoms, AtomConnections& result,
  ExecutionContext& context);

} // namespace bindpose

#endif
