#ifndef bindpose_domain_cage_domain_h
#define bindpose_domain_cage_domain_h

#include "domain/domain.h"
#include "handles/handles.h"
#include "inside/tetrahedralize.h"

namespace bindpose
{

/// Options of fill_cage(), which makes the domain of the weights from a cage among the handles.
struct CageOptions
{
  /// Threshold, > 0: a point is inside the cage if its winding number is at least this. Used only
  /// for a cage of edges.
  double winding_threshold = 0.5;
  /// The geometry of the handles. Its points become vertices of the tets; its segments and
  /// triangles are ignored. Used only for a cage of faces.
  HandleElements handle_elements;
  /// Maximum number of surface points that become vertices of the domain. If the surface has more
  /// points, no point becomes a vertex.
  Index maximum_points = 20000;
};

/// The result of fill_cage().
struct CageDomain
{
  Domain domain;
  TetrahedralizeResult tets; ///< the tets that fill a cage of faces
  TriangleMesh plane_cage; ///< the triangles that fill a cage of edges
};

/// Fill the closed cage that is formed by cage vertices among the handles. A cage of faces is
/// filled with tets (tetrahedralize); a cage of edges in the plane of a flat shape is filled with
/// triangles (planar_shape). The points of the surface become vertices, unless there are too many
/// (CageOptions::maximum_points).
///
/// Report: for a cage of faces, the report of tetrahedralize(); for a cage of edges, cage.area and
/// cage.min_angle (degrees). Return an error if the handles have no closed cage, if a cage of edges
/// is not flat, or if tetrahedralize() or planar_shape() fails.
Status fill_cage(ExecutionContext& context, PointsView points, TrianglesView triangles,
  const Handles& handles, const CageOptions& options, CageDomain& result);

} // namespace bindpose

#endif
