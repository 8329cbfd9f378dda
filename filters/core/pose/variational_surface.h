#ifndef bindpose_pose_variational_surface_h
#define bindpose_pose_variational_surface_h

#include "base/execution.h"
#include "pose/mesh_grips.h"
#include "pose/polyharmonic.h"

namespace bindpose
{

/// Where the derivatives across the edge of a patch come from, for PatchBoundary::tangent. The
/// integers are those of vtkVariationalSurface.
enum class PatchTangents : int
{
  surroundings = 0, ///< the triangles across the edge; where the mesh ends, zero
  given = 1, ///< VariationalSurfaceOptions::tangents
  clamped = 2 ///< zero: of displacements, the tangents at rest; of positions, a cusp
};

struct VariationalSurfaceOptions
{
  /// 1: Laplacian = 0, a membrane; 2: its square, a thin plate; 3: its cube.
  int order = 2;
  PatchBoundary boundary = PatchBoundary::region;
  PatchTangents tangent_source = PatchTangents::surroundings;
  /// What is solved for: displacements from rest (details stay), or positions (the patch is made
  /// anew from what is around it, whatever it was).
  bool fair = false;
  /// #V x 3 places of the vertices in the parameter domain; empty: at rest.
  Points parameters;
  /// #V flags of vertices that stay, besides those that handles hold; empty: none.
  std::vector<char> fixed;
  /// #V x 3 derivatives of the position across the edge, outwards, per unit of the parameter
  /// domain: a unit vector away from the patch where it is to be isometric. For `given`.
  Points tangents;
  /// #V x 3: what (-Laplacian)^order of the position (fair) or displacement is to be; empty: zero.
  Points load;
  /// #V labels of the vertices (Handle::region_id; 0: none). Needed when a handle is a region.
  std::vector<Index> region_ids;
};

/// Smooth surfaces between what is fixed: each coordinate of the free vertices solves Laplace's
/// equation of order 1, 2 or 3, with the operator frozen on a parameter domain. Jacobson, Tosun,
/// Sorkine, Zorin 2010, Mixed finite elements for variational surface modeling.
///
///     VariationalSurface surface;
///     surface.bind(context, points, triangles, handles, options);  // once
///     surface.solve(context, pose);            // a factorisation when modes change, else a solve
///     surface.posed();
///
/// Handles hold the mesh as in FullArap (see MeshGrips); there may be none. Linear: large rotations
/// shear details, and nothing is kept rigid.
///
/// Displacements: a part that nothing holds stays. Positions: it is an error, as it has no shape.
///
/// Cost: bind O(#V); a solve after a change of modes one sparse factorisation of the free vertices'
/// matrix (7, 19 or 37 entries a row), then a few solves with it for three right sides.
class VariationalSurface
{
public:
  /// Report: counts.vertices, counts.triangles, counts.handles, method, order, boundary. A warning
  /// for handles beside the mesh. invalid_input for numbers that are not finite, arrays of another
  /// length, an order that is not there, no triangle, a region without label or vertices.
  Status bind(ExecutionContext& context, PointsView points, TrianglesView triangles,
    const Handles& handles, const VariationalSurfaceOptions& options = {});

  /// Finds the vertices of a pose, one entry a handle. Report: counts.free, counts.constrained
  /// (vertices and points held), condition (of the factored matrix with ones on its diagonal,
  /// estimated from below), refinement (the last correction, as a share of the largest coordinate),
  /// constraint_residual (in diagonals). Errors: see Polyharmonic::prepare; positions with nothing
  /// fixed. Warnings name handles that contradict each other or are redundant, a refinement that
  /// leaves few digits, and boundary conditions that are less than they seem.
  Status solve(ExecutionContext& context, const Pose& pose);

  /// The vertices in the last solved pose.
  const Points& posed() const { return this->posed_; }
  /// How often a system was factored: once for each choice of modes.
  Index factorisations() const { return this->factorisations_; }

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
  Status prepared_status_; ///< its report and warnings stand on every solve
  Index factorisations_ = 0;

  Points posed_;
};

} // namespace bindpose

#endif
