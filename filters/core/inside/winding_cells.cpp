// Between two points the winding number changes by the signed crossings of the segment that joins
// them. A cell is convex, so the segment from a point to the cell's reference meets the cell's own
// triangles only, and they are few.
//
// A segment from p to r crosses the triangle a, b, c when p and r lie on different sides of its
// plane and the line passes all edges on the same side: five signs of volumes, all made of the
// cross products of the corners as seen from p. They are computed for eight triangles at once in
// floats, with a bound of their error. Where that leaves a sign open, in doubles; where that does,
// too, the point touches the triangle or the segment an edge: not told.
//
// Building goes from the box of the surface downwards: a box's triangles are sorted into its cells,
// and a cell that still holds many is a box again. References get their numbers from each other: a
// cell's from its neighbour's, the first one's from that of the box.
#include "inside/winding_cells.h"

#include "base/compact.h"
#include "base/simd.h"
#include "inside/solid_angle.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace bindpose
{

namespace
{
/// Cells with more triangles are cut further. Measured: half as many cost as much time for paths
/// through cells and twice the memory.
constexpr std::size_t few = 30;
/// Triangles that a new cell is meant to hold.
constexpr double wanted = 14;
constexpr int most_cells_along = 32;
constexpr int deepest = 12;
/// Errors of the volumes, in units of what doubles keep of the largest corner cubed, or squared
/// times the segment where that is a side: those of subtractions are 1, of cross products 28, of
/// volumes 90. Rounded up.
constexpr double double_error = 0x1p-53 * 256.0;
/// The same for floats, finer, for they decide how often doubles are asked: of a volume with the
/// segment as one side, in units of its largest coordinate times that of the corners squared, and
/// of one of three corners, in units of their largest coordinate cubed.
constexpr float segment_error = 0x1p-24f * 96.0f;
constexpr float corner_error = 0x1p-24f * 128.0f;
/// And where products leave the range of floats: surfaces as small as doubles can be.
constexpr float underflow_error = 1e-36f;

enum class Crossing
{
  none,
  outwards, ///< along the triangle's normal
  inwards,
  unclear
};

/// What the segment from p to r does with a triangle.
Crossing crossing(const Vec3& p, const Vec3& r, const std::array<Vec3, 3>& corners)
{
  const Vec3 a = corners[0] - p;
  const Vec3 b = corners[1] - p;
  const Vec3 c = corners[2] - p;
  const Vec3 d = r - p;
  const double length = d.lpNorm<Eigen::Infinity>();
  const double size = std::max({ a.lpNorm<Eigen::Infinity>(), b.lpNorm<Eigen::Infinity>(),
    c.lpNorm<Eigen::Infinity>(), length });
  const double error = double_error * size * size * size;
  const double edge_error = double_error * size * size * length;
  const Vec3 bc = b.cross(c);
  const double u = d.dot(bc);
  const double v = d.dot(c.cross(a));
  const double w = d.dot(a.cross(b));
  const double side = a.dot(bc);
  const double other_side = side - (u + v + w);
  const double least = std::min({ u, v, w });
  const double most = std::max({ u, v, w });
  if ((least < -edge_error && most > edge_error) || std::min(side, other_side) > error ||
    std::max(side, other_side) < -error)
  {
    return Crossing::none;
  }
  if (least > edge_error && side > error && other_side < -error)
  {
    return Crossing::outwards;
  }
  if (most < -edge_error && side < -error && other_side > error)
  {
    return Crossing::inwards;
  }
  return Crossing::unclear;
}

/// Whether a triangle and a box have a point in common (Akenine-Moeller's separating axes); true
/// when in doubt.
bool overlaps(const std::array<Vec3, 3>& corners, const Vec3& center, const Vec3& half)
{
  const Vec3 a = corners[0] - center;
  const Vec3 b = corners[1] - center;
  const Vec3 c = corners[2] - center;
  const auto apart = [&](const Vec3& axis)
  {
    const double pa = axis.dot(a), pb = axis.dot(b), pc = axis.dot(c);
    const double reach = axis.cwiseAbs().dot(half);
    const double rounding = 1e-14 * (std::abs(pa) + std::abs(pb) + std::abs(pc)) + 1e-14 * reach;
    return std::min({ pa, pb, pc }) > reach + rounding ||
      std::max({ pa, pb, pc }) < -reach - rounding;
  };
  const std::array<Vec3, 3> edges{ b - a, c - b, a - c };
  if (apart(edges[0].cross(edges[1])))
  {
    return false;
  }
  for (const Vec3& edge : edges)
  {
    if (apart(Vec3(0.0, -edge.z(), edge.y())) || apart(Vec3(edge.z(), 0.0, -edge.x())) ||
      apart(Vec3(-edge.y(), edge.x(), 0.0)))
    {
      return false;
    }
  }
  return true;
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

/// Triangles, and behind them caps, without the pairs that are each other turned over.
std::vector<std::int32_t> without_opposites(const Triangles& triangles, const Triangles& caps)
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
  std::vector<std::int32_t> kept;
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
      kept.push_back(static_cast<std::int32_t>(t));
    }
  }
  for (std::size_t i = 0; i < of_caps.size(); ++i)
  {
    if (!gone[i])
    {
      kept.push_back(static_cast<std::int32_t>(triangles.rows() + of_caps[i].triangle));
    }
  }
  return kept;
}
} // namespace

