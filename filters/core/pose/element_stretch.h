#ifndef bindpose_pose_element_stretch_h
#define bindpose_pose_element_stretch_h

#include "base/execution.h"
#include "geometry/mesh.h"

#include <vector>

namespace bindpose
{

/// Options of RestElements::stretch().
struct ElementStretchOptions
{
  /// Limit of the stretch, >= 1. An element counts as stretched if the pose multiplies the length
  /// of some line segment in the element by more than `limit` or by less than 1 / limit.
  double limit = 2.0;
  /// Whether to fill ElementStretch::largest and smallest. If false, only the report is computed.
  bool values = false;
};

/// Largest and smallest stretch of each element. The stretch in a direction is the factor by which
/// a pose multiplies the lengths of line segments with this direction in the element. It is 1 at
/// rest, and NaN for an element that is degenerate at rest.
struct ElementStretch
{
  std::vector<double> largest;
  std::vector<double> smallest; ///< negative if the element is turned inside out
};

/// Computes the singular values of the deformation gradient of each element, from rest to posed.
///
/// A tet whose gradient has a negative determinant is inverted (inside out), which is impossible
/// for a solid. A triangle in space has no such sign and is never inverted. Triangles of a flat
/// shape (z = const at rest and posed) are inverted if their orientation changes.
///
/// The report contains counts.elements, counts.inverted_elements, counts.stretched_elements, and
/// largest_stretch and smallest_stretch (singular values, never negative). Degenerate elements,
/// which have no volume or area at rest, are skipped; their number is counts.degenerate_elements.
/// If an element is inverted, a warning contains the number of inverted elements. Return
/// invalid_input if the limit is out of range, or if the numbers of posed and rest points differ.
/// Elements must be valid (check_mesh).
///
/// The data of the rest shape is computed once, for many poses:
///
///     const RestElements elements(rest, tets);
///     elements.stretch(context, options, posed, stretch);
///
/// Cost with AVX-512: about 50 ns per tet, 10 ns per triangle (one core). Memory: 112 bytes per
/// tet, 56 per triangle. The result has the same bits for any number of threads and on any machine.
class RestElements
{
public:
  RestElements() = default;
  RestElements(PointsView rest, TetsView tets);
  RestElements(PointsView rest, TrianglesView triangles);

  Status stretch(ExecutionContext& context, const ElementStretchOptions& options, PointsView posed,
    ElementStretch& stretch) const;

private:
  template <typename Elements>
  void store_rest_shape(PointsView rest, const Elements& elements);

  int corners_ = 3;
  Index points_ = 0;
  Index count_ = 0;
  bool flat_ = false; ///< whether the rest shape is in a plane z = const
  // Elements are stored in tiles of 8, one element per lane.
  std::vector<Index> ids_; ///< vertex ids, indexed by tile, corner and lane
  /// The numbers that describe each element at rest (10 per tet, 4 per triangle), indexed by tile,
  /// number and lane.
  std::vector<double> shape_;
};

/// Compute the stretch for a single pose.
Status element_stretch(ExecutionContext& context, const ElementStretchOptions& options,
  PointsView rest, PointsView posed, TetsView tets, ElementStretch& stretch);
Status element_stretch(ExecutionContext& context, const ElementStretchOptions& options,
  PointsView rest, PointsView posed, TrianglesView triangles, ElementStretch& stretch);

} // namespace bindpose

#endif
