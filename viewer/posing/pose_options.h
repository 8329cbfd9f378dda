#ifndef bindpose_posing_pose_options_h
#define bindpose_posing_pose_options_h

#include "pose/arap_energy.h"
#include "pose/endpoint_weights.h"
#include "pose/polyharmonic.h"
#include "pose/pose.h"
#include "pose/reduced_space.h"

namespace bindpose
{

/// All ways to pose. The integers are those of the window's actions.
enum class PoseMethod : int
{
  linear_blend = 0,
  dual_quaternion = 1,
  reduced_arap = 2,
  stretchable_bones = 3,
  rotation_centres = 4,
  full_arap = 5,
  variational = 6
};
constexpr int pose_method_count = 7;

/// The words of `bindpose deform --method`: "lbs", "dqs", "reduced-arap", "stbs", "cor",
/// "full-arap", "variational".
const char* to_string(PoseMethod method);
/// Whether it blends by weights: all but full as-rigid-as-possible and variational surfaces.
bool needs_weights(PoseMethod method);
/// Whether it blends transforms as they are given, and finds none.
bool is_skinning(PoseMethod method);
/// Whether it is as rigid as possible: it finds rotations that the pose leaves free.
bool finds_rotations(PoseMethod method);
/// What it does with the stretch and the twist of bones.
StretchUse stretch_use(PoseMethod method);
/// Whether a solve takes as long as the mesh is large: it then runs beside the window.
bool is_slow(PoseMethod method);

/// Which pseudo-edges turn points when skinning. The integers are vtkSkinningDeformation's.
enum class PseudoEdgeChoice : int
{
  none = 0,
  given = 1,
  automatic = 2
};

/// What a person chooses of a method. Each says which methods look at it.
struct PoseOptions
{
  PoseMethod method = PoseMethod::linear_blend;

  /// Skinning: weights as floats, right to a millionth of the shape.
  bool single_precision = false;
  /// Skinning: rotations of points from where they are dragged.
  PseudoEdgeChoice pseudo_edges = PseudoEdgeChoice::given;
  bool pseudo_edge_stretch = false;
  /// Stretchable bones without the array EndpointWeights.
  EndpointMethod endpoints = EndpointMethod::projection;

  /// Both as-rigid-as-possible methods: which edges share a rotation.
  ArapEnergy energy = ArapEnergy::automatic;
  /// Both: the energy of the tets that the weights were solved in, which keep volume.
  bool in_tets = false;
  /// Reduced: weights besides the handles', 0 to 30.
  Index extra_weights = 0;
  ExtraWeights extra_kind = ExtraWeights::bumps;
  /// Reduced: most iterations a frame (1 to 1000), and microseconds (0: no limit).
  Index iterations = 100;
  double budget_microseconds = 0.0;

  /// Variational surface: 1 membrane, 2 thin plate, 3 smoother still; and what holds at the edge.
  int order = 2;
  PatchBoundary boundary = PatchBoundary::region;
};

/// Whether the options differ in what only a new bind brings.
bool same_bind(const PoseOptions& a, const PoseOptions& b);
bool operator==(const PoseOptions& a, const PoseOptions& b);
inline bool operator!=(const PoseOptions& a, const PoseOptions& b)
{
  return !(a == b);
}

} // namespace bindpose

#endif
