// Construction of WindingCells. Cells are built from the box of the surface downwards. The
// triangles of a box are sorted into the cells of the box. A cell with many triangles is divided
// like the box. The winding number at the reference of a cell is computed from the winding number
// at the reference of a neighboring cell, or of the enclosing box for the first cell. The cells of
// the surface's box are built on all threads, and the parts are joined in order.
#include "winding/winding_cells.h"

#include "base/large_pages.h"
#include "base/parallel.h"
#include "solid_angle/segment_crossing.h"
#include "solid_angle/solid_angle.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

namespace bindpose
{

namespace
{
/// Cells with more triangles are divided further. Measured on refined_elephant.off: 30 takes an
/// eighth more memory and the same time; 56 takes an eighth less memory and a fifth more time near
/// the surface.
constexpr std::size_t maximum_leaf_faces = 40;
/// Intended number of triangles in a new cell.
constexpr double target_faces = 18;
constexpr int maximum_cells_along = 32;
/// Minimum number of cells along the longest side of the surface's box, so that most points around
/// a few large triangles are in cells without triangles.
constexpr double minimum_cells_along = 8.0;
constexpr int maximum_depth = 12;
/// Stored integer for a plane distance of one cell size. It is slightly less than the largest
/// 16-bit integer.
constexpr double distance_units = 32000.0;
/// A cross product has no reliable direction if its length is less than this number times the
/// length of its longer factor. This holds for coordinates of about 1 in double precision.
constexpr double shortest_product = 1e-9;

/// Report whether a triangle and a box intersect, by separating axes (Akenine-Moeller). Return true
/// if round-off makes the result uncertain.
bool overlaps(const std::array<Vec3, 3>& corners, const Vec3& center, const Vec3& half)
{
  const Vec3 a = corners[0] - center;
  const Vec3 b = corners[1] - center;
  const Vec3 c = corners[2] - center;
  const auto is_separating_axis = [&](const Vec3& axis)
  {
    const double pa = axis.dot(a), pb = axis.dot(b), pc = axis.dot(c);
    const double projected_half_size = axis.cwiseAbs().dot(half);
    const double rounding =
      1e-14 * (std::abs(pa) + std::abs(pb) + std::abs(pc)) + 1e-14 * projected_half_size;
    return std::min({ pa, pb, pc }) > projected_half_size + rounding ||
      std::max({ pa, pb, pc }) < -projected_half_size - rounding;
  };
  const std::array<Vec3, 3> edges{ b - a, c - b, a - c };
  if (is_separating_axis(edges[0].cross(edges[1])))
  {
    return false;
  }
  for (const Vec3& edge : edges)
  {
    if (is_separating_axis(Vec3(0.0, -edge.z(), edge.y())) ||
      is_separating_axis(Vec3(edge.z(), 0.0, -edge.x())) ||
      is_separating_axis(Vec3(-edge.y(), edge.x(), 0.0)))
    {
      return false;
    }
  }
  return true;
}

/// A triangle with sorted corner ids; `parity` is 1 if sorting was an even permutation and -1 if
/// odd.
struct SortedCorners
{
  std::array<Index, 3> ids;
  int parity;
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
      corners.parity = -corners.parity;
    }
  }
  return corners;
}

