// Heuristics of the domain "automatic" (surface_weights.h). They choose between conforming tets and
// an embedding lattice.
#include "domain/domain_choice.h"

#include "base/number_text.h"
#include "surface/triangle_shape.h"
#include "tets/tet_quality.h"

#include <algorithm>
#include <cmath>

namespace bindpose
{

namespace
{
/// Maximum number of triangles for conforming tets. Tets for weights had 3 to 5 times as many
/// vertices as surfaces of scanned and modeled shapes, so reason_against_tets() would reject the
/// tets of larger surfaces.
constexpr Index maximum_triangles = 9600;
/// A triangle with an angle below this counts as badly shaped, because a tet at such a triangle is
/// badly shaped, too. A tet counts as badly shaped if a dihedral angle is below 5 degrees.
constexpr double bad_angle = 2.0; // degrees
/// Maximum fractions of badly shaped triangles and of badly shaped tets. In measurements on real
/// furniture models, all tet meshes on which solves failed exceeded these fractions.
constexpr double maximum_bad_triangles = 0.02;
constexpr double maximum_bad_tets = 0.03;
/// With an embedding, the weights are solved on a coarse and a fine lattice, and the two results
/// are compared (the guard, see surface_weights.h). This is the approximate number of vertices of
/// the fine lattice.
constexpr Index typical_lattice_vertices = 9000;
/// Time to solve on both lattices, divided by the time to solve on the fine lattice.
constexpr double two_lattice_factor = 1.3;

std::string percent_of(Index part, Index total)
{
  return short_number(100.0 * static_cast<double>(part) / static_cast<double>(total), 2) + " %";
}
} // namespace

std::string reason_against_volume(const RepairedSurface& surface)
{
  const Index count = surface.triangles.rows();
  if (!surface.closed)
  {
    return "the surface is not closed";
  }
  if (!surface.is_clean())
  {
    return "triangles cross or coincide";
  }
  if (count > maximum_triangles)
  {
    return "the surface has many triangles";
  }
  const Index bad = count_needles(surface.points, surface.triangles, bad_angle);
  return static_cast<double>(bad) > maximum_bad_triangles * static_cast<double>(count)
    ? percent_of(bad, count) + " of the triangles have an angle below " + short_number(bad_angle) +
      " degrees"
    : std::string();
}

std::string reason_against_tets(const TetMesh& tets, Index handle_count)
{
  const Index count = tets.tets.rows();
  const TetQuality quality = measure_tets(tets.points, tets.tets);
  if (static_cast<double>(quality.below_5_degrees) > maximum_bad_tets * static_cast<double>(count))
  {
    return percent_of(quality.below_5_degrees, count) +
      " of the tets have a dihedral angle below 5 degrees";
  }
  const double tet_seconds = predicted_seconds(tets.points.rows(), handle_count);
  const double lattice_seconds =
    two_lattice_factor * predicted_seconds(typical_lattice_vertices, handle_count);
  // Conforming tets preserve the surface. Therefore lattices are used only if the predicted time of
  // the tets exceeds that of the lattices by more than this factor.
  constexpr double allowed_time_ratio = 2.0;
  return tet_seconds > allowed_time_ratio * lattice_seconds
    ? std::to_string(count) + " tets would take about " + short_number(tet_seconds, 2) +
      " s, a lattice " + short_number(lattice_seconds, 2) + " s"
    : std::string();
}

double predicted_seconds(Index vertices, Index handle_count)
{
  const double relative_size = static_cast<double>(vertices) / 12000.0;
  constexpr double factorization = 0.1;
  constexpr double per_column = 6.0;
  return factorization * relative_size * relative_size *
    (2.0 + per_column * static_cast<double>(handle_count));
}

} // namespace bindpose
