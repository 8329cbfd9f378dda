#ifndef bindpose_mesher_circumcenter_traits_h
#define bindpose_mesher_circumcenter_traits_h

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Robust_weighted_circumcenter_filtered_traits_3.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace bindpose
{

using RobustTraits = CGAL::Robust_weighted_circumcenter_filtered_traits_3<
  CGAL::Exact_predicates_inexact_constructions_kernel>;
using RobustCircumcenter = RobustTraits::Construct_weighted_circumcenter_3;

/// Constructs circumcenters that have the same distance from all corners. Without this class,
/// Mesh_3 accepts any point within the circumsphere as the center. For a flat cell (four points on
/// a circle, as in every square of a grid) rounding may give a point far from the exact center.
/// Then the segments between centers of neighboring cells cross the surface at a wrong position,
/// and refinement repeatedly splits there, down to edges of 1e-7 of the bounding-box diagonal.
class Circumcenter : public RobustCircumcenter
{
public:
  using Point = RobustTraits::Point_3;
  using WeightedPoint = RobustTraits::Weighted_point_3;

  explicit Circumcenter(const RobustCircumcenter& robust) : RobustCircumcenter(robust) {}
  using RobustCircumcenter::operator();
  Point operator()(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r,
    const WeightedPoint& s, bool exact = false) const
  {
    const Point center = RobustCircumcenter::operator()(p, q, r, s, exact);
    return exact || is_accurate(center, p, q, r, s)
      ? center
      : RobustCircumcenter::operator()(p, q, r, s, true);
  }

private:
  /// Report whether the center is accurate enough: its distances from q, r and s differ from its
  /// distance from p by less than a millionth of the shortest edge at p.
  static bool is_accurate(const Point& center, const WeightedPoint& p, const WeightedPoint& q,
    const WeightedPoint& r, const WeightedPoint& s)
  {
    constexpr double tolerance = 2e-6;
    const double radius = CGAL::squared_distance(center, p.point());
    double difference = 0.0;
    double edge = std::numeric_limits<double>::max();
    for (const auto* other : { &q, &r, &s })
    {
      difference =
        std::max(difference, std::abs(CGAL::squared_distance(center, other->point()) - radius));
      edge = std::min(edge, CGAL::squared_distance(p.point(), other->point()));
    }
    return difference * difference <= tolerance * tolerance * radius * edge;
  }
};

struct CircumcenterTraits : RobustTraits
{
  using Construct_weighted_circumcenter_3 = Circumcenter; // CGAL prescribes this type name
  Circumcenter construct_weighted_circumcenter_3_object() const
  {
    return Circumcenter(RobustTraits::construct_weighted_circumcenter_3_object());
  }
};

/// Tag that is passed to Mesh_triangulation_3 in place of a kernel and selects CircumcenterTraits.
struct CircumcenterKernel
{
};

} // namespace bindpose

template <>
struct CGAL::details::Mesh_geom_traits_generator<bindpose::CircumcenterKernel>
{
  using type = bindpose::CircumcenterTraits;
  using Type = type;
};

#endif
