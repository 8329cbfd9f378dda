#ifndef bindpose_weights_extrema_h
#define bindpose_weights_extrema_h

#include "weights/domain.h"

namespace bindpose
{

/// A local extremum of a function on a mesh's vertices.
struct Extremum
{
  Index vertex = 0;
  bool maximum = false;
  double value = 0.0;
  /// Required climb from a minimum (descent from a maximum) to reach a lower (higher) extremum or
  /// an exempt vertex, as a fraction of the function's range; 1 if neither can be reached.
  double persistence = 0.0;
};

/// Fraction of the range below which an extremum counts as a ripple.
constexpr double notable_persistence = 1e-3;

/// Find the extrema at vertices that are not exempt (the interior extrema), most persistent first,
/// then by vertex.
///
/// The method builds merge trees. Vertices are added in the order of their values, and each joins
/// the parts of its neighbors. Where two parts meet, the one with the less extreme extremum ends.
/// Exempt vertices (those on handles) outlive all others and are not listed.
/// Cost: O(#E log #V).
///
/// @param values #V, finite.
/// @param exempt #V, 1 for vertices on handles; vertices without neighbors are ignored.
/// @param least_persistence only extrema with a larger persistence are returned.
std::vector<Extremum> interior_extrema(const VertexGraph& graph, const Eigen::VectorXd& values,
  const std::vector<char>& exempt, double least_persistence = notable_persistence);

} // namespace bindpose

#endif
