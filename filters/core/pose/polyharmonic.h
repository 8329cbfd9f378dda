#ifndef bindpose_pose_polyharmonic_h
#define bindpose_pose_polyharmonic_h

#include "base/execution.h"
#include "pose/constrained_stiffness.h"

namespace bindpose
{

/// What holds of a solution at the edge of its patch, besides its values. The integers are those of
/// vtkVariationalSurface.
enum class PatchBoundary : int
{
  /// The mesh goes on: values are given in a band of `order` one-ring layers, and the solution
  /// continues them smoothly (C0, C1, C2 for order 1, 2, 3). Where the mesh ends before, slopes
  /// across its border are zero.
  region = 0,
  /// Values alone; the Laplacian (of order 3 its Laplacian as well) is zero: simply supported.
  curve = 1,
  /// Values and derivatives across the edge, outwards.
  tangent = 2
};

/// "region", "curve", "tangent"
const char* to_string(PatchBoundary boundary);

/// Solves (-Laplacian)^k u = load, k = 1, 2, 3, on the free vertices of a triangle mesh, by mixed
/// finite elements. Jacobson, Tosun, Sorkine, Zorin 2010, Mixed finite elements for variational
/// surface modeling.
///
/// Factored once for a choice of given vertices, solved for any values. #V x m values are solved
/// side by side.
class Polyharmonic
{
public:
  using Rows = ConstrainedStiffness::Rows;

  /// @param parameters places of the vertices in the parameter domain.
  /// @param order 1, 2 or 3.
  void bind(PointsView parameters, TrianglesView triangles, int order, PatchBoundary boundary);

  /// @param given vertices, ascending; held: points of the mesh whose values are given as well.
  /// invalid_input, naming the first offender: a triangle at a free vertex (of the region, also one
  /// that the band needs) without area, an edge there of three triangles or more. unavailable: the
  /// system has no factor in double precision. Report: counts.free, condition (of the matrix with
  /// ones on its diagonal, estimated from below).
  Status prepare(ExecutionContext& context, const Components& parts,
    const std::vector<Index>& given, const std::vector<MeshPoint>& held);

  /// @param flux integrals of phi_i du/dn along the edge of the patch, from below; empty: zero.
  /// @param load #V x m; empty: zero.
  /// @return the last correction of the refinement, as a share of the largest |x|.
  double solve(
    const Rows& given, const Rows& held, const Rows& flux, const Rows& load, Rows& x) const;

  /// Flux of derivatives du/dn (#V x m) given at the vertices of the patch's edge.
  Rows flux_of_derivatives(const Rows& derivatives) const;
  /// Flux of values on the triangles across the edge, outside of the patch; where there are none,
  /// zero.
  Rows flux_of_surroundings(const Rows& values) const;
  /// Flux of values on the patch's own triangles at its edge.
  Rows flux_of_patch(const Rows& values) const;

  /// One-ring layers between free vertices and where the mesh ends, at most `order`.
  int layers() const { return this->layers_; }
  /// Which of the held points others determine.
  const std::vector<Index>& redundant() const { return this->system_.redundant(); }

private:
  void estimate_condition(Report& report) const;

  Points parameters_;
  Triangles triangles_;
  int order_ = 2;
  PatchBoundary boundary_ = PatchBoundary::region;

  Index given_count_ = 0, held_count_ = 0;
  std::vector<char> is_free_;
  int layers_ = 0;
  SparseMatrix stiffness_; ///< K of the triangles that count
  Eigen::VectorXd mass_; ///< M of these, mean 1
  Eigen::VectorXd inverse_mass_; ///< 0 where the Laplacian is zero
  double unit_ = 1.0; ///< of mass
  SparseMatrix matrix_; ///< K (M^-1 K)^(k-1)
  SparseMatrix edge_mass_, outside_flux_, inside_flux_;
  ConstrainedStiffness system_;
};

} // namespace bindpose

#endif