/// Return the ids of the triangles and the caps in ascending order. The id of cap t is #triangles +
/// t. If a triangle and a cap have the same corners and opposite orientations, both are omitted.
std::vector<std::int32_t> remove_opposite_pairs(const Triangles& triangles, const Triangles& caps)
{
  std::vector<SortedCorners> cap_corners;
  for (Index t = 0; t < caps.rows(); ++t)
  {
    cap_corners.push_back(sorted_corners(caps, t));
  }
  std::sort(cap_corners.begin(), cap_corners.end(),
    [](const SortedCorners& x, const SortedCorners& y)
    { return x.ids != y.ids ? x.ids < y.ids : x.triangle < y.triangle; });
  std::vector<char> is_canceled(cap_corners.size(), 0);
  std::vector<std::int32_t> remaining;
  remaining.reserve(static_cast<std::size_t>(triangles.rows() + caps.rows()));
  for (Index t = 0; t < triangles.rows(); ++t)
  {
    bool canceled = false;
    if (!cap_corners.empty())
    {
      const SortedCorners triangle_corners = sorted_corners(triangles, t);
      auto cap = std::lower_bound(cap_corners.begin(), cap_corners.end(), triangle_corners.ids,
        [](const SortedCorners& x, const std::array<Index, 3>& ids) { return x.ids < ids; });
      for (; cap != cap_corners.end() && cap->ids == triangle_corners.ids && !canceled; ++cap)
      {
        char& cap_canceled = is_canceled[static_cast<std::size_t>(cap - cap_corners.begin())];
        canceled = !cap_canceled && cap->parity != triangle_corners.parity;
        cap_canceled = cap_canceled || canceled;
      }
    }
    if (!canceled)
    {
      remaining.push_back(static_cast<std::int32_t>(t));
    }
  }
  for (std::size_t i = 0; i < cap_corners.size(); ++i)
  {
    if (!is_canceled[i])
    {
      remaining.push_back(static_cast<std::int32_t>(triangles.rows() + cap_corners[i].triangle));
    }
  }
  std::sort(remaining.begin(), remaining.end());
  return remaining;
}
} // namespace

/// Divides boxes into cells.
class WindingCells::Builder
{
public:
  Builder(ExecutionContext& context, WindingCells& owner) : owner_(owner), context_(context) {}

  bool build();

private:
  struct Box
  {
    Vec3 lower;
    Vec3 size;
    Vec3 reference; ///< a point whose winding number is `count`
    int count = 0;
    std::vector<Id> faces; ///< ids of the faces, ascending
    std::vector<std::array<Vec3, 3>> corners; ///< corners of the faces, stored contiguously
    int depth = 0;
  };
  /// The cells of a box. The faces of cell c are faces[begin[c] … begin[c + 1]), ascending indices
  /// into the face list of the box.
  struct Grid
  {
    double cell = 0.0; ///< edge length of a cell
    std::array<Id, 3> size;
    std::size_t faces_before = 0; ///< number of faces in the box that is divided
    std::vector<Id> begin;
    std::vector<Id> faces;
    std::vector<Vec3> references;
    std::vector<int> counts; ///< winding numbers of the references

    Id cells() const { return this->size[0] * this->size[1] * this->size[2]; }
    std::array<Id, 3> position(Id c) const
    {
      return { c % this->size[0], c / this->size[0] % this->size[1],
        c / this->size[0] / this->size[1] };
    }
    Id number(Id c) const { return this->begin[c + 1] - this->begin[c]; }
  };
  using List = std::pair<const Id*, const Id*>;
  using CellFacePairs = std::vector<std::pair<Id, Id>>; // cell, face

  Grid choose_cells(const Box& box, double maximum_along) const;
  bool sort(const Box& box, bool on_all_threads, std::size_t maximum_entries, Grid& grid) const;
  bool find(const Box& box, const Grid& grid, Index begin, Index end, std::size_t maximum_entries,
    CellFacePairs& found) const;
  bool choose_references(const Box& box, Grid& grid) const;
  static bool crossings(
    const Box& box, const Vec3& from, const Vec3& to, List range_a, List range_b, int& count);
  bool count_by_solid_angles(const Vec3& position, int& count) const;
  bool cut_root(const Box& root_box);
  bool cut(const Box& box, Arrays& output, std::size_t entries) const;
  bool fill(
    const Box& box, const Grid& grid, Id c, std::size_t entries, Arrays& output, Cell& cell) const;
  static Id add_leaf(
    const Box& box, const Vec3& reference, int count, double cell, List faces, Arrays& output);
  void append(const Arrays& part, Id first, Id cells);

  WindingCells& owner_;
  ExecutionContext& context_;
  std::vector<Id> faces_; // ids of all triangles and caps
};

bool WindingCells::build(ExecutionContext& context, const Points& points,
  const Triangles& triangles, const Triangles& caps, double tolerance)
{
  this->points_ = &points;
  this->triangles_ = &triangles;
  this->caps_ = &caps;
  this->tolerance_ = tolerance;
  return Builder(context, *this).build();
}

