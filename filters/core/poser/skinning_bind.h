#ifndef bindpose_poser_skinning_methods_h
#define bindpose_poser_skinning_methods_h

#include "pose/pseudo_edges.h"
#include "skinning/endpoint_weights.h"
#include "skinning/skinning.h"

#include <optional>

namespace bindpose
{

/// Skinning methods. The integers are those of vtkSkinningDeformation.
enum class SkinningMethod : int
{
  linear_blend = 0,
  dual_quaternion = 1,
  stretchable_bones = 2,
  rotation_centers = 3
};

/// Source of the pseudo-edges that rotate point handles. The integers are those of
/// vtkSkinningDeformation.
enum class PseudoEdgeChoice : int
{
  none = 0,
  given = 1, ///< the pseudo-edges of the handle dataset
  automatic = 2 ///< automatic_pseudo_edges()
};

struct SkinningMethodOptions
{
  SkinningMethod method = SkinningMethod::linear_blend;
  /// Precision of the weights, and which weights are dropped. SkinningBind ignores `weights.center`
  /// and uses the mean of the handles' pivots instead.
  SkinningOptions weights;
  PseudoEdgeChoice pseudo_edges = PseudoEdgeChoice::none;
  bool pseudo_edge_stretch = false; ///< pseudo-edges also scale their handles
  /// Stretchable bones: how to compute endpoint weights if the shape has no endpoint weights.
  EndpointMethod endpoints = EndpointMethod::projection;
};

/// Views of a shape and its handles, valid during a call.
struct SkinnedShape
{
  PointsView points; ///< #V x 3, at rest
  WeightsView weights; ///< #V x #handles
  const Handles& handles;
  WeightsView endpoints; ///< #V x #handles, in [0, 1]; size 0 if the shape has no endpoint weights
};

/// All skinning methods with the data that they compute once per shape: sparse weights, pivots,
/// centers of rotation, endpoint weights and automatic pseudo-edges. A bind computes only the
/// missing data that its method needs.
///
/// A shape can be posed in several parts. With linear blending and dual quaternions, the result is
/// bit-identical to that of the whole shape. For this reason positions are computed relative to the
/// mean of the handles' pivots, which is the same for all parts.
class SkinningBind
{
public:
  /// Discard the bind, because the shape has changed.
  void reset() { *this = {}; }

  /// Report whether the bind contains everything that pose() needs for these options.
  bool is_bound(const SkinnedShape& shape, const SkinningMethodOptions& options) const;

  /// Report whether bind() needs the elements of the shape, because rotation centers, automatic
  /// pseudo-edges or endpoint weights are missing.
  bool needs_elements(const SkinnedShape& shape, const SkinningMethodOptions& options) const;

  /// Compute the missing data. Centers of rotation take seconds for a large shape. Endpoint weights
  /// other than projections take as long as bounded biharmonic weights. The reported phases are
  /// "edges", "centers" and "endpoints".
  /// @param tets, triangles  the elements of the shape. If there are tets, triangles are ignored.
  Status bind(ExecutionContext& context, const SkinnedShape& shape, TetsView tets,
    TrianglesView triangles, const SkinningMethodOptions& options);

  /// Compute the posed points, #V x 3. For the method rotation_centers, the report contains the
  /// entries of rotation_centers(). If pseudo-edges are used, the report contains
  /// counts.pseudo_edges.
  /// @param given  the pseudo-edges for PseudoEdgeChoice::given
  Status pose(ExecutionContext& context, const SkinnedShape& shape, const Pose& pose,
    const PseudoEdges& given, const SkinningMethodOptions& options, PointsOutput posed);

  /// Report whether pose_normals() supports a method. It does not support stretchable bones: with a
  /// stretch the endpoint weights also change the slope of the surface.
  static bool poses_normals(SkinningMethod method)
  {
    return method != SkinningMethod::stretchable_bones;
  }
  /// Compute the normals of the last pose, #V x 3, from those at rest.
  Status pose_normals(
    ExecutionContext& context, PointsView rest, SkinningMethod method, PointsOutput posed) const;

  /// Return the transforms of the last pose, one per handle.
  const std::vector<Affine>& transforms() const { return this->transforms_; }

private:
  bool has_endpoints(const SkinnedShape& shape, const SkinningMethodOptions& options) const;
  Status bind_centers(
    ExecutionContext& context, const SkinnedShape& shape, TetsView tets, TrianglesView triangles);
  Status bind_endpoints(ExecutionContext& context, const SkinnedShape& shape, TetsView tets,
    TrianglesView triangles, EndpointMethod method);
  WeightsView endpoints(const SkinnedShape& shape, EndpointMethod method) const;

  std::optional<SkinningOptions> bound_; ///< options of the sparse weights; empty before a bind
  Skinning skinning_;
  Points pivots_;
  std::optional<PseudoEdges> automatic_edges_;
  Points centers_; ///< centers of rotation; no rows before the first bind that needs them
  Report centers_report_;
  std::optional<EndpointMethod> endpoint_method_; ///< the method by which endpoints_ were computed
  Weights endpoints_;
  std::vector<Affine> transforms_;
};

} // namespace bindpose

#endif
