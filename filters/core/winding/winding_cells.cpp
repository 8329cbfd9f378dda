// Evaluation of exact winding numbers in cells. winding_cells_build.cpp builds the cells.
//
// The winding numbers of two points differ by the signed crossings of the segment that joins the
// points. A cell is convex, so the segment from a point to the cell's reference can cross only the
// few triangles of the cell.
//
// A segment from p to the reference r crosses the triangle a, b, c if two conditions are true.
// First, p and r are on different sides of the plane of the triangle. Second, p is on the same side
// of all three planes that contain r and an edge of the triangle. These four planes are stored as
// unit normals with 16 bits per coordinate. Their signs are computed for eight triangles in
// parallel, in a few operations each. The error bound depends only on the distance between p and r.
// An undecided sign is computed again in doubles, from volumes of tetrahedra of p, r and the exact
// corners. If the sign is still undecided, the point touches the triangle or the segment touches an
// edge. Then the point is unresolved.
#include "winding/winding_cells.h"

#include "base/simd.h"
#include "solid_angle/segment_crossing.h"
#include "solid_angle/solid_angle.h"

#include <algorithm>
#include <cmath>

namespace bindpose
{

namespace
{
/// Largest change of a stored coordinate by rounding, including a margin for the round-off of
/// floats.
constexpr float rounding_error = 0.57f;
} // namespace

std::array<Vec3, 3> WindingCells::corners(Id face) const
{
  const Index triangle_count = this->triangles_->rows();
  const auto row =
    face < triangle_count ? this->triangles_->row(face) : this->caps_->row(face - triangle_count);
  return { Vec3(this->points_->row(row[0])), Vec3(this->points_->row(row[1])),
    Vec3(this->points_->row(row[2])) };
}

bool WindingCells::is_outside(const Vec3& p) const
{
  return !((p.array() >= this->lower_.array()).all() && (p.array() <= this->upper_.array()).all());
}

std::array<WindingCells::Id, 3> WindingCells::cell_coordinates(
  const Node& node, const Vec3& p) const
{
  std::array<Id, 3> coordinates;
  for (int k = 0; k < 3; ++k)
  {
    coordinates[k] =
      std::clamp(static_cast<Id>((p[k] - node.lower[k]) * node.inverse), Id(0), node.size[k] - 1);
  }
  return coordinates;
}

/// Return the signed crossings of the segment from the point q to the reference, which is the
/// origin. q and `touching` are in units of the stored plane distances. Faces with an undecided
/// sign, and faces within the distance `touching` of the point, are not counted but added to
/// `undecided`.
BINDPOSE_SIMD_CLONES int WindingCells::count_crossings(const Block* begin, const Block* end,
  const Faces* faces, float touching, const float* q, UndecidedFaces& undecided)
{
  const float qx = q[0], qy = q[1], qz = q[2];
  const float length = std::abs(qx) + std::abs(qy) + std::abs(qz);
  // A point at the distance d from a triangle has a signed distance of at least -d from each plane
  // through the reference and an edge of the triangle (positive on the side of the triangle).
  // Therefore the bound includes `touching`: faces that the point touches become undecided.
  const float edge_bound = rounding_error * length + 1.01f * Block::fixed_point_one * touching;
  const float side_bound = edge_bound + rounding_error * Block::fixed_point_one;
  std::int32_t counts[lanes] = {};
  for (const Block* block = begin; block != end; ++block)
  {
    // The conversion to floats is a separate loop, because compilers would not vectorize the next
    // loop if it contained the conversion.
    float plane[Block::values_per_plane * lanes];
    for (int k = 0; k < Block::values_per_plane * lanes; ++k)
    {
      plane[k] = static_cast<float>(block->plane[k]);
    }
    std::int32_t undecided_lanes[lanes];
    std::int32_t any = 0;
    for (int i = 0; i < lanes; ++i)
    {
      const float u = qx * plane[i] + qy * plane[lanes + i] + qz * plane[2 * lanes + i];
      const float v =
        qx * plane[3 * lanes + i] + qy * plane[4 * lanes + i] + qz * plane[5 * lanes + i];
      const float w =
        qx * plane[6 * lanes + i] + qy * plane[7 * lanes + i] + qz * plane[8 * lanes + i];
      const float across =
        qx * plane[9 * lanes + i] + qy * plane[10 * lanes + i] + qz * plane[11 * lanes + i];
      const float other_side = Block::fixed_point_one * plane[12 * lanes + i];
      const float side = other_side - across;
      const float least = u < v ? (u < w ? u : w) : (v < w ? v : w);
      const float maximum = u > v ? (u > w ? u : w) : (v > w ? v : w);
      const bool before = side > side_bound, behind = side < -side_bound;
      const bool is_end_before = other_side > side_bound, is_end_behind = other_side < -side_bound;
      const bool none = ((least < -edge_bound) & (maximum > edge_bound)) |
        (before & is_end_before) | (behind & is_end_behind);
      const bool outwards = (maximum < -edge_bound) & before & is_end_behind;
      const bool inwards = (least > edge_bound) & behind & is_end_before;
      counts[i] += (outwards ? 1 : 0) - (inwards ? 1 : 0);
      undecided_lanes[i] = none | outwards | inwards ? 0 : 1;
      any |= undecided_lanes[i];
    }
    if (any)
    {
      for (int i = 0; i < lanes; ++i)
      {
        undecided.add(undecided_lanes[i] ? faces[block - begin][i] : -1);
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

bool WindingCells::count_in_leaf(const Leaf& leaf, const Vec3& p, int& count) const
{
  const Vec3 relative = static_cast<double>(leaf.distance_scale) * (p - leaf.reference);
  const float q[3] = { static_cast<float>(relative[0]), static_cast<float>(relative[1]),
    static_cast<float>(relative[2]) };
  UndecidedFaces undecided;
  count = leaf.count +
    count_crossings(this->arrays_.blocks.data() + leaf.begin,
      this->arrays_.blocks.data() + leaf.end, this->arrays_.faces.data() + leaf.begin,
      leaf.distance_scale * static_cast<float>(this->tolerance_), q, undecided);
  if (undecided.number == 0)
  {
    return true;
  }
  if (undecided.number > UndecidedFaces::maximum)
  {
    return false;
  }
  for (Id k = 0; k < undecided.number; ++k)
  {
    const std::array<Vec3, 3> corners = this->corners(undecided.faces[k]);
    const Vec3 u = corners[1] - corners[0];
    const Vec3 v = corners[2] - corners[0];
    const Vec3 r = corners[0] - p;
    const double edge_product = u.lpNorm<1>() * v.lpNorm<1>();
    if (std::abs(u.cross(v).dot(r)) <=
        edge_product * (2.0 * this->tolerance_ + 1e-14 * r.lpNorm<1>()) &&
      touches_triangle(p, corners[0], corners[1], corners[2], this->tolerance_))
    {
      return false;
    }
    const Crossing facet_crossing = crossing(p, leaf.reference, corners);
    if (facet_crossing == Crossing::undecided)
    {
      return false;
    }
    count += facet_crossing == Crossing::outwards ? 1
      : facet_crossing == Crossing::inwards       ? -1
                                                  : 0;
  }
  return true;
}

void WindingCells::evaluate(const Vec3* points, Index number, int* counts, bool* resolved) const
{
  // All points descend in parallel: the data of one point is prefetched while other points are
  // processed.
  std::array<const Cell*, maximum_batch> cells;
  std::array<Id, maximum_batch> active;
  Id active_count = 0;
  const auto look_up = [&](Id i, Id id)
  {
    const Node& node = this->arrays_.nodes[id];
    cells[i] = &this->cell_at(node, this->cell_coordinates(node, points[i]));
    __builtin_prefetch(cells[i]);
  };
  for (Index i = 0; i < number; ++i)
  {
    counts[i] = 0;
    resolved[i] = true;
    if (!this->is_outside(points[i]))
    {
      active[active_count++] = static_cast<Id>(i);
      look_up(static_cast<Id>(i), 0);
    }
  }
  std::array<Id, maximum_batch> in_leaves;
  Id leaves = 0;
  while (active_count > 0)
  {
    Id next_count = 0;
    for (Id k = 0; k < active_count; ++k)
    {
      const Id i = active[k];
      const Cell cell = *cells[i];
      if (cell.kind == empty_cell)
      {
        counts[i] = cell.value;
      }
      else if (cell.kind == leaf_cell)
      {
        __builtin_prefetch(&this->arrays_.leaves[cell.value]);
        in_leaves[leaves++] = i;
      }
      else
      {
        __builtin_prefetch(&this->arrays_.nodes[cell.value]);
        active[next_count++] = i;
      }
    }
    for (Id k = 0; k < next_count; ++k)
    {
      look_up(active[k], cells[active[k]]->value);
    }
    active_count = next_count;
  }
  for (Id k = 0; k < leaves; ++k)
  {
    const Leaf& leaf = this->arrays_.leaves[cells[in_leaves[k]]->value];
    const char* const begin =
      reinterpret_cast<const char*>(this->arrays_.blocks.data() + leaf.begin);
    const char* const end = reinterpret_cast<const char*>(this->arrays_.blocks.data() + leaf.end);
    for (const char* line = begin; line < end && line < begin + 768; line += 64)
    {
      __builtin_prefetch(line);
    }
  }
  for (Id k = 0; k < leaves; ++k)
  {
    const Id i = in_leaves[k];
    resolved[i] = this->count_in_leaf(this->arrays_.leaves[cells[i]->value], points[i], counts[i]);
  }
}

void WindingCells::evaluate_row(const double* xs, Index number, double y, double z, double* counts,
  std::vector<Index>& unresolved) const
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
    const Node* node = this->arrays_.nodes.data();
    std::array<Id, 3> coordinates = this->cell_coordinates(*node, p);
    Cell cell = this->cell_at(*node, coordinates);
    while (cell.kind == node_cell)
    {
      node = &this->arrays_.nodes[cell.value];
      coordinates = this->cell_coordinates(*node, p);
      cell = this->cell_at(*node, coordinates);
    }
    // Find the part of the row in this cell, without a small margin at the sides of the cell.
    // evaluate() could assign a point in the margin to the neighboring cell because of rounding.
    // This function must use the same cell as evaluate().
    const double lower = node->lower.x() + (coordinates[0] + 1e-6) / node->inverse;
    const double upper = node->lower.x() + (coordinates[0] + 1 - 1e-6) / node->inverse;
    Index end = i + 1;
    while (end < number && xs[end] > lower && xs[end] < upper)
    {
      ++end;
    }
    if (cell.kind == empty_cell)
    {
      std::fill(counts + i, counts + end, static_cast<double>(cell.value));
      i = end;
      continue;
    }
    const Leaf& leaf = this->arrays_.leaves[cell.value];
    for (; i < end; ++i)
    {
      p.x() = xs[i];
      int count = 0;
      if (!this->count_in_leaf(leaf, p, count))
      {
        unresolved.push_back(i);
      }
      counts[i] = count;
    }
  }
}

Index WindingCells::memory() const
{
  const Arrays& all = this->arrays_;
  return static_cast<Index>(all.nodes.capacity() * sizeof(Node) +
    all.cells.capacity() * sizeof(Cell) + all.leaves.capacity() * sizeof(Leaf) +
    all.blocks.capacity() * sizeof(Block) + all.faces.capacity() * sizeof(Faces));
}

} // namespace bindpose
