#ifndef bindpose_pose_variational_surface_h
#define bindpose_pose_variational_surface_h

#include "base/execution.h"
#include "pose/mesh_grips.h"
#include "pose/polyharmonic.h"

namespace bindpose
{

/// Source of the derivatives across the edge of a patch, for PatchBoundary::tangent. The integers
/// are those of vtkVariationalSurface.
enum class PatchTangents : int
{
  surroundings = 0, ///< the triangles across the edge; zero where the mesh ends
  given = 1, ///< VariationalSurfaceOptions::tangents
  clamped = 2 ///< zero: displacements keep the tangents at rest, positions get a cusp
};

struct VariationalSurfaceOptions
{
  /// 1: Laplacian = 0, a membrane; 2: its square, a thin plate; 3: its cube.
  int order = 2;
  PatchBoundary boundary = PatchBoundary::region;
  PatchTangents tangent_source = PatchTangents::surroundings;
  /// The unknowns: displacements from rest (details are kept) if false, or positions (the patch is
  /// replaced by a surface that fits its surroundings) if true.
  bool fair = false;
  /// #V x 3 positions of the vertices in the parameter domain; empty: the rest positions.
  Points parameters;
  /// #V flags of fixed vertices, in addition to those that handles constrain; empty: none.
  std::vector<char> fixed;
  /// #V x 3 derivatives of the position across the edge, outwards, per unit of the parameter
  /// domain. A unit vector that points away from the patch makes it isometric. Used by
  /// PatchTangents::given.
  Points tangents;
  /// #V x 3: required values of (-Laplacian)^order of the position (fair) or displacement; empty:
  /// zero.
  Points load;
  /// #V labels of the vertices (Handle::region_id; 0: none). Required if a handle is a region.
  std::vector<Index> region_ids;
};

/// Smooth surfaces between constraints. Each coordinate of the free vertices solves Laplace's
/// equation of order 1, 2 or 3, with the operator frozen on a parameter domain. Jacobson, Tosun,
/// Sorkine, Zorin 2010, Mixed finite elements for variational surface modeling.
///
///     VariationalSurface surface;
///     surface.bind(context, points, triangles, handles, options);  // once
///     surface.solve(context, pose);            // factors if modes change, then solves
///     surface.posed();
///
/// Handles constrain the mesh as in FullArap (see MeshGrips); there may be no handle. The method is
/// linear: large rotations shear details, and nothing is kept rigid.
///
/// A connected part without constraints does not move if displacements are solved for. It is an
/// error if positions are solved for, because the part has no shape then.
///
/// Cost: bind O(#V). A solve after a change of modes needs one sparse factorization of the free
/// vertices' matrix (7, 19 or 37 entries per row). Every solve needs a few solves with the factor
/// for three right-hand sides.
class VariationalSurface
{
public:
  /// Report: counts.vertices, counts.triangles, counts.handles, method, order, boundary. A warning
  /// names handles that are not on the mesh. invalid_input for numbers that are not finite, arrays
  /// of the wrong length, an order other than 1 to 3, no triangle, and a region without label or
  /// vertices.
  Status bind(ExecutionContext& context, PointsView points, TrianglesView triangles,
    const Handles& handles, const VariationalSurfaceOptions& options = {});

  /// Find the vertices of a pose, which has one entry per handle. Report: counts.free,
  /// counts.constrained (vertices and points held), condition (a lower bound of the condition
  /// number of the factored matrix with ones on its diagonal), refinement (the last correction, as
  /// a fraction of the largest coordinate), constraint_residual (in bounding-box diagonals).
  /// Errors: see Polyharmonic::prepare; in addition, positions without any constraint. Warnings
  /// name contradictory or redundant handles, a refinement that leaves few correct digits, and
  /// boundary conditions that have less effect than expected.
  Status solve(ExecutionContext& context, const Pose& pose);

  /// The vertices in the last solved pose.
  const Points& posed() const { return this->posed_; }
  /// Number of factorizations: one for each choice of modes.
  Index factorizations() const { return this->factorizations_; }

private:
  using Rows = Polyharmonic::Rows;

  Status prepare(ExecutionContext& context, const Pose& pose);
  Rows known(const Rows& given) const;

  Handles handles_;
  VariationalSurfaceOptions options_;
  Points rest_;
  Components parts_;
  std::vector<Index> staying_;
  MeshGrips grips_;

  // ---- per choice of modes
  bool prepared_ = false;
  std::vector<HandleMode> modes_;
  Polyharmonic system_;
  Status prepared_status_; ///< its report and warnings are part of every solve's status
  Index factorizations_ = 0;

  Points posed_;
};

} // namespace bindpose

#endif
