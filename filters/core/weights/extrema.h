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
  /// How far one must climb from a minimum (descend from a maximum) to reach a lower (higher) one
  /// or an exempt vertex, as a share of the function's range; 1 when neither can be reached.
  double persistence = 0.0;
};

/// The share of the range below which an extremum counts as a ripple.
constexpr double notable_persistence = 1e-3;

/// Extrema that lie on no exempt vertex (the interior ones), most persistent first, then by vertex.
///
/// By merge trees: vertices are added in the order of their values, each joins the parts of its
/// neighbours; where two parts meet, the one with the lesser extremum ends. Exempt vertices (those
/// on handles) outlive all others and are not listed. Cost: O(#E log #V).
///
/// @param values #V, finite.
/// @param exempt #V, 1 for vertices on handles; vertices without neighbours are ignored.
/// @param least_persistence extrema with no more are left out.
std::vector<Extremum> interior_extrema(const VertexGraph& graph, const Eigen::VectorXd& values,
  const std::vector<char>& exempt, double least_persistence = notable_persistence);

} // namespace bindpose

#endif
