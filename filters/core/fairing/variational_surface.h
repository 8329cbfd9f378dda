#ifndef bindpose_fairing_variational_surface_h
#define bindpose_fairing_variational_surface_h

#include "arap/mesh_grips.h"
#include "base/execution.h"
#include "fairing/polyharmonic.h"

namespace bindpose
{

/// Source of the derivatives that the boundary condition PatchBoundary::tangent prescribes. These
/// are the derivatives of the positions across the edge of a patch. The integers are those of
/// vtkVariationalSurface.
enum class PatchTangents : int
{
  /// Derivatives computed on the triangles that are outside of the patch and adjacent to its edge.
  /// Zero where the edge of the patch is the border of the mesh.
  surroundings = 0,
  prescribed = 1, ///< the values of VariationalSurfaceOptions::tangents
  clamped = 2 ///< zero. Displacements keep the tangents at rest; positions get a cusp.
};

/// Options of VariationalSurface::bind().
struct VariationalSurfaceOptions
{
  /// Exponent of the Laplacian in the equation. 1: the Laplacian, a membrane; 2: its square, a thin
  /// plate; 3: its cube.
  int order = 2;
  PatchBoundary boundary = PatchBoundary::region;
  PatchTangents tangent_source = PatchTangents::surroundings;
  /// Type of the unknowns. false: displacements from rest, which keep the details of the rest
  /// shape. true: positions, which replace the patch by a smooth surface that continues its
  /// surroundings.
  bool fair = false;
  /// #V x 3 positions of the vertices in the parameter domain. If empty, the rest positions are
  /// used.
  Points parameters;
  /// #V flags: 1 for vertices that are fixed in addition to those that handles constrain. If empty,
  /// there are no such vertices.
  std::vector<char> fixed;
  /// #V x 3 derivatives of the position across the edge of the patch. In the parameter domain, the
  /// direction of the derivative is perpendicular to the edge and points away from the patch. A
  /// unit vector means that the patch is not stretched in this direction. Used by
  /// PatchTangents::prescribed.
  Points tangents;
  /// #V x 3 right-hand side: required values of (-Laplacian)^order of the position (if `fair`) or
  /// of the displacement. If empty, these values are zero.
  Points load;
  /// #V labels of the vertices (Handle::region_id; 0: none). Required if a handle is a region.
  std::vector<Index> region_ids;
};

/// Smooth surfaces between constraints. Each coordinate of the free vertices solves a polyharmonic
/// equation of order 1, 2 or 3. The Laplacian is computed in a parameter domain that does not
/// depend on the pose. Method: Jacobson, Tosun, Sorkine, Zorin 2010, Mixed finite elements for
/// variational surface modeling.
///
///     VariationalSurface surface;
///     surface.bind(context, points, triangles, handles, options);  // once
///     surface.solve(context, pose);            // factors if modes change, then solves
///     surface.posed();
///
/// Handles constrain the mesh as in FullArap (see MeshGrips); handles are optional. The method is
/// linear: large rotations shear details, and no part remains rigid.
///
/// If the unknowns are displacements, a connected part of the mesh without constraints does not
/// move. If the unknowns are positions, such a part is an error, because its shape is undetermined.
///
/// Cost: bind O(#V). The first solve, and each solve after a handle has changed its mode
/// (HandleMode), needs one sparse factorization of the free vertices' matrix (about 7, 19 or 37
/// entries per row for order 1, 2 or 3). Every solve needs a few solves with the factor for three
/// right-hand sides.
class VariationalSurface
{
public:
  /// Bind a mesh and its handles. The report contains counts.vertices, counts.triangles,
  /// counts.handles, method, order and boundary. A warning contains the names of handles that are
  /// not on the mesh. Return invalid_input if a value is not finite, an array has the wrong length,
  /// the order is not 1 to 3, there is no triangle, or a region has no label or no vertices.
  Status bind(ExecutionContext& context, PointsView points, TrianglesView triangles,
    const Handles& handles, const VariationalSurfaceOptions& options = {});

  /// Compute the vertices for a pose, which has one entry per handle. The report contains
  /// counts.free, counts.constrained (number of constrained vertices and points), condition (see
  /// Polyharmonic::prepare), refinement (the last correction, as a fraction of the largest
  /// coordinate) and constraint_residual (in bounding-box diagonals). Errors are those of
  /// Polyharmonic::prepare. If the unknowns are positions, a connected part of the mesh without
  /// constraints is also an error. Warnings report contradictory or redundant handles, a refinement
  /// after which few digits are correct, and combinations of order and boundary condition that
  /// ignore the tangents or give a less smooth surface than the order suggests.
  Status solve(ExecutionContext& context, const Pose& pose);

  /// The vertices in the last solved pose.
  const Points& posed() const { return this->posed_; }
  /// Number of factorizations so far. The first solve factors the matrix. Later solves factor it
  /// again only if a handle has changed its mode.
  Index factorizations() const { return this->factorizations_; }

private:
  using Rows = Polyharmonic::Rows;

  Status solve_in_frame(ExecutionContext& context, const Pose& pose);
  Status prepare(ExecutionContext& context, const Pose& pose);
  Rows expand_prescribed(const Rows& prescribed) const;

  WorkingFrame frame_; ///< all other data is in this frame, except posed_ after a solve
  Handles handles_;
  VariationalSurfaceOptions options_;
  Points rest_;
  Components parts_;
  std::vector<Index> fixed_vertices_;
  MeshGrips grips_;

  // The following members depend on the modes of the handles.
  bool prepared_ = false;
  std::vector<HandleMode> modes_;
  Polyharmonic system_;
  /// Status of the last preparation; its report and warnings are copied to the status of every
  /// solve.
  Status prepared_status_;
  Index factorizations_ = 0;

  Points posed_;
};

} // namespace bindpose

#endif
