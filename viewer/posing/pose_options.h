#ifndef bindpose_posing_pose_options_h
#define bindpose_posing_pose_options_h

#include "pose/arap_energy.h"
#include "pose/endpoint_weights.h"
#include "pose/polyharmonic.h"
#include "pose/pose.h"
#include "pose/reduced_space.h"

namespace bindpose
{

/// All pose methods. The window's actions use the same integers.
enum class PoseMethod : int
{
  linear_blend = 0,
  dual_quaternion = 1,
  reduced_arap = 2,
  stretchable_bones = 3,
  rotation_centers = 4,
  full_arap = 5,
  variational = 6
};
constexpr int pose_method_count = 7;

/// Return the method's word in `bindpose deform --method`: "lbs", "dqs", "reduced-arap", "stbs",
/// "cor", "full-arap", "variational".
const char* to_string(PoseMethod method);
/// Report whether the method blends by weights: all but full as-rigid-as-possible and variational
/// surfaces.
bool needs_weights(PoseMethod method);
/// Report whether the method only blends the given transforms and computes none.
bool is_skinning(PoseMethod method);
/// Report whether the method is as-rigid-as-possible, so that it computes the rotations that the
/// pose leaves free.
bool finds_rotations(PoseMethod method);
/// Return how the method uses the stretch and the twist of bones.
StretchUse stretch_use(PoseMethod method);
/// Report whether the time of a solve grows with the size of the mesh. Slow methods run in the
/// background.
bool is_slow(PoseMethod method);

/// Which pseudo-edges rotate point handles in skinning. vtkSkinningDeformation uses the same
/// integers.
enum class PseudoEdgeChoice : int
{
  none = 0,
  given = 1,
  automatic = 2
};

/// The user's options of a pose method. Each comment begins with the methods that use the option.
struct PoseOptions
{
  PoseMethod method = PoseMethod::linear_blend;

  /// Skinning: weights in single precision. Positions are exact to a millionth of the shape's size.
  bool single_precision = false;
  /// Skinning: the pseudo-edges that give dragged points their rotations.
  PseudoEdgeChoice pseudo_edges = PseudoEdgeChoice::given;
  bool pseudo_edge_stretch = false;
  /// Stretchable bones: how to compute endpoint weights if there is no array EndpointWeights.
  EndpointMethod endpoints = EndpointMethod::projection;

  /// Both as-rigid-as-possible methods: which edges share a rotation.
  ArapEnergy energy = ArapEnergy::automatic;
  /// Both as-rigid-as-possible methods: use the energy of the tets on which the weights were
  /// solved. Tets preserve volume.
  bool in_tets = false;
  /// Reduced: number of weights in addition to the handles', 0 to 30.
  Index extra_weights = 0;
  ExtraWeights extra_kind = ExtraWeights::bumps;
  /// Reduced: limits per frame: iterations (1 to 1000), and microseconds (0: no limit).
  Index iterations = 100;
  double budget_microseconds = 0.0;

  /// Variational surface: order 1 is a membrane, 2 a thin plate, 3 is smoother than 2; and the
  /// conditions at the edge of the patch.
  int order = 2;
  PatchBoundary boundary = PatchBoundary::region;
};

/// Report whether both options can use the same bind.
bool same_bind(const PoseOptions& a, const PoseOptions& b);
bool operator==(const PoseOptions& a, const PoseOptions& b);
inline bool operator!=(const PoseOptions& a, const PoseOptions& b)
{
  return !(a == b);
}

} // namespace bindpose

#endif
