#ifndef bindpose_pose_reduced_space_h
#define bindpose_pose_reduced_space_h

#include "base/execution.h"
#include "base/thin_product.h"
#include "pose/arap_energy.h"
#include "pose/pose.h"
#include "pose/skinning.h"
#include "weights/handles.h"

namespace bindpose
{

/// What widens the space of deformations beyond the handles' weights.
enum class ExtraWeights : int
{
  bumps = 0, ///< spline_bumps(): each bends the shape around one place
  eigenmodes = 1 ///< skinning_eigenmodes(): the first ones bend all of it, smoothly
};

struct ReducedArapOptions
{
  ArapEnergy energy = ArapEnergy::automatic;
  /// Rotations to fit in an iteration; 0: four a handle. As many as there are vertices or more:
  /// every vertex (element) has its own.
  Index clusters = 0;
  /// Extra weights that widen the space of deformations; they vanish at handles.
  Index extra_weights = 0;
  ExtraWeights extra_kind = ExtraWeights::bumps;
  SkinningOptions skinning = {}; ///< how deform() keeps weights
  /// Also projects the mass (ReducedSpace::mass): for dynamics.
  bool mass = false;
};

/// What reduced as-rigid-as-possible needs of a mesh: energy and constraints projected on the space
/// of skinning transforms V' = V + M D, once. Nothing in it depends on a pose, and its size not on
/// the mesh's (but for the weights that deform()).
///
/// D has four rows a column of the weights: a displacement of w_j ((x - center_j) / size_j, 1).
struct ReducedSpace
{
  /// What D is: 4 #columns x 3.
  using Rows = Coordinates;

  /// See ReducedArap::bind().
  template <typename Elements>
  Status bind(ExecutionContext& context, PointsView points, const Elements& elements,
    WeightsView weights, const Handles& their_handles, const ReducedArapOptions& options);

  /// Displacement block of a column's transform, and back.
  Eigen::Matrix<double, 4, 3> block_of(const Affine& transform, Index column) const;
  Affine affine_of(const Eigen::Ref<const Eigen::Matrix<double, 4, 3>>& block, Index column) const;
  /// The transforms of all columns; those of full handles are the pose's own to the bit.
  std::vector<Affine> transforms_of(const Rows& d, const Pose& pose) const;

  Handles handles;
  Skinning skinning; ///< by all columns
  RotationGroups groups;
  double diagonal = 0.0;
  double radius = 0.0; ///< root mean square distance of the vertices from their middle
  double rest_energy = 0.0; ///< 1/2 tr(V^T L V)
  Index columns = 0; ///< handles and extra weights
  std::vector<Vec3> centers; ///< a column's frame: (x - center) / size
  std::vector<double> sizes;
  Eigen::VectorXd basis_scale; ///< 1 / root mean square of a column of M, 0 for an empty one
  Eigen::MatrixXd stiffness; ///< M^T L M
  Eigen::MatrixXd mass; ///< M^T M_L M, M_L lumped, of density 1; only when asked for
  Eigen::VectorXd mass_sums; ///< M^T M_L 1
  Eigen::MatrixXd covariance; ///< K M, rows i * clusters + k
  /// Displacements of the handles' pivots, then of their tails: 2 #handles x 4 columns.
  Eigen::MatrixXd pivot_rows;
  Eigen::MatrixXd cluster_weights; ///< #clusters x #handles, mean |weights|
  /// Matrices of clusters lie in planes: (3 i + j) * stride + k holds entry (i, j) of matrix k, and
  /// the stride is in whole tiles of 8.
  Index stride = 0;
  std::vector<double> rest_covariance; ///< K V in planes

private:
  void basis_row(const double* weights, const Vec3& point, double* row) const;
  template <typename Elements>
  void find_pivots(PointsView points, const Elements& elements, WeightsView weights);
  bool project_stiffness(ExecutionContext& context, PointsView points,
    const SparseMatrix& stiffness_matrix, WeightsView weights);
  void project_mass(PointsView points, const Eigen::VectorXd& masses, WeightsView weights);
  void project_covariance(PointsView points, const SparseMatrix& covariance_matrix,
    WeightsView weights, Index handle_count);
};

} // namespace bindpose

#endif
