// The method of embed_surface(). The material consists of the surface and the enclosed region. The
// material is divided into atoms. Each atom is in one lattice tet: a piece of a triangle, or a
// sample of the inside. Two atoms are connected if the straight segment between them is completely
// in the material. Connected atoms belong to the same copy of each node that their tets have in
// common. This is valid because the tets around a node fill a convex body (a rhombic dodecahedron),
// which contains the whole segment.
//
// 1. Choose the lattice's spacing; find the tets and cubes that triangles pass through, and the
//    cubes that are completely inside (lattice_cover.h).
// 2. Sample the cubes at the surface on a sub-grid (cube_samples.h, embedding_atoms.h).
// 3. Cut lines between neighboring samples where triangles cross them. The winding number at the
//    middle of the interval between two crossings determines whether the interval is inside. An
//    inside interval connects the atoms at its ends. Therefore no wall is missed, even if the gap
//    behind the wall is very thin. Connections thinner than the sample distance are found by the
//    triangles around them (line_crossings.h, atom_connections.h).
// 4. Connect triangles by shared vertices, and by shared edges in the tets that the edge passes
//    through. Within the tets around a node, all pieces of one triangle are connected, because a
//    triangle is convex.
// 5. The connected atoms in one tet form its parts. A union-find over (part, corner of its tet)
//    finds the copies of nodes (embedding_parts.h).
// 6. If the tets around a node contain only a thin slice of material, no line between samples may
//    be in the slice. Therefore, nodes with several copies are tested again. Straight probes run
//    from the atoms of one copy to the nearest atoms of another copy, and are tested against all
//    triangles around the node. A probe in the plane of a triangle is replaced by two probes, one
//    on each side of the plane (material_probes.h).
// 7. Parts of a tet with the same four copies of nodes become one tet.
//
// Every union keeps the smaller id, so the result does not depend on the order or the number of
// threads.
#include "embedding/embedding_tets.h"

#include "base/range_check.h"
#include "embedding/atom_connections.h"
#include "embedding/embedding_atoms.h"
#include "embedding/embedding_parts.h"
#include "embedding/lattice_cover.h"
#include "embedding/material_probes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace bindpose
{

namespace
{
Status embed(ExecutionContext& context, PointsView points, const LatticeSurface& surface,
  const WindingNumber& winding, double threshold, const LatticeCover& cover, EmbeddingTets& result)
{
  EmbeddingAtoms atoms(cover);
  {
    const Phase phase(context, "samples", 0.0, 0.6);
    Status status = atoms.number(context);
    if (status.ok())
    {
      status = atoms.find_inside(context, winding, threshold);
    }
    if (!status.ok())
    {
      return status;
    }
  }
  const Phase phase(context, "connect", 0.6, 1.0);
  AtomConnections connections;
  Status status = connect_atoms(context, surface, winding, threshold, cover, atoms, connections);
  if (!status.ok())
  {
    return status;
  }
  const MaterialProbes probes(cover, winding, threshold);
  const bool completed =
    make_embedding(context, points, surface, cover, atoms, std::move(connections), probes, result);
  return completed && !context.canceled() ? Status() : Status::canceled();
}

Index count_branching_facets(TetsView tets)
{
  std::vector<std::array<Index, 3>> facets;
  facets.reserve(static_cast<std::size_t>(4 * tets.rows()));
  for (Index t = 0; t < tets.rows(); ++t)
  {
    for (int k = 0; k < 4; ++k)
    {
      std::array<Index, 3> facet{ tets(t, (k + 1) % 4), tets(t, (k + 2) % 4),
        tets(t, (k + 3) % 4) };
      std::sort(facet.begin(), facet.end());
      facets.push_back(facet);
    }
  }
  std::sort(facets.begin(), facets.end());
  Index count = 0;
  for (std::size_t i = 0; i + 2 < facets.size(); ++i)
  {
    const bool first = i == 0 || facets[i - 1] != facets[i];
    count += first && facets[i] == facets[i + 2] ? 1 : 0;
  }
  return count;
}

Status check(PointsView points, TrianglesView triangles, const EmbeddingOptions& options)
{
  Status status = check_mesh(points, triangles);
  if (!status.ok())
  {
    return status;
  }
  if (triangles.rows() == 0)
  {
    return Status::invalid_input("the surface has no triangles");
  }
  constexpr Index most = std::numeric_limits<LatticeCover::Id>::max() / 64;
  if (triangles.rows() > most || points.rows() > std::numeric_limits<LatticeCover::Id>::max())
  {
    return Status::invalid_input(
      "the surface must have at most " + std::to_string(most) + " triangles");
  }
  if (options.resolution < 0 || options.resolution > LatticeCover::largest_resolution)
  {
    return Status::invalid_input("resolution must be from 0 to " +
      std::to_string(LatticeCover::largest_resolution) + " cubes, not " +
      std::to_string(options.resolution));
  }
  if (options.tets < 1)
  {
    return Status::invalid_input(
      "the target number of tets must be at least 1, not " + std::to_string(options.tets));
  }
  const Status threshold = check_positive("winding_threshold", options.winding_threshold);
  if (!threshold.ok())
  {
    return threshold;
  }
  for (const PartLink& link : options.links)
  {
    for (int k = 0; k < 2; ++k)
    {
      if (link.triangles[k] < 0 || link.triangles[k] >= triangles.rows() ||
        !link.positions[k].allFinite())
      {
        return Status::invalid_input("a link must connect two finite positions on triangles of the "
                                     "surface, but its triangle is " +
          std::to_string(link.triangles[k]));
      }
    }
  }
  return {};
}
} // namespace

Status embed_surface(ExecutionContext& context, PointsView points, TrianglesView triangles,
  const WindingNumber& winding, const EmbeddingOptions& options, EmbeddingTets& result)
{
  result = EmbeddingTets();
  Status status = check(points, triangles, options);
  if (!status.ok())
  {
    return status;
  }
  const Box box = bounding_box(points, triangles);
  // The volume of a cube with this edge length is still a finite double.
  constexpr double largest_size = 1e100;
  if (!(box.size().maxCoeff() <= largest_size))
  {
    return Status::invalid_input("the surface is larger than 1e100, so its volume would overflow");
  }
  LatticeSurface surface;
  LatticeCover cover(surface, winding, options.winding_threshold, box);
  {
    const Phase phase(context, "lattice", 0.0, 0.4);
    status = surface.build(context, points, triangles, options.links)
      ? cover.choose(context, options.resolution, options.tets)
      : Status::canceled();
    if (!status.ok())
    {
      return status;
    }
  }
  {
    const Phase phase(context, "parts", 0.4, 1.0);
    status = embed(context, points, surface, winding, options.winding_threshold, cover, result);
  }
  if (!status.ok())
  {
    result = EmbeddingTets();
    return status;
  }
  result.spacing = cover.lattice.spacing();
  result.resolution = static_cast<Index>(std::ceil(box.size().maxCoeff() / result.spacing));
  result.branching_facets = count_branching_facets(result.mesh.tets);
  result.components = connected_components(result.mesh.points.rows(), result.mesh.tets).count;
  status.report.set("spacing", result.spacing);
  status.report.set("resolution", result.resolution);
  status.report.set("counts.lattice_tets", result.lattice_tets);
  status.report.set("counts.duplicated_nodes", result.duplicated_nodes);
  status.report.set("counts.branching_facets", result.branching_facets);
  status.report.set("counts.tet_components", result.components);
  return status;
}

} // namespace bindpose
