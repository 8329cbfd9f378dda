#ifndef bindpose_tests_support_curves_h
#define bindpose_tests_support_curves_h

#include "geometry/mesh.h"

#include <vector>

namespace bindpose::test
{

/// A curve in the plane: points, and segments between them.
struct Curve
{
  PlanePoints points{ 0, 2 };
  Segments segments{ 0, 2 };

  /// Append vertices, and a segment from each vertex to the next. If `closed` is true, also append
  /// a segment from the last vertex to the first.
  void add(const std::vector<Vec2>& vertices, bool closed)
  {
    const Index first = this->points.rows();
    const auto count = static_cast<Index>(vertices.size());
    this->points.conservativeResize(first + count, 2);
    for (Index i = 0; i < count; ++i)
    {
      this->points.row(first + i) = vertices[i].transpose();
    }
    const Index added = closed ? count : count - 1;
    const Index before = this->segments.rows();
    this->segments.conservativeResize(before + added, 2);
    for (Index i = 0; i < added; ++i)
    {
      this->segments.row(before + i) << first + i, first + (i + 1) % count;
    }
  }
  void add_segment(Index from, Index to)
  {
    this->segments.conservativeResize(this->segments.rows() + 1, 2);
    this->segments.row(this->segments.rows() - 1) << from, to;
  }
};

} // namespace bindpose::test

#endif
