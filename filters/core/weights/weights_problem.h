#ifndef bindpose_weights_weights_problem_h
#define bindpose_weights_weights_problem_h

#include "geometry/laplacian.h"
#include "geometry/working_frame.h"
#include "linear/sparse_solver.h"
#include "qp/box_qp.h"
#include "weights/extrema.h"
#include "weights/weight_terms.h"

namespace bindpose
{

/// The way in which rows of bounded weights are made to sum to one.
enum class PartitionOfUnity
{
  normalize, ///< solve each column separately, then divide rows by their sums
  coupled ///< all columns are solved together with this constraint (see solve_coupled_qp)
};

/// Options of all weight methods. Lengths are relative: a mesh in meters or in millimeters gives
/// the same weights.
struct WeightsOptions
{
  /// Tolerance, above 0 and below 1: upper limit of the relative gap and of the natural residual of
  /// a column (see Certificate). 1e-9 is near the limit of double precision.
  double tolerance = 1e-6;
  /// Maximum number of iterations per column, at least 1. BoxQpOptions lists usual numbers.
  int maximum_iterations = 100;
  /// How rows are made to sum to one, for bounded weights only.
  PartitionOfUnity partition = PartitionOfUnity::normalize;
  /// Maximum number of handles with a weight above 0 at a vertex; 0: no limit. At each vertex, the
  /// largest weights are kept. Columns of bounded and monotone weights are then solved again, with
  /// all other weights fixed at 0. Weights of vertices on handles do not change.
  int maximum_influences = 0;
  /// Optional terms of bounded and monotone weights; read by make_weights_problem().
  WeightTerms terms;
  HandleInsertionOptions insertion;
  SparseSolver::Options solver;
  /// Order of the energy of bounded and monotone weights: 2 for biharmonic, 3 for triharmonic.
  /// Triharmonic weights oscillate within the bounds.
  int order = 2;
  double power = 2.0; ///< exponent (> 0) of the distance in inverse-distance weights
  /// Smoothed harmonic weights: smoothing length (>= 0), as a fraction of the diagonal.
  double smoothing = 0.05;
  /// Bone heat weights: heat coefficient (> 0) of the nearest handle. With a larger coefficient,
  /// the transition between handles is sharper.
  double heat = 1.0;
};

/// A mesh with the handles inserted as vertices, and the matrices of its energies. It is the input
/// of all weight methods. The same problem can be solved any number of times.
struct WeightsProblem
{
  /// The frame of the coordinates in `handles` and `mesh`. The frame is the identity unless the
  /// input is extremely large or small or far from the origin.
  WorkingFrame frame;
  Handles handles;
  HandleInsertion mesh;
  HandleConstraints constraints;
  /// Cotangent stiffness and lumped mass of the mesh scaled to diagonal 1; the largest mass is 1.
  SparseMatrix stiffness;
  Eigen::VectorXd mass;
  double diagonal = 1.0; ///< bounding-box diagonal of the mesh before scaling
  double mass_unit = 1.0; ///< largest mass of the scaled mesh
  /// Optional terms, extended to inserted vertices; a mirror plane is replaced by pairs of mirror
  /// vertices.
  WeightTerms terms;
  /// Stiffness weighted by each element's painted rigidity; empty if no rigidity is painted.
  SparseMatrix rigid_stiffness;
  VertexGraph graph;
  /// Fixed vertices: all vertices whose rows are given (roles `handle`, `without_handle`,
  /// `follower`, `unreferenced` of VertexRole). Their rows are in `fixed_values`, #fixed x
  /// #handles.
  std::vector<Index> fixed;
  Eigen::MatrixXd fixed_values;
  Status status; ///< counts and warnings of make_weights_problem()

  Index vertex_count() const { return this->mesh.domain.points.rows(); }
  Index handle_count() const { return static_cast<Index>(this->handles.size()); }
  /// Return the matrix Q of the k-harmonic energy 1/2 w' Q w, including the painted rigidity.
  SparseMatrix energy(int order) const;
};

/// Convert the origin of the mirror plane to the frame.
WeightTerms to_frame(const WorkingFrame& frame, WeightTerms terms);
/// Convert the lengths in the report of make_weights_problem() from the frame.
void convert_lengths(const WorkingFrame& frame, Report& report);

/// Insert the handles, find the constraints, and assemble stiffness and mass. Progress phase
/// "insert".
/// @param region_ids label of every vertex, or empty.
Status make_weights_problem(ExecutionContext& context, const Domain& domain,
  const std::vector<Index>& region_ids, const Handles& handles, const WeightsOptions& options,
  WeightsProblem& problem);

/// Make a problem like make_weights_problem(), but never convert the domain to a working frame.
/// This function is for callers that have already converted the domain.
Status make_weights_problem_in_place(ExecutionContext& context, const Domain& domain,
  const std::vector<Index>& region_ids, const Handles& handles, const WeightsOptions& options,
  WeightsProblem& problem);

/// One column of the weights before normalization, with its certificate.
struct WeightsColumn
{
  Certificate certificate;
  double minimum = 0.0;
  double maximum = 0.0;
  int iterations = 0;
  int factorizations = 0;
  /// Fraction of the vertices where the column before normalization is exactly 0. It is large if
  /// the handle affects a small part of the mesh.
  double zero_fraction = 0.0;
  /// Fraction of the vertices where the column before normalization is exactly 1.
  double one_fraction = 0.0;
  /// Interior extrema of the column before normalization, with persistence above 1e-3.
  std::vector<Extremum> extrema;
  Index normalized_interior_extrema = 0; ///< number of interior extrema after normalization
};

/// The result of every weight method.
struct WeightsResult
{
  /// #V x #handles, rows sum to one (rows of unreferenced vertices are zero).
  Weights weights;
  /// #V x #handles, weights before normalization. The certificates are for these weights.
  Weights raw;
  std::vector<WeightsColumn> columns;
  double row_sum_error = 0.0; ///< max |1 - row sum| of the rows before normalization
  Index analyses = 0; ///< number of symbolic analyses
};

/// Return invalid_input if the problem has optional terms (see WeightTerms), which only bounded and
/// monotone weights support.
Status check_no_terms(const WeightsProblem& problem);

/// Scale rows so that they sum to one. Pinned weights do not change; only the other weights of the
/// row are scaled.
/// @param fallback #V x #handles. It is used for rows whose sum, without pinned weights, is within
/// 1e-3 of zero. The weights of such a row become the positive entries of the row of `fallback`,
/// scaled to the required sum.
/// @param excluded #V * #handles, row by row: 1 for weights that must stay 0; empty: no such
/// weight.
/// @return number of rows for which `fallback` was used
Index normalize_rows(const WeightsProblem& problem, const Eigen::MatrixXd& fallback,
  const std::vector<char>& excluded, Weights& weights);

/// Compute the final weights from solved columns: normalize rows, copy rows to followers, find
/// extrema and fill the report. Return not_converged if a certificate exceeds the tolerance;
/// otherwise the status of the problem.
/// @param fallback, excluded see normalize_rows.
Status finish_weights(ExecutionContext& context, const WeightsProblem& problem,
  const std::string& method, double tolerance, const std::vector<BoxQpSolution>& solutions,
  const Eigen::MatrixXd& fallback, WeightsResult& result, const std::vector<char>& excluded = {});

} // namespace bindpose

#endif