// ---- Build -------------------------------------------------------------------------------------

/// Cuts boxes into cells. What it makes is appended to the arrays of its owner.
class WindingCells::Builder
{
public:
  Builder(WindingCells& owner, ExecutionContext& context) : owner_(owner), context_(context) {}

  bool build();

private:
  struct Box
  {
    Vec3 lower;
    Vec3 size;
    Vec3 reference; ///< a place whose winding number is `count`
    int count = 0;
    std::vector<Id> faces;
    int depth = 0;
  };

  bool cut(Box& box, Id node);
  Id add_leaf(const Vec3& reference, int count, double cell, const Id* begin, const Id* end);
  bool crossings(const Vec3& from, const Vec3& to,
    const std::vector<std::pair<const Id*, const Id*>>& lists, int& count);
  bool count_slowly(const Vec3& place, int& count) const;

  WindingCells& owner_;
  ExecutionContext& context_;
  std::vector<Id> faces_; // all of them
  std::vector<Id> seen_; // of a face: the last segment that was asked about it
  Id segment_ = 0;
  std::size_t entries_ = 0;
};

bool WindingCells::build(const Points& points, const Triangles& triangles, const Triangles& caps,
  double tolerance, ExecutionContext& context)
{
  this->points_ = &points;
  this->triangles_ = &triangles;
  this->caps_ = &caps;
  this->tolerance_ = tolerance;
  return Builder(*this, context).build();
}

std::array<Vec3, 3> WindingCells::corners(Id face) const
{
  const Index own = this->triangles_->rows();
  const auto row = face < own ? this->triangles_->row(face) : this->caps_->row(face - own);
  return { Vec3(this->points_->row(row[0])), Vec3(this->points_->row(row[1])),
    Vec3(this->points_->row(row[2])) };
}

bool WindingCells::Builder::build()
{
  this->faces_ = without_opposites(*this->owner_.triangles_, *this->owner_.caps_);
  this->seen_.assign(
    static_cast<std::size_t>(this->owner_.triangles_->rows() + this->owner_.caps_->rows()), 0);
  bindpose::Box bounds;
  for (const Id face : this->faces_)
  {
    for (const Vec3& corner : this->owner_.corners(face))
    {
      bounds.add(corner);
    }
  }
  Box all;
  if (!bounds.empty())
  {
    // Some room, so that no triangle lies in the box's sides, of no simple ratio, so that those of
    // cells do not lie in the planes of axis-aligned surfaces.
    const double room = 1e-3 * bounds.diagonal() + 16.0 * this->owner_.tolerance_;
    all.lower = bounds.lower - Vec3(1.0137, 1.0719, 1.0431) * room;
    all.size = bounds.upper + Vec3(1.0311, 1.0173, 1.0597) * room - all.lower;
    all.faces = this->faces_;
  }
  else
  {
    all.lower = Vec3::Zero();
    all.size = Vec3::Zero();
  }
  this->owner_.lower_ = all.lower;
  this->owner_.upper_ = all.lower + all.size;
  if (all.faces.empty())
  {
    this->owner_.upper_ = this->owner_.lower_ - Vec3::Ones(); // all is outside
    return true;
  }
  all.reference = all.lower - all.size; // replaced for the first cell
  this->owner_.nodes_.emplace_back();
  const bool done = this->cut(all, 0);
  compact(this->owner_.nodes_);
  compact(this->owner_.cells_);
  compact(this->owner_.leaves_);
  compact(this->owner_.blocks_);
  compact(this->owner_.faces_);
  return done;
}

