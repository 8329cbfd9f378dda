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
  /// A flat shape on itself. Up to 20,000 triangles, and with regions, in the volume, unless that
  /// has more than 120,000 tets or none; else in the embedding, unless the guard is not content.
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
  Weights raw; ///< the same before rows are divided by their sums
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
  /// embedding: lattice cubes along the longest side, 6 … 1000; 0: about 30,000 tets.
  Index resolution = 0;
  /// The guard of the embedding: it is solved on two thirds of the resolution, too. Off: not.
  bool guard = true;
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
/// how much of each is inside, parts that are near but not connected apart; the handles become
/// vertices, bones every half cube; what is solved is carried to the surface smoothly
/// (EmbeddedSurface). It differs from the volume's weights by a few hundredths, so a **guard**
/// solves on two thirds of the resolution as well: where the two differ by more than 0.02 rms or
/// 0.3 anywhere, the resolution is made 4/3 as fine and compared again; if they still do, `auto`
/// takes the volume, and `embedding` warns.
///
/// **cage**: the handles' own cage is filled, with tets (tetrahedralize) or, where it is of edges
/// in the plane of a flat shape, with triangles (planar_shape). The surface's points (of up to
/// 20,000 of them) become vertices; a surface that reaches out of it gets the nearest weights, with
/// a warning.
///
/// Report besides the method's keys: domain ("surface", "volume", "embedding",
/// "cage"), domain_reason (of
/// auto), tetrahedralize.method, embedding.resolution, guard.resolution, guard.rms_difference,
/// guard.max_difference, with a preview preview.rms_difference and
/// preview.max_difference (of it and the result), cage.area and cage.min_angle (degrees, of the
/// triangles of a cage of edges), and what tetrahedralize() and transfer() report.
/// The certificate is that of the columns in the tets. Errors: those of the parts. Regions and
/// domain embedding: invalid_input.
/// @param region_ids label of every vertex, or empty.
Status surface_weights(PointsView points, TrianglesView triangles,
  const std::vector<Index>& region_ids, const Handles& handles,
  const SurfaceWeightsOptions& options, const WeightsOptions& weights_options,
  const WeightsMethod& method, ExecutionContext& context, SurfaceWeights& result);

} // namespace bindpose

#endif
