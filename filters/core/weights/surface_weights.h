#ifndef bindpose_weights_surface_weights_h
#define bindpose_weights_surface_weights_h

#include "inside/tetrahedralize.h"
#include "weights/weights_problem.h"

#include <functional>

namespace bindpose
{

/// The domain on which the weights of a surface are solved. The integer values are those of
/// vtkWeightsAlgorithm.
enum class WeightsDomain : int
{
  surface = 0, ///< on the triangles
  /// Choose a domain. A flat shape is solved on its own triangles. A closed, clean surface is
  /// solved in its volume if that is predicted to be well conditioned and cheap (domain_choice.h);
  /// so is every surface with regions or with terms for individual points. All others are solved in
  /// the embedding, which also takes over if the first choice fails.
  automatic = 1,
  volume = 2, ///< in tets of the inside that preserve the surface (tetrahedralize, auto)
  embedding = 3, ///< in a lattice that contains the surface (tetrahedralize, embed)
  /// In tets of a closed cage of faces around the surface. For a flat shape, in triangles of a
  /// closed cage of edges around it.
  cage = 4
};

/// Return "surface", "auto", "volume", "embedding" or "cage".
const char* to_string(WeightsDomain domain);

/// A method (bounded_biharmonic_weights, monotone_weights, …) with its options bound.
using WeightsMethod =
  std::function<Status(const WeightsProblem&, ExecutionContext&, WeightsResult&)>;

struct SurfaceWeights
{
  Weights weights; ///< #V x #handles at the surface's points, rows sum to one
  /// The weights before rows are divided by their sums; empty unless
  /// SurfaceWeightsOptions::keep_raw.
  Weights raw;
  WeightsDomain domain = WeightsDomain::surface; ///< the domain that was used
  /// The tets before handles were inserted; for volume, embedding and a cage of faces.
  TetrahedralizeResult tets;
  TriangleMesh plane_cage; ///< the triangles before handles were inserted, for a cage of edges
  WeightsProblem problem;
  WeightsResult solved; ///< at the vertices of problem.mesh
};

struct SurfaceWeightsOptions
{
  WeightsDomain domain = WeightsDomain::automatic;
  /// Points with at least this winding number are inside, > 0.
  double winding_threshold = 0.5;
  /// embedding: lattice cubes along the longest side, 6 … 1000; 0: chosen by the guard.
  Index resolution = 0;
  /// embedding: solve on lattices of several resolutions until two agree. Off: solve on a single
  /// lattice, of about 12,000 tets if no resolution is given.
  bool guard = true;
  /// Transfer the raw weights to the surface's points, too.
  bool keep_raw = false;
  /// Handle geometry that becomes part of a volume's tets.
  HandlePlaces places;
  /// If set, called once with the weights of preview_weights at the surface's points, before the
  /// method itself runs. The call is on the caller's thread.
  std::function<void(const Weights&)> preview;
};

/// Compute weights at a surface's own points, solved in its inside.
///
/// **volume**: conforming tets. The surface's points are among the vertices of the tets, or take
/// their weights from the nearest point of the tets (transfer).
///
/// **embedding**: tets of a lattice, independent of the surface's resolution, weighted by the
/// fraction of each tet that is inside. Parts that are near each other but not connected stay
/// separate. A part without a handle is linked to the parts that it touches (nearer than 1/500 of
/// the diagonal), or to the nearest one (link_parts), with one warning. The handles become
/// vertices; bones are sampled every half cube. The solution is transferred to the surface and
/// smoothed (EmbeddedSurface).
///
/// The **guard** compares lattices. The first has about 4,500 tets, the second 3/2 of its
/// resolution. If these two differ by more than 0.016 rms, and a finer third one is predicted to
/// take at most 20 s on one thread, the second is compared with the third. The result is the finest
/// lattice that converged. It differs from the weights of much finer lattices by about 0.01 rms. If
/// the last two lattices still differ by more than 0.016 rms, a warning reports the rms and the
/// largest difference. A given resolution is compared with two thirds of it.
///
/// **automatic** always returns certified weights if the embedding converges. If the first choice
/// fails or does not converge, the embedding takes over, with one warning. An error of the first
/// choice is returned only if the embedding fails, too.
///
/// **cage**: the handles' own cage is filled (fill_cage). Points of the surface outside of the cage
/// get the nearest weights, with a warning.
///
/// Report, in addition to the method's keys:
/// - domain ("surface", "volume", "embedding", "cage");
/// - for automatic: domain_reason and, if the embedding took over, domain_fallback.from,
///   domain_fallback.status, domain_fallback.message;
/// - tetrahedralize.method, embedding.resolution;
/// - guard.resolution, guard.rms_difference, guard.max_difference;
/// - counts.linked_parts and counts.links (parts without a handle, and their links);
/// - with a preview: preview.rms_difference and preview.max_difference (from the result);
/// - for a cage of edges: cage.area and cage.min_angle (degrees) of its triangles;
/// - the reports of tetrahedralize() and transfer().
///
/// The certificate is that of the columns in the tets. Errors are those of the steps; regions with
/// domain embedding are invalid_input.
/// @param region_ids label of every vertex, or empty.
Status surface_weights(PointsView points, TrianglesView triangles,
  const std::vector<Index>& region_ids, const Handles& handles,
  const SurfaceWeightsOptions& options, const WeightsOptions& weights_options,
  const WeightsMethod& method, ExecutionContext& context, SurfaceWeights& result);

} // namespace bindpose

#endif
