// Outlines of images by marching squares and simplification (see image_outline.h). Only two rows of
// alpha are in memory. A frame of alpha 0 surrounds the image. Each line between an inside pixel
// and an outside neighbor gets one vertex. A cell is the square between the centers of four pixels.
// Each cell links the vertices on its edges, with the inside on the left. Every vertex then has one
// successor, and following the successors gives the loops.
//
// Simplification removes only vertices whose removal cannot make loops cross or touch. A vertex v
// between its neighbors p and n can be removed if the triangle p v n contains no other vertex. The
// first passes try every second vertex at a quarter of the tolerance. On straight lines, every pass
// halves the number of vertices, so each chain of contour points is tested only about log(length)
// times. After these passes, a search along the contour starts from each remaining vertex in turn.
// The vertex is connected to the farthest vertex for which the straight line is within the
// tolerance. On staircases of pixels, the lines to nearer vertices often exceed the tolerance; the
// search continues beyond these vertices.
#include "planar/image_outline.h"

#include <algorithm>
#include <cmath>

namespace bindpose
{

namespace
{
constexpr Index no_vertex = -1;
constexpr Index maximum_contour_points = Index(1) << 25;

/// The contour: points, and for each point its successor in a linked list.
struct Contour
{
  std::vector<Vec2> points;
  std::vector<Index> next;
};

/// A row of alpha, with one column of the frame at each end.
struct PaddedAlphaRow
{
  explicit PaddedAlphaRow(Index columns) : values(static_cast<std::size_t>(columns + 2), 0.0f) {}
  std::vector<float> values;
};

class MarchingSquares
{
public:
  MarchingSquares(Index columns, Index rows, const AlphaRow& alpha, double threshold)
    : columns_(columns), rows_(rows), alpha_(alpha), threshold_(static_cast<float>(threshold)),
      lower_(columns), upper_(columns), bottom_(static_cast<std::size_t>(columns + 2), no_vertex),
      top_(static_cast<std::size_t>(columns + 2), no_vertex)
  {
  }

  Status run(ExecutionContext& context, Contour& contour, Index& inside)
  {
    inside = 0;
    for (Index row = -1; row < this->rows_; ++row) // cells between row and row + 1
    {
      if (context.canceled())
      {
        return Status::canceled();
      }
      context.progress(static_cast<double>(row + 1) / static_cast<double>(this->rows_ + 1));
      this->read(row + 1, inside);
      this->link(row, contour);
      if (static_cast<Index>(contour.points.size()) > maximum_contour_points)
      {
        return Status::invalid_input("the image's outline has more than " +
          std::to_string(maximum_contour_points) +
          " points; blur the alpha channel or use a smaller image");
      }
      std::swap(this->lower_, this->upper_);
      std::swap(this->bottom_, this->top_);
    }
    return {};
  }

private:
  bool is_inside(float value) const { return value >= this->threshold_; }

  void read(Index row, Index& inside)
  {
    std::vector<float>& values = this->upper_.values;
    if (row == this->rows_)
    {
      std::fill(values.begin(), values.end(), 0.0f);
      return;
    }
    this->alpha_(row, values.data() + 1);
    for (Index x = 1; x <= this->columns_; ++x)
    {
      values[x] = std::isfinite(values[x]) ? values[x] : 0.0f;
      inside += this->is_inside(values[x]);
    }
  }

  /// Return the position of the threshold between the values a and b, as a fraction. The fraction
  /// is never 0 or 1, so that no two vertices coincide.
  double crossing(float a, float b) const
  {
    constexpr double margin = 0x1p-10;
    const double t =
      // The denominator is nonzero, because exactly one of a and b is inside.
      (double(this->threshold_) - double(a)) / (double(b) - double(a));
    return std::clamp(t, margin, 1.0 - margin);
  }

  Index add(double x, double y, Contour& contour)
  {
    contour.points.emplace_back(x, y);
    contour.next.push_back(no_vertex);
    return static_cast<Index>(contour.points.size()) - 1;
  }