/// Signed crossings of a segment with the faces of some lists, each face once; false when unclear.
bool WindingCells::Builder::crossings(const Vec3& from, const Vec3& to,
  const std::vector<std::pair<const Id*, const Id*>>& lists, int& count)
{
  this->segment_ += 1;
  count = 0;
  for (const auto& [begin, end] : lists)
  {
    for (const Id* face = begin; face != end; ++face)
    {
      if (this->seen_[*face] == this->segment_)
      {
        continue;
      }
      this->seen_[*face] = this->segment_;
      const Crossing found = crossing(from, to, this->owner_.corners(*face));
      if (found == Crossing::unclear)
      {
        return false;
      }
      count += found == Crossing::outwards ? 1 : found == Crossing::inwards ? -1 : 0;
    }
  }
  return true;
}

/// By the angles of all faces; false when the place touches one.
bool WindingCells::Builder::count_slowly(const Vec3& place, int& count) const
{
  SolidAngleSum sum(place, this->owner_.tolerance_);
  for (const Id face : this->faces_)
  {
    const std::array<Vec3, 3> corners = this->owner_.corners(face);
    sum.add(corners[0], corners[1], corners[2]);
  }
  count = static_cast<int>(std::lround(sum.winding_number()));
  return !sum.on_surface();
}

