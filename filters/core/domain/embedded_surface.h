#ifndef bindpose_domain_embedded_surface_h
#define bindpose_domain_embedded_surface_h

#include "base/execution.h"
#include "domain/handle_insertion.h"
#include "embedding/embedding_tets.h"
#include "geometry/simplex_locator.h"

#include <array>
#include <unordered_map>
#include <vector>

namespace bindpose
{

/// A surface in the tets of its embedding, a lattice that contains the surface. This class
/// transfers weights from the coarse tets to the surface. Two parts of a surface can be near each
/// other without being connected. The lattice keeps such parts separate, so several tets may have
/// the same position. These tets are called copies.
class EmbeddedSurface
{
public:
  /// The constructor stores references, so all arguments must outlive this object.
  /// @param surface locator of the points and triangles; shared by the lattices of all resolutions.
  /// @param lattice,binding a lattice that contains the points (embed_surface).
  EmbeddedSurface(PointsView points, TrianglesView triangles, const SimplexLocator& surface,
    const TetMesh& lattice, const PointBinding& binding);

  /// Return the lattice's tets as a domain, with the surface's points and the fraction of each tet
  /// that is inside. Fractions below 0.03 are set to 0.03, so that a tet that is almost empty still
  /// connects its corners.
  Domain domain(const Eigen::VectorXd& inside_fractions) const;

  /// Return the tet that contains a point. If no tet contains the point, return the nearest tet. If
  /// this tet has copies, return the copy that is connected to the surface point nearest to the
  /// given point. Thread-safe.
  Index tet_of(const Vec3& position) const;

  /// Whether transferred values are smoothed along the surface. Interpolated values are good enough
  /// for comparing lattices but not for display, because their second derivatives are discontinuous
  /// between tets.
  enum class Smoothness
  {
    as_interpolated,
    smoothed
  };

  /// Compute values at the surface's points (#V x #columns) from values at the vertices of the
  /// lattice in which the handles were inserted. Linear interpolation would make the edges of the
  /// tets visible on the surface. Therefore each corner contributes its value plus its gradient
  /// times half of the vector from the corner to the point. The barycentric mean of the four
  /// contributions is clamped to the column's range. With Smoothness::smoothed, the clamped values
  /// are smoothed along the surface over 0.3 times the lattice spacing (smooth_on_surface), except
  /// at points on handles. Finally, values below 1e-12 are set to 0.
  Status transfer_values(ExecutionContext& context, const HandleInsertion& mesh,
    const Handles& handles, WeightsView values, Smoothness smoothness, Weights& result) const;

private:
  using LatticePosition = std::array<Index, 3>;
  struct LatticePositionHash
  {
    std::size_t operator()(const LatticePosition& position) const;
  };
  LatticePosition center_of(Index tet) const;
  Status interpolate(ExecutionContext& context, const HandleInsertion& mesh, WeightsView values,
    Weights& result) const;
  /// @param fixed_points ids of points whose values do not change.
  Status smooth(ExecutionContext& context, const std::vector<Index>& fixed_points, double length,
    Weights& result) const;
  Index point_at(const Vec3& position) const;

  PointsView points_;
  TrianglesView triangles_;
  const TetMesh& lattice_;
  const PointBinding& binding_;
  SimplexLocator tets_;
  const SimplexLocator& surface_;
  double spacing_ = 0.0; ///< edge length of a lattice cube, which is the longest edge of a tet
  /// Ids of the copies of a tet. The key is the center of the tet (see center_of). Tets without
  /// copies are not stored.
  std::unordered_map<LatticePosition, std::vector<Index>, LatticePositionHash> copies_;
  /// Corners grouped by vertex, as 4 * tet + corner.
  std::vector<Index> first_corner_, corners_of_vertex_;
};

} // namespace bindpose

#endif
