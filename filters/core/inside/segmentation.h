#ifndef bindpose_inside_segmentation_h
#define bindpose_inside_segmentation_h

#include "base/execution.h"
#include "base/mesh.h"

#include <vector>

namespace bindpose
{

/// How tets are told apart. The order is the one vtkTetrahedralizeSurface exposes.
enum class SegmentationMethod
{
  graph_cut, ///< the labels of least energy
  threshold ///< inside where the winding number reaches the threshold
};

/// "graph-cut", "threshold".
const char* to_string(SegmentationMethod method);

struct SegmentationOptions
{
  SegmentationMethod method = SegmentationMethod::graph_cut;
  double winding_threshold = 0.5; ///< > 0
  /// Weight of smoothness against the winding number (gamma), >= 0; 0 is the plain threshold.
  double cut_smoothness = 1.0;
  /// Difference of winding numbers across a facet that makes a cut there cheap (sigma), > 0.
  double cut_sigma = 0.1;
};

struct Segmentation
{
  std::vector<char> inside; ///< #T
  double energy = 0.0; ///< of these labels; of graph_cut only, as what follows
  double threshold_energy = 0.0; ///< of the plain threshold's, never less
  Index changed = 0; ///< tets that the threshold labels otherwise
};

/// Says which tets are inside from their winding numbers, as one decision for all of them: with
/// w' = w - winding_threshold + 1/2, the energy is the sum over tets of max(w', 0) for those
/// outside and max(1 - w', 0) for those inside, and over facets between the two, of cut_smoothness
/// * area / mean area * exp(-(w_i - w_j)^2 / (2 cut_sigma^2)) (Jacobson, Kavan, Sorkine-Hornung,
/// Robust Inside-Outside Segmentation using Generalized Winding Numbers, 2013, equation 10 with its
/// misprint corrected). The boundary then follows jumps of the winding number - the surface - and
/// is small across openings, instead of the ragged border of a threshold.
/// @return invalid_input for options out of range, cancelled. Cost: 3 us a tet.
Status segment_tets(PointsView points, TetsView tets, const Eigen::VectorXd& winding_numbers,
  const SegmentationOptions& options, Segmentation& result, ExecutionContext& context);

} // namespace bindpose

#endif