bool WindingCells::Builder::cut(Box& box, Id id)
{
  if (this->context_.cancelled())
  {
    return false;
  }
  // Cubic cells, about so many that a sheet of triangles leaves the wanted number in each.
  const double count = static_cast<double>(box.faces.size());
  const double longest = box.size.maxCoeff();
  const double along =
    std::clamp(std::round(std::sqrt(count / wanted)), 2.0, double(most_cells_along));
  const double cell = longest / along;
  std::array<Id, 3> size;
  for (int k = 0; k < 3; ++k)
  {
    size[k] = std::clamp(
      static_cast<Id>(std::ceil(box.size[k] / cell - 1e-6)), Id(1), Id(most_cells_along));
  }
  const Id first = static_cast<Id>(this->owner_.cells_.size());
  const Id cells = size[0] * size[1] * size[2];
  this->owner_.nodes_[id] = { box.lower, 1.0 / cell, size, first };
  this->owner_.cells_.resize(static_cast<std::size_t>(first + cells));

  // Sort the faces into the cells. A little room, so that a point that rounding puts into the
  // neighbouring cell is still told right.
  const Vec3 half = Vec3::Constant(0.5 * cell * (1.0 + 1e-9) + 4.0 * this->owner_.tolerance_);
  std::vector<std::pair<Id, Id>> found; // cell, face
  for (std::size_t i = 0; i < box.faces.size(); ++i)
  {
    if (i % 16384 == 16383 && this->context_.cancelled())
    {
      return false;
    }
    const Id face = box.faces[i];
    const std::array<Vec3, 3> corners = this->owner_.corners(face);
    const Vec3 lower = corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]) - box.lower;
    const Vec3 upper = corners[0].cwiseMax(corners[1]).cwiseMax(corners[2]) - box.lower;
    std::array<Id, 3> from, to;
    bool outside = false;
    for (int k = 0; k < 3; ++k)
    {
      const double rim = half[k] - 0.5 * cell;
      const double low = std::floor((lower[k] - rim) / cell);
      const double high = std::floor((upper[k] + rim) / cell);
      outside = outside || low >= size[k] || high < 0.0;
      from[k] = static_cast<Id>(std::clamp(low, 0.0, size[k] - 1.0));
      to[k] = static_cast<Id>(std::clamp(high, 0.0, size[k] - 1.0));
    }
    const int wide = (from[0] < to[0]) + (from[1] < to[1]) + (from[2] < to[2]);
    for (Id z = from[2]; z <= to[2] && !outside; ++z)
    {
      for (Id y = from[1]; y <= to[1]; ++y)
      {
        for (Id x = from[0]; x <= to[0]; ++x)
        {
          const Vec3 center = box.lower + cell * Vec3(x + 0.5, y + 0.5, z + 0.5);
          if (wide < 2 || overlaps(corners, center, half))
          {
            found.emplace_back((z * size[1] + y) * size[0] + x, face);
          }
        }
      }
    }
  }
  std::vector<Id> begin(static_cast<std::size_t>(cells) + 1, 0);
  for (const auto& entry : found)
  {
    begin[entry.first + 1] += 1;
  }
  for (Id c = 0; c < cells; ++c)
  {
    begin[c + 1] += begin[c];
  }
  std::vector<Id> faces(found.size());
  {
    std::vector<Id> next(begin.begin(), begin.end() - 1);
    for (const auto& [c, face] : found)
    {
      faces[next[c]++] = face;
    }
  }
  std::vector<std::pair<Id, Id>>().swap(found);

  // References, and what winds around them.
  const bool is_whole = id == 0;
  const std::size_t parent_faces = box.faces.size();
  std::vector<Vec3> references(static_cast<std::size_t>(cells));
  std::vector<int> counts(static_cast<std::size_t>(cells), 0);
  std::vector<std::pair<const Id*, const Id*>> lists;
  for (Id c = 0; c < cells; ++c)
  {
    const Id x = c % size[0], y = c / size[0] % size[1], z = c / size[0] / size[1];
    const Id before = x > 0 ? c - 1 : y > 0 ? c - size[0] : c - size[0] * size[1];
    const Vec3 center = box.lower + cell * Vec3(x + 0.5, y + 0.5, z + 0.5);
    const std::pair<const Id*, const Id*> own{ faces.data() + begin[c],
      faces.data() + begin[c + 1] };
    bool told = false;
    for (int attempt = 0; attempt < 32 && !told; ++attempt)
    {
      // Off the middle, in another direction each time, and of no simple ratio.
      const double t = attempt + 1.0;
      references[c] = center +
        0.05 * cell *
          Vec3(std::sin(1.7 * t + 0.3), std::sin(2.3 * t + 1.1), std::sin(3.1 * t + 2.3));
      lists.assign(1, own);
      Vec3 to = box.reference;
      int known = box.count;
      if (c > 0)
      {
        lists.emplace_back(faces.data() + begin[before], faces.data() + begin[before + 1]);
        to = references[before];
        known = counts[before];
      }
      else if (is_whole)
      {
        to = references[c] - Vec3(1.1 * cell, 0.03 * cell, 0.05 * cell);
      }
      else
      {
        lists.assign(1, { box.faces.data(), box.faces.data() + box.faces.size() });
      }
      told = this->crossings(references[c], to, lists, counts[c]);
      counts[c] += known;
      if (!told && attempt % 8 == 7)
      {
        told = this->count_slowly(references[c], counts[c]);
      }
    }
  }

  // What the cells are. The faces of this box are not needed any more.
  std::vector<Id>().swap(box.faces);
  for (Id c = 0; c < cells; ++c)
  {
    const auto number = static_cast<std::size_t>(begin[c + 1] - begin[c]);
    Cell made{ counts[c], holds_nothing };
    // Cutting must pay: a vertex of many triangles stays in one cell however small.
    const bool shrinks = box.depth < 3 || 10 * number < 7 * parent_faces;
    const bool large_enough = cell > 1e6 * this->owner_.tolerance_;
    const std::size_t most_entries = 16 * this->faces_.size() + 100000;
    if (number > few && shrinks && large_enough && box.depth < deepest &&
      this->entries_ < most_entries)
    {
      Box inner;
      const Id x = c % size[0], y = c / size[0] % size[1], z = c / size[0] / size[1];
      inner.lower = box.lower + cell * Vec3(x, y, z);
      inner.size = Vec3::Constant(cell);
      inner.reference = references[c];
      inner.count = counts[c];
      inner.faces.assign(faces.begin() + begin[c], faces.begin() + begin[c + 1]);
      inner.depth = box.depth + 1;
      made = { static_cast<Id>(this->owner_.nodes_.size()), holds_node };
      this->owner_.nodes_.emplace_back();
      if (!this->cut(inner, made.value))
      {
        return false;
      }
    }
    else if (number > 0)
    {
      made = { this->add_leaf(references[c], counts[c], cell, faces.data() + begin[c],
                 faces.data() + begin[c + 1]),
        holds_leaf };
    }
    this->owner_.cells_[first + c] = made;
    if (is_whole)
    {
      this->context_.progress(static_cast<double>(c + 1) / static_cast<double>(cells));
    }
  }
  return true;
}

