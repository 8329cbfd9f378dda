// A ray straight up meets a closed surface as often from below as from above, up to the times the
// surface winds around the ray's origin: triangles that it leaves through count 1, those that it
// enters through count -1.
//
// Rays through edges and vertices are decided as if the point were moved by (e, e^2), e
// infinitesimal, in the plane across the ray: exact signs of three points in the plane. So there
// are no cracks and no second tries.
//
// Along a row of points the place of a crossing need not be known exactly: away from it all points
// are clearly above or below, and the few near it are asked one by one.
#include "inside/signed_crossings.h"

#include "base/exact.h"
#include "inside/solid_angle.h"

#include <algorithm>

namespace bindpose
{

namespace
{
/// +1, -1: the edge crosses the line to the right of the point upwards, downwards; else 0.
int crosses_right(const Vec3& a, const Vec3& b, const Vec3& p)
{
  const bool a_above = a.y() > p.y();
  const bool b_above = b.y() > p.y();
  if (a_above == b_above)
  {
    return 0;
  }
  const int side = orientation_2d(a.x(), a.y(), b.x(), b.y(), p.x(), p.y());
  if (b_above)
  {
    return side > 0 ? 1 : 0;
  }
  return side < 0 ? -1 : 0;
}

/// A triangle by its sorted corners; `turn` tells even from odd orders.
struct SortedCorners
{
  std::array<Index, 3> ids;
  int turn;
  Index triangle;
};

SortedCorners sorted_corners(const Triangles& triangles, Index t)
{
  SortedCorners corners{ { triangles(t, 0), triangles(t, 1), triangles(t, 2) }, 1, t };
  for (const auto& [i, k] : { std::pair{ 0, 1 }, std::pair{ 1, 2 }, std::pair{ 0, 1 } })
  {
    if (corners.ids[i] > corners.ids[k])
    {
      std::swap(corners.ids[i], corners.ids[k]);
      corners.turn = -corners.turn;
    }
  }
  return corners;
}

/// Triangles and caps without the pairs that are each other turned over.
std::vector<std::array<Index, 3>> without_opposites(
  const Triangles& triangles, const Triangles& caps)
{
  std::vector<SortedCorners> of_caps;
  for (Index t = 0; t < caps.rows(); ++t)
  {
    of_caps.push_back(sorted_corners(caps, t));
  }
  std::sort(of_caps.begin(), of_caps.end(),
    [](const SortedCorners& x, const SortedCorners& y)
    { return x.ids != y.ids ? x.ids < y.ids : x.triangle < y.triangle; });
  std::vector<char> gone(of_caps.size(), 0);
  std::vector<std::array<Index, 3>> kept;
  kept.reserve(static_cast<std::size_t>(triangles.rows() + caps.rows()));
  for (Index t = 0; t < triangles.rows(); ++t)
  {
    bool cancelled = false;
    if (!of_caps.empty())
    {
      const SortedCorners own = sorted_corners(triangles, t);
      auto cap = std::lower_bound(of_caps.begin(), of_caps.end(), own.ids,
        [](const SortedCorners& x, const std::array<Index, 3>& ids) { return x.ids < ids; });
      for (; cap != of_caps.end() && cap->ids == own.ids && !cancelled; ++cap)
      {
        char& is_gone = gone[static_cast<std::size_t>(cap - of_caps.begin())];
        cancelled = !is_gone && cap->turn != own.turn;
        is_gone = is_gone || cancelled;
      }
    }
    if (!cancelled)
    {
      kept.push_back({ triangles(t, 0), triangles(t, 1), triangles(t, 2) });
    }
  }
  for (std::size_t i = 0; i < of_caps.size(); ++i)
  {
    if (!gone[i])
    {
      const Index t = of_caps[i].triangle;
      kept.push_back({ caps(t, 0), caps(t, 1), caps(t, 2) });
    }
  }
  return kept;
}
} // namespace

bool SignedCrossings::build(const Points& points, const Triangles& triangles, const Triangles& caps,
  double tolerance, ExecutionContext& context)
{
  this->tolerance_ = tolerance;
  const Box box = bounding_box(points, triangles);
  // Rays along the shortest side meet the fewest triangles. Cyclic: nothing is mirrored.
  int shortest = 0;
  box.size().minCoeff(&shortest);
  this->axes_ = { (shortest + 1) % 3, (shortest + 2) % 3, shortest };

  this->points_.resize(static_cast<std::size_t>(points.rows()));
  for (Index v = 0; v < points.rows(); ++v)
  {
    this->points_[v] = this->turned(points.row(v));
  }
  const std::vector<std::array<Index, 3>> corners = without_opposites(triangles, caps);
  this->faces_.resize(corners.size());
  const Vec3 rim = Vec3::Constant(tolerance);
  for (std::size_t t = 0; t < corners.size(); ++t)
  {
    Face& face = this->faces_[t];
    face.a = static_cast<Id>(corners[t][0]);
    face.b = static_cast<Id>(corners[t][1]);
    face.c = static_cast<Id>(corners[t][2]);
    const Vec3& a = this->points_[face.a];
    const Vec3& b = this->points_[face.b];
    const Vec3& c = this->points_[face.c];
    face.lower = a.cwiseMin(b).cwiseMin(c) - rim;
    face.upper = a.cwiseMax(b).cwiseMax(c) + rim;
  }
  if (context.cancelled())
  {
    return false;
  }

  Box turned_box;
  turned_box.lower = this->turned(box.lower) - rim;
  turned_box.upper = this->turned(box.upper) + rim;
  this->choose_cells(turned_box);

  // Two passes over the triangles: count, then fill.
  this->first_.assign(static_cast<std::size_t>(this->cells_[0] * this->cells_[1] + 1), 0);
  for (const bool fill : { false, true })
  {
    for (std::size_t t = 0; t < this->faces_.size(); ++t)
    {
      if (t % 65536 == 0)
      {
        if (context.cancelled())
        {
          return false;
        }
        context.progress(
          0.5 * (fill + static_cast<double>(t) / static_cast<double>(this->faces_.size())));
      }
      const Face& face = this->faces_[t];
      const Index x_end = this->cell_of(face.upper.x(), 0);
      const Index y_end = this->cell_of(face.upper.y(), 1);
      for (Index y = this->cell_of(face.lower.y(), 1); y <= y_end; ++y)
      {
        for (Index x = this->cell_of(face.lower.x(), 0); x <= x_end; ++x)
        {
          const Index cell = y * this->cells_[0] + x;
          if (fill)
          {
            this->members_[static_cast<std::size_t>(this->first_[cell]++)] = static_cast<Id>(t);
          }
          else
          {
            this->first_[cell + 1] += 1;
          }
        }
      }
    }
    if (!fill)
    {
      for (std::size_t cell = 1; cell < this->first_.size(); ++cell)
      {
        this->first_[cell] += this->first_[cell - 1];
      }
      this->members_.resize(static_cast<std::size_t>(this->first_.back()));
    }
  }
  // Filling moved each cell's begin to its end.
  std::copy_backward(this->first_.begin(), this->first_.end() - 1, this->first_.end());
  this->first_[0] = 0;
  return true;
}

void SignedCrossings::choose_cells(const Box& box)
{
  const Vec3 size = box.size();
  const double count = static_cast<double>(std::max<std::size_t>(1, this->faces_.size()));
  this->lower_ = box.lower;
  // About two cells a triangle; coarser until large triangles do not fill too many of them.
  const double longest = std::max({ size.x(), size.y(), 1e-300 });
  const double area = std::max(size.x() * size.y(), longest * longest / (2.0 * count));
  this->cell_size_ = std::sqrt(area / (2.0 * count));
  for (;;)
  {
    for (int k = 0; k < 2; ++k)
    {
      this->cells_[k] =
        std::max<Index>(1, static_cast<Index>(std::ceil(size[k] / this->cell_size_)));
    }
    double entries = 0.0;
    for (const Face& face : this->faces_)
    {
      const Vec3 extent = (face.upper - face.lower) / this->cell_size_;
      entries += std::min(extent.x() + 1.0, static_cast<double>(this->cells_[0])) *
        std::min(extent.y() + 1.0, static_cast<double>(this->cells_[1]));
    }
    constexpr double most_entries = 2e9; // ids have 31 bits
    if (entries <= std::min(12.0 * count, most_entries) || this->cells_[0] * this->cells_[1] <= 4)
    {
      return;
    }
    this->cell_size_ *= 1.5;
  }
}

Index SignedCrossings::cell_of(double x, int direction) const
{
  const double cell = (x - this->lower_[direction]) / this->cell_size_;
  return std::clamp<Index>(static_cast<Index>(cell), 0, this->cells_[direction] - 1);
}

bool SignedCrossings::cell_at(double x, double y, Index& begin, Index& end) const
{
  const double u = (x - this->lower_.x()) / this->cell_size_;
  const double v = (y - this->lower_.y()) / this->cell_size_;
  if (!(u >= 0.0 && v >= 0.0 && u <= static_cast<double>(this->cells_[0]) &&
        v <= static_cast<double>(this->cells_[1])))
  {
    return false;
  }
  const Index cell = this->cell_of(y, 1) * this->cells_[0] + this->cell_of(x, 0);
  begin = this->first_[cell];
  end = this->first_[cell + 1];
  return true;
}

bool SignedCrossings::evaluate(const Vec3& original, int& count) const
{
  const Vec3 p = this->turned(original);
  count = 0;
  Index begin = 0;
  Index end = 0;
  if (!this->cell_at(p.x(), p.y(), begin, end))
  {
    return true;
  }
  for (Index i = begin; i < end; ++i)
  {
    const Face& face = this->faces_[this->members_[i]];
    if (p.z() <= face.upper.z() && p.x() >= face.lower.x() && p.x() <= face.upper.x() &&
      p.y() >= face.lower.y() && p.y() <= face.upper.y() && !this->crossing(face, p, count))
    {
      return false;
    }
  }
  return true;
}

void SignedCrossings::evaluate_row(
  const Vec3& original, const std::vector<double>& places, Row& row) const
{
  const std::size_t count = places.size();
  row.counts.assign(count, 0);
  row.touching.assign(count, 0);
  row.any_touching = false;
  const Vec3 p = this->turned(original);
  Index begin = 0;
  Index end = 0;
  if (count == 0 || !this->cell_at(p.x(), p.y(), begin, end))
  {
    return;
  }
  bool met = false;
  for (Index i = begin; i < end; ++i)
  {
    const Face& face = this->faces_[this->members_[i]];
    if (places.front() <= face.upper.z() && p.x() >= face.lower.x() && p.x() <= face.upper.x() &&
      p.y() >= face.lower.y() && p.y() <= face.upper.y())
    {
      this->cross_row(face, p, places, row);
      met = true;
    }
  }
  // So far each place holds what changes behind it.
  for (std::size_t k = count; met && --k > 0;)
  {
    row.counts[k - 1] += row.counts[k];
  }
}

/// Adds a face's crossings to the row: at the last point below it, for all before.
void SignedCrossings::cross_row(
  const Face& face, Vec3 p, const std::vector<double>& places, Row& row) const
{
  const Vec3& a = this->points_[face.a];
  const Vec3& b = this->points_[face.b];
  const Vec3& c = this->points_[face.c];
  const int turn = crosses_right(a, b, p) + crosses_right(b, c, p) + crosses_right(c, a, p);
  const Vec3 u = b - a;
  const Vec3 v = c - a;
  const double x = p.x() - a.x();
  const double y = p.y() - a.y();
  const double area = u.x() * v.y() - u.y() * v.x();
  const double along_v = u.x() * y - u.y() * x;
  const double along_u = x * v.y() - y * v.x();
  const double size = (face.upper.x() - face.lower.x()) + (face.upper.y() - face.lower.y());
  // Rounding of the areas, and how far beside the triangle in the plane a point may touch it.
  const double blur = 4.0 * size * (0x1p-50 * size + this->tolerance_);
  if (turn == 0)
  {
    const double sign = area < 0.0 ? -1.0 : 1.0;
    const double least =
      std::min({ sign * along_v, sign * along_u, sign * (area - along_u - along_v) });
    if (least < -blur)
    {
      return;
    }
  }
  // Where the line meets the triangle, and how far from there a point may be too near to tell.
  double lower = face.lower.z();
  double upper = face.upper.z();
  if (std::abs(area) > 4.0 * blur)
  {
    const double height = upper - lower;
    const double place = a.z() + (along_v * v.z() + along_u * u.z()) / area;
    const double steep = (height + size) * (height + size) / std::abs(area);
    const double slack =
      4.0 * this->tolerance_ * (1.0 + steep) + height * 4.0 * blur / std::abs(area);
    lower = std::max(lower, place - slack);
    upper = std::min(upper, place + slack);
  }
  const auto near = std::lower_bound(places.begin(), places.end(), lower) - places.begin();
  const auto past = std::upper_bound(places.begin() + near, places.end(), upper) - places.begin();
  if (near > 0)
  {
    row.counts[near - 1] += turn;
  }
  for (auto k = near; k < past; ++k)
  {
    int count = 0;
    p.z() = places[k];
    if (!this->crossing(face, p, count))
    {
      row.touching[k] = 1;
      row.any_touching = true;
    }
    else if (count != 0)
    {
      row.counts[k] += count;
      if (k > 0)
      {
        row.counts[k - 1] -= count;
      }
    }
  }
}

bool SignedCrossings::crossing(const Face& face, const Vec3& p, int& count) const
{
  const Vec3& a = this->points_[face.a];
  const Vec3& b = this->points_[face.b];
  const Vec3& c = this->points_[face.c];
  const bool below = p.z() < face.lower.z();
  if (!below && touches_triangle(p, a, b, c, this->tolerance_))
  {
    return false;
  }
  const int turn = crosses_right(a, b, p) + crosses_right(b, c, p) + crosses_right(c, a, p);
  if (turn != 0 && (below || side_of_triangle(p, a, b, c) * turn > 0.0))
  {
    count += turn;
  }
  return true;
}

Index SignedCrossings::memory() const
{
  return static_cast<Index>(this->points_.capacity() * sizeof(Vec3) +
    this->faces_.capacity() * sizeof(Face) + this->first_.capacity() * sizeof(Id) + this->members_.capacity() * sizeof(Id));
}

} // namespace bindpose
