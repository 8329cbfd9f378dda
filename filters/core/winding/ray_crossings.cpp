// Exact counts of the crossings of axis-aligned rays with triangles.
//
// The point p and the triangle a, b, c are in coordinates (x, y, z) whose first axis is the
// direction of the ray. The ray crosses the triangle if (py, pz) is in the projection of the
// triangle and p is in front of the triangle's plane. The signs of three orientations in the
// projection plane decide the first condition, the sign of a volume decides the second. Signs are
// computed in doubles, with error bounds for the whole bounding box of the triangle. Exact
// arithmetic computes the signs that the error bounds leave uncertain.
//
// If (py, pz) is on an edge, it is replaced by (py + e, pz + e^2) with an infinitesimal e. The
// orientations of the two triangles at a shared edge have opposite signs. Therefore a ray through
// the edge crosses exactly one of the two triangles, and sums over closed surfaces are integers.
#include "winding/ray_crossings.h"

#include "base/large_pages.h"
#include "base/parallel.h"
#include "base/simd.h"
#include "geometry/exact.h"
#include "solid_angle/solid_angle.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bindpose
{

namespace
{
constexpr double epsilon = 0x1p-53;
/// Error bound of an orientation in the projection plane, in units of the area of the triangle's
/// projected box.
constexpr double edge_error = 8.0 * epsilon;
/// Error bound of a volume, in units of the volume of the triangle's box.
constexpr double plane_error = 96.0 * epsilon;
/// Measured nanoseconds to project a triangle, to test a point against a triangle, to sort a point,
/// to process a triangle of a slab, and to test a row of a grid.
constexpr double face_cost = 35.0;
constexpr double test_cost = 1.5;
constexpr double point_cost = 120.0;
constexpr double slab_face_cost = 50.0;
constexpr double row_cost = 5.0;
/// The grid of the projection plane has as many cells as there are triangles, but at least
/// `minimum_cells_per_point` and at most `maximum_cells_per_point` cells per point. Therefore most
/// triangles overlap only cells without points if there are more triangles than points.
constexpr double minimum_cells_per_point = 0.5;
constexpr double maximum_cells_per_point = 8.0;
/// Points per slab of the grid in the projection plane; one thread processes a slab.
constexpr Index points_per_slab = 32768;
constexpr std::int32_t points_per_batch = 256;
/// A triangle is listed in each slab that it overlaps. These limits bound the memory if triangles
/// are as large as the surface.
constexpr Index maximum_slabs = 64;
constexpr Index maximum_slabs_per_face = 32;
/// Samples per slab of a sample grid. A slab takes some hundred kilobytes, so that it stays in the
/// cache.
constexpr Index samples_per_slab = 65536;

int sign_of(double x)
{
  return (x > 0.0) - (x < 0.0);
}

/// Return the orientation of the triangle of a, b and p, where p is moved by an infinitesimal
/// amount; 0 if a equals b.
int perturbed_orientation(double ay, double az, double by, double bz, double py, double pz)
{
  int sign = orientation_2d(ay, az, by, bz, py, pz);
  sign = sign != 0 ? sign : sign_of(az - bz);
  return sign != 0 ? sign : sign_of(by - ay);
}

/// Return the index of the first of the ascending `values` that is at least x. The search starts at
/// the index expected for equal spacing, with `per_length` values per unit of length.
Index lower_bound_index(const std::vector<double>& values, double x, double per_length)
{
  const auto count = static_cast<Index>(values.size());
  const double guess = (x - values[0]) * per_length;
  Index i = guess > 0.0 ? static_cast<Index>(std::min(guess, static_cast<double>(count))) : 0;
  while (i > 0 && values[i - 1] >= x)
  {
    --i;
  }
  while (i < count && values[i] < x)
  {
    ++i;
  }
  return i;
}

double index_density(const std::vector<double>& values)
{
  const double length = values.back() - values.front();
  return length > 0.0 ? static_cast<double>(values.size() - 1) / length : 0.0;
}
} // namespace

/// A triangle in the ray's coordinates, with error bounds for points in its box.
struct RayCrossings::Facet
{
  std::array<Vec3, 3> corners; ///< corners in the coordinates of the input
  int axis;
  double x[3], y[3], z[3];
  double lower[3], upper[3]; ///< box of the triangle, enlarged by the tolerance
  /// If the absolute value of an orientation is larger than this bound, the computed sign is right.
  double edge_bound;
  /// A point does not touch the triangle if one of its orientations is below -`outside` and another
  /// one is above `outside`.
  double outside;
  double normal[3]; ///< normal vector, not normalized
  /// If the absolute value of height() is larger than this bound, the computed sign is right and
  /// the point does not touch the triangle.
  double plane_bound;

  /// Return six times the signed volume of the tetrahedron of the triangle and the point. It is the
  /// distance of the point from the triangle's plane times the length of `normal`.
  double height(double px, double py, double pz) const
  {
    return this->normal[0] * (px - this->x[0]) + this->normal[1] * (py - this->y[0]) +
      this->normal[2] * (pz - this->z[0]);
  }
};

RayCrossings::RayCrossings(
  const Points& points, const Triangles& triangles, const Triangles& caps, double tolerance)
  : points_(&points), triangles_(&triangles), caps_(&caps), tolerance_(tolerance),
    faces_(triangles.rows() + caps.rows())
{
  this->box_ = bounding_box(points);
  Vec3 areas = Vec3::Zero();
  for (Index f = 0; f < this->faces_; ++f)
  {
    const std::array<Vec3, 3> c = this->corners(f);
    const Vec3 size = c[0].cwiseMax(c[1]).cwiseMax(c[2]) - c[0].cwiseMin(c[1]).cwiseMin(c[2]);
    areas += Vec3(size.y() * size.z(), size.z() * size.x(), size.x() * size.y());
  }
  const Vec3 size = this->box_.size();
  this->overlaps_ = 1e300;
  for (int k = 0; k < 3; ++k)
  {
    const double area = size[(k + 1) % 3] * size[(k + 2) % 3];
    const double overlaps = area > 0.0 ? areas[k] / area : static_cast<double>(this->faces_);
    if (overlaps < this->overlaps_)
    {
      this->overlaps_ = overlaps;
      this->axis_ = k;
    }
  }
}

double RayCrossings::predicted_nanoseconds(Index number) const
{
  return face_cost * static_cast<double>(this->faces_) +
    (point_cost + test_cost * this->overlaps_) * static_cast<double>(number);
}

std::array<Vec3, 3> RayCrossings::corners(Index face) const
{
  const Index triangle_count = this->triangles_->rows();
  const auto row =
    face < triangle_count ? this->triangles_->row(face) : this->caps_->row(face - triangle_count);
  return { Vec3(this->points_->row(row[0])), Vec3(this->points_->row(row[1])),
    Vec3(this->points_->row(row[2])) };
}

RayCrossings::Facet RayCrossings::facet(Index face, int axis) const
{
  Facet f;
  f.corners = this->corners(face);
  f.axis = axis;
  double size[3];
  double* const coordinates[3] = { f.x, f.y, f.z };
  for (int k = 0; k < 3; ++k)
  {
    for (int v = 0; v < 3; ++v)
    {
      coordinates[k][v] = f.corners[v][(axis + k) % 3];
    }
    const double* const at = coordinates[k];
    f.lower[k] = std::min({ at[0], at[1], at[2] }) - this->tolerance_;
    f.upper[k] = std::max({ at[0], at[1], at[2] }) + this->tolerance_;
    size[k] = f.upper[k] - f.lower[k];
  }
  const double u[3] = { f.x[1] - f.x[0], f.y[1] - f.y[0], f.z[1] - f.z[0] };
  const double v[3] = { f.x[2] - f.x[0], f.y[2] - f.y[0], f.z[2] - f.z[0] };
  double length = 0.0;
  for (int k = 0; k < 3; ++k)
  {
    const int l = (k + 1) % 3, m = (k + 2) % 3;
    f.normal[k] = u[l] * v[m] - u[m] * v[l];
    length += f.normal[k] * f.normal[k];
  }
  f.edge_bound = edge_error * size[1] * size[2];
  f.outside = f.edge_bound + 2.0 * this->tolerance_ * (size[1] + size[2]);
  f.plane_bound =
    plane_error * size[0] * size[1] * size[2] + 2.0 * this->tolerance_ * std::sqrt(length);
  return f;
}

int RayCrossings::signed_crossing(const Facet& f, const Vec3& point, bool& touches) const
{
  const double px = point[f.axis], py = point[(f.axis + 1) % 3], pz = point[(f.axis + 2) % 3];
  const bool before = px < f.lower[0];
  const double height = f.height(px, py, pz);
  const bool is_near = !before && !(std::abs(height) > f.plane_bound);
  if (is_near &&
    touches_triangle(point, f.corners[0], f.corners[1], f.corners[2], this->tolerance_))
  {
    touches = true;
    return 0;
  }
  const int sign = perturbed_orientation(f.y[0], f.z[0], f.y[1], f.z[1], py, pz);
  if (sign == 0 || perturbed_orientation(f.y[1], f.z[1], f.y[2], f.z[2], py, pz) != sign ||
    perturbed_orientation(f.y[2], f.z[2], f.y[0], f.z[0], py, pz) != sign)
  {
    return 0;
  }
  if (before)
  {
    return sign;
  }
  double signed_height = height;
  if (is_near)
  {
    signed_height = -side_of_triangle(point, f.corners[0], f.corners[1], f.corners[2]);
    touches = signed_height == 0.0;
  }
  return sign * signed_height < 0.0 ? sign : 0;
}

// ---- Points ------------------------------------------------------------------------------------

namespace
{
/// Points in the ray's coordinates.
struct PointLanes
{
  std::vector<double> x, y, z;
};

/// Data of a triangle for the loop over points.
struct FacetBounds
{
  double ax, ay, az, by, bz, cy, cz;
  double upper_x, lower_x, lower_y, upper_y, lower_z, upper_z;
  double nx, ny, nz, edge_bound, outside, plane_bound;
};

/// Add the crossings of the rays from `count` points with one triangle. For points with uncertain
/// signs, no crossing is counted and undecided[i] is set to 1. Return whether there are such
/// points.
BINDPOSE_SIMD_CLONES bool add_crossings(const FacetBounds& f, const double* x, const double* y,
  const double* z, int count, std::int32_t* counts, std::int32_t* undecided)
{
  std::int32_t any = 0;
  for (int i = 0; i < count; ++i)
  {
    const double px = x[i], py = y[i], pz = z[i];
    const double ay = f.ay - py, by = f.by - py, cy = f.cy - py;
    const double az = f.az - pz, bz = f.bz - pz, cz = f.cz - pz;
    const double ab = ay * bz - az * by;
    const double bc = by * cz - bz * cy;
    const double ca = cy * az - cz * ay;
    const double smaller_of_two = ab < bc ? ab : bc, larger_of_two = ab > bc ? ab : bc;
    const double minimum = smaller_of_two < ca ? smaller_of_two : ca;
    const double maximum = larger_of_two > ca ? larger_of_two : ca;
    const double height = f.nx * (px - f.ax) - f.ny * ay - f.nz * az;
    const bool in_box = (py >= f.lower_y) & (py <= f.upper_y) & (pz >= f.lower_z) &
      (pz <= f.upper_z) & (px <= f.upper_x);
    const bool before = px < f.lower_x;
    const bool above = height > f.plane_bound, below = height < -f.plane_bound;
    const bool is_side_certain = before | above | below;
    const bool outwards = minimum > f.edge_bound, inwards = maximum < -f.edge_bound;
    const bool is_outside = (minimum < -f.outside) & (maximum > f.outside);
    const bool is_open = in_box & !is_outside & (!is_side_certain | !(outwards | inwards));
    const bool leaves = in_box & outwards & (before | below);
    const bool enters = in_box & inwards & (before | above);
    counts[i] += is_open ? 0 : (leaves ? 1 : 0) - (enters ? 1 : 0);
    undecided[i] = is_open ? 1 : 0;
    any |= undecided[i];
  }
  return any != 0;
}
} // namespace

bool RayCrossings::count(ExecutionContext& context, const Vec3* points, Index number, int* counts,
  unsigned char* resolved) const
{
  std::fill(counts, counts + number, 0);
  std::fill(resolved, resolved + number, static_cast<unsigned char>(1));
  const int u = (this->axis_ + 1) % 3, v = (this->axis_ + 2) % 3;
  const Vec3 lower = this->box_.lower.array() - this->tolerance_;
  const Vec3 upper = this->box_.upper.array() + this->tolerance_;
  // A grid of cells in the projection plane. The index along axis u varies fastest.
  const double width = upper[u] - lower[u], height = upper[v] - lower[v];
  const double cells = std::clamp(std::clamp(static_cast<double>(this->faces_),
                                    minimum_cells_per_point * static_cast<double>(number),
                                    maximum_cells_per_point * static_cast<double>(number)),
    1.0, 4e6);
  const double aspect = width > 0.0 && height > 0.0 ? std::clamp(width / height, 1e-3, 1e3) : 1.0;
  const auto u_cells = static_cast<Index>(std::ceil(std::sqrt(cells * aspect)));
  const auto v_cells = static_cast<Index>(std::ceil(std::sqrt(cells / aspect)));
  const double cells_per_u = width > 0.0 ? static_cast<double>(u_cells) / width : 0.0;
  const double cells_per_v = height > 0.0 ? static_cast<double>(v_cells) / height : 0.0;
  // u_of() and v_of() are monotone, so the cells of a triangle's box contain all points in the box.
  const auto u_of = [&](double x)
  { return std::clamp<Index>(static_cast<Index>((x - lower[u]) * cells_per_u), 0, u_cells - 1); };
  const auto v_of = [&](double x)
  { return std::clamp<Index>(static_cast<Index>((x - lower[v]) * cells_per_v), 0, v_cells - 1); };

  std::vector<std::int32_t> cell(static_cast<std::size_t>(number));
  std::vector<std::int32_t> begin(static_cast<std::size_t>(u_cells * v_cells) + 1, 0);
  for (Index i = 0; i < number; ++i)
  {
    const Vec3& p = points[i];
    const bool inside = (p.array() >= lower.array()).all() && (p.array() <= upper.array()).all();
    cell[i] = inside ? static_cast<std::int32_t>(v_of(p[v]) * u_cells + u_of(p[u])) : -1;
    if (inside)
    {
      begin[cell[i] + 1] += 1;
    }
  }
  for (std::size_t c = 1; c < begin.size(); ++c)
  {
    begin[c] += begin[c - 1];
  }
  const auto inside = static_cast<std::size_t>(begin.back());
  std::vector<std::int32_t> next(begin.begin(), begin.end() - 1);
  std::vector<std::int32_t> ids(inside);
  PointLanes sorted;
  for (std::vector<double>* values : { &sorted.x, &sorted.y, &sorted.z })
  {
    reserve_in_large_pages(*values, inside);
    values->resize(inside);
  }
  for (Index i = 0; i < number; ++i)
  {
    if (cell[i] >= 0)
    {
      const std::int32_t at = next[cell[i]]++;
      ids[at] = static_cast<std::int32_t>(i);
      sorted.x[at] = points[i][this->axis_];
      sorted.y[at] = points[i][u];
      sorted.z[at] = points[i][v];
    }
  }
  if (context.canceled())
  {
    return false;
  }

  // Each slab consists of whole lines of cells. List the triangles that overlap each slab.
  const Index slabs = std::clamp<Index>(
    static_cast<Index>(inside) / points_per_slab, 1, std::min<Index>(v_cells, maximum_slabs));
  const auto slab_of = [&](Index line) { return line * slabs / v_cells; };
  std::vector<Index> face_begin(static_cast<std::size_t>(slabs) + 1, 0);
  std::vector<std::int32_t> faces;
  if (slabs > 1)
  {
    const auto visit = [&](const auto& add_face)
    {
      for (Index f = 0; f < this->faces_; ++f)
      {
        const std::array<Vec3, 3> c = this->corners(f);
        const double low = std::min({ c[0][v], c[1][v], c[2][v] }) - this->tolerance_;
        const double high = std::max({ c[0][v], c[1][v], c[2][v] }) + this->tolerance_;
        for (Index s = slab_of(v_of(low)); s <= slab_of(v_of(high)); ++s)
        {
          add_face(s, f);
        }
      }
    };
    visit([&](Index s, Index) { face_begin[s + 1] += 1; });
    for (Index s = 0; s < slabs; ++s)
    {
      face_begin[s + 1] += face_begin[s];
    }
    faces.resize(static_cast<std::size_t>(face_begin.back()));
    std::vector<Index> next_face(face_begin.begin(), face_begin.end() - 1);
    visit([&](Index s, Index f) { faces[next_face[s]++] = static_cast<std::int32_t>(f); });
  }
  return parallel_for(context, slabs, 1,
    [&](Index slab, Index)
    {
      Index first_line = slab * v_cells / slabs;
      while (slab_of(first_line) < slab)
      {
        ++first_line;
      }
      Index last_line = first_line;
      while (last_line < v_cells && slab_of(last_line) == slab)
      {
        ++last_line;
      }
      const std::int32_t first_point = begin[first_line * u_cells];
      const std::int32_t last_point = begin[last_line * u_cells];
      std::vector<std::int32_t> sums(static_cast<std::size_t>(last_point - first_point), 0);
      std::array<std::int32_t, points_per_batch> undecided;
      const Index face_count = slabs > 1 ? face_begin[slab + 1] - face_begin[slab] : this->faces_;
      for (Index i = 0; i < face_count; ++i)
      {
        if (i % 65536 == 65535 && context.canceled())
        {
          return;
        }
        const Index face = slabs > 1 ? faces[face_begin[slab] + i] : i;
        // If there are few points, most triangles overlap only grid cells without points. Compute
        // the Facet of a triangle only if one of its cells contains a point.
        const std::array<Vec3, 3> c = this->corners(face);
        const Index u0 = u_of(std::min({ c[0][u], c[1][u], c[2][u] }) - this->tolerance_);
        const Index u1 = u_of(std::max({ c[0][u], c[1][u], c[2][u] }) + this->tolerance_);
        const Index v0 =
          std::max(first_line, v_of(std::min({ c[0][v], c[1][v], c[2][v] }) - this->tolerance_));
        const Index v1 =
          std::min(last_line - 1, v_of(std::max({ c[0][v], c[1][v], c[2][v] }) + this->tolerance_));
        bool is_facet_ready = false;
        Facet f;
        FacetBounds bounds;
        for (Index line = v0; line <= v1; ++line)
        {
          const std::int32_t b = begin[line * u_cells + u0], e = begin[line * u_cells + u1 + 1];
          if (b == e)
          {
            continue;
          }
          if (!is_facet_ready)
          {
            f = this->facet(face, this->axis_);
            bounds = { f.x[0], f.y[0], f.z[0], f.y[1], f.z[1], f.y[2], f.z[2], f.upper[0],
              f.lower[0], f.lower[1], f.upper[1], f.lower[2], f.upper[2], f.normal[0], f.normal[1],
              f.normal[2], f.edge_bound, f.outside, f.plane_bound };
            is_facet_ready = true;
          }
          for (std::int32_t at = b; at < e; at += points_per_batch)
          {
            const std::int32_t batch_count = std::min(points_per_batch, e - at);
            if (add_crossings(bounds, &sorted.x[at], &sorted.y[at], &sorted.z[at], batch_count,
                  &sums[at - first_point], undecided.data()))
            {
              for (std::int32_t k = at; k < at + batch_count; ++k)
              {
                if (undecided[k - at])
                {
                  bool touches = false;
                  sums[k - first_point] += this->signed_crossing(f, points[ids[k]], touches);
                  resolved[ids[k]] = resolved[ids[k]] && !touches;
                }
              }
            }
          }
        }
      }
      for (std::int32_t k = first_point; k < last_point; ++k)
      {
        counts[ids[k]] = sums[k - first_point];
      }
    });
}

// ---- Grids -------------------------------------------------------------------------------------

RayCrossings::Layers RayCrossings::find_layers(const Grid& grid) const
{
  const auto& [xs, ys, zs] = grid.at;
  Layers layers;
  const auto layer_count = static_cast<Index>(zs.size());
  const auto area = static_cast<Index>(xs.size() * ys.size());
  layers.layers_per_slab =
    std::clamp<Index>(samples_per_slab / std::max<Index>(1, area), 1, layer_count);
  const Index slabs = (layer_count + layers.layers_per_slab - 1) / layers.layers_per_slab;
  const double y_density = index_density(ys), z_density = index_density(zs);
  layers.begin.assign(static_cast<std::size_t>(slabs) + 1, 0);
  struct Range
  {
    std::int32_t first, last;
  };
  std::vector<Range> ranges(static_cast<std::size_t>(this->faces_));
  double rows = 0.0;
  for (Index f = 0; f < this->faces_; ++f)
  {
    const std::array<Vec3, 3> c = this->corners(f);
    const Vec3 lower = c[0].cwiseMin(c[1]).cwiseMin(c[2]).array() - this->tolerance_;
    const Vec3 upper = c[0].cwiseMax(c[1]).cwiseMax(c[2]).array() + this->tolerance_;
    const Index first = lower_bound_index(zs, lower.z(), z_density);
    Index end = first;
    if (first < layer_count && zs[first] <= upper.z() && xs.front() <= upper.x())
    {
      end = lower_bound_index(zs, upper.z(), z_density);
      end += end < layer_count && zs[end] <= upper.z();
      const double row_count = (upper.y() - lower.y()) * y_density;
      rows +=
        static_cast<double>(end - first) * std::min(row_count, static_cast<double>(ys.size()));
    }
    ranges[f] = { static_cast<std::int32_t>(first / layers.layers_per_slab),
      static_cast<std::int32_t>(end > first ? (end - 1) / layers.layers_per_slab : -1) };
    for (Index s = ranges[f].first; s <= ranges[f].last; ++s)
    {
      layers.begin[s + 1] += 1;
    }
  }
  for (Index s = 0; s < slabs; ++s)
  {
    layers.begin[s + 1] += layers.begin[s];
  }
  if (layers.begin.back() > maximum_slabs_per_face * this->faces_ + 1000000)
  {
    layers.nanoseconds = std::numeric_limits<double>::infinity();
    return layers;
  }
  layers.faces.resize(static_cast<std::size_t>(layers.begin.back()));
  std::vector<Index> next(layers.begin.begin(), layers.begin.end() - 1);
  for (Index f = 0; f < this->faces_; ++f)
  {
    for (Index s = ranges[f].first; s <= ranges[f].last; ++s)
    {
      layers.faces[next[s]++] = static_cast<std::int32_t>(f);
    }
  }
  layers.nanoseconds = face_cost * static_cast<double>(this->faces_) +
    slab_face_cost * static_cast<double>(layers.faces.size()) + row_cost * rows;
  return layers;
}

/// Crossings of triangles with the rows of samples in a slab. A crossing adds `sign` to the samples
/// [0, end) of a row.
class RayCrossings::RowHits
{
public:
  explicit RowHits(Index rows) : begin_(static_cast<std::size_t>(rows) + 1, 0) {}

  void add(Index row, Index end, int sign)
  {
    if (end > 0)
    {
      this->hits_.push_back(
        { static_cast<std::int32_t>(row), static_cast<std::int32_t>(end), sign });
      this->begin_[row + 1] += 1;
    }
  }

  void write(Index length, double* values)
  {
    const std::size_t rows = this->begin_.size() - 1;
    for (std::size_t r = 0; r < rows; ++r)
    {
      this->begin_[r + 1] += this->begin_[r];
    }
    std::vector<Hit> sorted(this->hits_.size());
    std::vector<std::int32_t> next(this->begin_.begin(), this->begin_.end() - 1);
    for (const Hit& hit : this->hits_)
    {
      sorted[next[hit.row]++] = hit;
    }
    for (std::size_t r = 0; r < rows; ++r)
    {
      Hit* const first = sorted.data() + this->begin_[r];
      Hit* const last = sorted.data() + this->begin_[r + 1];
      std::sort(first, last, [](const Hit& a, const Hit& b) { return a.end < b.end; });
      int count = 0;
      for (const Hit* hit = first; hit != last; ++hit)
      {
        count += hit->sign;
      }
      double* const row = values + static_cast<Index>(r) * length;
      Index at = 0;
      for (const Hit* hit = first; hit != last; ++hit)
      {
        if (hit->end > at)
        {
          std::fill(row + at, row + hit->end, static_cast<double>(count));
          at = hit->end;
        }
        count -= hit->sign;
      }
      std::fill(row + at, row + length, 0.0);
    }
  }

private:
  struct Hit
  {
    std::int32_t row, end;
    int sign;
  };
  std::vector<Hit> hits_;
  std::vector<std::int32_t> begin_;
};

void RayCrossings::count_slab(const Grid& grid, const Layers& layers, Index slab, double* values,
  std::vector<Index>& unresolved) const
{
  const auto& [xs, ys, zs] = grid.at;
  const auto length = static_cast<Index>(xs.size());
  const auto rows = static_cast<Index>(ys.size());
  const Index first_layer = slab * layers.layers_per_slab;
  const Index last_layer =
    std::min(static_cast<Index>(zs.size()), first_layer + layers.layers_per_slab);
  const double x_density = index_density(xs), y_density = index_density(ys),
               z_density = index_density(zs);
  RowHits hits((last_layer - first_layer) * rows);
  for (Index i = layers.begin[slab]; i < layers.begin[slab + 1]; ++i)
  {
    const Facet f = this->facet(layers.faces[i], 0);
    const Index j0 = lower_bound_index(ys, f.lower[1], y_density);
    if (j0 == rows || ys[j0] > f.upper[1])
    {
      continue;
    }
    const Index k0 = std::max(first_layer, lower_bound_index(zs, f.lower[2], z_density));
    const double inverse_normal_x = 1.0 / f.normal[0];
    const double x_tolerance = f.plane_bound * std::abs(inverse_normal_x);
    for (Index k = k0; k < last_layer && zs[k] <= f.upper[2]; ++k)
    {
      const double pz = zs[k];
      const double az = f.z[0] - pz, bz = f.z[1] - pz, cz = f.z[2] - pz;
      for (Index j = j0; j < rows && ys[j] <= f.upper[1]; ++j)
      {
        const double py = ys[j];
        const double ay = f.y[0] - py, by = f.y[1] - py, cy = f.y[2] - py;
        const double ab = ay * bz - az * by;
        const double bc = by * cz - bz * cy;
        const double ca = cy * az - cz * ay;
        const double minimum = std::min({ ab, bc, ca }), maximum = std::max({ ab, bc, ca });
        if (minimum < -f.outside && maximum > f.outside)
        {
          continue;
        }
        const Index row = (k - first_layer) * rows + j;
        const bool is_side_certain = minimum > f.edge_bound || maximum < -f.edge_bound;
        // The samples with x coordinates from `x` to `y` are tested one by one. If the triangle is
        // parallel to the rows, inverse_normal_x is infinite. The comparisons below are then false,
        // so `x` and `y` are the ends of the triangle's box.
        const double center = f.x[0] + (f.normal[1] * ay + f.normal[2] * az) * inverse_normal_x;
        const double x = center - x_tolerance > f.lower[0]
          ? std::min(center - x_tolerance, f.upper[0])
          : f.lower[0];
        const double y = center + x_tolerance < f.upper[0]
          ? std::max(center + x_tolerance, f.lower[0])
          : f.upper[0];
        Index at = lower_bound_index(xs, x, x_density);
        bool touches = false;
        if (is_side_certain)
        {
          hits.add(row, at, minimum > 0.0 ? 1 : -1);
        }
        else if (at > 0)
        {
          // A ray that starts in front of the box crosses the triangle if it crosses the triangle's
          // projection.
          hits.add(row, at, this->signed_crossing(f, Vec3(f.lower[0] - 1.0, py, pz), touches));
        }
        for (; at < length && xs[at] <= y; ++at)
        {
          touches = false;
          const int sign = this->signed_crossing(f, Vec3(xs[at], py, pz), touches);
          if (touches)
          {
            unresolved.push_back(row * length + at);
          }
          else if (sign != 0)
          {
            hits.add(row, at + 1, sign);
            hits.add(row, at, -sign);
          }
        }
      }
    }
  }
  hits.write(length, values);
}

} // namespace bindpose
