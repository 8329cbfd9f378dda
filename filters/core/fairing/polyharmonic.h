#ifndef bindpose_fairing_polyharmonic_h
#define bindpose_fairing_polyharmonic_h

// Laplace, biharmonic and triharmonic equations on a triangle mesh, by mixed finite elements
// (Jacobson, Tosun, Sorkine, Zorin 2010).

#include "arap/constrained_stiffness.h"
#include "base/execution.h"

namespace bindpose
{

/// Conditions on the solution at the edge of its patch, in addition to the prescribed values. The
/// integers are those of vtkVariationalSurface.
enum class PatchBoundary : int
{
  /// The mesh continues beyond the edge. Values are given in a band of `order` one-ring layers, and
  /// the solution continues them smoothly (C0, C1, C2 for order 1, 2, 3). If the mesh ends within
  /// the band, derivatives perpendicular to the border are zero.
  region = 0,
  /// Only values are given. The Laplacian is zero at the edge (for order 3 also the Laplacian of
  /// the Laplacian). This condition is called simply supported.
  curve = 1,
  /// Values and outward derivatives perpendicular to the edge are given.
  tangent = 2
};

/// Return "region", "curve" or "tangent".
const char* to_string(PatchBoundary boundary);

/// Solves (-Laplacian)^k u = load for k = 1, 2 or 3 at the free vertices of a triangle mesh. u is
/// prescribed at the other vertices ("given vertices"), and optionally at other points of the mesh
/// ("constrained points"). Method: Jacobson, Tosun, Sorkine, Zorin 2010, Mixed finite elements for
/// variational surface modeling.
///
/// The matrix is factored once for a choice of given vertices. Then the system can be solved for
/// any values, #V x m.
class Polyharmonic
{
public:
  using Rows = ConstrainedStiffness::Rows;

  /// Set the mesh and the boundary condition.
  /// @param parameters positions of the vertices in the parameter domain, #V x 3.
  /// @param order 1, 2 or 3.
  void bind(PointsView parameters, TrianglesView triangles, int order, PatchBoundary boundary);

  /// Factor the system for a choice of given vertices.
  /// @param prescribed ids of the given vertices, ascending.
  /// @param constrained points of the mesh, other than vertices, whose values are also prescribed.
  /// @return invalid_input, with the first invalid triangle or edge, if a triangle at a free vertex
  /// has no area or an edge of such a triangle belongs to more than two triangles. For boundary
  /// `region`, the triangles in the band of given values (see PatchBoundary) are checked, too.
  /// Return unavailable if the system cannot be factored in double precision. The report contains
  /// counts.free and condition. The latter is a lower bound of the condition number of the matrix
  /// after scaling to a diagonal of ones.
  Status prepare(ExecutionContext& context, const Components& parts,
    const std::vector<Index>& prescribed, const std::vector<MeshPoint>& constrained);

  /// Solve for u, and store it in x.
  /// @param flux integrals of phi_i du/dn along the edge of the patch, where phi_i is the hat
  /// function of vertex i, #V x m. One of the flux functions below computes these integrals. If
  /// empty, all integrals are zero.
  /// @param load #V x m. If empty, the load is zero.
  /// @return the last correction of the iterative refinement, relative to x (ratio of the largest
  /// absolute entries).
  double solve(const Rows& prescribed, const Rows& constrained, const Rows& flux, const Rows& load,
    Rows& x) const;

  /// Return the flux that corresponds to derivatives du/dn (#V x m) at the vertices of the patch's
  /// edge.
  Rows flux_of_derivatives(const Rows& derivatives) const;
  /// Return the flux of values (#V x m) across the patch's edge, computed on the triangles outside
  /// of the patch; zero where there is no such triangle.
  Rows flux_of_surroundings(const Rows& values) const;
  /// Return the flux of values (#V x m) across the patch's edge, computed on the triangles of the
  /// patch.
  Rows flux_of_patch(const Rows& values) const;

  /// For boundary `region`, return the number of one-ring layers between the free vertices and the
  /// border of the mesh. Numbers above `order` are returned as `order`.
  int layers() const { return this->layers_; }
  /// Return the indices of constrained points that depend linearly on other constrained points.
  const std::vector<Index>& redundant() const { return this->system_.redundant(); }

private:
  void estimate_condition(Report& report) const;

  Points parameters_;
  Triangles triangles_;
  int order_ = 2;
  PatchBoundary boundary_ = PatchBoundary::region;

  Index prescribed_count_ = 0, constrained_count_ = 0;
  std::vector<char> is_free_;
  int layers_ = 0;
  SparseMatrix stiffness_; ///< stiffness K of the triangles in use
  /// Lumped mass M of the triangles in use, in units of unit_. The mean of the positive entries is
  /// 1; vertices that belong to no triangle in use have mass 0.
  Eigen::VectorXd mass_;
  Eigen::VectorXd inverse_mass_; ///< inverse of mass_; 0 where mass_ or the Laplacian is zero
  double unit_ = 1.0; ///< unit of mass_: the mean lumped mass of the vertices of triangles in use
  SparseMatrix matrix_; ///< K (M^-1 K)^(k-1)
  SparseMatrix edge_mass_, outside_flux_, inside_flux_;
  ConstrainedStiffness system_;
};

} // namespace bindpose

#endif
