#include "poser/tet_anchors.h"

#include "geometry/simplex_locator.h"

#include <algorithm>

namespace bindpose
{

TetAnchors::TetAnchors(PointsView surface, PointsView tet_points, TetsView tets)
{
  const SimplexLocator locator(tet_points, tets);
  this->anchors_.reserve(static_cast<std::size_t>(surface.rows()));
  for (Index v = 0; v < surface.rows(); ++v)
  {
    const Vec3 p = surface.row(v);
    const SimplexLocation location = locator.locate(p);
    Anchor anchor{ { 0, 0, 0, 0 }, location.barycentric };
    for (int k = 0; k < 4; ++k)
    {
      anchor.vertices[k] = tets(location.element, k);
    }
    for (int k = 0; k < 4; ++k)
    {
      if (Vec3(tet_points.row(anchor.vertices[k])) == p)
      {
        anchor = { { anchor.vertices[k], 0, 0, 0 }, { 1.0, 0.0, 0.0, 0.0 } };
        break;
      }
    }
    this->anchors_.push_back(anchor);
  }
}

std::vector<Index> TetAnchors::nearest_vertices() const
{
  std::vector<Index> nearest;
  for (const Anchor& anchor : this->anchors_)
  {
    const auto* largest = std::max_element(anchor.coordinates.begin(), anchor.coordinates.end());
    nearest.push_back(
      anchor.vertices[static_cast<std::size_t>(largest - anchor.coordinates.begin())]);
  }
  return nearest;
}

void TetAnchors::move(
  PointsView surface, PointsView tet_points, PointsView moved, Points& posed) const
{
  posed.resize(surface.rows(), 3);
  for (Index v = 0; v < surface.rows(); ++v)
  {
    const Anchor& anchor = this->anchors_[static_cast<std::size_t>(v)];
    if (anchor.coordinates[0] == 1.0)
    {
      posed.row(v) =
        moved.row(anchor.vertices[0]) + (surface.row(v) - tet_points.row(anchor.vertices[0]));
      continue;
    }
    posed.row(v) = surface.row(v);
    for (int k = 0; k < 4; ++k)
    {
      posed.row(v) += anchor.coordinates[k] *
        (moved.row(anchor.vertices[k]) - tet_points.row(anchor.vertices[k]));
    }
  }
}

} // namespace bindpose
