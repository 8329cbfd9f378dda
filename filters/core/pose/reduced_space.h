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

/// Type of the weights that extend the space of deformations beyond the handles' weights.
enum class ExtraWeights : int
{
  bumps = 0, ///< spline_bumps(): each bends the shape around one point
  eigenmodes = 1 ///< skinning_eigenmodes(): the first ones bend the whole shape smoothly
};

struct ReducedArapOptions
{
  ArapEnergy energy = ArapEnergy::automatic;
  /// Number of rotations to fit per iteration; 0: four per column of weights (handles and extra
  /// weights). If it is at least the number of vertices, every vertex (element) has its own
  /// rotation.
  Index clusters = 0;
  /// Number of extra weights that extend the space of deformations. They vanish at handles.
  Index extra_weights = 0;
  ExtraWeights extra_kind = ExtraWeights::bumps;
  SkinningOptions skinning = {}; ///< how deform() stores weights
  /// Whether to also project the mass (ReducedSpace::mass), for dynamics.
  bool mass = false;
};

/// The data of a mesh that reduced as-rigid-as-possible uses: energy and constraints, projected
/// once on the space of skinning transforms V' = V + M D. The data does not depend on a pose. Its
/// size does not depend on the size of the mesh, except for the weights of deform().
///
/// D has a 4 x 3 block per column j of the weights. The block contributes the displacement
/// w_j ((x - center_j) / size_j, 1) block.
struct ReducedSpace
{
  /// Type of D: 4 #columns x 3.
  using Rows = Coordinates;

  /// See ReducedArap::bind().
  template <typename Elements>
  Status bind(ExecutionContext& context, PointsView points, const Elements& elements,
    WeightsView weights, const Handles& their_handles, const ReducedArapOptions& options);

  /// Convert a column's transform to its displacement block, or back.
  Eigen::Matrix<double, 4, 3> block_of(const Affine& transform, Index column) const;
  Affine affine_of(const Eigen::Ref<const Eigen::Matrix<double, 4, 3>>& block, Index column) const;
  /// Return the transforms of all columns. Those of full handles equal the pose's transforms to the
  /// bit.
  std::vector<Affine> transforms_of(const Rows& d, const Pose& pose) const;

  Handles handles;
  Skinning skinning; ///< with all columns
  RotationGroups groups;
  double diagonal = 0.0;
  double radius = 0.0; ///< root mean square distance of the vertices from their centroid
  double rest_energy = 0.0; ///< 1/2 tr(V^T L V)
  Index columns = 0; ///< handles and extra weights
  std::vector<Vec3> centers; ///< frame of each column: (x - center) / size
  std::vector<double> sizes;
  Eigen::VectorXd basis_scale; ///< 1 / root mean square of a column of M, 0 for an empty one
  Eigen::MatrixXd stiffness; ///< M^T L M
  Eigen::MatrixXd mass; ///< M^T M_L M with lumped M_L, for density 1; only if requested
  Eigen::VectorXd mass_sums; ///< M^T M_L 1
  Eigen::MatrixXd covariance; ///< K M, rows i * clusters + k
  /// Maps D to the displacements of the handles' pivots, then of their tails: 2 #handles x
  /// 4 #columns.
  Eigen::MatrixXd pivot_rows;
  Eigen::MatrixXd cluster_weights; ///< #clusters x #handles, mean |weights|
  /// Matrices of clusters are stored in planes: entry (i, j) of matrix k is at
  /// (3 i + j) * stride + k. The stride is a multiple of 8.
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
