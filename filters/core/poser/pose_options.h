#ifndef bindpose_poser_pose_options_h
#define bindpose_poser_pose_options_h

#include "arap/arap_energy.h"
#include "arap/reduced_space.h"
#include "fairing/polyharmonic.h"
#include "pose/pose.h"
#include "poser/skinning_bind.h"

namespace bindpose
{

// The pose methods and their options.

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

/// Return the name of the method in `bindpose deform --method`: "lbs", "dqs", "reduced-arap",
/// "stbs", "cor", "full-arap", "variational".
const char* to_string(PoseMethod method);
/// Report whether the method blends by weights. All methods do, except full as-rigid-as-possible
/// and variational surfaces.
bool needs_weights(PoseMethod method);
/// Report whether the method only blends the transforms of the pose and computes no transforms
/// itself.
bool is_skinning(PoseMethod method);
/// Return the skinning method. The argument must be a skinning method.
SkinningMethod to_skinning(PoseMethod method);
/// Report whether the method is one of the as-rigid-as-possible methods, which compute the
/// rotations that the pose does not prescribe.
bool finds_rotations(PoseMethod method);
/// Return how the method uses the stretch and the twist of bones.
StretchUse stretch_use(PoseMethod method);
/// Report whether the time of a solve grows with the size of the mesh. Slow methods run in the
/// background.
bool is_slow(PoseMethod method);

/// The user's options of a pose method. Each comment begins with the methods that use the option.
struct PoseOptions
{
  PoseMethod method = PoseMethod::linear_blend;

  /// Skinning methods: weights in single precision. Positions are accurate to a millionth of the
  /// shape's size.
  bool single_precision = false;
  /// Skinning methods: the pseudo-edges that determine the rotations of dragged points.
  PseudoEdgeChoice pseudo_edges = PseudoEdgeChoice::given;
  bool pseudo_edge_stretch = false;
  /// Stretchable bones: how to compute endpoint weights if the mesh has no array EndpointWeights.
  EndpointMethod endpoints = EndpointMethod::projection;

  /// Both as-rigid-as-possible methods: the sets of edges that share a rotation.
  ArapEnergy energy = ArapEnergy::automatic;
  /// Both as-rigid-as-possible methods: use the energy of the tets on which the weights were
  /// solved. Tets preserve volume.
  bool use_tet_energy = false;
  /// Reduced as-rigid-as-possible: number of weights in addition to those of the handles, 0 to 30.
  Index extra_weights = 0;
  ExtraWeights extra_kind = ExtraWeights::bumps;
  /// Reduced as-rigid-as-possible: maximum number of iterations per frame (1 to 1000), and maximum
  /// number of microseconds per frame (0: no limit).
  Index iterations = 100;
  double budget_microseconds = 0.0;

  /// Variational surface: order (1 is a membrane, 2 a thin plate, 3 is smoother than 2), and
  /// boundary conditions at the edge of the patch.
  int order = 2;
  PatchBoundary boundary = PatchBoundary::region;
};

/// Report whether the same bind can be used for the options a and b. The methods must not be
/// skinning methods (see SkinningBind).
bool same_bind(const PoseOptions& a, const PoseOptions& b);
bool operator==(const PoseOptions& a, const PoseOptions& b);
inline bool operator!=(const PoseOptions& a, const PoseOptions& b)
{
  return !(a == b);
}

} // namespace bindpose

#endif