  void link(Index row, Contour& contour)
  {
    const float* lower = this->lower_.values.data();
    const float* upper = this->upper_.values.data();
    Index left = no_vertex;
    bool previous_b = false; // the left column of the frame is outside
    bool previous_c = false;
    for (Index x = 0; x <= this->columns_; ++x) // cell between columns x - 1 and x of the image
    {
      const bool a = previous_b;
      const bool d = previous_c;
      const bool b = this->is_inside(lower[x + 1]);
      const bool c = this->is_inside(upper[x + 1]);
      previous_b = b;
      previous_c = c;
      this->top_[x] = no_vertex;
      if (a == b && b == c && c == d)
      {
        left = no_vertex;
        continue;
      }
      const double at = static_cast<double>(x - 1);
      if (c != d)
      {
        this->top_[x] = this->add(
          at + this->crossing(upper[x], upper[x + 1]), static_cast<double>(row + 1), contour);
      }
      const Index right = b == c
        ? no_vertex
        : this->add(at + 1.0, static_cast<double>(row) + this->crossing(lower[x + 1], upper[x + 1]),
            contour);
      this->link_cell({ a, b, c, d }, { this->bottom_[x], right, this->top_[x], left },
        { lower[x], lower[x + 1], upper[x + 1], upper[x] }, contour);
      left = right;
    }
  }

  /// Link the vertices on the edges of a cell. Corners are counter-clockwise from the lower left;
  /// edge k is between corners k and k + 1. Consecutive inside corners form a run. The vertex on
  /// the edge after a run is linked to the vertex on the edge before the same run. A saddle cell
  /// has two runs of one corner. If its inside corners are connected, the vertex after each run is
  /// linked to the vertex before the other run instead.
  void link_cell(const std::array<bool, 4>& corner_is_inside, const std::array<Index, 4>& sides,
    const std::array<float, 4>& values, Contour& contour) const
  {
    const bool saddle =
      corner_is_inside[0] == corner_is_inside[2] && corner_is_inside[1] == corner_is_inside[3];
    bool joined = false;
    if (saddle)
    {
      const double v[4] = { values[0], values[1], values[2], values[3] };
      const double value = (v[0] * v[2] - v[1] * v[3]) / (v[0] + v[2] - v[1] - v[3]);
      joined = value >= double(this->threshold_);
    }
    Index begin = no_vertex;
    for (int k = 0; k < 4; ++k)
    {
      if (!corner_is_inside[k] && corner_is_inside[(k + 1) % 4])
      {
        begin = sides[k];
      }
    }
    for (int k = 0; k < 4; ++k)
    {
      if (corner_is_inside[k] && !corner_is_inside[(k + 1) % 4])
      {
        contour.next[sides[k]] = saddle ? sides[(k + (joined ? 1 : 3)) % 4] : begin;
      }
    }
  }

  Index columns_;
  Index rows_;
  const AlphaRow& alpha_;
  float threshold_;
  PaddedAlphaRow lower_;
  PaddedAlphaRow upper_;
  std::vector<Index> bottom_; // vertices on the bottom edges of the row of cells, by column
  std::vector<Index> top_;
};

/// Vertices in the order of their loops. Loop l has the indices starts[l] … starts[l + 1] - 1.
struct Loops
{
  std::vector<Vec2> points;
  std::vector<Index> starts{ 0 };
};

Loops read_loops(Contour& contour)
{
  Loops loops;
  loops.points.reserve(contour.points.size());
  for (std::size_t first = 0; first < contour.points.size(); ++first)
  {
    Index v = static_cast<Index>(first);
    while (contour.next[v] != no_vertex)
    {
      loops.points.push_back(contour.points[v]);
      v = std::exchange(contour.next[v], no_vertex);
    }
    if (static_cast<Index>(loops.points.size()) > loops.starts.back())
    {
      loops.starts.push_back(static_cast<Index>(loops.points.size()));
    }
  }
  return loops;
}

double squared_distance(const Vec2& p, const Vec2& a, const Vec2& b)
{
  const Vec2 segment_vector = b - a;
  const double length = segment_vector.squaredNorm();
  const double t = length > 0.0 ? std::clamp((p - a).dot(segment_vector) / length, 0.0, 1.0) : 0.0;
  return (p - a - t * segment_vector).squaredNorm();
}

/// Vertices sorted into the square cells of a grid, to find vertices near a triangle.
class VertexGrid
{
public:
  VertexGrid(Index columns, Index rows)
    : width_((columns + 2) / side + 1), height_((rows + 2) / side + 1)
  {
  }

