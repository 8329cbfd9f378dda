// Links for surface components that no handle controls, and for openings that other components
// cover (see loose_parts.h).
#include "domain/loose_parts.h"

#include <algorithm>

namespace bindpose
{

namespace
{
/// Components touch if their distance is at most this fraction of the surface's diagonal.
constexpr double touch_distance = 1.0 / 500.0;
/// Distance between neighboring links at a covered opening, as a fraction of the surface's
/// diagonal.
constexpr double opening_link_spacing = 1.0 / 100.0;
/// Maximum number of components that can be linked. A surface with more such components counts as a
/// triangle soup and gets no links.
constexpr Index maximum_components = 20000;

/// For each part of the lattice, return 1 if the part contains a handle, else 0.
std::vector<char> parts_with_handles(
  const Components& parts, Index vertex_count, const HandleInsertion& inserted)
{
  std::vector<char> has_handle(static_cast<std::size_t>(parts.count), 0);
  const auto add = [&](Index v)
  {
    const Index original = v < vertex_count ? v : inserted.inserted[v - vertex_count].parents[0];
    has_handle[parts.component_of_vertex[original]] = 1;
  };
  for (const HandlePlacement& placement : inserted.handles)
  {
    std::for_each(placement.vertices.begin(), placement.vertices.end(), add);
  }
  for (const CageVertex& on_cage : inserted.cage)
  {
    add(on_cage.vertex);
  }
  return has_handle;
}

/// A surface after welding equal points, and its connected components.
struct WeldedSurface
{
  Triangles triangles;
  Components components;
  std::vector<Index> component_of_triangle;

  WeldedSurface(TrianglesView unwelded, const std::vector<Index>& representative_of_vertex)
    : triangles(unwelded)
  {
    for (Index i = 0; i < this->triangles.size(); ++i)
    {
      this->triangles.data()[i] = representative_of_vertex[this->triangles.data()[i]];
    }
    this->components = connected_components(
      static_cast<Index>(representative_of_vertex.size()), TrianglesView(this->triangles));
    this->component_of_triangle.resize(static_cast<std::size_t>(this->triangles.rows()));
    for (Index f = 0; f < this->triangles.rows(); ++f)
    {
      this->component_of_triangle[f] = this->components.component_of_vertex[this->triangles(f, 0)];
    }
  }
};
} // namespace

Status link_covered_openings(ExecutionContext& context, PointsView points, TrianglesView triangles,
  const std::vector<Index>& representative_of_vertex, CoveredOpenings& result)
{
  result = {};
  const WeldedSurface welded(triangles, representative_of_vertex);
  if (welded.components.count < 2 || welded.components.count > maximum_components)
  {
    return {};
  }
  const double diagonal = bounding_box(points, triangles).diagonal();
  PartLinkOptions options;
  options.touch_distance = touch_distance * diagonal;
  options.spacing = opening_link_spacing * diagonal;
  return find_covered_openings(
    context, points, welded.triangles, welded.component_of_triangle, options, result);
}

Status find_loose_parts(ExecutionContext& context, PointsView points, TrianglesView triangles,
  const std::vector<Index>& representative_of_vertex, const EmbeddingTets& lattice,
  const EmbeddedSurface& surface, const Handles& handles, const HandleInsertionOptions& insertion,
  LooseParts& result)
{
  result = LooseParts();
  const TetMesh& tets = lattice.mesh;
  if (lattice.components < 2)
  {
    return {};
  }
  HandleInsertion inserted;
  const Status status =
    insert_handles(context, surface.domain(lattice.inside_fractions), handles, insertion, inserted);
  if (!status.ok())
  {
    return status;
  }
  const Components parts = connected_components(tets.points.rows(), tets.tets);
  const std::vector<char> has_handle = parts_with_handles(parts, tets.points.rows(), inserted);
  result.count = static_cast<Index>(std::count(has_handle.begin(), has_handle.end(), 0));
  if (result.count == 0)
  {
    return {};
  }
  // Link surface components instead of parts of the lattice, because components that share a part
  // of this lattice may be in separate parts of a finer lattice.
  const WeldedSurface welded(triangles, representative_of_vertex);
  const Index component_count = welded.components.count;
  std::vector<char> is_attached(static_cast<std::size_t>(component_count), 0);
  for (Index f = 0; f < triangles.rows(); ++f)
  {
    const Index tet = lattice.binding.tets[triangles(f, 0)];
    is_attached[welded.component_of_triangle[f]] =
      tet < 0 || has_handle[parts.component_of_vertex[tets.tets(tet, 0)]] ? 1 : 0;
  }
  const auto loose_count = std::count(is_attached.begin(), is_attached.end(), 0);
  if (loose_count == 0 || loose_count == component_count || loose_count > maximum_components)
  {
    return {};
  }
  PartLinkOptions options;
  options.touch_distance = touch_distance * bounding_box(points, triangles).diagonal();
  options.spacing = lattice.spacing;
  return link_parts(
    context, points, triangles, welded.component_of_triangle, is_attached, options, result.links);
}

} // namespace bindpose