bool WindingCells::Builder::build()
{
  this->faces_ = remove_opposite_pairs(*this->owner_.triangles_, *this->owner_.caps_);
  Box all;
  bindpose::Box bounds;
  reserve_in_large_pages(all.corners, this->faces_.size());
  for (const Id face : this->faces_)
  {
    all.corners.push_back(this->owner_.corners(face));
    for (const Vec3& corner : all.corners.back())
    {
      bounds.add(corner);
    }
  }
  if (!bounds.empty())
  {
    // The margin keeps triangles away from the sides of the box. The irregular ratios of the margin
    // ensure that the sides of cells are not in the planes of axis-aligned surfaces.
    const double margin = 1e-3 * bounds.diagonal() + 16.0 * this->owner_.tolerance_;
    all.lower = bounds.lower - Vec3(1.0137, 1.0719, 1.0431) * margin;
    all.size = bounds.upper + Vec3(1.0311, 1.0173, 1.0597) * margin - all.lower;
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
    // With this empty box, every point counts as outside.
    this->owner_.upper_ = this->owner_.lower_ - Vec3::Ones();
    return true;
  }
  return this->cut_root(all);
}

/// Count the signed crossings of a segment with the faces of two lists. A face in both lists is
/// counted once. Return false if a crossing is unclear.
bool WindingCells::Builder::crossings(
  const Box& box, const Vec3& from, const Vec3& to, List range_a, List range_b, int& count)
{
  count = 0;
  while (range_a.first != range_a.second || range_b.first != range_b.second)
  {
    const bool both = range_a.first != range_a.second && range_b.first != range_b.second &&
      *range_a.first == *range_b.first;
    const bool takes_a = range_b.first == range_b.second ||
      (range_a.first != range_a.second && *range_a.first <= *range_b.first);
    const Id face = takes_a ? *range_a.first : *range_b.first;
    range_a.first += takes_a || both;
    range_b.first += !takes_a || both;
    const Crossing found = crossing(from, to, box.corners[face]);
    if (found == Crossing::undecided)
    {
      return false;
    }
    count += found == Crossing::outwards ? 1 : found == Crossing::inwards ? -1 : 0;
  }
  return true;
}

/// Compute the winding number from the solid angles of all faces. Return false if the point touches
/// a face.
bool WindingCells::Builder::count_by_solid_angles(const Vec3& position, int& count) const
{
  SolidAngleSum sum(position, this->owner_.tolerance_);
  for (const Id face : this->faces_)
  {
    const std::array<Vec3, 3> corners = this->owner_.corners(face);
    sum.add(corners[0], corners[1], corners[2]);
  }
  count = static_cast<int>(std::lround(sum.winding_number()));
  return !sum.on_surface();
}

/// Choose the cubic cells of a box. The number of cells is chosen so that a cell contains about
/// `target_faces` triangles if the triangles form a sheet.
WindingCells::Builder::Grid WindingCells::Builder::choose_cells(
  const Box& box, double maximum_along) const
{
  Grid grid;
  grid.faces_before = box.faces.size();
  const double least_cells_along = box.depth == 0 ? minimum_cells_along : 2.0;
  const double cells_along = std::min(maximum_along,
    std::max(least_cells_along,
      std::round(std::sqrt(static_cast<double>(box.faces.size()) / target_faces))));
  grid.cell = box.size.maxCoeff() / cells_along;
  for (int k = 0; k < 3; ++k)
  {
    grid.size[k] = std::clamp(
      static_cast<Id>(std::ceil(box.size[k] / grid.cell - 1e-6)), Id(1), Id(maximum_cells_along));
  }
  return grid;
}