  void fill(const std::vector<Vec2>& points, const std::vector<char>& alive)
  {
    this->starts_.assign(static_cast<std::size_t>(this->width_ * this->height_ + 1), 0);
    const auto count = static_cast<Index>(points.size());
    for (Index v = 0; v < count; ++v)
    {
      this->starts_[this->cell(points[v]) + 1] += alive[v];
    }
    for (std::size_t c = 1; c < this->starts_.size(); ++c)
    {
      this->starts_[c] += this->starts_[c - 1];
    }
    this->ids_.resize(static_cast<std::size_t>(this->starts_.back()));
    std::vector<Index> at(this->starts_.begin(), this->starts_.end() - 1);
    for (Index v = 0; v < count; ++v)
    {
      if (alive[v])
      {
        this->ids_[at[this->cell(points[v])]++] = v;
      }
    }
  }

  /// Call visit(id) for the vertices near the triangle until a call returns true. Return whether a
  /// call returned true. In each row of cells, the search covers the cells between the triangle's
  /// leftmost and rightmost point in this row.
  template <typename Visit>
  bool any(const std::array<Vec2, 3>& corners, const Visit& visit) const
  {
    const auto [low, high] = std::minmax({ corners[0].y(), corners[1].y(), corners[2].y() });
    for (Index row = this->index(low, this->height_); row <= this->index(high, this->height_);
         ++row)
    {
      const double bottom = static_cast<double>(row * side) - 1.0 - slack;
      const double top = bottom + side + 2.0 * slack;
      double left = std::numeric_limits<double>::max();
      double right = std::numeric_limits<double>::lowest();
      for (int k = 0; k < 3; ++k)
      {
        const Vec2& a = corners[k];
        const Vec2& b = corners[(k + 1) % 3];
        const double rise = b.y() - a.y();
        // Range (in 0 … 1) of the part of the triangle's edge that is within this row of cells.
        double from = 0.0;
        double to = 1.0;
        if (rise != 0.0)
        {
          const auto [s, e] = std::minmax({ (bottom - a.y()) / rise, (top - a.y()) / rise });
          from = std::max(from, s);
          to = std::min(to, e);
        }
        if (from <= to)
        {
          for (const double t : { from, to })
          {
            const double x = a.x() + t * (b.x() - a.x());
            left = std::min(left, x);
            right = std::max(right, x);
          }
        }
      }
      if (left > right)
      {
        continue;
      }
      const Index first = this->index(left - slack, this->width_);
      const Index last = this->index(right + slack, this->width_);
      for (Index k = this->starts_[row * this->width_ + first];
           k < this->starts_[row * this->width_ + last + 1]; ++k)
      {
        if (visit(this->ids_[k]))
        {
          return true;
        }
      }
    }
    return false;
  }

private:
  static constexpr Index side = 8; // edge length of a cell in pixels
  static constexpr double slack = 1e-6;

  Index index(double x, Index count) const
  {
    return std::clamp<Index>(static_cast<Index>(x + 1.0) / side, 0, count - 1);
  }
  Index cell(const Vec2& p) const
  {
    return this->index(p.y(), this->height_) * this->width_ + this->index(p.x(), this->width_);
  }

  Index width_;
  Index height_;
  std::vector<Index> starts_;
  std::vector<Index> ids_;
};

class Simplifier
{
public:
  Simplifier(const Loops& loops, Index columns, Index rows)
    : loops_(loops), grid_(columns, rows), is_remaining_(loops.points.size(), 1),
      next_(loops.points.size()), previous_(loops.points.size())
  {
    for (std::size_t l = 0; l + 1 < loops.starts.size(); ++l)
    {
      const Index begin = loops.starts[l];
      const Index end = loops.starts[l + 1];
      for (Index v = begin; v < end; ++v)
      {
        this->next_[v] = v + 1 < end ? v + 1 : begin;
        this->previous_[v] = v > begin ? v - 1 : end - 1;
      }
      this->remaining_counts_.push_back(end - begin);
    }
  }

  Status run(ExecutionContext& context, double tolerance)
  {
    constexpr double first = 0.25;
    for (bool has_removed = true; has_removed;)
    {
      if (context.canceled())
      {
        return Status::canceled();
      }
      has_removed = this->halve(first * tolerance);
    }
    context.progress(0.5);
    for (bool has_removed = true; has_removed;)
    {
      if (context.canceled())
      {
        return Status::canceled();
      }
      has_removed = this->simplify_by_search_ahead(tolerance);
    }
    return {};
  }

