#ifndef bindpose_posing_pose_source_h
#define bindpose_posing_pose_source_h

#include "fairing/variational_surface.h"
#include "geometry/mesh.h"
#include "handles/handles.h"
#include "pose/pose.h"
#include "pose/pseudo_edges.h"

class vtkPolyData;
class vtkUnstructuredGrid;

namespace bindpose
{

/// Copies of everything that a bind reads (the surface, its weights and its handles), so that a
/// bind can run in the background. A source is immutable; a new source is created for new weights
/// or handles.
struct PoseSource
{
  Points points; ///< the surface at rest
  Triangles triangles;
  Weights weights; ///< #V x #handles; empty before a bind
  Weights endpoints; ///< the point array EndpointWeights; empty if there is none
  /// The region labels and the point arrays Fixed, Parameterization, Tangents and Load, as
  /// vtkVariationalSurface reads them. All other options are set when a method is bound.
  VariationalSurfaceOptions arrays;
  Handles handles;
  PseudoEdges pseudo_edges; ///< pseudo-edges of the handle dataset
  Status of_pseudo_edges; ///< the reason why pseudo_edges cannot be used, or ok
  /// The tets on which the weights were solved; empty if they are unknown or were not tets.
  Points tet_points;
  Tets tets;
  Weights tet_weights;

  bool has_weights() const { return this->weights.rows() > 0; }
  bool has_tets() const { return this->tets.rows() > 0 && this->tet_weights.rows() > 0; }
};

/// Create the source from datasets. Return invalid_input for a surface, handles or weights that the
/// filters reject: an invalid surface, invalid handles, weights that do not match the handles,
/// endpoint weights outside [0, 1].
/// @param tets  tets with the point array Weights; may be null. Invalid tets, and tets whose
/// weights do not match the handles, are ignored.
Status to_pose_source(
  vtkPolyData* surface, vtkUnstructuredGrid* tets, vtkPolyData* handles, PoseSource& source);

} // namespace bindpose

#endif
