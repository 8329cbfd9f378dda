#ifndef bindpose_pose_element_stretch_h
#define bindpose_pose_element_stretch_h

#include "base/execution.h"
#include "base/mesh.h"

#include <vector>

namespace bindpose
{

struct ElementStretchOptions
{
  /// An element is badly stretched when some direction in it becomes more than this many times as
  /// long, or less than 1 / limit as long. At least 1; 2 by default.
  double limit = 2.0;
  /// Whether ElementStretch::largest and smallest are filled; else only the report is made.
  bool values = false;
};

/// What a pose does to each element: how many times as long its directions become. 1 at rest; NaN
/// for an element that is degenerate at rest.
struct ElementStretch
{
  std::vector<double> largest;
  std::vector<double> smallest; ///< less than zero where the element is turned inside out
};

/// Singular values of the deformation gradient of each element, from rest to posed.
///
/// A tet whose gradient has a determinant of less than zero is inverted: it was turned inside out,
/// and no motion of a solid does that. Triangles in space have no such sign; those of a flat shape
/// (z = const at rest and posed) are inverted when they look the other way.
///
/// Report: counts.elements, counts.inverted_elements, counts.stretched_elements, largest_stretch,
/// smallest_stretch (the singular values, never less than zero); counts.degenerate_elements, which
/// are without volume or area at rest and left out, where there are some. A warning with the
/// numbers where an element is inverted. invalid_input for a limit out of range and for posed
/// points that are not as many as those at rest; elements must be valid (check_mesh).
///
/// What is asked of the shape at rest is made once, for many poses:
///
///     const RestElements elements(rest, tets);
///     elements.stretch(context, options, posed, stretch);
///
/// Cost with AVX-512: about 50 ns a tet, 10 ns a triangle (one core). Memory: 112 bytes a tet, 56 a
/// triangle. The same bits for any number of threads and on any machine.
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
  void take(PointsView rest, const Elements& elements);

  int corners_ = 3;
  Index points_ = 0;
  Index count_ = 0;
  bool flat_ = false; ///< at rest, in a plane z = const
  // In tiles of 8 elements, side by side.
  std::vector<Index> ids_; ///< corner, lane
  std::vector<double> shape_; ///< number, lane
};

/// The same for a single pose.
Status element_stretch(ExecutionContext& context, const ElementStretchOptions& options,
  PointsView rest, PointsView posed, TetsView tets, ElementStretch& stretch);
Status element_stretch(ExecutionContext& context, const ElementStretchOptions& options,
  PointsView rest, PointsView posed, TrianglesView triangles, ElementStretch& stretch);

} // namespace bindpose

#endif