  /// Copy the remaining vertices to the outline.
  void collect(ImageOutline& outline) const
  {
    const Index count = std::count(this->is_remaining_.begin(), this->is_remaining_.end(), 1);
    outline.points.resize(count, 2);
    outline.segments.resize(count, 2);
    Index at = 0;
    for (std::size_t l = 0; l + 1 < this->loops_.starts.size(); ++l)
    {
      const Index first = at;
      for (Index v = this->loops_.starts[l]; v < this->loops_.starts[l + 1]; ++v)
      {
        if (this->is_remaining_[v])
        {
          outline.points.row(at) = this->loops_.points[v].transpose();
          outline.segments.row(at) << at, at + 1;
          ++at;
        }
      }
      outline.segments(at - 1, 1) = first;
    }
  }

private:
  bool halve(double tolerance)
  {
    this->grid_.fill(this->loops_.points, this->is_remaining_);
    bool has_removed = false;
    for (std::size_t l = 0; l + 1 < this->loops_.starts.size(); ++l)
    {
      for (Index v = this->loops_.starts[l]; v < this->loops_.starts[l + 1]; ++v)
      {
        const Index p = this->previous_[v];
        const Index n = this->next_[v];
        if (this->is_remaining_[v] && this->remaining_counts_[l] > minimum_loop_size &&
          this->deviation(l, p, n, tolerance) <= tolerance && !this->contains_vertex(p, v, n))
        {
          has_removed = true;
          this->remove(l, p, n, 1);
          this->is_remaining_[v] = 0;
          v = n > v ? n : v; // skip the next vertex in this pass
        }
      }
    }
    return has_removed;
  }

  bool simplify_by_search_ahead(double tolerance)
  {
    this->grid_.fill(this->loops_.points, this->is_remaining_);
    bool has_removed = false;
    for (std::size_t l = 0; l + 1 < this->loops_.starts.size(); ++l)
    {
      for (Index v = this->loops_.starts[l]; v < this->loops_.starts[l + 1]; ++v)
      {
        has_removed =
          (this->is_remaining_[v] && this->search_ahead_from(l, v, tolerance)) || has_removed;
      }
    }
    return has_removed;
  }

  /// Connect p to the farthest vertex f for which the segment pf deviates from the contour by at
  /// most the tolerance. To find f, the vertices after p are removed one by one. The search ends if
  /// the deviation exceeds `search_limit` times the tolerance or if loops could cross. Then f and
  /// the vertices after f are restored. Return true if a vertex remains removed.
  bool search_ahead_from(std::size_t loop, Index p, double tolerance)
  {
    constexpr std::size_t maximum_removed =
      256; // maximum number of vertices that are removed at a time
    constexpr double search_limit = 3.0; // the search ends at this multiple of the tolerance
    std::vector<Index>& removed = this->removed_;
    removed.clear();
    std::size_t accepted_count = 0;
    Index v = this->next_[p];
    while (this->remaining_counts_[loop] - static_cast<Index>(removed.size()) > minimum_loop_size &&
      removed.size() < maximum_removed)
    {
      const Index n = this->next_[v];
      const double deviation = this->deviation(loop, p, n, search_limit * tolerance);
      if (deviation > search_limit * tolerance || this->contains_vertex(p, v, n))
      {
        break;
      }
      this->is_remaining_[v] = 0;
      removed.push_back(v);
      accepted_count = deviation <= tolerance ? removed.size() : accepted_count;
      v = n;
    }
    for (std::size_t k = accepted_count; k < removed.size(); ++k)
    {
      this->is_remaining_[removed[k]] = 1;
    }
    if (accepted_count > 0)
    {
      this->remove(
        loop, p, this->next_[removed[accepted_count - 1]], static_cast<Index>(accepted_count));
    }
    return accepted_count > 0;
  }

  void remove(std::size_t loop, Index p, Index n, Index count)
  {
    this->remaining_counts_[loop] -= count;
    this->next_[p] = n;
    this->previous_[n] = p;
  }

