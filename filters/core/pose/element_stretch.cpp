// The gradient of a tet is (posed edges) (rest edges)^-1. Its singular values are the lengths of
// its columns once they have been turned until they are at right angles (one-sided Jacobi), which
// is exact to round-off for collapsed tets, too. Eight tets are turned at once, lanes side by side.
//
// A triangle's gradient is 3 x 2, in a frame of its plane at rest, and has its singular values in
// closed form.
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
constexpr Index block_size = 4096;
/// An element whose volume (area) at rest is no more than this share of that of a cube (square) of
/// its edges is degenerate: what it has of a shape is round-off.
constexpr double degenerate_share = 1e-12;
/// Of the diagonal: a shape as flat as this lies in a plane.
constexpr double flat_tolerance = 1e-9;
/// Matrices that are turned at once; block_size is a multiple.
constexpr Index lanes = 8;
/// Squared cosine between two columns above which a sweep over them is not the last: the next one
/// squares what is left.
constexpr double right_angle = 1e-16;
constexpr int most_sweeps = 12;

struct Block
{
  Index inverted = 0, stretched = 0, degenerate = 0, measured = 0;
  double largest = 0.0;
  double smallest = std::numeric_limits<double>::infinity();
};

/// 3 x 3 matrices: column, row, lane.
struct alignas(64) Batch
{
  double at[3][3][lanes];
};

struct alignas(64) BatchValues
{
  double largest[lanes], smallest[lanes];
};

/// Turns columns p and q of each lane to a right angle; the largest squared cosine before, over
/// 1e-16 of them: above zero when there is more to turn.
BINDPOSE_ALWAYS_INLINE double turn(double (*p)[lanes], double (*q)[lanes])
{
  double open[lanes];
  for (Index i = 0; i < lanes; ++i)
  {
    const double a = p[0][i] * p[0][i] + p[1][i] * p[1][i] + p[2][i] * p[2][i];
    const double b = q[0][i] * q[0][i] + q[1][i] * q[1][i] + q[2][i] * q[2][i];
    const double c = p[0][i] * q[0][i] + p[1][i] * q[1][i] + p[2][i] * q[2][i];
    open[i] = c * c - right_angle * a * b;
    const double d = b - a;
    const double reach = std::abs(d) + std::sqrt(d * d + 4.0 * c * c);
    const double tangent = (d < 0.0 ? -2.0 : 2.0) * c / (reach + 1e-300);
    const double cosine = 1.0 / std::sqrt(1.0 + tangent * tangent);
    const double sine = tangent * cosine;
    for (int k = 0; k < 3; ++k)
    {
      const double first = cosine * p[k][i] - sine * q[k][i];
      q[k][i] = cosine * q[k][i] + sine * p[k][i];
      p[k][i] = first;
    }
  }
  double most = open[0];
  for (Index i = 1; i < lanes; ++i)
  {
    most = open[i] > most ? open[i] : most;
  }
  return most;
}

