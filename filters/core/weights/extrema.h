#ifndef bindpose_weights_extrema_h
#define bindpose_weights_extrema_h

#include "domain/domain.h"

namespace bindpose
{

/// A local extremum of a function on a mesh's vertices.
struct Extremum
{
  Index vertex = 0;
  bool maximum = false;
  double value = 0.0;
  /// The climb that a path from this minimum needs to reach a lower minimum or an exempt vertex
  /// (for a maximum: the descent to a higher maximum or an exempt vertex), as a fraction of the
  /// function's range; 1 if neither can be reached.
  double persistence = 0.0;
};

/// An extremum whose persistence is below this fraction of the range counts as a ripple.
constexpr double notable_persistence = 1e-3;

/// Find the local extrema at vertices that are not exempt. They are returned in the order of
/// descending persistence, then by vertex.
///
/// The method builds merge trees. Vertices are added in the order of their values. The vertices
/// that have been added form connected parts; each added vertex joins the parts that contain its
/// neighbors. Where two parts merge, the less extreme of their two extrema ends, which determines
/// its persistence. Exempt vertices (vertices on handles) never end and are not listed.
/// Cost: O(#E log #V).
///
/// @param values #V, finite.
/// @param exempt #V, 1 for vertices on handles; vertices without neighbors are ignored.
/// @param least_persistence only extrema with a larger persistence are returned, as a fraction of
/// the range.
std::vector<Extremum> interior_extrema(const VertexGraph& graph, const Eigen::VectorXd& values,
  const std::vector<char>& exempt, double least_persistence = notable_persistence);

} // namespace bindpose

#endif