  /// Return the largest distance from the segment pn to the contour points between p and n. The
  /// search stops at the first distance above the limit.
  double deviation(std::size_t loop, Index p, Index n, double limit) const
  {
    const std::vector<Vec2>& points = this->loops_.points;
    double largest = 0.0;
    for (Index u = this->after(loop, p); u != n && largest <= limit * limit;
         u = this->after(loop, u))
    {
      largest = std::max(largest, squared_distance(points[u], points[p], points[n]));
    }
    return std::sqrt(largest);
  }

  /// Return the next point of the original contour. The point may have been removed.
  Index after(std::size_t loop, Index v) const
  {
    return v + 1 < this->loops_.starts[loop + 1] ? v + 1 : this->loops_.starts[loop];
  }

  /// Report whether another remaining vertex is in the closed triangle, with a tolerance for
  /// rounding.
  bool contains_vertex(Index p, Index v, Index n) const
  {
    const std::vector<Vec2>& points = this->loops_.points;
    std::array<Vec2, 3> corners{ points[p], points[v], points[n] };
    if (cross(corners[1] - corners[0], corners[2] - corners[0]) < 0.0)
    {
      std::swap(corners[1], corners[2]);
    }
    constexpr double slack = 1e-9;
    const Vec2 low = corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]);
    const Vec2 high = corners[0].cwiseMax(corners[1]).cwiseMax(corners[2]);
    return this->grid_.any(corners,
      [&](Index u)
      {
        if (u == p || u == v || u == n || !this->is_remaining_[u])
        {
          return false;
        }
        // Test the bounding box first: on a straight contour, the three corners are on one line,
        // and the tests of the sides below accept every point of this line.
        if ((points[u] - low).minCoeff() < -slack || (high - points[u]).minCoeff() < -slack)
        {
          return false;
        }
        for (int k = 0; k < 3; ++k)
        {
          const Vec2 side = corners[(k + 1) % 3] - corners[k];
          if (cross(side, points[u] - corners[k]) < -slack * (1.0 + side.norm()))
          {
            return false;
          }
        }
        return true;
      });
  }

  // Minimum number of vertices of a loop, so that the diamond around a single pixel is kept.
  static constexpr Index minimum_loop_size = 4;

  const Loops& loops_;
  VertexGrid grid_;
  std::vector<char> is_remaining_;
  std::vector<Index> next_; // next remaining vertex in the loop
  std::vector<Index> previous_; // previous remaining vertex in the loop
  std::vector<Index> remaining_counts_; // number of remaining vertices per loop
  std::vector<Index> removed_;
};
} // namespace

Status image_outline(ExecutionContext& context, Index columns, Index rows, const AlphaRow& alpha,
  const ImageOutlineOptions& options, ImageOutline& outline)
{
  outline = ImageOutline();
  const Phase phase(context, "outline");
  if (columns < 1 || rows < 1)
  {
    return Status::invalid_input("the image has no pixels");
  }
  if (!(options.threshold > 0.0 && options.threshold <= 1.0))
  {
    return Status::invalid_input("the alpha threshold must be greater than 0 and at most 1");
  }
  if (!(options.simplify >= 0.0 && options.simplify <= 1.0))
  {
    return Status::invalid_input("the tolerance of the outline must be from 0 to 1 pixel");
  }
  Contour contour;
  Index inside = 0;
  Status status;
  {
    const ProgressRange range(context, 0.0, 0.7);
    status = MarchingSquares(columns, rows, alpha, options.threshold).run(context, contour, inside);
  }
  if (status.ok() && inside == 0)
  {
    status =
      Status::invalid_input("the image is transparent everywhere: no pixel's alpha reaches " +
        std::to_string(options.threshold));
  }
  if (!status.ok())
  {
    return status;
  }
  status.report.set("counts.pixels", columns * rows);
  status.report.set("counts.inside_pixels", inside);
  status.report.set("counts.contour_points", static_cast<Index>(contour.points.size()));
  const Loops loops = read_loops(contour);
  Simplifier simplifier(loops, columns, rows);
  if (options.simplify > 0.0)
  {
    const ProgressRange range(context, 0.7, 1.0);
    const Status simplified = simplifier.run(context, options.simplify);
    if (!simplified.ok())
    {
      return simplified;
    }
  }
  simplifier.collect(outline);
  status.report.set("counts.outline_points", outline.points.rows());
  status.report.set("counts.loops", static_cast<Index>(loops.starts.size()) - 1);
  return status;
}

} // namespace bindpose
