#ifndef bindpose_weights_monotone_smoothing_h
#define bindpose_weights_monotone_smoothing_h

#include "weights/box_qp.h"
#include "weights/extrema.h"
#include "weights/extrema_order.h"

namespace bindpose
{

/// The function that determines the order of neighboring vertices in the result.
enum class SmoothingGuide
{
  /// The minimizer without any order, after flooding removes its other extrema: nearest to the
  /// data.
  unconstrained,
  /// The function that is harmonic for positive edge weights, with the maxima and minima as
  /// boundary values.
  harmonic
};

struct MonotoneSmoothingOptions
{
  /// Order k of the energy: 2 biharmonic, 3 triharmonic.
  int order = 2;
  /// Weight lambda >= 0 of the data term, in units of the mesh's size to the power -2 k. Detail
  /// finer than about six times lambda^(-1 / 2 k) of the size is smoothed away. For lambda = 1e6,
  /// lambda^(-1 / 2 k) is 0.03 for k = 2 and 0.1 for k = 3. If lambda is 0, only the values at the
  /// extrema are used, and they are kept.
  double data_weight = 1e6;
  /// The extrema that the result may have, #V; empty: extrema of the data, chosen by the next two
  /// options.
  ExtremaList extrema;
  /// Choose extrema of the data whose persistence is a larger fraction of the data's range, [0, 1).
  double persistence = 0.05;
  /// If above 0, choose this number of the most persistent extrema instead, and at least one
  /// maximum and one minimum per connected part.
  Index extrema_count = 0;
  /// Whether extrema keep the data's values. Otherwise their values are solved for, too.
  bool keep_values = false;
  SmoothingGuide guide = SmoothingGuide::unconstrained;
  /// Largest number of times that the order is taken from the result and the problem is solved
  /// again, >= 0. Ends early if there is no gain. The energy never increases.
  int rebuilds = 1;
  /// Smallest difference of each vertex from its lower and from its higher neighbor, as a fraction
  /// of the data's range, >= 0. If above 0, the order is strict.
  double epsilon = 0.0;
  /// See WeightsOptions.
  double tolerance = 1e-6;
  int maximum_iterations = 100;
  SparseSolver::Options solver;
};

struct MonotoneSmoothingResult
{
  Eigen::VectorXd values; ///< #V, in the data's unit
  /// The listed extrema by vertex, with values and persistence of the result.
  std::vector<Extremum> extrema;
  /// Other extrema of the result with a notable persistence; empty unless the list is empty.
  std::vector<Extremum> spurious;
  ExtremaList list; ///< #V: the extrema that were given or chosen
  /// For data scaled to a range of 1; its energy is half of the last of `energies`, in another
  /// unit.
  Certificate certificate;
  std::vector<double> energies; ///< after the first solve and after each rebuild
  int iterations = 0; ///< total over all solves
  Index analyses = 0; ///< number of symbolic analyses
};

/// Compute the smooth function nearest to data on a mesh whose only extrema are the listed ones
/// (topological simplification). It is the minimizer of
///   integral of |k-harmonic derivative of w|^2 + lambda integral of (w - f)^2
/// on the mesh scaled to size 1, with data f scaled to a range of 1. Every vertex that is not
/// listed is above one of its neighbors and below another. The result does not depend on units,
/// position and orientation of data and mesh, beyond rounding. It has the certificate of this
/// quadratic program. The size is sqrt(12) times the root mean square distance from the centroid:
/// for a box this is the diagonal.
///
/// Every connected part needs a maximum and a minimum, or no extremum at all. A part without
/// extrema becomes constant, the mean of its data. Vertices without a measurable element keep their
/// data. Constant data do not change. Return invalid_input if data are not finite or not one per
/// vertex, if the list names a vertex without a measurable element or lacks a maximum or minimum in
/// a part, or if no such function has the values at the extrema.
///
/// Cost: 15 to 30 factorizations of the energy for the first solve and for each rebuild.
/// Jacobson, Weinkauf, Sorkine 2012, Smooth shape-aware functions with controlled extrema.
Status monotone_smoothing(const Domain& domain, const Eigen::VectorXd& data,
  const MonotoneSmoothingOptions& options, ExecutionContext& context,
  MonotoneSmoothingResult& result);

} // namespace bindpose

#endif
