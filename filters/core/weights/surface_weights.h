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
  surface = 0, ///< Solve on the surface's own triangles.
  /// Choose a domain automatically. A flat shape is solved on its own triangles. A surface with
  /// regions or with terms for individual points is solved in its volume. A closed, clean surface
  /// is also solved in its volume if the volume is predicted to be well conditioned and cheap
  /// (domain_choice.h). All other surfaces are solved in the embedding. If another domain fails,
  /// the embedding is used instead, except for regions and for terms of individual points.
  automatic = 1,
  /// Solve in tets that fill the surface's inside and preserve the surface (tetrahedralize, method
  /// auto).
  volume = 2,
  embedding = 3, ///< Solve in a lattice that contains the surface (tetrahedralize, method embed).
  /// Solve inside a closed cage around the surface. The cage consists of faces and is filled with
  /// tets. For a flat shape, the cage consists of edges and is filled with triangles.
  cage = 4
};

/// Return "surface", "auto", "volume", "embedding" or "cage".
const char* to_string(WeightsDomain domain);

/// A weight method (bounded_biharmonic_weights, monotone_weights, …) as a function that already
/// contains its options.
using WeightsMethod =
  std::function<Status(ExecutionContext&, const WeightsProblem&, WeightsResult&)>;

/// The result of surface_weights().
struct SurfaceWeights
{
  Weights weights; ///< #V x #handles at the surface's points, rows sum to one
  /// The weights before rows are divided by their sums; empty unless
  /// SurfaceWeightsOptions::keep_raw is set.
  Weights raw;
  WeightsDomain domain = WeightsDomain::surface; ///< the domain that was used
  /// The tets before handles were inserted. Empty for domain surface and for a cage of edges.
  TetrahedralizeResult tets;
  /// The triangles that fill a cage of edges, before handles were inserted. Empty for other
  /// domains.
  TriangleMesh plane_cage;
  WeightsProblem problem;
  WeightsResult solved; ///< the weights at the vertices of problem.mesh
};

/// Options of surface_weights().
struct SurfaceWeightsOptions
{
  WeightsDomain domain = WeightsDomain::automatic;
  /// Threshold (> 0): a point is inside if its winding number is at least this value.
  double winding_threshold = 0.5;
  /// Domain embedding: resolution of the lattice, 6 … 1000; 0: chosen automatically (see
  /// `check_resolution`). The resolution is the number of lattice cubes along the longest side of
  /// the bounding box.
  Index resolution = 0;
  /// Domain embedding: if true, solve on lattices of increasing resolution until the weights on two
  /// lattices agree (see surface_weights). If false, solve on a single lattice, with about 12,000
  /// tets if no resolution is given.
  bool check_resolution = true;
  /// If true, the raw weights are also computed at the surface's points (see SurfaceWeights::raw).
  bool keep_raw = false;
  /// Handle geometry (such as bones) that becomes part of the volume's tets.
  HandleElements handle_elements;
  /// If set, this function is called once, before the method runs, on the caller's thread. Its
  /// argument contains the weights of preview_weights() at the surface's points.
  std::function<void(const Weights&)> preview;
};

/// Compute weights at the points of a surface. The weights are solved in one of the following
/// domains. Domain **surface** is the surface itself.
///
/// **volume**: conforming tets. The surface's points are usually vertices of the tets. A point that
/// is not a vertex gets the weights of the nearest point of the tets (transfer).
///
/// **embedding**: tets of a lattice whose resolution does not depend on the surface's resolution.
/// The energy of each tet is multiplied by the fraction of the tet that is inside the surface.
/// Parts that are near each other but not connected stay separate. A part is linked to the parts
/// that cover one of its openings (find_covered_openings). For example, a knob whose open bottom is
/// covered by a plate is linked to the plate. A part without a handle is linked to the parts that
/// it touches (within 1/500 of the diagonal), or else to the nearest part (link_parts), with one
/// warning. The handles become vertices of the lattice; samples of a bone are half the edge of a
/// lattice cube apart. The solution is transferred to the surface and smoothed (EmbeddedSurface).
///
/// The **guard** compares the weights of two lattices. The first lattice has about 4,500 tets; the
/// second lattice has 3/2 times the resolution of the first. If the weights of the first two
/// lattices differ by more than 0.016 rms, the second lattice is compared with a third, finer
/// lattice. The third lattice is omitted if its predicted time is above 20 s on one thread. The
/// result is the finest lattice that converged. Its weights differ from the weights of much finer
/// lattices by about 0.01 rms. If the last two lattices still differ by more than 0.016 rms, a
/// warning reports the rms difference and the largest difference. If the caller specifies a
/// resolution, the lattice with this resolution is compared with a lattice with two thirds of this
/// resolution.
///
/// **automatic** chooses a domain (see WeightsDomain::automatic). If the chosen domain fails or
/// does not converge, the embedding is used instead, with one warning. The error of the chosen
/// domain is returned if the embedding fails, too. There is no such fallback for a surface with
/// regions or with terms for individual points, unless the surface is flat.
///
/// **cage**: the closed cage that the cage vertices among the handles form is filled with tets or
/// triangles (fill_cage). Points of the surface outside of the cage get the weights of the nearest
/// point of the cage, with a warning.
///
/// Report, in addition to the keys of the method:
/// - domain ("surface", "volume", "embedding", "cage");
/// - for automatic: domain_reason and, if the embedding replaced the first choice,
///   domain_fallback.from, domain_fallback.status, domain_fallback.message;
/// - tetrahedralize.method, embedding.resolution;
/// - guard.resolution, guard.rms_difference, guard.max_difference;
/// - if there are links: counts.covered_openings (openings that other parts cover),
///   counts.linked_parts (parts without a handle) and counts.links (links of both kinds);
/// - with a preview: preview.rms_difference and preview.max_difference (between preview and
///   result);
/// - for a cage of edges: cage.area and cage.min_angle (degrees) of the triangles in the cage;
/// - the reports of tetrahedralize() and transfer().
///
/// The certificate belongs to the weights at the vertices of the domain, before the transfer to the
/// surface. Errors of meshing, handle insertion, method and transfer are returned. Return
/// invalid_input for regions with domain embedding.
/// @param region_ids label of every vertex, or empty.
Status surface_weights(ExecutionContext& context, PointsView points, TrianglesView triangles,
  const std::vector<Index>& region_ids, const Handles& handles,
  const SurfaceWeightsOptions& options, const WeightsOptions& weights_options,
  const WeightsMethod& method, SurfaceWeights& result);

} // namespace bindpose

#endif