/// For each of the faces [begin, end) of the box, find the cells that the face overlaps. Append the
/// pairs (cell, face) to `found`. Return false if canceled or if there are more than
/// `maximum_entries` pairs.
bool WindingCells::Builder::find(const Box& box, const Grid& grid, Index begin, Index end,
  std::size_t maximum_entries, CellFacePairs& found) const
{
  const std::array<Id, 3>& size = grid.size;
  // The small margin makes the result correct also for points that rounding assigns to the
  // neighboring cell.
  const Vec3 half = Vec3::Constant(0.5 * grid.cell * (1.0 + 1e-9) + 4.0 * this->owner_.tolerance_);
  const double inverse = 1.0 / grid.cell;
  for (Index i = begin; i < end; ++i)
  {
    if (found.size() > maximum_entries || (i % 16384 == 16383 && this->context_.canceled()))
    {
      return false;
    }
    const std::array<Vec3, 3>& corners = box.corners[i];
    const Vec3 lower = corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]) - box.lower;
    const Vec3 upper = corners[0].cwiseMax(corners[1]).cwiseMax(corners[2]) - box.lower;
    std::array<Id, 3> from, to;
    bool outside = false;
    for (int k = 0; k < 3; ++k)
    {
      const double cell_overlap = half[k] - 0.5 * grid.cell;
      const double low = (lower[k] - cell_overlap) * inverse;
      const double high = (upper[k] + cell_overlap) * inverse;
      outside = outside || low >= size[k] || high < 0.0;
      from[k] = static_cast<Id>(std::clamp(low, 0.0, size[k] - 1.0));
      to[k] = static_cast<Id>(std::clamp(high, 0.0, size[k] - 1.0));
    }
    const int spanned_axes = (from[0] < to[0]) + (from[1] < to[1]) + (from[2] < to[2]);
    for (Id z = from[2]; z <= to[2] && !outside; ++z)
    {
      for (Id y = from[1]; y <= to[1]; ++y)
      {
        for (Id x = from[0]; x <= to[0]; ++x)
        {
          const Vec3 center = box.lower + grid.cell * Vec3(x + 0.5, y + 0.5, z + 0.5);
          if (spanned_axes < 2 || overlaps(corners, center, half))
          {
            found.emplace_back((z * size[1] + y) * size[0] + x, static_cast<Id>(i));
          }
        }
      }
    }
  }
  return true;
}

/// Sort the faces of the box into its cells. Return false if canceled or if there would be more
/// than `maximum_entries` pairs of a cell and a face.
bool WindingCells::Builder::sort(
  const Box& box, bool on_all_threads, std::size_t maximum_entries, Grid& grid) const
{
  const auto count = static_cast<Index>(box.faces.size());
  const Index faces_per_task = on_all_threads ? 16384 : count;
  std::vector<CellFacePairs> found(
    static_cast<std::size_t>((count + faces_per_task - 1) / faces_per_task));
  std::atomic<bool> done{ true };
  std::atomic<std::size_t> entries{ 0 };
  const auto body = [&](Index begin, Index end)
  {
    CellFacePairs& task_pairs = found[begin / faces_per_task];
    if (!done || !this->find(box, grid, begin, end, maximum_entries, task_pairs) ||
      (entries += task_pairs.size()) > maximum_entries)
    {
      done = false;
    }
  };
  if (on_all_threads)
  {
    done = parallel_for(this->context_, count, faces_per_task, body) && done;
  }
  else
  {
    body(0, count);
  }
  if (!done)
  {
    return false;
  }
  grid.begin.assign(static_cast<std::size_t>(grid.cells()) + 1, 0);
  for (const CellFacePairs& part : found)
  {
    for (const auto& entry : part)
    {
      grid.begin[entry.first + 1] += 1;
    }
  }
  for (Id c = 0; c < grid.cells(); ++c)
  {
    grid.begin[c + 1] += grid.begin[c];
  }
  grid.faces.resize(static_cast<std::size_t>(grid.begin.back()));
  std::vector<Id> next(grid.begin.begin(), grid.begin.end() - 1);
  for (const CellFacePairs& part : found)
  {
    for (const auto& [c, face] : part)
    {
      grid.faces[next[c]++] = face;
    }
  }
  return true;
}

