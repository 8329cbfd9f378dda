#ifndef bindpose_weights_weights_problem_h
#define bindpose_weights_weights_problem_h

#include "base/laplacian.h"
#include "base/sparse_solver.h"
#include "weights/box_qp.h"
#include "weights/extrema.h"
#include "weights/weight_terms.h"

namespace bindpose
{

/// How rows of bounded weights come to sum to one.
enum class PartitionOfUnity
{
  normalise, ///< each column is solved for alone, rows are divided by their sums
  coupled ///< all columns are solved for together, with that as a constraint (see CoupledQp)
};

/// What all weights take. Lengths have no unit: a mesh in metres or millimetres gives the same.
struct WeightsOptions
{
  /// Largest relative gap and natural residual of a column (see Certificate), range (0, 1).
  /// 1e-6 by default, 1e-9 is tight.
  double tolerance = 1e-6;
  /// Iterations a column, > 0: see BoxQpOptions.
  int maximum_iterations = 100;
  /// Bounded weights alone.
  PartitionOfUnity partition = PartitionOfUnity::normalise;
  /// Handles with a weight above 0 at a vertex, at most; 0: any number. The handles of the largest
  /// weights are kept, then all columns are solved for again within what is left to them, of
  /// bounded and monotone weights. Vertices on handles stay as they are.
  int maximum_influences = 0;
  WeightTerms terms; ///< of bounded and monotone weights; read when the problem is made
  HandleInsertionOptions insertion;
  SparseSolver::Options solver;
};

/// A mesh with its handles as vertices and what the energies are made of: the common start of all
/// methods. Built once, it serves any number of them.
struct WeightsProblem
{
  Handles handles;
  HandleInsertion mesh;
  HandleConstraints constraints;
  /// Cotangent stiffness and lumped mass of the mesh scaled to diagonal 1; the largest mass is 1.
  SparseMatrix stiffness;
  Eigen::VectorXd mass;
  double diagonal = 1.0; ///< of the mesh, what was scaled to 1
  double mass_unit = 1.0; ///< the largest mass of the scaled mesh
  WeightTerms terms; ///< with values for inserted vertices and, of a plane, with its mirror
  /// Stiffness with each element's painted rigidity as a factor; empty without any.
  SparseMatrix rigid_stiffness;
  VertexGraph graph;
  /// All vertices whose rows are known beforehand (handles, tethered, followers, unreferenced) and
  /// those rows, #fixed x #handles.
  std::vector<Index> fixed;
  Eigen::MatrixXd fixed_values;
  Status status; ///< counts and warnings so far

  Index vertex_count() const { return this->mesh.domain.points.rows(); }
  Index handle_count() const { return static_cast<Index>(this->handles.size()); }
  /// The form Q of the k-harmonic energy 1/2 w' Q w, with the painted rigidity.
  SparseMatrix energy(int order) const;
};

/// Inserts the handles, finds constraints, assembles stiffness and mass. Phase "insert".
/// @param region_ids label of every vertex, or empty.
Status make_weights_problem(const Domain& domain, const std::vector<Index>& region_ids,
  const Handles& handles, const WeightsOptions& options, ExecutionContext& context,
  WeightsProblem& problem);

/// One column of the weights before normalisation, proved.
struct WeightsColumn
{
  Certificate certificate;
  double minimum = 0.0;
  double maximum = 0.0;
  int iterations = 0;
  int factorisations = 0;
  double zeros = 0.0; ///< share of the vertices where the raw column is exactly 0: its locality
  double ones = 0.0; ///< where it is exactly 1
  std::vector<Extremum> extrema; ///< interior ones of the raw column, persistence above 1e-3
  Index normalised_interior_extrema = 0; ///< of the column that is handed on
};

struct WeightsResult
{
  /// #V x #handles, rows sum to one (rows of unreferenced vertices are zero).
  Weights weights;
  /// As solved for; what the certificates are about.
  Weights raw;
  std::vector<WeightsColumn> columns;
  double row_sum_error = 0.0; ///< max |1 - row sum| of the raw rows
  Index analyses = 0; ///< symbolic analyses made
};

/// Divides rows by their sums. Pinned weights stay; the others of the row are what is scaled.
/// @param fallback rows used where there is less than 1e-3 to scale (#V x #handles).
/// @param excluded #V * #handles, row by row: weights that must stay 0; empty: none.
/// @return how often the fallback was used.
Index normalise_rows(const WeightsProblem& problem, const Eigen::MatrixXd& fallback,
  const std::vector<char>& excluded, Weights& weights);

/// Turns solved columns into weights: rows of followers, normalisation, extrema, report. The status
/// is the problem's, not_converged when a column is not certified.
/// @param fallback, excluded see normalise_rows.
Status finish_weights(const WeightsProblem& problem, const std::string& method, double tolerance,
  const std::vector<BoxQpSolution>& solutions, const Eigen::MatrixXd& fallback,
  ExecutionContext& context, WeightsResult& result, const std::vector<char>& excluded = {});

} // namespace bindpose

#endif
