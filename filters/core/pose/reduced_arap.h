#ifndef bindpose_pose_reduced_arap_h
#define bindpose_pose_reduced_arap_h

#include "base/execution.h"
#include "pose/arap_energy.h"
#include "pose/pose.h"
#include "pose/skinning.h"
#include "weights/handles.h"

namespace bindpose
{

struct ReducedArapOptions
{
  ArapEnergy energy = ArapEnergy::automatic;
  /// Rotations to fit in an iteration; 0: four a handle. As many as there are vertices or more:
  /// every vertex (element) has its own.
  Index clusters = 0;
  /// Extra weights (spline_bumps) that widen the space of deformations; they vanish at handles.
  Index extra_weights = 0;
};

/// As-rigid-as-possible deformation in the space of skinning transforms: the transforms that the
/// user left open are those that bend the mesh least. Jacobson et al. 2012, Fast automatic skinning
/// transformations.
///
///     ReducedArap arap;
///     arap.bind(context, points, tets, weights, handles, options);  // seconds, once
///     arap.solve(context, pose);                                    // microseconds an iteration
///     arap.deform(context, points, posed);                          // as linear blend skinning
///
/// The energy is 1/2 sum_k sum c |e' - R_k e|^2 over edges e, with rotations R_k shared by clusters
/// of vertices that have similar weights. A solve alternates between the best rotations (local
/// step) and the best transforms (global step: one product with a dense matrix that is made once
/// for each choice of modes); neither step can raise the energy. A handle in mode `full` has its
/// transform, in mode `position` its pivot goes where the transform takes it, in mode `free`
/// nothing is asked of it. With every handle full the result is linear blend skinning.
///
/// Unknowns are displacements from rest, so that rest is exact however ill-conditioned, doubled or
/// empty weight columns are; directions that neither energy nor constraints see stay at rest.
/// A pivot on a vertex or inside an element is constrained as that point of the mesh; one that is
/// not, and a region's, by its own handle's transform.
///
/// Cost: bind O(#V (4 m)^2), m = handles and extra weights; after a change of modes O((4 m)^3); an
/// iteration 72 m r multiply-adds for r clusters, whatever the mesh. The same bits for any number
/// of threads.
class ReducedArap
{
public:
  /// Lengths are measured against the diagonal of the used points. Report: counts.vertices,
  /// counts.triangles or counts.tets, counts.handles, counts.clusters, counts.extra_weights, method
  /// (the energy), row_sum_error. Warnings: rows that do not sum to one, handles without weight.
  /// invalid_input for sizes that do not fit or numbers that are not finite.
  Status bind(ExecutionContext& context, PointsView points, TrianglesView triangles,
    WeightsView weights, const Handles& handles, const ReducedArapOptions& options = {});
  Status bind(ExecutionContext& context, PointsView points, TetsView tets, WeightsView weights,
    const Handles& handles, const ReducedArapOptions& options = {});

  /// The rotations that a solve begins with.
  enum class Start
  {
    last, ///< those of the last solve (a guess in the first): few iterations, twists add up
    guess, ///< near full handles theirs, elsewhere one that fits all pivots: depends on the pose
           ///< only
    rest ///< none
  };
  struct SolveOptions
  {
    /// Ends when an iteration lowers the energy by no more than this share of it (or of 1e-6 of
    /// the rest energy, a strain of a few 1e-6). 0: runs all iterations, cannot fail to converge.
    double tolerance = 1e-6;
    Index max_iterations = 100;
    Start start = Start::last;
  };

  /// Finds the transforms of a pose, one entry a handle. not_converged when max_iterations were
  /// not enough; the result is usable. Report: energy, iterations, microseconds_per_iteration,
  /// constraint_residual (largest miss of a position, in diagonals). Warnings name position
  /// handles that are redundant and those that contradict each other (met in the least-squares
  /// sense).
  Status solve(ExecutionContext& context, const Pose& pose, const SolveOptions& options);
  Status solve(ExecutionContext& context, const Pose& pose)
  {
    return this->solve(context, pose, SolveOptions());
  }

  /// The next solve starts from a guess.
  void forget() { this->warm_ = false; }

