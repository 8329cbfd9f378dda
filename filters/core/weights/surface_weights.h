#ifndef bindpose_weights_surface_weights_h
#define bindpose_weights_surface_weights_h

#include "inside/tetrahedralize.h"
#include "weights/weights_problem.h"

#include <functional>

namespace bindpose
{

/// Where the weights of a surface are solved. The integers are those of vtkWeightsAlgorithm.
enum class WeightsDomain : int
{
  surface = 0, ///< on the triangles
  /// A flat shape on itself; a closed, clean surface in its volume where that is predicted to be
  /// well conditioned and cheap (domain_choice.h), and every surface with regions; all others in
  /// the embedding, which also takes over where the first choice fails.
  automatic = 1,
  volume = 2, ///< in tets of the inside that keep the surface (tetrahedralize, auto)
  embedding = 3, ///< in a lattice that holds the surface (tetrahedralize, embed)
  /// In tets of a closed cage of faces around the surface; of a flat shape, in triangles of a
  /// closed cage of edges around it.
  cage = 4
};

/// "surface", "auto", "volume", "embedding", "cage"
const char* to_string(WeightsDomain domain);

/// A method: bounded_biharmonic_weights, monotone_weights, … with its options bound.
using WeightsMethod =
  std::function<Status(const WeightsProblem&, ExecutionContext&, WeightsResult&)>;

struct SurfaceWeights
{
  Weights weights; ///< #V x #handles at the surface's points, rows sum to one
  /// The same before rows are divided by their sums; empty unless SurfaceWeightsOptions::keep_raw.
  Weights raw;
  WeightsDomain domain = WeightsDomain::surface; ///< which it was
  /// What `problem` began with: of volume, embedding and a cage of faces.
  TetrahedralizeResult tets;
  TriangleMesh plane_cage; ///< the same of a cage of edges
  WeightsProblem problem;
  WeightsResult solved; ///< at the vertices of problem.mesh
};

struct SurfaceWeightsOptions
{
  WeightsDomain domain = WeightsDomain::automatic;
  /// Inside is where the winding number is at least this, > 0.
  double winding_threshold = 0.5;
  /// embedding: lattice cubes along the longest side, 6 … 1000; 0: chosen by the guard.
  Index resolution = 0;
  /// embedding: lattices of several resolutions are solved until two agree. Off: a single one, of
  /// about 12,000 tets unless the resolution is given.
  bool guard = true;
  /// Carries the raw weights to the surface's points, too.
  bool keep_raw = false;
  /// What of the handles becomes part of a volume's tets.
  HandlePlaces places;
  /// Where set: called with the weights of preview_weights at the surface's points, once, as soon
  /// as they are there, while the method itself goes on afterwards. On the caller's thread.
  std::function<void(const Weights&)> preview;
};

/// Weights at a surface's own points, solved in its inside.
///
/// **volume**: conforming tets; the surface's points are among their vertices or are taken from the
/// nearest (transfer). **embedding**: tets of a lattice, whatever the surface's size, weighted by
/// the fraction of each that is inside. Parts that are near but not connected stay apart, but a
/// part without a handle is held by the parts that it touches (nearer than 1/500 of the diagonal),
/// or by the nearest one (link_parts), with one warning. The handles become vertices, bones every
/// half cube, and the solution is carried to the surface smoothly (EmbeddedSurface). A **guard**
/// compares lattices: a first one of about 4,500 tets with a second one of 3/2 of its resolution,
/// and that one with a finer third one if the two differ by more than 0.016 rms and the third is
/// predicted to take at most 20 s on one thread. The finest that converged is the result; it
/// differs from the weights of much finer lattices by about a hundredth (rms). If the last two
/// still differ more, there is a warning with both numbers. With a given resolution, it is compared
/// with two thirds of it.
///
/// **automatic** always ends in certified weights where the embedding converges: if the first
/// choice fails or does not converge, the embedding takes over, with one warning. An error of the
/// first choice is returned only if the embedding fails, too.
///
/// **cage**: the handles' own cage is filled (fill_cage). A surface that reaches out of it gets the
/// nearest weights, with a warning.
///
/// Report besides the method's keys: domain ("surface", "volume", "embedding", "cage"); of
/// automatic domain_reason and, where the embedding took over, domain_fallback.from,
/// domain_fallback.status, domain_fallback.message; tetrahedralize.method, embedding.resolution,
/// guard.resolution, guard.rms_difference, guard.max_difference, counts.linked_parts and
/// counts.links (parts without a handle, and what holds them); with a preview
/// preview.rms_difference and preview.max_difference (from the result); cage.area and
/// cage.min_angle (degrees, of the triangles of a cage of edges); what tetrahedralize() and
/// transfer() report. The certificate is that of the columns in the tets.
/// Errors: those of the parts; regions with domain embedding: invalid_input.
/// @param region_ids label of every vertex, or empty.
Status surface_weights(PointsView points, TrianglesView triangles,
  const std::vector<Index>& region_ids, const Handles& handles,
  const SurfaceWeightsOptions& options, const WeightsOptions& weights_options,
  const WeightsMethod& method, ExecutionContext& context, SurfaceWeights& result);

} // namespace bindpose

#endif
