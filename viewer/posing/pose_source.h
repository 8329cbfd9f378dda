#ifndef bindpose_posing_pose_source_h
#define bindpose_posing_pose_source_h

#include "base/mesh.h"
#include "pose/pose.h"
#include "pose/pseudo_edges.h"
#include "pose/variational_surface.h"
#include "weights/handles.h"

class vtkPolyData;
class vtkUnstructuredGrid;

namespace bindpose
{

/// What is bent, and by what: everything that a bind reads, in copies, so that binds may run beside
/// the window. Does not change once it is made; other weights or handles make another one.
struct PoseSource
{
  Points points; ///< the surface at rest
  Triangles triangles;
  Weights weights; ///< #V x #handles; empty: not bound yet
  Weights endpoints; ///< the point array EndpointWeights; empty: there is none
  /// Regions, and the point arrays Fixed, Parameterization, Tangents and Load, as
  /// vtkVariationalSurface reads them. Options are set when a method is bound.
  VariationalSurfaceOptions arrays;
  Handles handles;
  PseudoEdges pseudo_edges; ///< those of the handle dataset
  Status of_pseudo_edges; ///< what is wrong with them
  /// What weights were solved in; empty: not known, or no tets.
  Points tet_points;
  Tets tets;
  Weights tet_weights;

  bool has_weights() const { return this->weights.rows() > 0; }
  bool has_tets() const { return this->tets.rows() > 0 && this->tet_weights.rows() > 0; }
};

/// @param tets  with the point array Weights; may be null.
/// invalid_input for what the filters refuse: a surface that is none, handles that are none,
/// weights of other handles, endpoint weights that are not between 0 and 1.
Status to_pose_source(
  vtkPolyData* surface, vtkUnstructuredGrid* tets, vtkPolyData* handles, PoseSource& source);

} // namespace bindpose

#endif
