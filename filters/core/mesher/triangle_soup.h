#ifndef bindpose_mesher_triangle_soup_h
#define bindpose_mesher_triangle_soup_h

#include "mesher/jobs.h"

#include <array>
#include <vector>

namespace bindpose
{

/// Points and triangles in the form that CGAL requires.
template <typename Point>
struct TriangleSoup
{
  explicit TriangleSoup(const MesherData& data)
  {
    for (Index v = 0; v < data.points.rows(); ++v)
    {
      this->points.emplace_back(data.points(v, 0), data.points(v, 1), data.points(v, 2));
    }
    for (Index f = 0; f < data.triangles.rows(); ++f)
    {
      this->triangles.push_back({ static_cast<std::size_t>(data.triangles(f, 0)),
        static_cast<std::size_t>(data.triangles(f, 1)),
        static_cast<std::size_t>(data.triangles(f, 2)) });
    }
  }

  std::vector<Point> points;
  std::vector<std::array<std::size_t, 3>> triangles;
};

} // namespace bindpose

#endif
