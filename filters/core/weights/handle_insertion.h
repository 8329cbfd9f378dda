#ifndef bindpose_weights_handle_insertion_h
#define bindpose_weights_handle_insertion_h

#include "base/execution.h"
#include "weights/domain.h"
#include "weights/handles.h"

#include <array>
#include <functional>

namespace bindpose
{

struct HandleInsertionOptions
{
  /// A handle's sample takes an existing vertex, edge or face when the barycentric coordinates that
  /// this drops are below it, range (0, 0.25). Smaller: handles lie more exactly where they were
  /// put; larger: rounder elements. No sample moves by more than 3 * snap edge lengths.
  double snap = 0.1;
  /// Leave the mesh as it is and take the corners of the simplex that holds a sample.
  bool keep_mesh = false;
  /// Distance of a bone's samples in local edge lengths, range (0, 1].
  double spacing = 1.0;
  /// The element that holds a place, where elements overlap and the mesh alone cannot tell (the
  /// copies of an embedding); empty: the one that is found first.
  std::function<Index(const Vec3&)> element_of;
};

/// Where one handle ended up.
struct HandlePlacement
{
  std::vector<Index> vertices; ///< ascending; of regions: none
  double outside = 0.0; ///< how far the farthest of its samples lay outside of the mesh
  double snap = 0.0; ///< how far the farthest of its samples moved within the mesh
};

/// A new vertex as a point of an element of the mesh as it came.
struct InsertedVertex
{
  std::array<Index, 4> parents{ -1, -1, -1, -1 }; ///< original vertex ids; the last -1 on surfaces
  std::array<double, 4> barycentric{ 0.0, 0.0, 0.0, 0.0 };
};

/// A vertex on a cage's edge or face, between cage vertices.
struct CageVertex
{
  Index vertex = -1;
  CageElement element{ -1, -1, -1 };
  std::array<double, 3> shares{ 0.0, 0.0, 0.0 }; ///< of the element's corners, sum 1
};

struct HandleInsertion
{
  /// Original vertices first, with their ids; then the inserted ones. Elements that were not split
  /// come first, in their order.
  Domain domain;
  std::vector<HandlePlacement> handles; ///< one a handle
  std::vector<CageVertex> cage; ///< where the cage lies in the mesh
  std::vector<InsertedVertex> inserted;
  std::vector<Index> parent_element; ///< of every element: the original that it is part of
  double largest_snap = 0.0; ///< in local edge lengths
  std::vector<std::string> warnings;
};

/// Labels of vertices and, where all corners around them agree, of inserted ones, else 0.
std::vector<Index> extend_labels(const HandleInsertion& mesh, const std::vector<Index>& labels);

/// Makes handles vertices of the mesh: a weight of one at a point inside a simplex would force all
/// its corners to one.
///
/// Points (and cage vertices) and samples of bones, spaced by the local edge length between the
/// vertices that a bone meets anyway, are located; what lies outside is moved to the nearest
/// element, with a warning that names handles and distances. Each then splits the elements around
/// it: the union of the mesh, its volume or area and all orientations stay. Two different handles
/// never share a vertex unless they share the place, even if that makes small elements.
///
/// Edges and faces of cages are sampled as bones are, but what of them lies outside is left out.
/// Cost: O(#elements log #elements), no more than building a search tree.
Status insert_handles(const Domain& domain, const Handles& handles,
  const HandleInsertionOptions& options, ExecutionContext& context, HandleInsertion& result);

} // namespace bindpose

#endif
