#ifndef bindpose_embedding_embedding_parts_h
#define bindpose_embedding_embedding_parts_h

#include "base/execution.h"
#include "embedding/atom_connections.h"
#include "embedding/embedding_atoms.h"
#include "embedding/embedding_result.h"
#include "embedding/lattice_cover.h"
#include "embedding/material_probes.h"
#include "geometry/mesh.h"

namespace bindpose
{

/// Make tets from connected atoms, and bind the points of the surface to the tets. This sets mesh,
/// inside_fractions, binding, lattice_tets and duplicated_nodes of an empty result.
/// @return false if canceled.
bool make_embedding(ExecutionContext& context, PointsView points, const LatticeSurface& surface,
  const LatticeCover& cover, const EmbeddingAtoms& atoms, AtomConnections connections,
  const MaterialProbes& probes, EmbeddingTets& result);

} // namespace bindpose

#endif
