#ifndef bindpose_arap_reduced_space_h
#define bindpose_arap_reduced_space_h

// Bind-time data of reduced as-rigid-as-possible (Jacobson et al. 2012).

#include "arap/arap_energy.h"
#include "base/execution.h"
#include "handles/handles.h"
#include "linear/thin_product.h"
#include "pose/pose.h"
#include "skinning/skinning.h"

namespace bindpose
{

/// Type of the extra weights, which are weights in addition to those of the handles. They extend
/// the space of deformations.
enum class ExtraWeights : int
{
  bumps = 0, ///< spline_bumps(): each extra weight deforms the shape around one point
  eigenmodes = 1 ///< skinning_eigenmodes(): the first extra weights deform the whole shape smoothly
};

struct ReducedArapOptions
{
  ArapEnergy energy = ArapEnergy::automatic;
  /// Number of clusters, which is the number of rotations to fit per iteration; 0: four per column
  /// of weights (handles and extra weights). If it is at least the number of vertices, each vertex
  /// (or element) has a separate rotation.
  Index clusters = 0;
  /// Number of extra weights that extend the space of deformations. They are zero at handles.
  Index extra_weights = 0;
  ExtraWeights extra_kind = ExtraWeights::bumps;
  SkinningOptions skinning = {}; ///< storage of the weights for deform()
  /// Whether to also project the mass (ReducedSpace::mass), for dynamics.
  bool mass = false;
};

/// Bind-time data of reduced as-rigid-as-possible: energy and constraints, projected once on the
/// space of skinning transforms V' = V + M D. The data does not depend on a pose. Its size does not
/// depend on the size of the mesh, except for the weights of deform().
///
/// D has one 4 x 3 block D_j for each column j of the weights. For a vertex at x with the weight
/// w_j, this block contributes the displacement w_j ((x - center_j) / size_j, 1) D_j.
struct ReducedSpace
{
  /// Type of D: 4 #columns x 3.
  using Rows = Coordinates;

  /// Compute the data. Arguments and errors are those of ReducedArap::bind().
  template <typename Elements>
  Status bind(ExecutionContext& context, PointsView points, const Elements& elements,
    WeightsView weights, const Handles& input_handles, const ReducedArapOptions& options);

  /// Convert a column's transform to its block of D. The next function converts a block of D to a
  /// transform. Both functions use the coordinates of `frame`.
  Eigen::Matrix<double, 4, 3> block_of(const Affine& transform, Index column) const;
  Affine affine_of(const Eigen::Ref<const Eigen::Matrix<double, 4, 3>>& block, Index column) const;
  /// Return the transforms of all columns. The transforms of handles in mode full are bit-identical
  /// to those of the pose.
  std::vector<Affine> transforms_of(const Rows& d, const Pose& pose) const;

  /// All other data is in the coordinates of this frame. The transforms that the user gives in a
  /// pose, and the result of transforms_of(), are in the original coordinates.
  WorkingFrame frame;
  Handles handles;
  Skinning skinning; ///< skinning weights with all columns
  RotationGroups groups;
  double diagonal = 0.0;
  double radius = 0.0; ///< root mean square distance of the vertices from their centroid
  double rest_energy = 0.0; ///< 1/2 tr(V^T L V)
  Index columns = 0; ///< number of handles and extra weights
  std::vector<Vec3> centers; ///< coordinates in the frame of a column are (x - center) / size
  std::vector<double> sizes;
  Eigen::VectorXd basis_scale; ///< 1 / (root mean square of a column of M); 0 for an empty column
  Eigen::MatrixXd stiffness; ///< M^T L M
  /// M^T M_L M with the lumped mass matrix M_L for density 1; only if requested.
  Eigen::MatrixXd mass;
  Eigen::VectorXd mass_sums; ///< sum of the rows of M, weighted by the masses: M^T M_L 1
  Eigen::MatrixXd covariance; ///< K M, rows i * clusters + k
  /// Matrix that maps D to the displacements of the handles' pivots, then of their tails: 2
  /// #handles x 4 #columns.
  Eigen::MatrixXd pivot_rows;
  /// #clusters x #handles: mean absolute weight of each handle in each cluster.
  Eigen::MatrixXd cluster_weights;
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
