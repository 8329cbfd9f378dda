#ifndef bindpose_domain_handle_insertion_h
#define bindpose_domain_handle_insertion_h

#include "base/execution.h"
#include "domain/domain.h"
#include "handles/handles.h"

#include <array>
#include <functional>

namespace bindpose
{

/// Options of insert_handles(), which adds vertices to the mesh at the positions of the handles.
struct HandleInsertionOptions
{
  /// Threshold of barycentric coordinates, range (0, 0.25). A sample is a point of a handle. If a
  /// barycentric coordinate of a sample in its element is below `snap`, the coordinate is set to
  /// zero, which moves the sample to a vertex, edge or face of the element. Smaller values keep
  /// handles closer to their specified positions; larger values give better shaped elements. No
  /// sample moves by more than 3 * snap edge lengths.
  double snap = 0.1;
  /// Do not change the mesh; instead, constrain the corners of the element that contains a sample.
  bool keep_mesh = false;
  /// Distance between the samples of a bone, in local edge lengths, range (0, 1].
  double spacing = 1.0;
  /// Callback that returns the element that contains a point. It is required if elements overlap
  /// (the copies of an embedding), because several elements then contain the same point. If empty,
  /// the first element found is used.
  std::function<Index(const Vec3&)> element_of;
};

/// The position of one handle in the mesh.
struct HandlePlacement
{
  std::vector<Index> vertices; ///< the vertices on the handle, ascending; empty for regions
  double outside = 0.0; ///< largest distance of a sample from the mesh; 0 for samples in the mesh
  double snap = 0.0; ///< largest distance that a sample moved within the mesh
};

/// A new vertex as a point in an element of the original mesh.
struct InsertedVertex
{
  /// Vertex ids of the element's corners. The fourth id is -1 if the element is a triangle.
  std::array<Index, 4> parents{ -1, -1, -1, -1 };
  std::array<double, 4> barycentric{ 0.0, 0.0, 0.0, 0.0 };
};

/// A vertex on an edge or face of a cage, between the cage vertices at its corners.
struct CageVertex
{
  Index vertex = -1;
  CageElement element{ -1, -1, -1 };
  /// Barycentric coordinates of the vertex in the edge or face of the cage.
  std::array<double, 3> barycentric{ 0.0, 0.0, 0.0 };
};

/// The mesh with handles as vertices.
struct HandleInsertion
{
  /// The original vertices come first and keep their ids. The inserted vertices follow. Elements
  /// that were not split come first, in the order of the original mesh.
  Domain domain;
  std::vector<HandlePlacement> handles; ///< placements of all handles
  std::vector<CageVertex> cage; ///< mesh vertices on edges and faces of the cage
  std::vector<InsertedVertex> inserted;
  std::vector<Index> parent_element; ///< #elements: the original element that contains each element
  /// Largest distance that a sample moved within the mesh, in local edge lengths.
  double largest_snap = 0.0;
  std::vector<std::string> warnings;
};

/// Extend labels to inserted vertices. Only the corners of the original element with a positive
/// barycentric coordinate count: the inserted vertex gets their label if they all have the same
/// label, else 0.
std::vector<Index> extend_labels(const HandleInsertion& mesh, const std::vector<Index>& labels);

/// Add vertices to the mesh at the positions of the handles. Without such a vertex, a weight of one
/// at a point inside an element would require a weight of one at all corners of the element.
///
/// Samples are point handles, cage vertices, and points along bones. Mesh vertices that are already
/// on a bone divide it into sections. Each section gets samples that are about `spacing` times the
/// local edge length apart. A sample outside of the mesh is moved to the nearest element, with a
/// warning that names handles and distances. Each sample then splits the elements that contain it.
/// The union of the mesh, its volume or area and all orientations do not change. Two different
/// handles get a common vertex only where they coincide. Elsewhere they get separate vertices, even
/// if this makes small elements.
///
/// Edges and faces of cages are sampled like bones, but samples outside of the mesh are ignored.
/// Cost: O(#elements log #elements), the cost of building a search tree.
Status insert_handles(ExecutionContext& context, const Domain& domain, const Handles& handles,
  const HandleInsertionOptions& options, HandleInsertion& result);

} // namespace bindpose

#endif
