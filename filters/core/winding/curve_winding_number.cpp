// Exact winding numbers of curves in the plane, by ray crossings for closed loops plus the angles
// of chords for open ends.
//
// The build merges equal vertices and walks along the segments until each one is used. Walks start
// at vertices with more outgoing than incoming segments, then at all others. A walk that ends at
// its start is a closed curve. Any other walk is closed by a chord from its end to its start. Thus
// the segments become loops. There is one chord per pair of open ends, which is the minimum.
//
// The winding number of the curve is the integer winding number of the loops plus 1/(2 pi) times
// the angles of the chords from start to end, as seen from the point. (The loops contain each chord
// in the direction from end to start.)
//
// The winding number of a loop is the signed number of times it crosses the ray from the point
// toward -x. A vertex at the height of the ray counts as above the ray, and an exact predicate
// decides whether a segment passes left of the point. Therefore no crossing is missed or counted
// twice.
//
// Crossings are counted in a tree over the pieces of the loop. If the point is outside a piece's
// box, the straight line between the ends of the piece has the same signed number of crossings as
// the piece. The reason is that the piece and the line together do not wind around the point. The
// loops are also sorted into a tree of boxes. A loop has the winding number 0 outside its box.
//
// If the point touches a segment, the same tree is used to sum the angles of all other segments. If
// the point is outside the box of a piece, the angle of the piece is the angle of the straight line
// between the ends of the piece.
#include "winding/curve_winding_number.h"

