#ifndef bindpose_inside_signed_crossings_h
#define bindpose_inside_signed_crossings_h

#include "base/execution.h"
#include "base/mesh.h"

#include <cstdint>

namespace bindpose
{

/// Exact winding numbers from the crossings of one ray and the surface's boundary edges (Martens,
/// Trettner, Bessmeltsev, the antipodal method, 2026; here with parallel rays).
///
/// Triangles are sorted into the cells of a plane grid, the ray of a point meets those of one cell.
/// A closed surface needs nothing else: tens of nanoseconds a point. An open one adds about 15 ns
/// per boundary edge. Not for points on the surface or next to a boundary edge.
class SignedCrossings
{
public:
  /// Points are centred and scaled, equal points are one vertex, ids below 2^31.
  /// @return false when cancelled.
  bool build(const Points& points, const Triangles& triangles, const std::vector<Edge>& edges,
    double tolerance, ExecutionContext& context);

  /// Thread-safe. @return false when the point touches the surface or is so near a boundary edge
  /// that digits would be lost: ask somebody else.
  bool evaluate(const Vec3& point, double& winding_number) const;

  /// Bytes held.
  Index memory() const;

private:
  using Id = std::int32_t;
  struct Face
  {
    Vec3 lower, upper;
    Id a, b, c;
  };
  struct Rim
  {
    Vec3 a, b; ///< runs a -> b
    double multiplicity;
  };

  void choose_cells(const Box& box);
  Index cell_of(double x, int direction) const;
  bool crossing(const Face& face, const Vec3& point, int& count) const;
  bool walls(const Vec3& point, double& turns) const;

  std::array<int, 3> axes_{ 0, 1, 2 }; ///< the ray runs along the last
  double tolerance_ = 0.0;
  std::vector<Vec3> points_;
  std::vector<Face> faces_;
  std::vector<Rim> rims_;
  Vec3 lower_ = Vec3::Zero();
  double cell_size_ = 1.0;
  std::array<Index, 2> cells_{ 1, 1 };
  std::vector<Index> first_; ///< of each cell in members_
  std::vector<Id> members_;
};

} // namespace bindpose

#endif
