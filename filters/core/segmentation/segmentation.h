#ifndef bindpose_segmentation_segmentation_h
#define bindpose_segmentation_segmentation_h

// Labels of tets as inside or outside, from their winding numbers (Jacobson, Kavan, Sorkine-Hornung
// 2013).

#include "base/execution.h"
#include "geometry/mesh.h"

#include <vector>

namespace bindpose
{

/// Method of labeling tets as inside or outside. vtkTetrahedralizeSurface uses the same integer
/// values.
enum class SegmentationMethod
{
  graph_cut, ///< the labels with minimum energy
  threshold ///< inside if the winding number reaches the threshold
};

/// Return "graph-cut" or "threshold".
const char* to_string(SegmentationMethod method);

/// Options of segment_tets().
struct SegmentationOptions
{
  SegmentationMethod method = SegmentationMethod::graph_cut;
  /// Threshold (> 0) of the winding number. For method `threshold`, a tet is inside if its winding
  /// number is at least this value. For method `graph_cut`, the energy contains the threshold; see
  /// segment_tets().
  double winding_threshold = 0.5;
  /// Factor (>= 0) of the energy's second term, which makes the boundary smooth (gamma in the
  /// paper). With 0, the labels are the same as with method `threshold`.
  double cut_smoothness = 1.0;
  /// Difference (> 0) of winding numbers, sigma in the paper. A facet is cheap to cut if the
  /// winding numbers of its two tets differ by more than this.
  double cut_sigma = 0.1;
};

/// Return invalid_input, with the name and the value of the option, if one is out of range.
Status check_options(const SegmentationOptions& options);

struct Segmentation
{
  std::vector<char> inside; ///< #T: 1 inside, 0 outside
  /// Energy of the labels in `inside`. With method `threshold`, this member and the next two are 0.
  double energy = 0.0;
  double threshold_energy = 0.0; ///< energy of the labels of method `threshold`, >= `energy`
  Index changed = 0; ///< number of tets that have a different label with method `threshold`
};

/// Label tets as inside or outside from their winding numbers. Method `graph_cut` minimizes an
/// energy over all tets (Jacobson, Kavan, Sorkine-Hornung, Robust Inside-Outside Segmentation using
/// Generalized Winding Numbers, 2013, equation 10 with its misprint corrected). Let w be the
/// winding number of a tet and w' = w - winding_threshold + 1/2. The energy is the sum of
/// - max(w', 0) for each tet outside,
/// - max(1 - w', 0) for each tet inside, and
/// - cut_smoothness * area / mean area * exp(-(w_i - w_j)^2 / (2 cut_sigma^2)) for each facet
///   between a tet inside and a tet outside, where w_i and w_j are the winding numbers of its tets.
///
/// The boundary of the tets inside then follows the surface, where the winding number jumps. In
/// openings the area of this boundary is small, whereas a threshold gives a ragged boundary there.
/// @return invalid_input if an option is out of range; canceled; or ok. Cost: 3 us per tet.
Status segment_tets(ExecutionContext& context, PointsView points, TetsView tets,
  const Eigen::VectorXd& winding_numbers, const SegmentationOptions& options, Segmentation& result);

} // namespace bindpose

#endif