WindingCells::Id WindingCells::Builder::add_leaf(
  const Vec3& reference, int count, double cell, const Id* begin, const Id* end)
{
  Leaf made;
  made.reference = reference;
  made.count = count;
  made.begin = static_cast<Id>(this->owner_.blocks_.size());
  this->entries_ += static_cast<std::size_t>(end - begin);
  double reach = 0.0;
  for (const Id* face = begin; face < end; face += lanes)
  {
    Block block = {};
    Faces ids;
    for (int lane = 0; lane < lanes; ++lane)
    {
      ids[lane] = face + lane < end ? face[lane] : -1;
      if (ids[lane] >= 0)
      {
        const std::array<Vec3, 3> corners = this->owner_.corners(ids[lane]);
        for (int k = 0; k < 9; ++k)
        {
          const double x = corners[k / 3][k % 3] - reference[k % 3];
          block.corner[k][lane] = static_cast<float>(x);
          reach = std::max(reach, std::abs(x));
        }
      }
    }
    this->owner_.blocks_.push_back(block);
    this->owner_.faces_.push_back(ids);
  }
  made.reach = static_cast<float>(reach);
  // Lanes that are none: a triangle that the whole cell sees from the same side.
  const float far_off = static_cast<float>(4.0 * cell + 2.0 * reach);
  const float nowhere[9] = { far_off, -far_off, -far_off, far_off, far_off, -far_off, far_off, 0.0f,
    far_off };
  for (int lane = static_cast<int>((end - begin) % lanes); lane > 0 && lane < lanes; ++lane)
  {
    for (int k = 0; k < 9; ++k)
    {
      this->owner_.blocks_.back().corner[k][lane] = nowhere[k];
    }
  }
  made.end = static_cast<Id>(this->owner_.blocks_.size());
  this->owner_.leaves_.push_back(made);
  return static_cast<Id>(this->owner_.leaves_.size()) - 1;
}

// ---- Evaluation --------------------------------------------------------------------------------

bool WindingCells::is_outside(const Vec3& p) const
{
  return !((p.array() >= this->lower_.array()).all() && (p.array() <= this->upper_.array()).all());
}

std::array<WindingCells::Id, 3> WindingCells::place_of(const Node& node, const Vec3& p) const
{
  std::array<Id, 3> place;
  for (int k = 0; k < 3; ++k)
  {
    place[k] =
      std::clamp(static_cast<Id>((p[k] - node.lower[k]) * node.inverse), Id(0), node.size[k] - 1);
  }
  return place;
}