/// Choose the references of the cells and compute their winding numbers. Return false if canceled.
bool WindingCells::Builder::choose_references(const Box& box, Grid& grid) const
{
  const Id cells = grid.cells();
  grid.references.resize(static_cast<std::size_t>(cells));
  grid.counts.assign(static_cast<std::size_t>(cells), 0);
  for (Id c = 0; c < cells; ++c)
  {
    if (c % 256 == 255 && this->context_.canceled())
    {
      return false;
    }
    const auto [x, y, z] = grid.position(c);
    const Id before = x > 0 ? c - 1 : y > 0 ? c - grid.size[0] : c - grid.size[0] * grid.size[1];
    const Vec3 center = box.lower + grid.cell * Vec3(x + 0.5, y + 0.5, z + 0.5);
    const auto list = [&](Id i)
    { return List(grid.faces.data() + grid.begin[i], grid.faces.data() + grid.begin[i + 1]); };
    bool resolved = false;
    for (int attempt = 0; attempt < 32 && !resolved; ++attempt)
    {
      // Place the reference near the center of the cell. Each attempt uses another, irregular
      // offset from the center.
      const double t = attempt + 1.0;
      const Vec3 position = center +
        0.05 * grid.cell *
          Vec3(std::sin(1.7 * t + 0.3), std::sin(2.3 * t + 1.1), std::sin(3.1 * t + 2.3));
      grid.references[c] = position;
      const List none(nullptr, nullptr);
      int& found = grid.counts[c];
      if (c > 0)
      {
        resolved = crossings(box, position, grid.references[before], list(c), list(before), found);
        found += grid.counts[before];
      }
      else if (box.depth == 0)
      {
        // The segment ends outside the box, where the winding number is 0.
        const Vec3 step = grid.cell * Vec3(1.1, 0.03, 0.05);
        resolved = crossings(box, position, position - step, list(c), none, found);
      }
      else
      {
        std::vector<Id> all(box.faces.size());
        std::iota(all.begin(), all.end(), 0);
        resolved = crossings(
          box, position, box.reference, List(all.data(), all.data() + all.size()), none, found);
        found += box.count;
      }
      if (!resolved && attempt % 8 == 7)
      {
        resolved = this->count_by_solid_angles(position, found);
      }
    }
  }
  return true;
}

bool WindingCells::Builder::cut_root(const Box& root_box)
{
  // Largest number of pairs of a cell and a face in all cells together. This limit is divided among
  // the cells in proportion to the number of faces in each cell. For every arrangement of the
  // faces, the limit bounds the memory to a multiple of the surface's memory. Surfaces with
  // triangles as large as the surface get fewer cells.
  const double maximum_entries = 16.0 * static_cast<double>(this->faces_.size()) + 1e5;
  Grid grid;
  {
    const ProgressRange range(this->context_, 0.0, 0.3);
    bool sorted = false;
    for (double cells_along = maximum_cells_along;
         !sorted && cells_along >= 1.0 && !this->context_.canceled();
         cells_along = 0.5 * root_box.size.maxCoeff() / grid.cell)
    {
      grid = this->choose_cells(root_box, cells_along);
      sorted = this->sort(root_box, true, static_cast<std::size_t>(maximum_entries), grid);
    }
    if (!sorted || !this->choose_references(root_box, grid))
    {
      return false;
    }
  }
  const Id cells = grid.cells();
  const double entries_per_pair =
    maximum_entries / static_cast<double>(std::max<std::size_t>(1, grid.faces.size()));
  constexpr Index cells_at_once = 16;
  std::vector<Arrays> parts(static_cast<std::size_t>((cells + cells_at_once - 1) / cells_at_once));
  Arrays& all = this->owner_.arrays_;
  all = Arrays();
  all.nodes.push_back({ root_box.lower, 1.0 / grid.cell, grid.size, 0 });
  all.cells.resize(static_cast<std::size_t>(cells));
  std::atomic<bool> done{ true };
  {
    const ProgressRange range(this->context_, 0.3, 0.95);
    done =
      parallel_for(this->context_, cells, cells_at_once,
        [&](Index begin, Index end)
        {
          for (auto c = static_cast<Id>(begin); c < end && done; ++c)
          {
            const auto entries = static_cast<std::size_t>(entries_per_pair * grid.number(c));
            if (!this->fill(root_box, grid, c, entries, parts[begin / cells_at_once], all.cells[c]))
            {
              done = false;
            }
          }
        }) &&
      done;
  }
  if (!done)
  {
    return false;
  }
  grid = Grid();
  const auto reserve_items = [&](auto Arrays::*items)
  {
    std::size_t count = (all.*items).size();
    for (const Arrays& part : parts)
    {
      count += (part.*items).size();
    }
    reserve_in_large_pages(all.*items, count);
  };
  reserve_items(&Arrays::nodes);
  reserve_items(&Arrays::cells);
  reserve_items(&Arrays::leaves);
  reserve_items(&Arrays::blocks);
  reserve_items(&Arrays::faces);
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    const auto first = static_cast<Id>(i * cells_at_once);
    this->append(parts[i], first, std::min(cells, first + static_cast<Id>(cells_at_once)));
    parts[i] = Arrays();
  }
  return !this->context_.canceled();
}

