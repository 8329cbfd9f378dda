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

  /// For up to `most_at_once` points; more than one, and the memory for the next is on its way
  /// while one is looked at. A point that touches a triangle or a cap is said to: its count means
  /// nothing, ask somebody else. Thread-safe.
  static constexpr Index most_at_once = 32;
  void evaluate(const Vec3* points, Index number, int* counts, bool* touching) const;

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
    Id a, b, c;
  };
  /// Some faces of a cell with their bounds, rounded down in steps of the cell: what a point's own
  /// place in steps is compared with, eight at once. Nothing is lost, and few faces have to be
  /// looked at themselves.
  using Lanes = std::uint8_t __attribute__((vector_size(8)));
  struct Block
  {
    Lanes x_lower, x_upper, y_lower, y_upper, z_upper;
    Id face[8];
  };
  struct Place
  {
    std::uint8_t x, y, z;
    Id begin, end; ///< of the cell's blocks
  };

  void choose_cells(const Box& box);
  void bounds(const Face& face, Vec3& lower, Vec3& upper) const;
  Index cell_of(double x, int direction) const;
  std::uint8_t step_of(double x, Index cell, int direction) const;
  std::uint8_t height_of(double z) const;
  /// false: the ray through the point meets nothing.
  bool place_of(const Vec3& point, Place& place) const;
  /// Calls look(id) for each face whose bounds the ray from the place meets.
  template <typename Look>
  void each_face(const Place& place, const Look& look) const;
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
  double height_ = 1.0;
  double cell_size_ = 1.0;
  std::array<Index, 2> cells_{ 1, 1 };
  std::vector<Id> first_; ///< of each cell in blocks_
  std::vector<Block> blocks_;
};

} // namespace bindpose

#endif
