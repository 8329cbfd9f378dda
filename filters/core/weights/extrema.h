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
  /// Persistence of a minimum: the smallest climb of a path from the minimum to a lower minimum or
  /// to an exempt vertex (see interior_extrema), as a fraction of the function's range. The climb
  /// of a path is its highest value minus its first value. If there is no such path, the
  /// persistence is 1. For a maximum, the function is negated.
  double persistence = 0.0;
};

/// By default, extrema with at most this persistence are ignored.
constexpr double notable_persistence = 1e-3;

/// Find the local extrema at vertices that are not exempt. The extrema are sorted by descending
/// persistence. Extrema with equal persistence are sorted by vertex.
///
/// The method builds merge trees. Vertices are added in the order of their values. The vertices
/// that have been added form connected parts; each added vertex joins the parts that contain its
/// neighbors. When two parts merge, the less extreme of their two extrema ends: its persistence is
/// the difference between its value and the value of the added vertex. Extrema at exempt vertices
/// (vertices on handles) are not returned. If one of the two extrema is at an exempt vertex, the
/// other extremum ends.
/// Cost: O(#E log #V).
///
/// @param values #V, finite.
/// @param is_exempt #V, 1 for vertices on handles. Vertices without neighbors are ignored.
/// @param minimum_persistence only extrema whose persistence is above this fraction of the range
/// are returned.
std::vector<Extremum> interior_extrema(const VertexGraph& graph, const Eigen::VectorXd& values,
  const std::vector<char>& is_exempt, double minimum_persistence = notable_persistence);

} // namespace bindpose

#endif
