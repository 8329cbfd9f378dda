// Hang a wall from every boundary edge straight down to infinity. Surface and walls are closed, so
// their winding number is the signed count of crossings on a ray straight up, and that ray meets
// the surface only: walls are upright and the ray misses them for all points but those right below
// an edge. What is left is the walls' own share, one angle per boundary edge:
//
//     w(p) = crossings(p) - 1/(2 pi) sum of m atan2(a x b, u_a u_b + a.b)
//
// a and b relative to p, products in the plane across the ray, u_a = |a| - a_z, m the edge's net
// multiplicity. With u instead of the textbook's |a||b| + a.b - a_z|b| - b_z|a| nothing cancels
// where the ray passes close to the edge.
//
// Rays through edges and vertices are decided as if the point were moved by (e, e^2), e
// infinitesimal, in the plane: exact signs of three points in the plane, and the walls' angles take
// the same side. So there are no cracks and no second tries.
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

/// The vertex of a wall as seen from the point: in the plane, and |a| - a_z.
struct Corner
{
  double x, y, u;
};

Corner corner_of(const Vec3& a)
{
  const double plane = a.x() * a.x() + a.y() * a.y();
  if (plane == 0.0 && a.z() > 0.0)
  {
    // Right above the point: what is left of the infinitesimal shift, whose size does not matter.
    return { -1.0, 0.0, 0.0 };
  }
  const double length = std::sqrt(plane + a.z() * a.z());
  return { a.x(), a.y(), a.z() > 0.0 ? plane / (length + a.z()) : length - a.z() };
}
} // namespace

bool SignedCrossings::build(const Points& points, const Triangles& triangles,
  const std::vector<Edge>& edges, double tolerance, ExecutionContext& context)
{
  this->tolerance_ = tolerance;
  const Box box = bounding_box(points, triangles);
  // Rays along the shortest side meet the fewest triangles. Cyclic: nothing is mirrored.
  int shortest = 0;
  box.size().minCoeff(&shortest);
  this->axes_ = { (shortest + 1) % 3, (shortest + 2) % 3, shortest };
  const auto turned = [&](const Vec3& p)
  { return Vec3(p[this->axes_[0]], p[this->axes_[1]], p[this->axes_[2]]); };

  this->points_.resize(static_cast<std::size_t>(points.rows()));
  for (Index v = 0; v < points.rows(); ++v)
  {
    this->points_[v] = turned(points.row(v));
  }
  this->faces_.resize(static_cast<std::size_t>(triangles.rows()));
  const Vec3 rim = Vec3::Constant(tolerance);
  for (Index t = 0; t < triangles.rows(); ++t)
  {
    Face& face = this->faces_[t];
    face.a = static_cast<Id>(triangles(t, 0));
    face.b = static_cast<Id>(triangles(t, 1));
    face.c = static_cast<Id>(triangles(t, 2));
    const Vec3& a = this->points_[face.a];
    const Vec3& b = this->points_[face.b];
    const Vec3& c = this->points_[face.c];
    face.lower = a.cwiseMin(b).cwiseMin(c) - rim;
    face.upper = a.cwiseMax(b).cwiseMax(c) + rim;
  }
  this->rims_.clear();
  for (const Edge& edge : edges)
  {
    if (edge.net_direction != 0)
    {
      this->rims_.push_back(
        { this->points_[edge.a], this->points_[edge.b], static_cast<double>(edge.net_direction) });
    }
  }
  if (context.cancelled())
  {
    return false;
  }

  Box turned_box;
  turned_box.lower = turned(box.lower) - rim;
  turned_box.upper = turned(box.upper) + rim;
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
            this->members_[this->first_[cell]++] = static_cast<Id>(t);
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
    if (entries <= 12.0 * count || this->cells_[0] * this->cells_[1] <= 4)
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

bool SignedCrossings::evaluate(const Vec3& original, double& winding_number) const
{
  const Vec3 p(original[this->axes_[0]], original[this->axes_[1]], original[this->axes_[2]]);
  int count = 0;
  const double x = (p.x() - this->lower_.x()) / this->cell_size_;
  const double y = (p.y() - this->lower_.y()) / this->cell_size_;
  if (x >= 0.0 && y >= 0.0 && x <= static_cast<double>(this->cells_[0]) &&
    y <= static_cast<double>(this->cells_[1]))
  {
    const Index cell = this->cell_of(p.y(), 1) * this->cells_[0] + this->cell_of(p.x(), 0);
    for (Index i = this->first_[cell]; i < this->first_[cell + 1]; ++i)
    {
      const Face& face = this->faces_[this->members_[i]];
      if (p.z() <= face.upper.z() && p.x() >= face.lower.x() && p.x() <= face.upper.x() &&
        p.y() >= face.lower.y() && p.y() <= face.upper.y() && !this->crossing(face, p, count))
      {
        return false;
      }
    }
  }
  double turns = 0.0;
  if (!this->walls(p, turns))
  {
    return false;
  }
  winding_number = static_cast<double>(count) - turns;
  return true;
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

bool SignedCrossings::walls(const Vec3& p, double& turns) const
{
  double angles = 0.0;
  double real = 1.0; // product of up to three complex numbers whose angles add up
  double imaginary = 0.0;
  int factors = 0;
  for (const Rim& rim : this->rims_)
  {
    const Corner a = corner_of(rim.a - p);
    const Corner b = corner_of(rim.b - p);
    const double left = a.x * b.y;
    const double right = a.y * b.x;
    double cross = left - right;
    const double level = a.x * b.x + a.y * b.y;
    const double depth = a.u * b.u;
    const double run = level + depth;
    if (std::abs(cross) + std::abs(run) < 1e-4 * (std::abs(level) + depth))
    {
      return false; // next to the edge
    }
    if (run > 1.1 * std::abs(cross) && run > 1e-30 && std::abs(rim.multiplicity) == 1.0)
    {
      const double signed_cross = rim.multiplicity * cross;
      const double product = real * run - imaginary * signed_cross;
      imaginary = real * signed_cross + imaginary * run;
      real = product;
      if (++factors == 4)
      {
        angles += std::atan2(imaginary, real);
        real = 1.0;
        imaginary = 0.0;
        factors = 0;
      }
      continue;
    }
    if (run <= 0.0 && std::abs(cross) <= 4e-16 * (std::abs(left) + std::abs(right)))
    {
      // Below the edge, or nearly: the side must be that of the crossings.
      int side = orientation_2d(rim.a.x(), rim.a.y(), rim.b.x(), rim.b.y(), p.x(), p.y());
      if (side == 0)
      {
        const double dy = rim.a.y() - rim.b.y();
        const double dx = rim.b.x() - rim.a.x();
        side = dy != 0.0 ? (dy > 0.0 ? 1 : -1) : (dx > 0.0) - (dx < 0.0);
      }
      if (side == 0)
      {
        continue; // an upright edge has no wall
      }
      cross = std::copysign(cross, side); // atan2 knows the sign of zero
    }
    angles += rim.multiplicity * std::atan2(cross, run);
  }
  constexpr double two_pi = 6.283185307179586477;
  turns = (angles + std::atan2(imaginary, real)) / two_pi;
  return true;
}

Index SignedCrossings::memory() const
{
  return static_cast<Index>(this->points_.capacity() * sizeof(Vec3) +
    this->faces_.capacity() * sizeof(Face) + this->rims_.capacity() * sizeof(Rim) +
    this->first_.capacity() * sizeof(Index) + this->members_.capacity() * sizeof(Id));
}

} // namespace bindpose
