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
  /// Choose a domain automatically. A flat shape is solved on its own triangles. A closed, clean
  /// surface is solved in its volume if that is predicted to be well conditioned and cheap
  /// (domain_choice.h). A surface with regions or with terms for individual points is also solved
  /// in its volume. All other surfaces are solved in the embedding, which is also used if the first
  /// choice fails.
  automatic = 1,
  /// Solve in tets of the inside that preserve the surface (tetrahedralize, method auto).
  volume = 2,
  embedding = 3, ///< Solve in a lattice that contains the surface (tetrahedralize, method embed).
  /// Solve in tets of a closed cage of faces around the surface. For a flat shape, solve in
  /// triangles of a closed cage of edges around the shape.
  cage = 4
};

/// Return "surface", "auto", "volume", "embedding" or "cage".
const char* to_string(WeightsDomain domain);

/// A weight method (bounded_biharmonic_weights, monotone_weights, …) as a function; its options are
/// already stored in it.
using WeightsMethod =
  std::function<Status(const WeightsProblem&, ExecutionContext&, WeightsResult&)>;

/// The result of surface_weights().
struct SurfaceWeights
{
  Weights weights; ///< #V x #handles at the surface's points, rows sum to one
  /// The weights before rows are divided by their sums; empty unless
  /// SurfaceWeightsOptions::keep_raw.
  Weights raw;
  WeightsDomain domain = WeightsDomain::surface; ///< the domain that was used
  /// The tets before handles were inserted; for domains volume, embedding, and cage with faces.
  TetrahedralizeResult tets;
  TriangleMesh plane_cage; ///< the triangles before handles were inserted; for a cage of edges
  WeightsProblem problem;
  WeightsResult solved; ///< the weights at the vertices of problem.mesh
};

/// Options of surface_weights().
struct SurfaceWeightsOptions
{
  WeightsDomain domain = WeightsDomain::automatic;
  /// Points with at least this winding number are inside, > 0.
  double winding_threshold = 0.5;
  /// embedding: number of lattice cubes along the longest side, 6 … 1000; 0: chosen automatically
  /// (see `guard`)
  Index resolution = 0;
  /// embedding: solve on lattices of increasing resolution until two agree (see surface_weights).
  /// If off, solve on a single lattice, with about 12,000 tets if no resolution is given.
  bool guard = true;
  /// Transfer the raw weights to the surface's points, too.
  bool keep_raw = false;
  /// Handle geometry (such as bones) that becomes part of the volume's tets.
  HandlePlaces places;
  /// If set, this function is called once with the weights of preview_weights at the surface's
  /// points, before the method itself runs. The call is made in the caller's thread.
  std::function<void(const Weights&)> preview;
};

/// Compute weights at a surface's own points, solved in one of these domains of its inside.
///
/// **volume**: conforming tets. The surface's points are usually vertices of the tets. A point that
/// is not a vertex gets the weights of the nearest point of the tets (transfer).
///
/// **embedding**: tets of a lattice, independent of the surface's resolution, weighted by the
/// fraction of each tet that is inside. Parts that are near each other but not connected stay
/// separate. A part without a handle is linked to the parts that it touches (within 1/500 of the
/// diagonal), or else to the nearest part (link_parts), with one warning. The handles become
/// vertices of the lattice; the samples of a bone are half a cube apart. The solution is
/// transferred to the surface and smoothed (EmbeddedSurface).
///
/// The **guard** compares the weights of two lattices. The first lattice has about 4,500 tets; the
/// second has 3/2 of its resolution. If the weights of these two differ by more than 0.016 rms, and
/// a finer third lattice is predicted to take at most 20 s on one thread, the second is compared
/// with the third. The result is the finest lattice that converged. Its weights differ from the
/// weights of much finer lattices by about 0.01 rms. If the last two lattices still differ by more
/// than 0.016 rms, a warning reports the rms difference and the largest difference. If the caller
/// specifies a resolution, the lattice with this resolution is compared with a lattice with two
/// thirds of this resolution.
///
/// **automatic** returns certified weights whenever the embedding converges. If the first choice
/// fails or does not converge, the embedding is used instead, with one warning. An error of the
/// first choice is returned only if the embedding fails, too.
///
/// **cage**: the handles' own cage is filled (fill_cage). Points of the surface outside of the cage
/// get the nearest weights, with a warning.
///
/// Report, in addition to the keys of the method:
/// - domain ("surface", "volume", "embedding", "cage");
/// - for automatic: domain_reason and, if the embedding replaced the first choice,
///   domain_fallback.from, domain_fallback.status, domain_fallback.message;
/// - tetrahedralize.method, embedding.resolution;
/// - guard.resolution, guard.rms_difference, guard.max_difference;
/// - counts.linked_parts and counts.links (parts without a handle, and their links);
/// - with a preview: preview.rms_difference and preview.max_difference, its differences from the
///   result;
/// - for a cage of edges: cage.area and cage.min_angle (degrees) of its triangles;
/// - the reports of tetrahedralize() and transfer().
///
/// The certificate is computed for the columns in the tets. Errors of meshing, insertion, method
/// and transfer are returned. Regions with domain embedding are invalid_input.
/// @param region_ids label of every vertex, or empty.
Status surface_weights(PointsView points, TrianglesView triangles,
  const std::vector<Index>& region_ids, const Handles& handles,
  const SurfaceWeightsOptions& options, const WeightsOptions& weights_options,
  const WeightsMethod& method, ExecutionContext& context, SurfaceWeights& result);

} // namespace bindpose

#endif
