#ifndef bindpose_weights_cage_domain_h
#define bindpose_weights_cage_domain_h

#include "inside/tetrahedralize.h"
#include "weights/domain.h"
#include "weights/handles.h"

namespace bindpose
{

/// Options of fill_cage().
struct CageOptions
{
  double winding_threshold = 0.5; ///< > 0
  HandlePlaces places; ///< parts of the handles that become part of the tets
  Index most_points = 20000; ///< a surface with more points: they do not become vertices
};

/// The inside of a cage.
struct CageDomain
{
  Domain domain;
  TetrahedralizeResult tets; ///< of a cage of faces
  TriangleMesh plane_cage; ///< of a cage of edges
};

/// Fills the closed cage among the handles: with tets where it has faces (tetrahedralize), with
/// triangles where it has edges in the plane of a flat shape (planar_shape). The surface's points
/// become vertices.
///
/// Report: of a cage of faces what tetrahedralize() reports, of a cage of edges cage.area and
/// cage.min_angle (degrees). Errors: no closed cage among the handles, a cage of edges that is not
/// flat, and those of the parts.
Status fill_cage(PointsView points, TrianglesView triangles, const Handles& handles,
  const CageOptions& options, CageDomain& result, ExecutionContext& context);

} // namespace bindpose

#endif
