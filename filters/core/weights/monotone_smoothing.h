#ifndef bindpose_weights_monotone_smoothing_h
#define bindpose_weights_monotone_smoothing_h

#include "weights/box_qp.h"
#include "weights/extrema.h"
#include "weights/extrema_order.h"

namespace bindpose
{

/// What says which way a smoothed function rises.
enum class SmoothingGuide
{
  /// The minimiser without any order, its other extrema flooded: nearest to the data.
  unconstrained,
  /// The function that is harmonic for positive weights of the edges, with maxima and minima given.
  harmonic
};

struct MonotoneSmoothingOptions
{
  /// Order k of the energy: 2 biharmonic, 3 triharmonic.
  int order = 2;
  /// lambda >= 0 of the energy, in units of the mesh's size to the power -2 k: detail finer than
  /// about six times lambda^(-1 / 2 k) of the size is smoothed away (that is 0.03 for 1e6 and k =
  /// 2, 0.1 for k = 3). 0: only the values at the extrema count, which are kept then.
  double data_weight = 1e6;
  /// The extrema that the result may have, #V; empty: those of the data, chosen by what follows.
  ExtremaList extrema;
  /// Extrema of the data whose persistence is a larger share of the data's range, [0, 1).
  double persistence = 0.05;
  /// Instead of that: the so many most persistent ones, at least one maximum and one minimum of
  /// each connected part; 0: by persistence.
  Index extrema_count = 0;
  /// Extrema keep the data's values; otherwise their values are found, too.
  bool keep_values = false;
  SmoothingGuide guide = SmoothingGuide::unconstrained;
  /// How often the order is taken anew from the result and solved for again, >= 0; ends early where
  /// that gains nothing. The energy never rises.
  int rebuilds = 1;
  /// By which share of the data's range each vertex is at least above its lower and below its
  /// higher neighbour, >= 0. Above 0 the order is strict.
  double epsilon = 0.0;
  /// As of weights (see WeightsOptions).
  double tolerance = 1e-6;
  int maximum_iterations = 100;
  SparseSolver::Options solver;
};

struct MonotoneSmoothingResult
{
  Eigen::VectorXd values; ///< #V, in the data's unit
  /// The list, by vertex: values and persistence of the result.
  std::vector<Extremum> extrema;
  /// Other extrema of the result with a notable persistence: none, unless the list is empty.
  std::vector<Extremum> spurious;
  ExtremaList list; ///< #V: what was given or chosen
  Certificate certificate; ///< of data scaled to a range of 1; its energy is half of that below
  std::vector<double> energies; ///< after the first solve and after each rebuild
  int iterations = 0; ///< of all solves
  Index analyses = 0; ///< symbolic analyses made
};

/// The smooth function nearest to data on a mesh whose only extrema are those listed (topological
/// simplification): the minimiser of
///   integral of |k-harmonic derivative of w|^2 + lambda integral of (w - f)^2
/// on the mesh scaled to size 1 and data f scaled to a range of 1, with every vertex that is not
/// listed above one of its neighbours and below another. So units, place and turn of data and mesh
/// do not show, beyond rounding. It is proved by the certificate of that quadratic program. (The
/// size is sqrt(12) times the root mean square distance from the centroid: a box's diagonal.)
///
/// Every connected part needs a maximum and a minimum, or none of both: it becomes constant then,
/// the mean of its data. Vertices in no element that has a size keep their data. Constant data stay
/// as they are. invalid_input: data that are not finite or not one a vertex, lists that name other
/// vertices or lack a kind somewhere, values at extrema that no such function can have.
///
/// Cost: 15 to 30 factorisations of the energy for the first solve and each rebuild.
/// Jacobson, Weinkauf, Sorkine 2012, Smooth shape-aware functions with controlled extrema.
Status monotone_smoothing(const Domain& domain, const Eigen::VectorXd& data,
  const MonotoneSmoothingOptions& options, ExecutionContext& context,
  MonotoneSmoothingResult& result);

} // namespace bindpose

#endif