BINDPOSE_SIMD_CLONES void singular_values(Batch& f, BatchValues& values)
{
  double size[lanes];
  for (Index i = 0; i < lanes; ++i)
  {
    size[i] = 0.0;
  }
  // Squares of huge and tiny entries must stay numbers.
  for (auto& column : f.at)
  {
    for (auto& row : column)
    {
      for (Index i = 0; i < lanes; ++i)
      {
        size[i] = std::abs(row[i]) > size[i] ? std::abs(row[i]) : size[i];
      }
    }
  }
  for (auto& column : f.at)
  {
    for (auto& row : column)
    {
      for (Index i = 0; i < lanes; ++i)
      {
        row[i] = size[i] > 0.0 ? row[i] / size[i] : 0.0;
      }
    }
  }
  for (int sweep = 0; sweep < most_sweeps; ++sweep)
  {
    const double first = turn(f.at[0], f.at[1]);
    const double second = turn(f.at[0], f.at[2]);
    const double third = turn(f.at[1], f.at[2]);
    if (first <= 0.0 && second <= 0.0 && third <= 0.0)
    {
      break;
    }
  }
  for (Index i = 0; i < lanes; ++i)
  {
    double length[3];
    for (int c = 0; c < 3; ++c)
    {
      length[c] = size[i] *
        std::sqrt(f.at[c][0][i] * f.at[c][0][i] + f.at[c][1][i] * f.at[c][1][i] +
          f.at[c][2][i] * f.at[c][2][i]);
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

/// Takes one element's values; `flipped`: inside out.
void count(Block& block, double limit, Index element, double largest, double smallest, bool flipped,
  ElementStretch& stretch)
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

/// The gradient of a tet into a lane; whether it has one.
bool load(
  PointsView rest, PointsView posed, const Index* v, Index lane, Batch& batch, bool& flipped)
{
  const Vec3 a = edge(rest, v[0], v[1]), b = edge(rest, v[0], v[2]), c = edge(rest, v[0], v[3]);
  const Vec3 bc = b.cross(c), ca = c.cross(a), ab = a.cross(b);
  const double volume = a.dot(bc);
  const double longest = std::max({ a.squaredNorm(), b.squaredNorm(), c.squaredNorm() });
  if (!(std::abs(volume) > degenerate_share * longest * std::sqrt(longest)))
  {
    return false;
  }
  const Vec3 pa = edge(posed, v[0], v[1]), pb = edge(posed, v[0], v[2]),
             pc = edge(posed, v[0], v[3]);
  for (int k = 0; k < 3; ++k) // [pa pb pc] [a b c]^-1
  {
    const Vec3 column = (bc[k] / volume) * pa + (ca[k] / volume) * pb + (ab[k] / volume) * pc;
    for (int row = 0; row < 3; ++row)
    {
      batch.at[k][row][lane] = column[row];
    }
  }
  flipped = pa.dot(pb.cross(pc)) / volume < 0.0;
  return true;
}

Status check(const ElementStretchOptions& options, PointsView rest, PointsView posed)
{
  if (!(options.limit >= 1.0))
  {
    return Status::invalid_input("the stretch limit must be at least 1");
  }
  if (rest.rows() != posed.rows())
  {
    return Status::invalid_input("there are " + std::to_string(posed.rows()) +
      " posed points for " + std::to_string(rest.rows()) + " at rest");
  }
  return {};
}

/// measure(begin, end, block) for all, and what the blocks found.
template <typename Measure>
Status over_elements(
  ExecutionContext& context, Index elements, const char* what, const Measure& measure)
{
  std::vector<Block> blocks(static_cast<std::size_t>((elements + block_size - 1) / block_size));
  const bool done = parallel_for(context, elements, block_size,
    [&](Index begin, Index end)
    {
      Block block; // on this thread's stack: neighbours share no cache line
      measure(begin, end, block);
      blocks[static_cast<std::size_t>(begin / block_size)] = block;
    });
  if (!done)
  {
    return Status::cancelled();
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
    status.warnings.push_back("the pose turns " + std::to_string(all.inverted) + " of " +
      std::to_string(elements) + " " + what + " inside out");
  }
  return status;
}

void prepare(const ElementStretchOptions& options, Index elements, ElementStretch& stretch)
{
  const auto size = static_cast<std::size_t>(options.values ? elements : 0);
  stretch.largest.assign(size, std::numeric_limits<double>::quiet_NaN());
  stretch.smallest = stretch.largest;
}

bool in_a_plane(PointsView points)
{
  const Box box = bounding_box(points);
  return box.size().z() <= flat_tolerance * box.diagonal();
}
} // namespace

Status element_stretch(ExecutionContext& context, const ElementStretchOptions& options,
  PointsView rest, PointsView posed, TetsView tets, ElementStretch& stretch)
{
  Status status = check(options, rest, posed);
  if (!status.ok())
  {
    return status;
  }
  prepare(options, tets.rows(), stretch);
  return over_elements(context, tets.rows(), "tets",
    [&](Index begin, Index end, Block& block)
    {
      Batch batch;
      BatchValues values;
      Index element[lanes];
      bool flipped[lanes];
      for (Index t = begin; t < end;)
      {
        Index filled = 0;
        for (; t < end && filled < lanes; ++t)
        {
          if (load(rest, posed, tets.data() + 4 * t, filled, batch, flipped[filled]))
          {
            element[filled] = t;
            filled += 1;
          }
          else
          {
            block.degenerate += 1;
          }
        }
        for (Index i = filled; i < lanes; ++i)
        {
          for (auto& column : batch.at)
          {
            column[0][i] = column[1][i] = column[2][i] = 0.0;
          }
        }
        singular_values(batch, values);
        for (Index i = 0; i < filled; ++i)
        {
          count(block, options.limit, element[i], values.largest[i], values.smallest[i], flipped[i],
            stretch);
        }
      }
    });
}

Status element_stretch(ExecutionContext& context, const ElementStretchOptions& options,
  PointsView rest, PointsView posed, TrianglesView triangles, ElementStretch& stretch)
{
  Status status = check(options, rest, posed);
  if (!status.ok())
  {
    return status;
  }
  prepare(options, triangles.rows(), stretch);
  const bool flat = in_a_plane(rest) && in_a_plane(posed);
  return over_elements(context, triangles.rows(), "triangles",
    [&](Index begin, Index end, Block& block)
    {
      for (Index t = begin; t < end; ++t)
      {
        const Index* v = triangles.data() + 3 * t;
        const Vec3 a = edge(rest, v[0], v[1]), b = edge(rest, v[0], v[2]);
        const double length = a.norm();
        const double height = a.cross(b).norm() / length;
        if (!(height > degenerate_share * std::max(length, b.norm())))
        {
          block.degenerate += 1;
          continue;
        }
        const Vec3 pa = edge(posed, v[0], v[1]), pb = edge(posed, v[0], v[2]);
        const Vec3 x = pa / length;
        const Vec3 y = (pb - (a.dot(b) / length) * x) / height;
        const double half = 0.5 * (x.squaredNorm() - y.squaredNorm()), mixed = x.dot(y);
        const double largest = std::sqrt(
          0.5 * (x.squaredNorm() + y.squaredNorm()) + std::sqrt(half * half + mixed * mixed));
        const double smallest = largest > 0.0 ? x.cross(y).norm() / largest : 0.0;
        const bool flipped =
          flat && (pa[0] * pb[1] - pa[1] * pb[0]) * (a[0] * b[1] - a[1] * b[0]) < 0.0;
        count(block, options.limit, t, largest, smallest, flipped, stretch);
      }
    });
}

} // namespace bindpose
