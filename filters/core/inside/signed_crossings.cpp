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
#include <cstring>

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
  for (std::size_t t = 0; t < corners.size(); ++t)
  {
    this->faces_[t] = { static_cast<Id>(corners[t][0]), static_cast<Id>(corners[t][1]),
      static_cast<Id>(corners[t][2]) };
  }
  if (context.cancelled())
  {
    return false;
  }

  const Vec3 rim = Vec3::Constant(tolerance);
  Box turned_box;
  turned_box.lower = this->turned(box.lower) - rim;
  turned_box.upper = this->turned(box.upper) + rim;
  this->choose_cells(turned_box);

  // Two passes over the triangles: count, then fill.
  const auto cells = static_cast<std::size_t>(this->cells_[0] * this->cells_[1]);
  std::vector<Id> filled(cells, 0);
  this->first_.assign(cells + 1, 0);
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
      Vec3 lower, upper;
      this->bounds(this->faces_[t], lower, upper);
      const Index x_end = this->cell_of(upper.x(), 0);
      const Index y_end = this->cell_of(upper.y(), 1);
      for (Index y = this->cell_of(lower.y(), 1); y <= y_end; ++y)
      {
        for (Index x = this->cell_of(lower.x(), 0); x <= x_end; ++x)
        {
          const Index cell = y * this->cells_[0] + x;
          const Id place = filled[cell]++;
          if (fill)
          {
            Block& block = this->blocks_[this->first_[cell] + place / 8];
            const Id lane = place % 8;
            block.x_lower[lane] = this->step_of(lower.x(), x, 0);
            block.x_upper[lane] = this->step_of(upper.x(), x, 0);
            block.y_lower[lane] = this->step_of(lower.y(), y, 1);
            block.y_upper[lane] = this->step_of(upper.y(), y, 1);
            block.z_upper[lane] = this->height_of(upper.z());
            block.face[lane] = static_cast<Id>(t);
          }
        }
      }
    }
    if (!fill)
    {
      for (std::size_t cell = 0; cell < cells; ++cell)
      {
        this->first_[cell + 1] = this->first_[cell] + (filled[cell] + 7) / 8;
        filled[cell] = 0;
      }
      Block nothing = {}; // bounds no place is within
      nothing.x_lower = ~nothing.x_lower;
      this->blocks_.assign(static_cast<std::size_t>(this->first_.back()), nothing);
    }
  }
  return true;
}

void SignedCrossings::choose_cells(const Box& box)
{
  const Vec3 size = box.size();
  const double count = static_cast<double>(std::max<std::size_t>(1, this->faces_.size()));
  this->lower_ = box.lower;
  this->height_ = std::max(size.z(), 1e-300);
  // About one cell a triangle; coarser until large triangles do not fill too many of them.
  const double longest = std::max({ size.x(), size.y(), 1e-300 });
  const double area = std::max(size.x() * size.y(), longest * longest / count);
  this->cell_size_ = std::sqrt(area / count);
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
      Vec3 lower, upper;
      this->bounds(face, lower, upper);
      const Vec3 extent = (upper - lower) / this->cell_size_;
      entries += std::min(extent.x() + 1.0, static_cast<double>(this->cells_[0])) *
        std::min(extent.y() + 1.0, static_cast<double>(this->cells_[1]));
    }
    constexpr double most_entries = 2e9; // ids have 31 bits
    if (entries <= std::min(8.0 * count, most_entries) || this->cells_[0] * this->cells_[1] <= 4)
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

void SignedCrossings::bounds(const Face& face, Vec3& lower, Vec3& upper) const
{
  const Vec3& a = this->points_[face.a];
  const Vec3& b = this->points_[face.b];
  const Vec3& c = this->points_[face.c];
  const Vec3 rim = Vec3::Constant(this->tolerance_);
  lower = a.cwiseMin(b).cwiseMin(c) - rim;
  upper = a.cwiseMax(b).cwiseMax(c) + rim;
}

std::uint8_t SignedCrossings::step_of(double x, Index cell, int direction) const
{
  const double steps =
    256.0 * ((x - this->lower_[direction]) / this->cell_size_ - static_cast<double>(cell));
  return static_cast<std::uint8_t>(std::clamp(steps, 0.0, 255.0));
}

std::uint8_t SignedCrossings::height_of(double z) const
{
  return static_cast<std::uint8_t>(
    std::clamp(256.0 * ((z - this->lower_.z()) / this->height_), 0.0, 255.0));
}

bool SignedCrossings::place_of(const Vec3& p, Place& place) const
{
  const double u = (p.x() - this->lower_.x()) / this->cell_size_;
  const double v = (p.y() - this->lower_.y()) / this->cell_size_;
  if (!(u >= 0.0 && v >= 0.0 && u <= static_cast<double>(this->cells_[0]) &&
        v <= static_cast<double>(this->cells_[1])))
  {
    return false;
  }
  const Index x = this->cell_of(p.x(), 0);
  const Index y = this->cell_of(p.y(), 1);
  const Index cell = y * this->cells_[0] + x;
  place.x = this->step_of(p.x(), x, 0);
  place.y = this->step_of(p.y(), y, 1);
  place.z = this->height_of(p.z());
  place.begin = this->first_[cell];
  place.end = this->first_[cell + 1];
  return true;
}

