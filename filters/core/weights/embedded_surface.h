#ifndef bindpose_weights_embedded_surface_h
#define bindpose_weights_embedded_surface_h

#include "base/execution.h"
#include "base/simplex_locator.h"
#include "embedding/embedding_tets.h"
#include "weights/handle_insertion.h"

#include <array>
#include <unordered_map>
#include <vector>

namespace bindpose
{

/// A surface in the tets of its embedding: tells weights on the surface from weights on coarse
/// tets, some of which lie at the same place (parts that are near but not connected).
class EmbeddedSurface
{
public:
  /// Keeps references: all must outlive it.
  /// @param surface of the points and triangles; it serves the lattices of all resolutions.
  /// @param lattice,binding a lattice that holds the points (embed_surface).
  EmbeddedSurface(PointsView points, TrianglesView triangles, const SimplexLocator& surface,
    const TetMesh& lattice, const PointBinding& binding);

  /// The lattice's tets with their fractions of material, none below 0.03: a tet that has almost
  /// none still ties its corners together. With the surface's points.
  Domain domain(const Eigen::VectorXd& inside_fractions) const;

  /// The tet that holds a place, or the nearest; of copies the one that is connected with the
  /// surface's nearest point. Thread-safe.
  Index tet_of(const Vec3& place) const;

  /// Whether carried values are smoothed along the surface. As interpolated they are good enough to
  /// be compared, not to be looked at: second derivatives jump from tet to tet.
  enum class Smoothness
  {
    as_interpolated,
    smoothed
  };

  /// Values at the surface's points (#V x #columns) from values at the vertices of the lattice with
  /// handles. Linear interpolation would show every tet, so each corner adds half of what its
  /// gradient says and the sum is clamped to the column's range; smoothed along the surface over
  /// 0.3 of the lattice's spacing (smooth_on_surface), except at points that lie on handles.
  Status carry(const HandleInsertion& mesh, const Handles& handles, WeightsView values,
    Smoothness smoothness, ExecutionContext& context, Weights& result) const;

private:
  using Place = std::array<Index, 3>;
  struct PlaceHash
  {
    std::size_t operator()(const Place& place) const;
  };
  Place centre_of(Index tet) const;
  Status interpolate(const HandleInsertion& mesh, WeightsView values, ExecutionContext& context,
    Weights& result) const;
  /// @param fixed_points ids of points whose values stay.
  Status smooth(const std::vector<Index>& fixed_points, double length, ExecutionContext& context,
    Weights& result) const;
  Index point_at(const Vec3& place) const;

  PointsView points_;
  TrianglesView triangles_;
  const TetMesh& lattice_;
  const PointBinding& binding_;
  SimplexLocator tets_;
  const SimplexLocator& surface_;
  double spacing_ = 0.0; ///< of the lattice: side of a cube, the longest edge of a tet
  std::unordered_map<Place, std::vector<Index>, PlaceHash> copies_; ///< of tets that have some
  std::vector<Index> first_corner_, corners_at_; ///< of each vertex: 4 * tet + corner
};

} // namespace bindpose

#endif
