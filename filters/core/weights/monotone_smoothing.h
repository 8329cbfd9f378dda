#ifndef bindpose_weights_monotone_smoothing_h
#define bindpose_weights_monotone_smoothing_h

#include "qp/box_qp.h"
#include "weights/extrema.h"
#include "weights/extrema_order.h"

namespace bindpose
{

/// The guide: a function that determines for each vertex of the result which of its neighbors have
/// a larger value and which have a smaller value.
enum class SmoothingGuide
{
  /// The guide is the minimizer without ordered pairs. The vertices are sorted by the values of the
  /// minimizer; flooding then removes the unlisted extrema from this order. This guide is closer to
  /// the data than the guide `harmonic`.
  unconstrained,
  /// The guide is a harmonic function, computed with positive edge weights. Its boundary values are
  /// given at the listed extrema: the data if keep_values is true or data_weight is 0, else 1 at
  /// maxima and 0 at minima.
  harmonic
};

/// Options of monotone_smoothing().
struct MonotoneSmoothingOptions
{
  /// Order k of the energy: 2 biharmonic, 3 triharmonic.
  int order = 2;
  /// Weight lambda >= 0 of the data term, in units of (mesh size)^(-2 k). Let s be lambda to the
  /// power of -1 / (2 k). Details smaller than about 6 * s times the mesh size are smoothed away.
  /// For lambda = 1e6, s is 0.03 for k = 2 and 0.1 for k = 3. If lambda is 0, only the data's
  /// values at the extrema are used, and the result keeps these values.
  double data_weight = 1e6;
  /// The extrema that the result may have, #V. If empty, they are chosen from the extrema of the
  /// data by the next two options.
  ExtremaList extrema;
  /// Choose all extrema of the data whose persistence is above this fraction of the data's range.
  /// The fraction must be at least 0 and less than 1.
  double persistence = 0.05;
  /// If above 0, choose this number of the most persistent extrema instead. Every connected part
  /// gets at least one maximum and one minimum.
  Index extrema_count = 0;
  /// If true, the result has the data's values at the listed extrema. If false, these values are
  /// solved for, too.
  bool keep_values = false;
  SmoothingGuide guide = SmoothingGuide::unconstrained;
  /// Maximum number (>= 0) of rebuilds. A rebuild takes the order from the last result and solves
  /// again. A rebuild that decreases the energy by less than 0.01 % is the last. The energy never
  /// increases.
  int rebuilds = 1;
  /// Minimum difference between the two values of an ordered pair (see pairs_from_order): a
  /// fraction (0 … 1) of the data's range. If above 0, the two vertices of a pair cannot have equal
  /// values.
  double epsilon = 0.0;
  /// See WeightsOptions.
  double tolerance = 1e-6;
  int maximum_iterations = 100;
  SparseSolver::Options solver;
};

/// Result of monotone_smoothing().
struct MonotoneSmoothingResult
{
  Eigen::VectorXd values; ///< #V: the values of the function, in the unit of the data
  /// The listed extrema, sorted by vertex. Values and persistence are those of the result.
  std::vector<Extremum> extrema;
  /// Unlisted extrema of the result that have a persistence above notable_persistence. Empty for a
  /// correct result, because the ordered pairs exclude unlisted extrema.
  std::vector<Extremum> spurious;
  /// #V: the extrema that were requested by MonotoneSmoothingOptions::extrema or chosen by
  /// persistence.
  ExtremaList list;
  /// Certificate of the quadratic program, for data scaled to a range of 1. certificate.energy is
  /// the last entry of `energies` times mass_unit^(order - 1) / 2, where mass_unit is the largest
  /// mass of the scaled mesh.
  Certificate certificate;
  /// The energy after the first solve and after each accepted rebuild. A rebuild is rejected if it
  /// increases the energy.
  std::vector<double> energies;
  int iterations = 0; ///< number of iterations of all solves together
  Index analyses = 0; ///< number of symbolic analyses
};

/// Compute a smooth function that is near the data and has only the listed extrema (topological
/// simplification). The result w is the solution of a quadratic program: it minimizes
///   integral of |k-harmonic derivative of w|^2 + lambda integral of (w - f)^2
/// on the mesh scaled to size 1, where f is the data scaled to a range of 1. Every vertex that is
/// not listed is above one of its neighbors and below another. Except for rounding errors, the
/// result does not depend on the units of the data or on the units, position and orientation of the
/// mesh. The mesh size is sqrt(12) times the root mean square distance from the centroid: for a box
/// this is the diagonal.
///
/// Every connected part must have at least one maximum and one minimum in the list, or no extremum
/// at all. A part without listed extrema becomes constant, with the mean of its data. Vertices that
/// are in no element of positive measure keep their data. Constant data do not change. Return
/// invalid_input in these cases:
/// - a data value is not finite at a vertex of an element of positive measure, or the number of
///   values is not #V;
/// - the list contains a vertex in no element of positive measure;
/// - a part has listed extrema but no maximum or no minimum;
/// - the values at the listed extrema are kept, but every function with these values has additional
///   extrema.
///
/// Cost: 15 to 30 factorizations of the energy for the first solve and for each rebuild.
/// Jacobson, Weinkauf, Sorkine 2012, Smooth shape-aware functions with controlled extrema.
Status monotone_smoothing(ExecutionContext& context, const Domain& domain,
  const Eigen::VectorXd& data, const MonotoneSmoothingOptions& options,
  MonotoneSmoothingResult& result);

} // namespace bindpose

#endif