/// Signed crossings of the segment from the point q to the reference, both as seen from there.
/// Faces of which a sign is not clear are not counted but added to the unclear ones.
BINDPOSE_SIMD_CLONES int WindingCells::tally(const Block* begin, const Block* end,
  const Faces* faces, float leaf_reach, float tolerance, const float* q, Unclear& unclear)
{
  const float qx = q[0], qy = q[1], qz = q[2];
  const float length = std::max({ std::abs(qx), std::abs(qy), std::abs(qz) });
  const float reach = leaf_reach + length;
  // A triangle that the point touches, within the tolerance of one of its points, has a volume of
  // at most 9 tolerance reach^2 with the point and none on the wrong side of the segment by more
  // than 6 tolerance reach length: with the rounding below that, too, it is left open.
  const float edge_bound =
    length * reach * (segment_error * reach + 8.0f * tolerance) + underflow_error;
  const float side_bound =
    reach * reach * (corner_error * reach + 12.0f * tolerance) + underflow_error;
  const float other_bound = side_bound + 4.0f * edge_bound;
  std::int32_t counts[lanes] = {};
  for (const Block* block = begin; block != end; ++block)
  {
    std::int32_t open[lanes];
    std::int32_t any = 0;
    for (int i = 0; i < lanes; ++i)
    {
      const float ax = block->corner[0][i] - qx;
      const float ay = block->corner[1][i] - qy;
      const float az = block->corner[2][i] - qz;
      const float bx = block->corner[3][i] - qx;
      const float by = block->corner[4][i] - qy;
      const float bz = block->corner[5][i] - qz;
      const float cx = block->corner[6][i] - qx;
      const float cy = block->corner[7][i] - qy;
      const float cz = block->corner[8][i] - qz;
      const float bcx = by * cz - bz * cy, bcy = bz * cx - bx * cz, bcz = bx * cy - by * cx;
      const float cax = cy * az - cz * ay, cay = cz * ax - cx * az, caz = cx * ay - cy * ax;
      const float abx = ay * bz - az * by, aby = az * bx - ax * bz, abz = ax * by - ay * bx;
      const float u = -(qx * bcx + qy * bcy + qz * bcz);
      const float v = -(qx * cax + qy * cay + qz * caz);
      const float w = -(qx * abx + qy * aby + qz * abz);
      const float side = ax * bcx + ay * bcy + az * bcz;
      const float other_side = side - (u + v + w);
      const float least = u < v ? (u < w ? u : w) : (v < w ? v : w);
      const float most = u > v ? (u > w ? u : w) : (v > w ? v : w);
      const bool before = side > side_bound, behind = side < -side_bound;
      const bool to_before = other_side > other_bound, to_behind = other_side < -other_bound;
      const bool none =
        ((least < -edge_bound) & (most > edge_bound)) | (before & to_before) | (behind & to_behind);
      const bool outwards = (least > edge_bound) & before & to_behind;
      const bool inwards = (most < -edge_bound) & behind & to_before;
      counts[i] += (outwards ? 1 : 0) - (inwards ? 1 : 0);
      open[i] = none | outwards | inwards ? 0 : 1;
      any |= open[i];
    }
    if (any)
    {
      for (int i = 0; i < lanes; ++i)
      {
        unclear.add(open[i] ? faces[block - begin][i] : -1);
      }
    }
  }
  int sum = 0;
  for (int i = 0; i < lanes; ++i)
  {
    sum += counts[i];
  }
  return sum;
}

bool WindingCells::count_in(const Leaf& found, const Vec3& p, int& count) const
{
  const Vec3 seen = p - found.reference;
  const float q[3] = { static_cast<float>(seen[0]), static_cast<float>(seen[1]),
    static_cast<float>(seen[2]) };
  Unclear unclear;
  count = found.count +
    tally(this->blocks_.data() + found.begin, this->blocks_.data() + found.end,
      this->faces_.data() + found.begin, found.reach, static_cast<float>(this->tolerance_), q,
      unclear);
  if (unclear.number == 0)
  {
    return true;
  }
  if (unclear.number > Unclear::most)
  {
    return false;
  }
  for (Id k = 0; k < unclear.number; ++k)
  {
    const std::array<Vec3, 3> corners = this->corners(unclear.faces[k]);
    const Vec3 u = corners[1] - corners[0];
    const Vec3 v = corners[2] - corners[0];
    const Vec3 r = corners[0] - p;
    const double reach = u.lpNorm<1>() * v.lpNorm<1>();
    if (std::abs(u.cross(v).dot(r)) <= reach * (2.0 * this->tolerance_ + 1e-14 * r.lpNorm<1>()) &&
      touches_triangle(p, corners[0], corners[1], corners[2], this->tolerance_))
    {
      return false;
    }
    const Crossing what = crossing(p, found.reference, corners);
    if (what == Crossing::unclear)
    {
      return false;
    }
    count += what == Crossing::outwards ? 1 : what == Crossing::inwards ? -1 : 0;
  }
  return true;
}