/// Append `part`, the contents of the cells [first, end) of the surface's box, to the arrays of the
/// WindingCells.
void WindingCells::Builder::append(const Arrays& part, Id first, Id end)
{
  Arrays& all = this->owner_.arrays_;
  const auto nodes = static_cast<Id>(all.nodes.size());
  const auto cells = static_cast<Id>(all.cells.size());
  const auto leaves = static_cast<Id>(all.leaves.size());
  const auto blocks = static_cast<Id>(all.blocks.size());
  const auto shift = [&](Cell& cell) {
    cell.value += cell.kind == node_cell ? nodes : cell.kind == leaf_cell ? leaves : 0;
  };
  std::for_each(all.cells.begin() + first, all.cells.begin() + end, shift);
  all.nodes.insert(all.nodes.end(), part.nodes.begin(), part.nodes.end());
  all.cells.insert(all.cells.end(), part.cells.begin(), part.cells.end());
  all.leaves.insert(all.leaves.end(), part.leaves.begin(), part.leaves.end());
  all.blocks.insert(all.blocks.end(), part.blocks.begin(), part.blocks.end());
  all.faces.insert(all.faces.end(), part.faces.begin(), part.faces.end());
  std::for_each(
    all.nodes.begin() + nodes, all.nodes.end(), [&](Node& node) { node.first += cells; });
  std::for_each(all.cells.begin() + cells, all.cells.end(), shift);
  for (auto leaf = all.leaves.begin() + leaves; leaf != all.leaves.end(); ++leaf)
  {
    leaf->begin += blocks;
    leaf->end += blocks;
  }
}

/// Add the box as a new node. Return false if canceled. Return false and add nothing if there would
/// be more than `entries` pairs of a cell and a face.
bool WindingCells::Builder::cut(const Box& box, Arrays& output, std::size_t entries) const
{
  Grid grid = this->choose_cells(box, maximum_cells_along);
  if (this->context_.canceled() || !this->sort(box, false, entries, grid) ||
    !this->choose_references(box, grid))
  {
    return false;
  }
  const Id cells = grid.cells();
  const auto first = static_cast<Id>(output.cells.size());
  output.cells.resize(static_cast<std::size_t>(first + cells));
  output.nodes.push_back({ box.lower, 1.0 / grid.cell, grid.size, first });
  const double entries_per_pair =
    static_cast<double>(entries) / static_cast<double>(std::max<std::size_t>(1, grid.faces.size()));
  for (Id c = 0; c < cells; ++c)
  {
    Cell cell{};
    if (!this->fill(
          box, grid, c, static_cast<std::size_t>(entries_per_pair * grid.number(c)), output, cell))
    {
      return false;
    }
    output.cells[first + c] = cell;
  }
  return true;
}

/// Set `cell` for the cell c of the grid, and add its leaf or node to `output`. Return false if
/// canceled.
bool WindingCells::Builder::fill(
  const Box& box, const Grid& grid, Id c, std::size_t entries, Arrays& output, Cell& cell) const
{
  const auto number = static_cast<std::size_t>(grid.number(c));
  const List faces(grid.faces.data() + grid.begin[c], grid.faces.data() + grid.begin[c + 1]);
  // At a depth of 3 or more, divide the cell only if it has less than 70 % of the faces of the
  // enclosing box. At a vertex of many triangles, dividing does not help: the cell that contains
  // the vertex overlaps all these triangles, however small the cell is.
  const bool shrinks = box.depth < 3 || 10 * number < 7 * grid.faces_before;
  const bool large_enough = grid.cell > 1e6 * this->owner_.tolerance_;
  if (number > maximum_leaf_faces && shrinks && large_enough && box.depth < maximum_depth &&
    entries > number)
  {
    const auto [x, y, z] = grid.position(c);
    Box inner;
    inner.lower = box.lower + grid.cell * Vec3(x, y, z);
    inner.size = Vec3::Constant(grid.cell);
    inner.reference = grid.references[c];
    inner.count = grid.counts[c];
    inner.faces.reserve(number);
    inner.corners.reserve(number);
    for (const Id* face = faces.first; face < faces.second; ++face)
    {
      inner.faces.push_back(box.faces[*face]);
      inner.corners.push_back(box.corners[*face]);
    }
    inner.depth = box.depth + 1;
    cell = { static_cast<Id>(output.nodes.size()), node_cell };
    if (this->cut(inner, output, entries))
    {
      return true;
    }
    if (this->context_.canceled())
    {
      return false;
    }
    // The faces are too large to be sorted into smaller cells, so the cell becomes a leaf.
  }
  cell = { grid.counts[c], empty_cell };
  if (number > 0)
  {
    cell = { add_leaf(box, grid.references[c], grid.counts[c], grid.cell, faces, output),
      leaf_cell };
  }
  return true;
}