  /// The vertices in the last solved pose: V' = V + M D.
  Status deform(ExecutionContext& context, PointsView rest, Points& posed) const;
  Status deform_normals(
    ExecutionContext& context, PointsView rest_normals, Points& posed_normals) const;

  /// Transforms of the last solve: the handles', then those of the extra weights (whose rest is
  /// the identity, too).
  const std::vector<Affine>& transforms() const { return this->transforms_; }
  /// Rotations of the last solve, one a cluster.
  std::vector<Eigen::Matrix3d> rotations() const;
  const RotationGroups& groups() const { return this->groups_; }
  /// Energy after each half-step of the last solve: start, local, global, local, global, …
  const std::vector<double>& energies() const { return this->energies_; }
  /// 1/2 tr(V^T L V): the unit of round-off in an energy.
  double rest_energy() const { return this->rest_energy_; }

private:
  /// Rows of a matrix in planes that the iteration can stream through, padded to whole tiles.
  struct Tall
  {
    Index rows = 0, cols = 0, stride = 0; ///< column c starts at c * stride
    std::vector<double> values;
    void assign(const Eigen::MatrixXd& matrix);
    /// y_j += A x_j for three columns j.
    void multiply_add(const double* const (&x)[3], double* const (&y)[3]) const;
  };

  template <typename Elements>
  Status bind_any(ExecutionContext& context, PointsView points, const Elements& elements,
    WeightsView weights, const Handles& handles, const ReducedArapOptions& options);
  void basis_row(const double* weights, const Vec3& point, double* row) const;
  template <typename Elements>
  void find_pivots(PointsView points, const Elements& elements, WeightsView weights);
  bool project_stiffness(ExecutionContext& context, PointsView points,
    const SparseMatrix& stiffness, WeightsView weights);
  void project_covariance(
    PointsView points, const SparseMatrix& covariance, WeightsView weights, Index handle_count);
  void factor(const Pose& pose);
  void start_rotations(const Pose& pose);
  Eigen::Matrix<double, 4, 3> block_of(const Affine& transform, Index column) const;
  Affine affine_of(const Eigen::Ref<const Eigen::Matrix<double, 4, 3>>& block, Index column) const;
  void covariances(const std::vector<double>& d, std::vector<double>& s) const;
  double paired(const std::vector<double>& q, const std::vector<double>& s) const;

  // ---- bind time
  Handles handles_;
  Skinning skinning_;
  RotationGroups groups_;
  double diagonal_ = 0.0;
  double radius_ = 0.0; ///< root mean square distance of the vertices from their middle
  double rest_energy_ = 0.0;
  Index columns_ = 0; ///< handles and extra weights
  std::vector<Vec3> centers_; ///< a column's frame: (x - center) / size
  std::vector<double> sizes_;
  Eigen::VectorXd basis_scale_; ///< 1 / root mean square of a column of M, 0 for an empty one
  Eigen::MatrixXd stiffness_; ///< M^T L M
  Eigen::MatrixXd covariance_; ///< K M, rows i * clusters + k
  Eigen::MatrixXd pivot_rows_; ///< #handles x 4 columns_: displacement of the pivots
  Eigen::MatrixXd cluster_weights_; ///< #clusters x #handles, mean |weights|
  std::vector<double> rest_covariance_; ///< K V in planes

  // ---- per choice of modes
  std::vector<HandleMode> modes_;
  std::vector<Index> open_; ///< open unknowns: rows of D
  std::vector<Index> positions_; ///< handles in mode position
  std::vector<Index> redundant_;
  Eigen::MatrixXd particular_; ///< open x positions: least change that meets the positions
  Eigen::MatrixXd response_; ///< open x open: Z (Z^T L Z)^+ Z^T
  std::array<Tall, 3> covariance_open_; ///< K M of the open unknowns, row i of S
  std::array<Tall, 3> gamma_; ///< response (K M)^T, for row i of the rotations

  // ---- state; planes (3 i + j) * stride_ + k hold entry (i, j) of matrix k
  Index stride_ = 0;
  std::vector<double> rotations_;
  bool warm_ = false;
  std::vector<Affine> transforms_;
  std::vector<double> energies_;
};

} // namespace bindpose

#endif