void WindingCells::evaluate(const Vec3* points, Index number, int* counts, bool* told) const
{
  // All points go down together: what one needs is on its way while the others are looked at.
  std::array<const Cell*, most_at_once> cells;
  std::array<Id, most_at_once> waiting;
  Id left = 0;
  const auto look_up = [&](Id i, Id id)
  {
    const Node& at = this->nodes_[id];
    cells[i] = &this->cell_at(at, this->place_of(at, points[i]));
    __builtin_prefetch(cells[i]);
  };
  for (Index i = 0; i < number; ++i)
  {
    counts[i] = 0;
    told[i] = true;
    if (!this->is_outside(points[i]))
    {
      waiting[left++] = static_cast<Id>(i);
      look_up(static_cast<Id>(i), 0);
    }
  }
  std::array<Id, most_at_once> in_leaves;
  Id leaves = 0;
  while (left > 0)
  {
    Id still = 0;
    for (Id k = 0; k < left; ++k)
    {
      const Id i = waiting[k];
      const Cell cell = *cells[i];
      if (cell.kind == holds_nothing)
      {
        counts[i] = cell.value;
      }
      else if (cell.kind == holds_leaf)
      {
        __builtin_prefetch(&this->leaves_[cell.value]);
        in_leaves[leaves++] = i;
      }
      else
      {
        __builtin_prefetch(&this->nodes_[cell.value]);
        waiting[still++] = i;
      }
    }
    for (Id k = 0; k < still; ++k)
    {
      look_up(waiting[k], cells[waiting[k]]->value);
    }
    left = still;
  }
  for (Id k = 0; k < leaves; ++k)
  {
    const Leaf& found = this->leaves_[cells[in_leaves[k]]->value];
    const char* const begin = reinterpret_cast<const char*>(this->blocks_.data() + found.begin);
    const char* const end = reinterpret_cast<const char*>(this->blocks_.data() + found.end);
    for (const char* line = begin; line < end && line < begin + 1280; line += 64)
    {
      __builtin_prefetch(line);
    }
  }
  for (Id k = 0; k < leaves; ++k)
  {
    const Id i = in_leaves[k];
    told[i] = this->count_in(this->leaves_[cells[i]->value], points[i], counts[i]);
  }
}

void WindingCells::evaluate_row(const double* xs, Index number, double y, double z, double* counts,
  std::vector<Index>& untold) const
{
  if (!(y >= this->lower_.y() && y <= this->upper_.y() && z >= this->lower_.z() &&
        z <= this->upper_.z()))
  {
    std::fill(counts, counts + number, 0.0);
    return;
  }
  for (Index i = 0; i < number;)
  {
    Vec3 p(xs[i], y, z);
    if (!(p.x() >= this->lower_.x() && p.x() <= this->upper_.x()))
    {
      counts[i++] = 0.0;
      continue;
    }
    const Node* at = this->nodes_.data();
    std::array<Id, 3> place = this->place_of(*at, p);
    Cell cell = this->cell_at(*at, place);
    while (cell.kind == holds_node)
    {
      at = &this->nodes_[cell.value];
      place = this->place_of(*at, p);
      cell = this->cell_at(*at, place);
    }
    // The cell's own part of the row, but for what rounding could put into its neighbour: whoever
    // comes from elsewhere must find a point in the same cell.
    const double lower = at->lower.x() + (place[0] + 1e-6) / at->inverse;
    const double upper = at->lower.x() + (place[0] + 1 - 1e-6) / at->inverse;
    Index end = i + 1;
    while (end < number && xs[end] > lower && xs[end] < upper)
    {
      ++end;
    }
    if (cell.kind == holds_nothing)
    {
      std::fill(counts + i, counts + end, static_cast<double>(cell.value));
      i = end;
      continue;
    }
    const Leaf& found = this->leaves_[cell.value];
    for (; i < end; ++i)
    {
      p.x() = xs[i];
      int count = 0;
      if (!this->count_in(found, p, count))
      {
        untold.push_back(i);
      }
      counts[i] = count;
    }
  }
}

Index WindingCells::memory() const
{
  return static_cast<Index>(this->nodes_.capacity() * sizeof(Node) +
    this->cells_.capacity() * sizeof(Cell) + this->leaves_.capacity() * sizeof(Leaf) +
    this->blocks_.capacity() * sizeof(Block) + this->faces_.capacity() * sizeof(Faces));
}

} // namespace bindpose
