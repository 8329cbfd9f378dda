// What is to be held, the material, is the surface and what it encloses. It is taken apart into
// atoms, each in one lattice tet: a piece of a triangle, or a sample of the inside. Two atoms are
// connected when the straight line between them stays in the material; both its tets' nodes then
// see them as one part, for the tets around a node fill a convex body (a rhombic dodecahedron), so
// that the line does not leave it.
//
// 1. The lattice's spacing, what triangles go through, and cubes that are inside as a whole
//    (lattice_cover.h).
// 2. The other cubes at the surface are sampled on a sub-grid (cube_samples.h, embedding_atoms.h).
// 3. Lines between neighbouring samples are cut where triangles cross them. A stretch between two
//    crossings is inside or not, by the winding number at its middle. Inside stretches connect what
//    is at their ends. So a wall is never missed, however thin the gap behind it; connections that
//    are thinner than the samples' distance are seen by the triangles around them
//    (line_crossings.h, atom_connections.h).
// 4. Triangles connect by shared vertices, and by shared edges in the tets that the edge goes
//    through; within the tets around a node a triangle is one piece, being convex.
// 5. Atoms that are connected in one tet make its parts. A union-find over (part, corner of its
//    tet) finds the copies of nodes; parts with the same four copies are one tet
//    (embedding_parts.h).
// 6. Where the tets around a node hold but a slice of material, no line between samples may lie in
//    it. So before the last step, nodes with several copies are looked at again: straight probes
//    from one copy's atoms to the nearest of another's, against all triangles around the node
//    (material_probes.h).
//
// Every union keeps the smaller id, so that nothing depends on the order, nor on threads.
#include "embedding/embedding_tets.h"

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
Status embed(PointsView points, const LatticeSurface& surface, const WindingNumber& winding,
  double threshold, const LatticeCover& cover, EmbeddingTets& result, ExecutionContext& context)
{
  EmbeddingAtoms atoms(cover);
  {
    const Phase phase(context, "samples", 0.0, 0.6);
    Status status = atoms.number(context);
    if (status.ok())
    {
      status = atoms.find_inside(winding, threshold, context);
    }
    if (!status.ok())
    {
      return status;
    }
  }
  const Phase phase(context, "connect", 0.6, 1.0);
  AtomConnections connections;
  Status status = connect_atoms(surface, winding, threshold, cover, atoms, connections, context);
  if (!status.ok())
  {
    return status;
  }
  const MaterialProbes probes(cover, winding, threshold);
  const bool made =
    make_embedding(points, surface, cover, atoms, std::move(connections), probes, result, context);
  return made && !context.cancelled() ? Status() : Status::cancelled();
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
      "the surface has more than " + std::to_string(most) + " triangles");
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
      "the wanted number of tets must be at least 1, not " + std::to_string(options.tets));
  }
  if (!std::isfinite(options.winding_threshold) || options.winding_threshold <= 0.0)
  {
    return Status::invalid_input("winding_threshold must be positive");
  }
  for (const PartLink& link : options.links)
  {
    for (int k = 0; k < 2; ++k)
    {
      if (link.triangles[k] < 0 || link.triangles[k] >= triangles.rows() ||
        !link.places[k].allFinite())
      {
        return Status::invalid_input("a link must join two places on triangles of the surface, "
                                     "not on triangle " +
          std::to_string(link.triangles[k]));
      }
    }
  }
  return {};
}
} // namespace

Status embed_surface(PointsView points, TrianglesView triangles, const WindingNumber& winding,
  const EmbeddingOptions& options, EmbeddingTets& result, ExecutionContext& context)
{
  result = EmbeddingTets();
  Status status = check(points, triangles, options);
  if (!status.ok())
  {
    return status;
  }
  const Box box = bounding_box(points, triangles);
  constexpr double largest_size = 1e100; // its cube is a volume
  if (!(box.size().maxCoeff() <= largest_size))
  {
    return Status::invalid_input("the surface is larger than 1e100, too large for volumes");
  }
  LatticeSurface surface;
  LatticeCover cover(surface, winding, options.winding_threshold, box);
  {
    const Phase phase(context, "lattice", 0.0, 0.4);
    status = surface.build(points, triangles, options.links, context)
      ? cover.choose(options.resolution, options.tets, context)
      : Status::cancelled();
    if (!status.ok())
    {
      return status;
    }
  }
  {
    const Phase phase(context, "parts", 0.4, 1.0);
    status = embed(points, surface, winding, options.winding_threshold, cover, result, context);
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
