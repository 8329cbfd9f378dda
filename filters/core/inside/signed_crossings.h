#ifndef bindpose_inside_signed_crossings_h
#define bindpose_inside_signed_crossings_h

#include "base/execution.h"
#include "base/mesh.h"

#include <cstdint>

namespace bindpose
{

/// Winding numbers of closed surfaces, whole numbers, exact: the signed crossings of a ray with the
/// surface.
///
/// Triangles are sorted into the cells of a plane grid, the ray of a point meets those of one cell:
/// tens of nanoseconds a point. A row of points along the ray shares the crossings: some
/// nanoseconds a point. Not for points on the surface.
class SignedCrossings
{
public:
  /// Triangles and the caps that close them (boundary_caps.h); together every edge's directions
  /// cancel. Points are centred and scaled, equal points are one vertex, ids below 2^31.
  /// @return false when cancelled.
  bool build(const Points& points, const Triangles& triangles, const Triangles& caps,
    double tolerance, ExecutionContext& context);

  /// Axis the rays run along, 0, 1, 2.
  int axis() const { return this->axes_[2]; }

  /// Thread-safe. @return false when the point touches a triangle or a cap: ask somebody else.
  bool evaluate(const Vec3& point, int& count) const;

  /// What a row needs besides its result; kept by the caller so that rows allocate nothing.
  struct Row
  {
    std::vector<std::int32_t> counts; ///< of each point
    std::vector<char> touching; ///< the point touches: its count is not meant
    bool any_touching = false;
  };
  /// The same for the points that share `point` but for the coordinate along the ray, which is
  /// places[0 … n), not decreasing. Thread-safe with a Row a thread.
  void evaluate_row(const Vec3& point, const std::vector<double>& places, Row& row) const;

  /// Bytes held.
  Index memory() const;

private:
  using Id = std::int32_t;
  struct Face
  {
    Vec3 lower, upper;
    Id a, b, c;
  };

  void choose_cells(const Box& box);
  Index cell_of(double x, int direction) const;
  /// Range of members_ that the ray through the point may meet; false: none.
  bool cell_at(double x, double y, Index& begin, Index& end) const;
  Vec3 turned(const Vec3& p) const
  {
    return { p[this->axes_[0]], p[this->axes_[1]], p[this->axes_[2]] };
  }
  bool crossing(const Face& face, const Vec3& point, int& count) const;
  void cross_row(const Face& face, Vec3 point, const std::vector<double>& places, Row& row) const;

  std::array<int, 3> axes_{ 0, 1, 2 }; ///< the ray runs along the last
  double tolerance_ = 0.0;
  std::vector<Vec3> points_;
  std::vector<Face> faces_;
  Vec3 lower_ = Vec3::Zero();
  double cell_size_ = 1.0;
  std::array<Index, 2> cells_{ 1, 1 };
  std::vector<Id> first_; ///< of each cell in members_
  std::vector<Id> members_;
};

} // namespace bindpose

#endif
