// Singular values of the deformation gradient of each element.
//
// The gradient of a tet is (posed edges) (rest edges)^-1. The one-sided Jacobi method rotates the
// columns of the gradient until they are orthogonal. The lengths of the columns are then the
// singular values. The method is accurate to round-off even for collapsed tets.
//
// The gradient of a triangle is 3 x 2, in a frame of its plane at rest, and its singular values
// have a closed form.
//
// Eight elements are processed in parallel, one per lane. The inverses of the rest edges are
// stored. For a tet, the data is a 3 x 3 matrix and the sign of the volume. For a triangle with
// edges a and b and height h over a, the data is
//     1 / |a|,   a.b / |a|^2,   1 / h,   the sign of its area in the plane z = const.
#include "pose/element_stretch.h"

#include "base/parallel.h"
#include "base/simd.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bindpose
{

namespace
{
constexpr Index elements_per_block = 4096;
/// A tet is degenerate if its volume at rest is at most about this fraction of the cube of its
/// longest edge. A triangle is degenerate if its area at rest is at most about this fraction of the
/// square of its longest edge. Only round-off determines the shape of a degenerate element.
constexpr double degenerate_tolerance = 1e-12;
/// A shape is flat if its thickness in z is at most this fraction of the bounding-box diagonal.
constexpr double flat_tolerance = 1e-9;
/// Number of elements that are processed in parallel; elements_per_block is a multiple of it.
constexpr Index elements_per_tile = 8;
/// Number of values stored per element at rest. The last value is a sign. All values of a
/// degenerate element are zero.
constexpr Index triangle_numbers = 4, tet_numbers = 10;
/// Jacobi sweeps are repeated while the squared cosine of the angle between two columns exceeds
/// this value. Each sweep squares the remaining cosine.
constexpr double right_angle = 1e-16;
constexpr int maximum_sweeps = 12;

struct Block
{
  Index inverted = 0, stretched = 0, degenerate = 0, measured = 0;
  double largest = 0.0;
  double smallest = std::numeric_limits<double>::infinity();
};

/// 3 x 3 matrices, indexed by column, row, lane.
struct alignas(64) Batch
{
  double columns[3][3][elements_per_tile];
};

struct alignas(64) BatchValues
{
  double largest[elements_per_tile], smallest[elements_per_tile];
  double area[elements_per_tile]; ///< signed size of the posed element; negative if it is flipped
};

/// Rotate columns p and q of each lane until they are orthogonal. Return the largest value of
/// c^2 - right_angle * a * b over the lanes before the rotation, where a and b are the squared
/// lengths and c is the dot product. It is positive if another sweep is needed.
BINDPOSE_ALWAYS_INLINE double jacobi_rotate(
  double (*p)[elements_per_tile], double (*q)[elements_per_tile])
{
  double off_diagonal[elements_per_tile];
  for (Index i = 0; i < elements_per_tile; ++i)
  {
    const double a = p[0][i] * p[0][i] + p[1][i] * p[1][i] + p[2][i] * p[2][i];
    const double b = q[0][i] * q[0][i] + q[1][i] * q[1][i] + q[2][i] * q[2][i];
    const double c = p[0][i] * q[0][i] + p[1][i] * q[1][i] + p[2][i] * q[2][i];
    off_diagonal[i] = c * c - right_angle * a * b;
    const double d = b - a;
    const double denominator = std::abs(d) + std::sqrt(d * d + 4.0 * c * c);
    const double tangent = (d < 0.0 ? -2.0 : 2.0) * c / (denominator + 1e-300);
    const double cosine = 1.0 / std::sqrt(1.0 + tangent * tangent);
    const double sine = tangent * cosine;
    for (int k = 0; k < 3; ++k)
    {
      const double first = cosine * p[k][i] - sine * q[k][i];
      q[k][i] = cosine * q[k][i] + sine * p[k][i];
      p[k][i] = first;
    }
  }
  double maximum = off_diagonal[0];
  for (Index i = 1; i < elements_per_tile; ++i)
  {
    maximum = off_diagonal[i] > maximum ? off_diagonal[i] : maximum;
  }
  return maximum;
}

BINDPOSE_ALWAYS_INLINE void singular_values(Batch& f, BatchValues& values)
{
  double size[elements_per_tile];
  for (Index i = 0; i < elements_per_tile; ++i)
  {
    size[i] = 0.0;
  }
  // Scale the entries so that squares of huge and tiny entries neither overflow nor underflow.
  for (auto& column : f.columns)
  {
    for (auto& row : column)
    {
      for (Index i = 0; i < elements_per_tile; ++i)
      {
        size[i] = std::abs(row[i]) > size[i] ? std::abs(row[i]) : size[i];
      }
    }
  }
  for (auto& column : f.columns)
  {
    for (auto& row : column)
    {
      for (Index i = 0; i < elements_per_tile; ++i)
      {
        row[i] = size[i] > 0.0 ? row[i] / size[i] : 0.0;
      }
    }
  }
  for (int sweep = 0; sweep < maximum_sweeps; ++sweep)
  {
    const double first = jacobi_rotate(f.columns[0], f.columns[1]);
    const double second = jacobi_rotate(f.columns[0], f.columns[2]);
    const double third = jacobi_rotate(f.columns[1], f.columns[2]);
    if (first <= 0.0 && second <= 0.0 && third <= 0.0)
    {
      break;
    }
  }
  for (Index i = 0; i < elements_per_tile; ++i)
  {
    double length[3];
    for (int c = 0; c < 3; ++c)
    {
      length[c] = size[i] *
        std::sqrt(f.columns[c][0][i] * f.columns[c][0][i] +
          f.columns[c][1][i] * f.columns[c][1][i] + f.columns[c][2][i] * f.columns[c][2][i]);
    }
    values.largest[i] = std::max({ length[0], length[1], length[2] });
    values.smallest[i] = std::min({ length[0], length[1], length[2] });
  }
}

Vec3 edge(PointsView points, Index from, Index to)
{
  const double* a = points.data() + 3 * from;
  const double* b = points.data() + 3 * to;
  return Vec3(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
}

/// Add the singular values of one element to the totals of its block.
/// @param flipped whether the element is inside out.
void count_element(Block& block, double limit, Index element, double largest, double smallest,
  bool flipped, ElementStretch& stretch)
{
  block.measured += 1;
  block.largest = std::max(block.largest, largest);
  block.smallest = std::min(block.smallest, smallest);
  block.stretched += largest > limit || smallest * limit < 1.0 ? 1 : 0;
  block.inverted += flipped ? 1 : 0;
  if (!stretch.largest.empty())
  {
    stretch.largest[static_cast<std::size_t>(element)] = largest;
    stretch.smallest[static_cast<std::size_t>(element)] = flipped ? -smallest : smallest;
  }
}

/// Load, for each posed element, the vectors from its first corner to its other corners. Index
/// order: edge, coordinate, lane.
template <int corners>
BINDPOSE_ALWAYS_INLINE void load_edges(
  const double* posed, const Index* ids, double (&edges)[corners - 1][3][elements_per_tile])
{
  for (Index i = 0; i < elements_per_tile; ++i)
  {
    const double* from = posed + 3 * ids[i];
    for (int k = 1; k < corners; ++k)
    {
      const double* to = posed + 3 * ids[k * elements_per_tile + i];
      edges[k - 1][0][i] = to[0] - from[0];
      edges[k - 1][1][i] = to[1] - from[1];
      edges[k - 1][2][i] = to[2] - from[2];
    }
  }
}

BINDPOSE_SIMD_CLONES void measure_tets(
  const double* posed, const Index* ids, const double* shape, BatchValues& values)
{
  alignas(64) double p[3][3][elements_per_tile];
  load_edges<4>(posed, ids, p);
  Batch f;
  for (int k = 0; k < 3; ++k) // gradient = (posed edges) (rest edges)^-1
  {
    const double *u = shape + 3 * k * elements_per_tile, *v = u + elements_per_tile,
                 *w = v + elements_per_tile;
    for (int row = 0; row < 3; ++row)
    {
      for (Index i = 0; i < elements_per_tile; ++i)
      {
        f.columns[k][row][i] = u[i] * p[0][row][i] + v[i] * p[1][row][i] + w[i] * p[2][row][i];
      }
    }
  }
  const double* sign = shape + 9 * elements_per_tile;
  for (Index i = 0; i < elements_per_tile; ++i)
  {
    values.area[i] = sign[i] *
      (p[0][0][i] * (p[1][1][i] * p[2][2][i] - p[1][2][i] * p[2][1][i]) +
        p[0][1][i] * (p[1][2][i] * p[2][0][i] - p[1][0][i] * p[2][2][i]) +
        p[0][2][i] * (p[1][0][i] * p[2][1][i] - p[1][1][i] * p[2][0][i]));
  }
  singular_values(f, values);
}

BINDPOSE_SIMD_CLONES void measure_triangles(
  const double* posed, const Index* ids, const double* shape, BatchValues& values)
{
  alignas(64) double p[2][3][elements_per_tile];
  load_edges<3>(posed, ids, p);
  const double *length = shape, *slope = shape + elements_per_tile,
               *height = shape + 2 * elements_per_tile, *sign = shape + 3 * elements_per_tile;
  for (Index i = 0; i < elements_per_tile; ++i)
  {
    const double a0 = p[0][0][i], a1 = p[0][1][i], a2 = p[0][2][i];
    const double x0 = a0 * length[i], x1 = a1 * length[i], x2 = a2 * length[i];
    const double y0 = (p[1][0][i] - slope[i] * a0) * height[i];
    const double y1 = (p[1][1][i] - slope[i] * a1) * height[i];
    const double y2 = (p[1][2][i] - slope[i] * a2) * height[i];
    const double xx = x0 * x0 + x1 * x1 + x2 * x2, yy = y0 * y0 + y1 * y1 + y2 * y2;
    const double half = 0.5 * (xx - yy), xy = x0 * y0 + x1 * y1 + x2 * y2;
    const double n0 = x1 * y2 - x2 * y1, n1 = x2 * y0 - x0 * y2, n2 = x0 * y1 - x1 * y0;
    const double largest = std::sqrt(0.5 * (xx + yy) + std::sqrt(half * half + xy * xy));
    values.largest[i] = largest;
    values.smallest[i] = largest > 0.0 ? std::sqrt(n0 * n0 + n1 * n1 + n2 * n2) / largest : 0.0;
    values.area[i] = sign[i] * (a0 * p[1][1][i] - a1 * p[1][0][i]);
  }
}

/// Write the stored values of an element at rest into a lane. Nothing is written for a degenerate
/// element.
void shape_of(PointsView rest, const Index* v, TetsView, double* shape)
{
  const Vec3 a = edge(rest, v[0], v[1]), b = edge(rest, v[0], v[2]), c = edge(rest, v[0], v[3]);
  const Vec3 bc = b.cross(c), ca = c.cross(a), ab = a.cross(b);
  const double volume = a.dot(bc);
  const double longest = std::max({ a.squaredNorm(), b.squaredNorm(), c.squaredNorm() });
  if (!(std::abs(volume) > degenerate_tolerance * longest * std::sqrt(longest)))
  {
    return;
  }
  for (int k = 0; k < 3; ++k)
  {
    shape[3 * k * elements_per_tile] = bc[k] / volume;
    shape[(3 * k + 1) * elements_per_tile] = ca[k] / volume;
    shape[(3 * k + 2) * elements_per_tile] = ab[k] / volume;
  }
  shape[9 * elements_per_tile] = volume > 0.0 ? 1.0 : -1.0;
}

void shape_of(PointsView rest, const Index* v, TrianglesView, double* shape)
{
  const Vec3 a = edge(rest, v[0], v[1]), b = edge(rest, v[0], v[2]);
  const double length = a.norm();
  const double height = a.cross(b).norm() / length;
  if (!(height > degenerate_tolerance * std::max(length, b.norm())))
  {
    return;
  }
  shape[0] = 1.0 / length;
  shape[elements_per_tile] = a.dot(b) / (length * length);
  shape[2 * elements_per_tile] = 1.0 / height;
  shape[3 * elements_per_tile] = a[0] * b[1] - a[1] * b[0] > 0.0 ? 1.0 : -1.0;
}

Status check(const ElementStretchOptions& options, Index rest, PointsView posed)
{
  if (!(options.limit >= 1.0))
  {
    return Status::invalid_input("the stretch limit must be at least 1");
  }
  if (rest != posed.rows())
  {
    return Status::invalid_input("the number of posed points (" + std::to_string(posed.rows()) +
      ") differs from the number of rest points (" + std::to_string(rest) + ")");
  }
  return {};
}

/// Call measure(begin, end, block) for each block of elements, and add up the blocks. The report of
/// the returned status contains the totals.
template <typename Measure>
Status sum_over_elements(
  ExecutionContext& context, Index elements, const char* element_kind, const Measure& measure)
{
  std::vector<Block> blocks(
    static_cast<std::size_t>((elements + elements_per_block - 1) / elements_per_block));
  const bool done = parallel_for(context, elements, elements_per_block,
    [&](Index begin, Index end)
    {
      Block block; // each thread has a local block, to avoid false sharing of cache lines
      measure(begin, end, block);
      blocks[static_cast<std::size_t>(begin / elements_per_block)] = block;
    });
  if (!done)
  {
    return Status::canceled();
  }
  Block all;
  for (const Block& block : blocks)
  {
    all.inverted += block.inverted;
    all.stretched += block.stretched;
    all.degenerate += block.degenerate;
    all.measured += block.measured;
    all.largest = std::max(all.largest, block.largest);
    all.smallest = std::min(all.smallest, block.smallest);
  }
  Status status;
  status.report.set("counts.elements", elements);
  status.report.set("counts.inverted_elements", all.inverted);
  status.report.set("counts.stretched_elements", all.stretched);
  if (all.degenerate > 0)
  {
    status.report.set("counts.degenerate_elements", all.degenerate);
  }
  if (all.measured > 0)
  {
    status.report.set("largest_stretch", all.largest);
    status.report.set("smallest_stretch", all.smallest);
  }
  if (all.inverted > 0)
  {
    status.warnings.push_back("the pose inverts " + std::to_string(all.inverted) + " of " +
      std::to_string(elements) + " " + element_kind);
  }
  return status;
}

void prepare(const ElementStretchOptions& options, Index elements, ElementStretch& stretch)
{
  const auto size = static_cast<std::size_t>(options.values ? elements : 0);
  stretch.largest.assign(size, std::numeric_limits<double>::quiet_NaN());
  stretch.smallest = stretch.largest;
}

bool are_coplanar(PointsView points)
{
  const Box box = bounding_box(points);
  return box.size().z() <= flat_tolerance * box.diagonal();
}
} // namespace

template <typename Elements>
void RestElements::store_rest_shape(PointsView rest, const Elements& elements)
{
  constexpr Index numbers = Elements::ColsAtCompileTime == 4 ? tet_numbers : triangle_numbers;
  this->corners_ = Elements::ColsAtCompileTime;
  this->points_ = rest.rows();
  this->count_ = elements.rows();
  this->flat_ = this->corners_ == 3 && are_coplanar(rest);
  const Index tiles = (this->count_ + elements_per_tile - 1) / elements_per_tile;
  this->ids_.assign(static_cast<std::size_t>(tiles * this->corners_ * elements_per_tile), 0);
  this->shape_.assign(static_cast<std::size_t>(tiles * numbers * elements_per_tile), 0.0);
  for (Index e = 0; e < this->count_; ++e)
  {
    const Index tile = e / elements_per_tile, lane = e % elements_per_tile;
    const Index* v = elements.data() + this->corners_ * e;
    for (int k = 0; k < this->corners_; ++k)
    {
      this->ids_[static_cast<std::size_t>((tile * this->corners_ + k) * elements_per_tile + lane)] =
        v[k];
    }
    shape_of(rest, v, elements, this->shape_.data() + tile * numbers * elements_per_tile + lane);
  }
}

RestElements::RestElements(PointsView rest, TetsView tets)
{
  this->store_rest_shape(rest, tets);
}

RestElements::RestElements(PointsView rest, TrianglesView triangles)
{
  this->store_rest_shape(rest, triangles);
}

Status RestElements::stretch(ExecutionContext& context, const ElementStretchOptions& options,
  PointsView posed, ElementStretch& stretch) const
{
  Status status = check(options, this->points_, posed);
  if (!status.ok())
  {
    return status;
  }
  prepare(options, this->count_, stretch);
  const bool tets = this->corners_ == 4;
  // Triangles in space have no orientation sign.
  const bool sign = tets || (this->flat_ && are_coplanar(posed));
  const Index numbers = tets ? tet_numbers : triangle_numbers;
  return sum_over_elements(context, this->count_, tets ? "tets" : "triangles",
    [&](Index begin, Index end, Block& block)
    {
      BatchValues values;
      for (Index e = begin; e < end; e += elements_per_tile)
      {
        const Index tile = e / elements_per_tile;
        const Index* ids = this->ids_.data() + tile * this->corners_ * elements_per_tile;
        const double* shape = this->shape_.data() + tile * numbers * elements_per_tile;
        if (tets)
        {
          measure_tets(posed.data(), ids, shape, values);
        }
        else
        {
          measure_triangles(posed.data(), ids, shape, values);
        }
        const double* orientation = shape + (numbers - 1) * elements_per_tile;
        for (Index i = 0; i < std::min(elements_per_tile, end - e); ++i)
        {
          if (orientation[i] == 0.0)
          {
            block.degenerate += 1;
            continue;
          }
          count_element(block, options.limit, e + i, values.largest[i], values.smallest[i],
            sign && values.area[i] < 0.0, stretch);
        }
      }
    });
}

Status element_stretch(ExecutionContext& context, const ElementStretchOptions& options,
  PointsView rest, PointsView posed, TetsView tets, ElementStretch& stretch)
{
  return RestElements(rest, tets).stretch(context, options, posed, stretch);
}

Status element_stretch(ExecutionContext& context, const ElementStretchOptions& options,
  PointsView rest, PointsView posed, TrianglesView triangles, ElementStretch& stretch)
{
  return RestElements(rest, triangles).stretch(context, options, posed, stretch);
}

} // namespace bindpose
