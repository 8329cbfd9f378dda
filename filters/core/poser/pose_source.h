#ifndef bindpose_poser_pose_source_h
#define bindpose_poser_pose_source_h

#include "fairing/variational_surface.h"
#include "geometry/mesh.h"
#include "handles/handles.h"
#include "pose/pose.h"
#include "pose/pseudo_edges.h"

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
  /// Options of VariationalSurface. Only the arrays are set here: the region labels, and the point
  /// arrays Fixed, Parameterization, Tangents and Load. VariationalPoser sets `order` and
  /// `boundary` in a copy.
  VariationalSurfaceOptions arrays;
  Handles handles;
  PseudoEdges pseudo_edges; ///< pseudo-edges of the handle dataset
  Status pseudo_edges_status; ///< the reason why pseudo_edges cannot be used, or ok
  /// The tets on which the weights were solved; empty if the weights were not solved on tets, or if
  /// the tets are unknown.
  Points tet_points;
  Tets tets;
  Weights tet_weights;

  bool has_weights() const { return this->weights.rows() > 0; }
  bool has_tets() const { return this->tets.rows() > 0 && this->tet_weights.rows() > 0; }
};

} // namespace bindpose

#endif