template <typename Look>
void SignedCrossings::each_face(const Place& place, const Look& look) const
{
  for (Id i = place.begin; i < place.end; ++i)
  {
    const Block& block = this->blocks_[i];
    const auto within = (block.x_lower <= place.x) & (block.x_upper >= place.x) &
      (block.y_lower <= place.y) & (block.y_upper >= place.y) & (block.z_upper >= place.z);
    std::uint64_t mask = 0;
    std::memcpy(&mask, &within, sizeof(mask));
    if (mask == 0)
    {
      continue;
    }
    for (int lane = 0; lane < 8; ++lane)
    {
      if (within[lane])
      {
        look(block.face[lane]);
      }
    }
  }
}

void SignedCrossings::evaluate(
  const Vec3* originals, Index number, int* counts, bool* touching) const
{
  // Step by step for all points: each step asks for the memory that the next one needs.
  struct Candidate
  {
    Id point, face;
  };
  constexpr std::size_t most_candidates = 8 * most_at_once;
  std::array<Vec3, most_at_once> points;
  std::array<Place, most_at_once> places;
  for (Index i = 0; i < number; ++i)
  {
    counts[i] = 0;
    touching[i] = false;
    points[i] = this->turned(originals[i]);
    Place& place = places[i];
    if (!this->place_of(points[i], place))
    {
      place.begin = place.end = 0;
    }
    for (Id block = place.begin; block < place.end; ++block)
    {
      __builtin_prefetch(&this->blocks_[block]);
    }
  }
  std::array<Candidate, most_candidates> candidates;
  std::size_t waiting = 0;
  const auto look = [&]()
  {
    for (std::size_t k = 0; k < waiting; ++k)
    {
      const Face& face = this->faces_[candidates[k].face];
      __builtin_prefetch(&this->points_[face.a]);
      __builtin_prefetch(&this->points_[face.b]);
      __builtin_prefetch(&this->points_[face.c]);
    }
    for (std::size_t k = 0; k < waiting; ++k)
    {
      const Id i = candidates[k].point;
      touching[i] =
        !this->crossing(this->faces_[candidates[k].face], points[i], counts[i]) || touching[i];
    }
    waiting = 0;
  };
  for (Index i = 0; i < number; ++i)
  {
    this->each_face(places[i],
      [&](Id id)
      {
        __builtin_prefetch(&this->faces_[id]);
        candidates[waiting++] = { static_cast<Id>(i), id };
        if (waiting == most_candidates)
        {
          look();
        }
      });
  }
  look();
}

void SignedCrossings::evaluate_row(
  const Vec3& original, const std::vector<double>& places, Row& row) const
{
  const std::size_t count = places.size();
  row.counts.assign(count, 0);
  row.touching.assign(count, 0);
  row.any_touching = false;
  if (count == 0)
  {
    return;
  }
  Vec3 p = this->turned(original);
  p.z() = places.front();
  Place place;
  if (!this->place_of(p, place))
  {
    return;
  }
  bool met = false;
  this->each_face(place,
    [&](Id id)
    {
      this->cross_row(this->faces_[id], p, places, row);
      met = true;
    });
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
  Vec3 face_lower, face_upper;
  this->bounds(face, face_lower, face_upper);
  const double size = (face_upper.x() - face_lower.x()) + (face_upper.y() - face_lower.y());
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
  double lower = face_lower.z();
  double upper = face_upper.z();
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
  const double bottom = std::min({ a.z(), b.z(), c.z() }) - this->tolerance_;
  const double top = std::max({ a.z(), b.z(), c.z() }) + this->tolerance_;
  if (p.z() > top)
  {
    return true;
  }
  double side = 0.0;
  const bool below = p.z() < bottom;
  if (!below)
  {
    const Vec3 u = b - a;
    const Vec3 v = c - a;
    const Vec3 r = a - p;
    const Vec3 normal = u.cross(v);
    side = normal.dot(r);
    const double reach = u.lpNorm<1>() * v.lpNorm<1>();
    if (std::abs(side) <= reach * (2.0 * this->tolerance_ + 1e-14 * r.lpNorm<1>()))
    {
      // Near the plane of the triangle.
      if (touches_triangle(p, a, b, c, this->tolerance_))
      {
        return false;
      }
      side = side_of_triangle(p, a, b, c);
    }
  }
  const int turn = crosses_right(a, b, p) + crosses_right(b, c, p) + crosses_right(c, a, p);
  if (turn != 0 && (below || side * turn > 0.0))
  {
    count += turn;
  }
  return true;
}

Index SignedCrossings::memory() const
{
  return static_cast<Index>(this->points_.capacity() * sizeof(Vec3) +
    this->faces_.capacity() * sizeof(Face) + this->first_.capacity() * sizeof(Id) +
    this->blocks_.capacity() * sizeof(Block));
}

} // namespace bindpose