namespace
{
/// Return a cross product scaled to the length `fixed_point_one`, or the zero vector if it is too
/// short to have a reliable direction. With the zero vector every sign is undecided.
std::array<double, 3> direction(const Vec3& product, double shortest, double fixed_point_one)
{
  const double length = product.norm();
  if (!(length > shortest))
  {
    return { 0.0, 0.0, 0.0 };
  }
  const Vec3 scaled = product * (fixed_point_one / length);
  return { scaled.x(), scaled.y(), scaled.z() };
}
} // namespace

WindingCells::Id WindingCells::Builder::add_leaf(
  const Box& box, const Vec3& reference, int count, double cell, List faces, Arrays& output)
{
  constexpr auto fixed_point_one = static_cast<double>(Block::fixed_point_one);
  Leaf leaf;
  leaf.reference = reference;
  leaf.count = count;
  leaf.distance_scale = static_cast<float>(distance_units / cell);
  leaf.begin = static_cast<Id>(output.blocks.size());
  for (const Id* first = faces.first; first < faces.second; first += lanes)
  {
    Block block;
    Faces ids;
    for (int lane = 0; lane < lanes; ++lane)
    {
      // An unused lane contains a plane far from the cell.
      std::array<double, Block::values_per_plane> plane{};
      plane[12] = fixed_point_one;
      ids[lane] = -1;
      if (first + lane < faces.second)
      {
        ids[lane] = box.faces[first[lane]];
        const std::array<Vec3, 3>& corners = box.corners[first[lane]];
        const std::array<Vec3, 3> relative{ corners[0] - reference, corners[1] - reference,
          corners[2] - reference };
        double largest_corner_distance = 0.0;
        for (int k = 0; k < 3; ++k)
        {
          largest_corner_distance = std::max(largest_corner_distance, relative[k].norm());
        }
        for (int k = 0; k < 3; ++k)
        {
          const auto normal = direction(relative[(k + 1) % 3].cross(relative[(k + 2) % 3]),
            shortest_product * largest_corner_distance, fixed_point_one);
          std::copy(normal.begin(), normal.end(), plane.begin() + 3 * k);
        }
        const Vec3 u = corners[1] - corners[0];
        const Vec3 v = corners[2] - corners[0];
        const Vec3 product = u.cross(v);
        const double longest = std::max(u.norm(), v.norm());
        const auto normal = direction(product,
          shortest_product * longest * std::max(1.0, largest_corner_distance / cell),
          fixed_point_one);
        const double distance =
          static_cast<double>(leaf.distance_scale) * product.dot(relative[0]) / product.norm();
        // For most faces, the distance of the plane fits into 16 bits, because most faces overlap
        // the cell. Otherwise the distance 0 is stored, which makes the sign undecided.
        const bool is_near = std::abs(distance) < fixed_point_one;
        std::copy(normal.begin(), normal.end(), plane.begin() + 9);
        plane[12] = is_near && normal != std::array<double, 3>{} ? distance : 0.0;
      }
      for (int k = 0; k < Block::values_per_plane; ++k)
      {
        // Round to the nearest integer without a library function such as std::lround(), which
        // would take more time than the other work in this function.
        block.plane[k * lanes + lane] =
          static_cast<std::int16_t>(plane[k] + (plane[k] < 0.0 ? -0.5 : 0.5));
      }
    }
    output.blocks.push_back(block);
    output.faces.push_back(ids);
  }
  leaf.end = static_cast<Id>(output.blocks.size());
  output.leaves.push_back(leaf);
  return static_cast<Id>(output.leaves.size()) - 1;
}

} // namespace bindpose