#include "base/constants.h"
#include "base/parallel_sort.h"
#include "geometry/exact.h"
#include "geometry/median_split.h"
#include "winding/exact_frame.h"
#include "winding/point_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace bindpose
{

namespace
{
using Id = std::int32_t;
/// Pieces with at most this many segments are not split further. (Measured: limits from 4 to 12
/// have nearly the same speed.)
constexpr Id maximum_leaf_size = 6;

/// Report whether a vertex is above the ray from p. A vertex at the height of the ray counts as
/// above.
bool is_above(const Vec2& a, const Vec2& p)
{
  return a.y() >= p.y();
}

/// Return the signed crossing of the segment a, b and the ray from p toward -x: +1 downwards, -1
/// upwards, 0 if they do not cross. A segment through p counts as crossing the ray.
int crossing(const Vec2& a, const Vec2& b, const Vec2& p)
{
  const int downwards = static_cast<int>(is_above(a, p)) - static_cast<int>(is_above(b, p));
  if (downwards == 0 || (a.x() > p.x() && b.x() > p.x()))
  {
    return 0;
  }
  if (a.x() < p.x() && b.x() < p.x())
  {
    return downwards;
  }
  const int side = orientation_2d(a.x(), a.y(), b.x(), b.y(), p.x(), p.y());
  return side == 0 || side == downwards ? downwards : 0;
}

/// Return the signed angle from a to b seen from p, in [-pi, pi]. If p is on the line between a and
/// b, the sign of the angle agrees with crossing(). The sign is computed exactly: if an angle near
/// pi got the wrong sign, the sum of the angles would change by a full turn.
double signed_angle(const Vec2& a, const Vec2& b, const Vec2& p)
{
  const Vec2 u = a - p;
  const Vec2 v = b - p;
  const double left = u.x() * v.y();
  const double right = u.y() * v.x();
  double determinant = left - right;
  const double dot = u.dot(v);
  constexpr double relative_error_bound = 1e-15;
  if (std::abs(determinant) <= relative_error_bound * (std::abs(left) + std::abs(right)))
  {
    int side = orientation_2d(a.x(), a.y(), b.x(), b.y(), p.x(), p.y());
    if (side == 0 && dot >= 0.0)
    {
      return 0.0;
    }
    if (side == 0)
    {
      const int downwards = static_cast<int>(is_above(a, p)) - static_cast<int>(is_above(b, p));
      side = downwards != 0 ? downwards : a.x() > b.x() ? 1 : -1;
    }
    determinant = side > 0 ? std::abs(determinant) : -std::abs(determinant);
  }
  return std::atan2(determinant, dot);
}

bool touches(const Vec2& a, const Vec2& b, const Vec2& p, double tolerance)
{
  if (std::min(a.x(), b.x()) - p.x() > tolerance || p.x() - std::max(a.x(), b.x()) > tolerance ||
    std::min(a.y(), b.y()) - p.y() > tolerance || p.y() - std::max(a.y(), b.y()) > tolerance)
  {
    return false;
  }
  const Vec2 ab = b - a;
  const Vec2 ap = p - a;
  const double length = ab.squaredNorm();
  const double t = length > 0.0 ? std::clamp(ap.dot(ab) / length, 0.0, 1.0) : 0.0;
  return (ap - t * ab).squaredNorm() <= tolerance * tolerance;
}

Vec2 in_frame(const ExactFrame& frame, const Vec2& p)
{
  return frame(Vec3(p.x(), p.y(), 0.0)).head<2>();
}

Status check_segments(PlanePointsView points, SegmentsView segments)
{
  for (Index e = 0; e < segments.rows(); ++e)
  {
    for (int k = 0; k < 2; ++k)
    {
      const Index v = segments(e, k);
      if (v < 0 || v >= points.rows())
      {
        return Status::invalid_input("segment " + std::to_string(e) + " references vertex " +
          std::to_string(v) + ", but there are " + std::to_string(points.rows()) + " vertices");
      }
      if (!points.row(v).allFinite())
      {
        return Status::invalid_input("vertex " + std::to_string(v) +
          " has a coordinate that is not a finite number (used by segment " + std::to_string(e) +
          ")");
      }
    }
  }
  if (segments.rows() > std::numeric_limits<Id>::max() / 4)
  {
    return Status::invalid_input(
      "the curve has " + std::to_string(segments.rows()) + " segments: expected fewer than 2^29");
  }
  return {};
}

ExactFrame frame_of(PlanePointsView points, SegmentsView segments)
{
  Box box;
  for (Index k = 0; k < segments.size(); ++k)
  {
    const Index v = segments.data()[k];
    box.add(Vec3(points(v, 0), points(v, 1), 0.0));
  }
  return segments.size() ? ExactFrame(box) : ExactFrame();
}

struct Segment
{
  Id from, to;
};

struct WeldedCurve
{
  std::vector<Vec2> points; ///< vertices in the exact frame (ExactFrame); equal points are merged
  std::vector<Segment> segments; ///< all segments except those from a vertex to itself
  Index merged_vertices = 0;
};

bool weld(ExecutionContext& context, PlanePointsView points, SegmentsView segments,
  const ExactFrame& frame, WeldedCurve& welded)
{
  std::vector<char> used(static_cast<std::size_t>(points.rows()), 0);
  for (Index k = 0; k < segments.size(); ++k)
  {
    used[segments.data()[k]] = 1;
  }
  struct Vertex
  {
    Vec2 at;
    Index id;
  };
  std::vector<Vertex> vertices;
  for (Index v = 0; v < points.rows(); ++v)
  {
    if (used[v])
    {
      vertices.push_back({ in_frame(frame, points.row(v)), v });
    }
  }
  if (!parallel_sort(context, vertices,
        [](const Vertex& x, const Vertex& y)
        { return x.at.x() != y.at.x() ? x.at.x() < y.at.x() : x.at.y() < y.at.y(); }))
  {
    return false;
  }
  std::vector<Id> id_of(static_cast<std::size_t>(points.rows()), -1);
  for (std::size_t i = 0; i < vertices.size(); ++i)
  {
    if (i == 0 || vertices[i].at != vertices[i - 1].at)
    {
      welded.points.push_back(vertices[i].at);
    }
    id_of[vertices[i].id] = static_cast<Id>(welded.points.size()) - 1;
  }
  welded.merged_vertices = static_cast<Index>(vertices.size() - welded.points.size());
  for (Index e = 0; e < segments.rows(); ++e)
  {
    const Segment segment{ id_of[segments(e, 0)], id_of[segments(e, 1)] };
    if (segment.from != segment.to)
    {
      welded.segments.push_back(segment);
    }
  }
  return true;
}

/// Count the segments that join the same two vertices as an earlier segment, in either direction.
/// Return false if canceled.
bool count_duplicates(
  ExecutionContext& context, const std::vector<Segment>& segments, Index& duplicates)
{
  std::vector<std::array<Id, 2>> ends;
  ends.reserve(segments.size());
  for (const Segment& segment : segments)
  {
    ends.push_back({ std::min(segment.from, segment.to), std::max(segment.from, segment.to) });
  }
  if (!parallel_sort(context, ends, std::less<>()))
  {
    return false;
  }
  for (std::size_t i = 1; i < ends.size(); ++i)
  {
    duplicates += ends[i] == ends[i - 1];
  }
  return true;
}

/// Numbers of incoming and outgoing segments of a vertex.
struct Degree
{
  Id in = 0, out = 0;
};

/// A closed polyline. If a traced curve is open, a chord between its ends is added as last segment.
struct Loop
{
  /// Indices of the loop's first and last point in the array of path points; both are the same
  /// vertex.
  Id first, last;
  bool open; ///< whether the last segment is a chord
};

/// Write the vertices of all loops to `path`, one loop after the other.
void trace_loops(const std::vector<Segment>& segments, const std::vector<Degree>& degrees,
  std::vector<Id>& path, std::vector<Loop>& loops)
{
  // The segments that leave each vertex, in their input order.
  std::vector<Id> next(degrees.size() + 1, 0);
  for (std::size_t v = 0; v < degrees.size(); ++v)
  {
    next[v + 1] = next[v] + degrees[v].out;
  }
  const std::vector<Id> end(next.begin() + 1, next.end());
  std::vector<Id> to(segments.size());
  {
    std::vector<Id> next_slot = next;
    for (const Segment& segment : segments)
    {
      to[next_slot[segment.from]++] = segment.to;
    }
  }
  const auto trace_from = [&](Id start)
  {
    const auto first = static_cast<Id>(path.size());
    path.push_back(start);
    for (Id at = start; next[at] < end[at];)
    {
      at = to[next[at]++];
      path.push_back(at);
    }
    const bool open = path.back() != start;
    if (open)
    {
      path.push_back(start);
    }
    loops.push_back({ first, static_cast<Id>(path.size()) - 1, open });
  };
  const auto count = static_cast<Id>(degrees.size());
  for (Id v = 0; v < count; ++v)
  {
    for (Id surplus = degrees[v].out - degrees[v].in; surplus > 0; --surplus)
    {
      trace_from(v);
    }
  }
  for (Id v = 0; v < count; ++v)
  {
    while (next[v] < end[v])
    {
      trace_from(v);
    }
  }
}

/// A pair of open ends, joined by a chord, and the leaf that contains the chord.
struct Chord
{
  Vec2 start, end;
  Id leaf;
};

/// A node of the tree: a piece of a loop, a loop, or several loops.
struct Node
{
  Vec2 lower, upper; ///< box with a margin; contains every point that touches one of the segments
  double first_y, last_y; ///< y coordinates of the ends of a piece; equal for loops
  /// The piece or loop consists of the path points `first` … `last`. Both indices are 0 if the node
  /// contains several loops.
  Id first, last;
  Id skip; ///< index of the node after this node's descendants
  bool leaf;
  bool ends_with_chord; ///< whether the last segment of a leaf is a chord
};

/// Builds the tree. Nodes are stored in depth-first order, left child first.
class TreeBuilder
{
public:
  TreeBuilder(ExecutionContext& context, const std::vector<Vec2>& path,
    const std::vector<Loop>& loops, double margin, std::vector<Node>& nodes,
    std::vector<Chord>& chords)
    : path_(path), loops_(loops), margin_(margin), context_(context), nodes_(nodes), chords_(chords)
  {
  }

  /// Build the nodes and the chords.
  /// @return false if canceled.
  bool run()
  {
    for (const Loop& loop : this->loops_)
    {
      Vec2 lower = this->path_[loop.first];
      Vec2 upper = lower;
      for (Id i = loop.first; i < loop.last; ++i)
      {
        lower = lower.cwiseMin(this->path_[i]);
        upper = upper.cwiseMax(this->path_[i]);
      }
      this->twice_centers_.emplace_back(lower + upper);
    }
    this->order_.resize(this->loops_.size());
    std::iota(this->order_.begin(), this->order_.end(), 0);
    if (!this->loops_.empty())
    {
      this->add_loops(0, static_cast<Id>(this->loops_.size()));
    }
    return !this->stopped_;
  }

private:
  bool stopped(Id size)
  {
    constexpr Id large = 1 << 14; // building a piece of this size takes about a millisecond
    this->stopped_ = this->stopped_ || (size >= large && this->context_.canceled());
    return this->stopped_;
  }

  void add_loops(Id begin, Id end)
  {
    if (this->stopped(end - begin))
    {
      return;
    }
    if (end - begin == 1)
    {
      const Loop& loop = this->loops_[this->order_[begin]];
      this->add_piece(loop.first, loop.last, loop.open);
      this->context_.progress(static_cast<double>(end) / static_cast<double>(this->loops_.size()));
      return;
    }
    Vec2 lower = this->twice_centers_[this->order_[begin]];
    Vec2 upper = lower;
    for (Id i = begin; i < end; ++i)
    {
      lower = lower.cwiseMin(this->twice_centers_[this->order_[i]]);
      upper = upper.cwiseMax(this->twice_centers_[this->order_[i]]);
    }
    int axis = 0;
    (upper - lower).maxCoeff(&axis);
    const Id middle = begin + (end - begin) / 2;
    const auto first = this->order_.begin();
    split_at(first + begin, first + middle, first + end,
      [&](Id loop) { return std::pair(this->twice_centers_[loop][axis], loop); });
    const std::size_t node = this->nodes_.size();
    this->nodes_.push_back({});
    this->add_loops(begin, middle);
    this->add_loops(middle, end);
    this->finish(node);
  }

  void add_piece(Id first, Id last, bool ends_with_chord)
  {
    if (this->stopped(last - first))
    {
      return;
    }
    const std::size_t node = this->nodes_.size();
    this->nodes_.push_back({});
    this->nodes_[node].leaf = last - first <= maximum_leaf_size;
    if (this->nodes_[node].leaf)
    {
      Node& leaf = this->nodes_[node];
      leaf.ends_with_chord = ends_with_chord;
      leaf.lower = leaf.upper = this->path_[first];
      for (Id i = first; i <= last; ++i)
      {
        leaf.lower = leaf.lower.cwiseMin(this->path_[i]);
        leaf.upper = leaf.upper.cwiseMax(this->path_[i]);
      }
      leaf.lower.array() -= this->margin_;
      leaf.upper.array() += this->margin_;
      leaf.skip = static_cast<Id>(node) + 1;
      if (ends_with_chord)
      {
        this->chords_.push_back(
          { this->path_[last], this->path_[last - 1], static_cast<Id>(node) });
      }
    }
    else
    {
      const Id middle = first + (last - first) / 2;
      this->add_piece(first, middle, false);
      this->add_piece(middle, last, ends_with_chord);
      this->finish(node);
    }
    this->nodes_[node].first = first;
    this->nodes_[node].last = last;
    this->nodes_[node].first_y = this->path_[first].y();
    this->nodes_[node].last_y = this->path_[last].y();
  }

  /// Compute the box of a node and its `skip` index after its children are complete.
  void finish(std::size_t node)
  {
    if (this->stopped_)
    {
      return;
    }
    Node& parent = this->nodes_[node];
    const Node& left = this->nodes_[node + 1];
    const Node& right = this->nodes_[left.skip];
    parent.lower = left.lower.cwiseMin(right.lower);
    parent.upper = left.upper.cwiseMax(right.upper);
    parent.skip = static_cast<Id>(this->nodes_.size());
  }

  const std::vector<Vec2>& path_;
  const std::vector<Loop>& loops_;
  double margin_;
  ExecutionContext& context_;
  std::vector<Node>& nodes_;
  std::vector<Chord>& chords_;
  std::vector<Vec2> twice_centers_;
  std::vector<Id> order_;
  bool stopped_ = false;
};

/// Return the enclosed area, weighted by the winding number (a region with winding number 2 counts
/// twice). The shoelace formula is used, with the first point of each loop as the origin.
double signed_area(const std::vector<Vec2>& path, const std::vector<Loop>& loops)
{
  double area_times_two = 0.0;
  for (const Loop& loop : loops)
  {
    const Vec2& origin = path[loop.first];
    for (Id i = loop.first + 1; i + 1 < loop.last; ++i)
    {
      const Vec2 a = path[i] - origin;
      const Vec2 b = path[i + 1] - origin;
      area_times_two += a.x() * b.y() - a.y() * b.x();
    }
  }
  return 0.5 * area_times_two;
}
} // namespace

struct CurveWindingNumber::Impl
{
  Status status;
  ExactFrame frame;
  std::vector<Vec2> path;
  std::vector<Node> nodes;
  std::vector<Chord> chords;

  double at(const Vec2& query, bool& on_curve) const;
  double evaluate_on_curve(const Vec2& framed) const;
  Vec2 gradient_at(const Vec2& query) const;
};

CurveWindingNumber::CurveWindingNumber() : impl_(new Impl) {}
CurveWindingNumber::CurveWindingNumber(PlanePointsView points, SegmentsView segments)
  : impl_(new Impl)
{
  ExecutionContext context;
  this->build(context, points, segments);
}
CurveWindingNumber::~CurveWindingNumber() = default;
CurveWindingNumber::CurveWindingNumber(CurveWindingNumber&&) noexcept = default;
CurveWindingNumber& CurveWindingNumber::operator=(CurveWindingNumber&&) noexcept = default;

Status CurveWindingNumber::build(
  ExecutionContext& context, PlanePointsView points, SegmentsView segments)
{
  this->impl_.reset(new Impl);
  Impl& impl = *this->impl_;
  Status& status = impl.status;
  status = check_segments(points, segments);
  if (!status.ok())
  {
    return status;
  }
  impl.frame = frame_of(points, segments);
  WeldedCurve welded;
  Index duplicates = 0;
  bool done = true;
  {
    const ProgressRange range(context, 0.0, 0.4);
    done = weld(context, points, segments, impl.frame, welded);
  }
  if (done)
  {
    const ProgressRange range(context, 0.4, 0.7);
    done = count_duplicates(context, welded.segments, duplicates);
  }
  if (done)
  {
    std::vector<Degree> degrees(welded.points.size());
    // connected_components() expects triangles, so each segment becomes a triangle without area.
    Triangles flat(static_cast<Index>(welded.segments.size()), 3);
    for (std::size_t e = 0; e < welded.segments.size(); ++e)
    {
      const Segment& segment = welded.segments[e];
      degrees[segment.from].out += 1;
      degrees[segment.to].in += 1;
      flat.row(static_cast<Index>(e)) << segment.from, segment.to, segment.to;
    }
    Index boundary = 0, nonmanifold = 0, open = 0;
    for (const Degree& degree : degrees)
    {
      boundary += degree.in + degree.out == 1;
      nonmanifold += degree.in + degree.out > 2;
      open += degree.in != degree.out;
    }
    Report& report = status.report;
    report.set("method", "crossings");
    report.set("counts.vertices", points.rows());
    report.set("counts.segments", segments.rows());
    report.set("counts.boundary_vertices", boundary);
    report.set("counts.nonmanifold_vertices", nonmanifold);
    report.set("counts.open_ends", open);
    report.set("counts.components",
      connected_components(static_cast<Index>(welded.points.size()), flat).count);
    report.set("counts.merged_vertices", welded.merged_vertices);
    report.set(
      "counts.degenerate_segments", segments.rows() - static_cast<Index>(welded.segments.size()));
    report.set("counts.duplicate_segments", duplicates);
    if (welded.segments.empty())
    {
      status.warnings.push_back(segments.rows() == 0
          ? "the curve has no segments, so its winding number is 0 everywhere"
          : "all segments have length 0, so the winding number is 0 everywhere");
    }

    std::vector<Id> vertices;
    std::vector<Loop> loops;
    trace_loops(welded.segments, degrees, vertices, loops);
    impl.path.reserve(vertices.size());
    for (const Id v : vertices)
    {
      impl.path.push_back(welded.points[v]);
    }
    report.set("area", signed_area(impl.path, loops) / impl.frame.scale / impl.frame.scale);
    const ProgressRange range(context, 0.7, 1.0);
    // The boxes are enlarged by twice the tolerance, because their coordinates are rounded.
    done =
      TreeBuilder(context, impl.path, loops, 2.0 * impl.frame.tolerance, impl.nodes, impl.chords)
        .run();
  }
  if (!done)
  {
    this->impl_.reset(new Impl);
    this->impl_->status = Status::canceled();
  }
  return this->impl_->status;
}

const Status& CurveWindingNumber::status() const
{
  return this->impl_->status;
}

Index CurveWindingNumber::memory() const
{
  return static_cast<Index>(sizeof(Vec2) * this->impl_->path.size() +
    sizeof(Node) * this->impl_->nodes.size() + sizeof(Chord) * this->impl_->chords.size());
}

double CurveWindingNumber::Impl::at(const Vec2& query, bool& on_curve) const
{
  on_curve = false;
  if (!query.allFinite())
  {
    return std::numeric_limits<double>::quiet_NaN();
  }
  const Vec2 p = in_frame(this->frame, query);
  if (!(p.cwiseAbs().maxCoeff() < zero_distance))
  {
    return 0.0;
  }
  Index crossing_sum = 0;
  const auto count = static_cast<Id>(this->nodes.size());
  for (Id n = 0; n < count;)
  {
    const Node& node = this->nodes[n];
    if (p.x() < node.lower.x() || p.y() < node.lower.y() || p.y() > node.upper.y())
    {
      n = node.skip; // the ray misses the box
    }
    else if (p.x() > node.upper.x())
    {
      crossing_sum +=
        static_cast<int>(node.first_y >= p.y()) - static_cast<int>(node.last_y >= p.y());
      n = node.skip;
    }
    else
    {
      if (node.leaf)
      {
        const Id segment_end = node.ends_with_chord ? node.last - 1 : node.last;
        for (Id i = node.first; i < node.last; ++i)
        {
          const Vec2& a = this->path[i];
          const Vec2& b = this->path[i + 1];
          if (i < segment_end && touches(a, b, p, this->frame.tolerance))
          {
            on_curve = true;
            return this->evaluate_on_curve(p);
          }
          crossing_sum += crossing(a, b, p);
        }
      }
      ++n;
    }
  }
  double angles = 0.0;
  for (const Chord& chord : this->chords)
  {
    angles += signed_angle(chord.start, chord.end, p);
  }
  return static_cast<double>(crossing_sum) + angles / two_pi;
}

/// Return the sum of the angles of all segments that do not touch the point, in full turns.
double CurveWindingNumber::Impl::evaluate_on_curve(const Vec2& p) const
{
  const auto outside = [&](const Node& node)
  { return (p.array() < node.lower.array()).any() || (p.array() > node.upper.array()).any(); };
  double angles = 0.0;
  const auto count = static_cast<Id>(this->nodes.size());
  for (Id n = 0; n < count;)
  {
    const Node& node = this->nodes[n];
    if (outside(node))
    {
      if (node.first < node.last)
      {
        angles += signed_angle(this->path[node.first], this->path[node.last], p);
      }
      n = node.skip;
      continue;
    }
    if (node.leaf)
    {
      const Id segment_end = node.ends_with_chord ? node.last - 1 : node.last;
      for (Id i = node.first; i < segment_end; ++i)
      {
        if (!touches(this->path[i], this->path[i + 1], p, this->frame.tolerance))
        {
          angles += signed_angle(this->path[i], this->path[i + 1], p);
        }
      }
    }
    ++n;
  }
  // Remove the angles of the chords from the sum. If p is inside the box of a chord's leaf, the
  // code above has skipped the chord, so the sum does not contain it. Otherwise the sum contains
  // the angle of the whole leaf, or of a larger piece, including the chord.
  for (const Chord& chord : this->chords)
  {
    if (outside(this->nodes[chord.leaf]))
    {
      angles += signed_angle(chord.start, chord.end, p);
    }
  }
  return angles / two_pi;
}

/// Return the gradient of the winding number. Up to full turns, the angle from s to t seen from p
/// is arg(t - p) - arg(s - p). For a vertex v, let (X, Y) = v - p. Then d arg(v - p) = (X dY - Y
/// dX) / (X^2 + Y^2) and (dX, dY) = -dp, so the derivative of arg(v - p) along p is (Y, -X) / (X^2
/// + Y^2). Only open ends contribute, because the contributions of all other vertices cancel.
Vec2 CurveWindingNumber::Impl::gradient_at(const Vec2& query) const
{
  if (!query.allFinite())
  {
    return Vec2::Constant(std::numeric_limits<double>::quiet_NaN());
  }
  const Vec2 p = in_frame(this->frame, query);
  Vec2 sum = Vec2::Zero();
  if (!(p.cwiseAbs().maxCoeff() < zero_distance))
  {
    return sum;
  }
  const auto end_contribution = [&](const Vec2& end) -> Vec2
  {
    const Vec2 to_end = end - p;
    const double squared = to_end.squaredNorm();
    if (squared <= this->frame.tolerance * this->frame.tolerance)
    {
      return Vec2::Zero();
    }
    return Vec2(to_end.y(), -to_end.x()) / squared;
  };
  for (const Chord& chord : this->chords)
  {
    sum += end_contribution(chord.end) - end_contribution(chord.start);
  }
  return this->frame.scale / two_pi * sum;
}

double CurveWindingNumber::evaluate_at(const Vec2& point, bool* on_curve) const
{
  bool touches_segment = false;
  const double winding_number = this->impl_->at(point, touches_segment);
  if (on_curve)
  {
    *on_curve = touches_segment;
  }
  return winding_number;
}

namespace
{
double nanoseconds_per_point(std::size_t chords)
{
  return 200.0 + 25.0 * static_cast<double>(chords);
}
} // namespace

Status CurveWindingNumber::evaluate(
  ExecutionContext& context, PlanePointsView queries, double* out, unsigned char* on_curve) const
{
  const Impl& impl = *this->impl_;
  if (!impl.status.ok())
  {
    return impl.status;
  }
  return point_values(context, queries.rows(), nanoseconds_per_point(impl.chords.size()), out,
    on_curve,
    [&](Index begin, Index end, unsigned char* flags)
    {
      for (Index i = begin; i < end; ++i)
      {
        bool touches = false;
        out[i] = impl.at(queries.row(i), touches);
        flags[i - begin] = touches;
      }
    });
}

Status CurveWindingNumber::evaluate(
  ExecutionContext& context, PlanePointsView queries, Eigen::VectorXd& out) const
{
  out.resize(queries.rows());
  return this->evaluate(context, queries, out.data());
}

Status CurveWindingNumber::evaluate_gradient(
  ExecutionContext& context, PlanePointsView queries, double* out) const
{
  const Impl& impl = *this->impl_;
  if (!impl.status.ok())
  {
    return impl.status;
  }
  return point_gradients(context, queries.rows(), nanoseconds_per_point(impl.chords.size()),
    [&](Index i) { Eigen::Map<Vec2>(out + 2 * i) = impl.gradient_at(queries.row(i)); });
}

double curve_winding_number_direct(
  PlanePointsView points, SegmentsView segments, const Vec2& point, bool* on_curve)
{
  if (on_curve)
  {
    *on_curve = false;
  }
  if (!point.allFinite())
  {
    return std::numeric_limits<double>::quiet_NaN();
  }
  const ExactFrame frame = frame_of(points, segments);
  const Vec2 p = in_frame(frame, point);
  if (!(p.cwiseAbs().maxCoeff() < zero_distance))
  {
    return 0.0;
  }
  double angles = 0.0;
  for (Index e = 0; e < segments.rows(); ++e)
  {
    const Vec2 a = in_frame(frame, points.row(segments(e, 0)));
    const Vec2 b = in_frame(frame, points.row(segments(e, 1)));
    if (a == b)
    {
      continue;
    }
    if (!touches(a, b, p, frame.tolerance))
    {
      angles += signed_angle(a, b, p);
    }
    else if (on_curve)
    {
      *on_curve = true;
    }
  }
  return angles / two_pi;
}

} // namespace bindpose
