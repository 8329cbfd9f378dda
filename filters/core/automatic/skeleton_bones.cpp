// Simplification of a curve skeleton to bones (see skeleton_bones.h). The skeleton is a graph of
// points. Cutting, pruning and contracting keep each component connected, and after the cuts each
// component is a tree. Branches are recomputed after each operation, which is cheap: a skeleton has
// some thousand points and a few dozen branches.
#include "automatic/skeleton_bones.h"

#include "base/constants.h"
#include "base/number_text.h"
#include "handles/bone_projection.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>
#include <set>

namespace bindpose
{

namespace
{
/// A path from joint to joint, with all points between them.
struct Branch
{
  std::vector<Index> path;
  double length = 0.0;
};

class Graph
{
public:
  Graph(const CurveSkeleton& skeleton, const std::function<bool(const Vec3&)>& inside)
    : neighbors_(static_cast<std::size_t>(skeleton.points.rows())), alive_(neighbors_.size(), 1),
      is_root_(neighbors_.size(), 0), skeleton_(skeleton), inside_(inside)
  {
    for (Index v = 0; v < skeleton.points.rows(); ++v)
    {
      this->positions_.push_back(skeleton.points.row(v));
      this->radii_.push_back(skeleton.radii[v]);
    }
    for (Index s = 0; s < skeleton.segments.rows(); ++s)
    {
      this->neighbors_[skeleton.segments(s, 0)].insert(skeleton.segments(s, 1));
      this->neighbors_[skeleton.segments(s, 1)].insert(skeleton.segments(s, 0));
    }
  }

  Index size() const { return static_cast<Index>(this->neighbors_.size()); }
  bool is_inside(const Vec3& p) const { return !this->inside_ || this->inside_(p); }
  bool is_partly_outside(const Vec3& head, const Vec3& tail) const
  {
    constexpr int pieces = 16;
    for (int i = 1; i < pieces; ++i)
    {
      const double t = static_cast<double>(i) / pieces;
      if (!this->is_inside((1.0 - t) * head + t * tail))
      {
        return true;
      }
    }
    return false;
  }
  const Vec3& position(Index v) const { return this->positions_[v]; }
  double radius(Index v) const { return this->radii_[v]; }
  Index part(Index v) const { return this->skeleton_.part_of_point[v]; }
  const Vec3& centroid(Index part) const { return this->skeleton_.centroids[part]; }
  bool is_alive(Index v) const { return this->alive_[v] != 0; }
  bool is_root(Index v) const { return this->is_root_[v] != 0; }
  Index degree(Index v) const { return static_cast<Index>(this->neighbors_[v].size()); }
  bool is_joint(Index v) const
  {
    return this->is_alive(v) && (this->degree(v) != 2 || this->is_root(v));
  }

  /// Return the joint nearest to the centroid, or the nearest vertex if there is no joint.
  Index nearest_joint(Index part) const
  {
    Index best = -1;
    double minimum_distance = infinite;
    for (const bool joints_only : { true, false })
    {
      for (Index v = 0; v < this->size() && (joints_only || best < 0); ++v)
      {
        const double distance = (this->position(v) - this->centroid(part)).norm();
        if (this->part(v) == part && this->is_alive(v) && (!joints_only || this->is_joint(v)) &&
          distance < minimum_distance)
        {
          minimum_distance = distance;
          best = v;
        }
      }
      if (best >= 0)
      {
        break;
      }
    }
    return best;
  }

  /// If the component has cycles, choose a root and reduce the component to the tree of shortest
  /// paths from the root. A root is always a joint and never moves.
  /// @return the number of cycles.
  Index cut_cycles(Index part)
  {
    Index vertices = 0;
    Index ends = 0;
    for (Index v = 0; v < this->size(); ++v)
    {
      if (this->part(v) == part)
      {
        ++vertices;
        ends += this->degree(v);
      }
    }
    const Index cycles = ends / 2 - vertices + 1;
    if (cycles <= 0)
    {
      return 0;
    }
    const Index root = this->nearest_joint(part);
    this->is_root_[root] = 1;
    std::vector<double> distance(this->neighbors_.size(), infinite);
    std::vector<Index> from(this->neighbors_.size(), -1);
    std::set<std::pair<double, Index>> open{ { 0.0, root } };
    distance[root] = 0.0;
    while (!open.empty())
    {
      const Index v = open.begin()->second;
      open.erase(open.begin());
      for (const Index w : this->neighbors_[v])
      {
        const double path_length = distance[v] + (this->position(v) - this->position(w)).norm();
        if (path_length < distance[w])
        {
          open.erase({ distance[w], w });
          distance[w] = path_length;
          from[w] = v;
          open.insert({ path_length, w });
        }
      }
    }
    for (Index v = 0; v < this->size(); ++v)
    {
      if (this->part(v) != part)
      {
        continue;
      }
      const std::set<Index> old_neighbors = this->neighbors_[v];
      for (const Index w : old_neighbors)
      {
        if (from[w] != v && from[v] != w)
        {
          this->disconnect(v, w);
        }
      }
    }
    return cycles;
  }

  std::vector<Branch> branches() const
  {
    std::vector<Branch> all;
    for (Index v = 0; v < this->size(); ++v)
    {
      if (!this->is_joint(v))
      {
        continue;
      }
      for (const Index first : this->neighbors_[v])
      {
        Branch branch;
        branch.path = { v };
        Index before = v;
        Index at = first;
        for (;;)
        {
          branch.path.push_back(at);
          branch.length += (this->position(at) - this->position(before)).norm();
          if (this->is_joint(at))
          {
            break;
          }
          const std::set<Index>& adjacent = this->neighbors_[at];
          const Index on = *adjacent.begin() == before ? *adjacent.rbegin() : *adjacent.begin();
          before = at;
          at = on;
        }
        // Each branch is found from both of its ends; keep it once.
        if (branch.path.front() < branch.path.back())
        {
          all.push_back(std::move(branch));
        }
      }
    }
    return all;
  }

  /// Remove a branch with a free end. The junction at the other end is kept; it is path.front() if
  /// path.back() is the free end, otherwise path.back().
  void prune(const Branch& branch)
  {
    const bool keep_front = this->degree(branch.path.front()) > 1;
    const std::size_t kept = keep_front ? 0 : branch.path.size() - 1;
    for (std::size_t i = 0; i < branch.path.size(); ++i)
    {
      if (i != kept)
      {
        this->remove(branch.path[i]);
      }
    }
  }

  /// Remove the points outside the shape at a branch's free ends, but keep at least one segment.
  void trim(const Branch& branch)
  {
    std::vector<Index> path = branch.path;
    constexpr std::size_t minimum_points = 2;
    for (int end = 0; end < 2; ++end)
    {
      std::reverse(path.begin(), path.end());
      while (path.size() > minimum_points && this->degree(path.back()) == 1 &&
        !this->is_root(path.back()) && !this->is_inside(this->position(path.back())))
      {
        this->remove(path.back());
        path.pop_back();
      }
    }
  }

  /// Contract a branch between two junctions to one point. If one of the junctions is a root, the
  /// point is the root. Otherwise the point is the first of the following positions that is inside
  /// the shape: the middle of the straight line between the junctions, the middle of the path,
  /// path.front(). If none is inside, the point is path.front().
  void contract(const Branch& branch)
  {
    // A root does not move.
    const Index a = this->is_root(branch.path.back()) ? branch.path.back() : branch.path.front();
    const Index b = a == branch.path.front() ? branch.path.back() : branch.path.front();
    const std::set<Index> other_neighbors = this->neighbors_[b];
    Vec3 position = 0.5 * (this->position(a) + this->position(b));
    if (!this->is_inside(position))
    {
      position = this->position(branch.path[branch.path.size() / 2]);
    }
    if (this->is_root(a) || !this->is_inside(position))
    {
      position = this->position(a);
    }
    for (const Index v : branch.path)
    {
      if (v != a)
      {
        this->remove(v);
      }
    }
    for (const Index w : other_neighbors)
    {
      if (this->is_alive(w) && w != a)
      {
        this->neighbors_[a].insert(w);
        this->neighbors_[w].insert(a);
      }
    }
    this->positions_[a] = position;
    this->radii_[a] = std::max(this->radii_[a], this->radii_[b]);
  }

  /// Remove all vertices of a component except the one with the largest radius.
  void collapse(Index part)
  {
    Index widest = -1;
    for (Index v = 0; v < this->size(); ++v)
    {
      if (this->is_alive(v) && this->part(v) == part &&
        (widest < 0 || this->radius(v) > this->radius(widest)))
      {
        widest = v;
      }
    }
    for (Index v = 0; v < this->size(); ++v)
    {
      if (this->is_alive(v) && this->part(v) == part && v != widest)
      {
        this->remove(v);
      }
    }
  }

private:
  void disconnect(Index v, Index w)
  {
    this->neighbors_[v].erase(w);
    this->neighbors_[w].erase(v);
  }
  void remove(Index v)
  {
    const std::set<Index> old_neighbors = this->neighbors_[v];
    for (const Index w : old_neighbors)
    {
      this->disconnect(v, w);
    }
    this->alive_[v] = 0;
  }

  std::vector<std::set<Index>> neighbors_;
  std::vector<char> alive_;
  std::vector<char> is_root_; ///< 1 for roots, which are joints even if they have two neighbors
  std::vector<Vec3> positions_;
  std::vector<double> radii_;
  const CurveSkeleton& skeleton_;
  const std::function<bool(const Vec3&)>& inside_;
};

/// Return the length of a branch divided by the radius at its junction. For a branch between two
/// junctions, the larger of their radii is used. If the result is below 1, the branch is inside the
/// ball with this radius around the junction. Return infinity for a branch that must be kept: a
/// branch without a junction, or a branch that ends at a root that joins only two branches.
/// @param is_inner set to true if the branch is between two junctions.
double relative_length(const Graph& graph, const Branch& branch, bool& is_inner)
{
  const Index a = branch.path.front();
  const Index b = branch.path.back();
  is_inner = graph.degree(a) > 1 && graph.degree(b) > 1;
  const Index junction = graph.degree(a) > 1 ? a : b;
  constexpr Index junction_degree = 3;
  double thickness = graph.radius(junction);
  if (is_inner)
  {
    if (graph.degree(a) < junction_degree || graph.degree(b) < junction_degree)
    {
      return infinite; // one end is a root with only two neighbors
    }
    thickness = std::max(graph.radius(a), graph.radius(b));
  }
  else if (graph.degree(junction) < junction_degree)
  {
    return infinite;
  }
  return thickness > 0.0 ? branch.length / thickness : infinite;
}

/// Collapse components that are balls to one point. A component is a ball if the total length of
/// its curve is at most `prune` times its largest radius.
void collapse_balls(Graph& graph, Index parts, double prune)
{
  std::vector<double> length(static_cast<std::size_t>(parts), 0.0);
  std::vector<double> radius(length.size(), 0.0);
  for (const Branch& branch : graph.branches())
  {
    const Index part = graph.part(branch.path.front());
    length[part] += branch.length;
    for (const Index v : branch.path)
    {
      radius[part] = std::max(radius[part], graph.radius(v));
    }
  }
  for (Index part = 0; part < parts; ++part)
  {
    if (length[part] <= prune * radius[part])
    {
      graph.collapse(part);
    }
  }
}

/// Prune and contract short branches. Then prune branches until their number is at most
/// maximum_bones.
void simplify(Graph& graph, const SkeletonBonesOptions& options, SkeletonBones& result)
{
  for (;;)
  {
    const std::vector<Branch> branches = graph.branches();
    const Branch* shortest_branch = nullptr;
    const Branch* shortest_limb = nullptr;
    double score = infinite;
    double limb_score = infinite;
    bool shortest_is_inner = false;
    for (const Branch& branch : branches)
    {
      bool is_inner = false;
      const double r = relative_length(graph, branch, is_inner);
      if (r < score)
      {
        score = r;
        shortest_branch = &branch;
        shortest_is_inner = is_inner;
      }
      if (!is_inner && r < limb_score)
      {
        limb_score = r;
        shortest_limb = &branch;
      }
    }
    if (shortest_branch && score < options.prune)
    {
      if (shortest_is_inner)
      {
        graph.contract(*shortest_branch);
        ++result.merged_branches;
      }
      else
      {
        graph.prune(*shortest_branch);
        ++result.pruned_branches;
      }
    }
    else if (options.maximum_bones > 0 && shortest_limb &&
      static_cast<Index>(branches.size()) > options.maximum_bones)
    {
      graph.prune(*shortest_limb);
      ++result.pruned_branches;
    }
    else
    {
      return;
    }
  }
}

/// A piece of a branch that is represented by one bone.
struct Piece
{
  std::vector<Index> path;
  /// The larger of two values: the distance of the piece from its bone divided by the tolerance,
  /// and the length of the piece divided by the maximum length. The piece must be split if this is
  /// above 1. If the distance is within the tolerance but the bone leaves the shape, 1 is added.
  double split_priority = 0.0;
  std::size_t at = 0; ///< index in the path at which the piece would be split
};

Piece make_piece(const Graph& graph, std::vector<Index> path, double tolerance, double longest)
{
  Piece piece;
  piece.path = std::move(path);
  const Vec3& head = graph.position(piece.path.front());
  const Vec3 chord = graph.position(piece.path.back()) - head;
  const double squared = chord.squaredNorm();
  double length = 0.0;
  std::vector<double> lengths_along{ 0.0 };
  // Minimum deviation at which a piece may be split, as a fraction of the tolerance.
  constexpr double minimum_deviation = 0.25;
  double farthest = minimum_deviation * tolerance;
  for (std::size_t i = 1; i < piece.path.size(); ++i)
  {
    const Vec3& p = graph.position(piece.path[i]);
    length += (p - graph.position(piece.path[i - 1])).norm();
    lengths_along.push_back(length);
    const double t =
      squared > 0.0 ? std::min(std::max((p - head).dot(chord) / squared, 0.0), 1.0) : 0.0;
    const double distance = (p - head - t * chord).norm();
    // The piece may only be split at a point inside the shape, because this point becomes a joint.
    if (distance > farthest && graph.is_inside(p))
    {
      farthest = distance;
      piece.at = i;
    }
  }
  if (piece.path.size() < 3)
  {
    return piece; // there is no point at which to split
  }
  if (piece.at > 0)
  {
    piece.split_priority = farthest / tolerance;
    if (piece.split_priority <= 1.0 && graph.is_partly_outside(head, head + chord))
    {
      piece.split_priority += 1.0;
    }
  }
  if (longest > 0.0 && length / longest > std::max(piece.split_priority, 1.0))
  {
    double middle_distance = infinite;
    for (std::size_t i = 1; i + 1 < lengths_along.size(); ++i)
    {
      const double distance = std::abs(lengths_along[i] - 0.5 * length);
      if (distance < middle_distance && graph.is_inside(graph.position(piece.path[i])))
      {
        middle_distance = distance;
        piece.split_priority = length / longest;
        piece.at = i;
      }
    }
  }
  return piece;
}

/// Return the path without the points within the radius of the junctions at its ends. Near a
/// junction the curve turns from one limb to another, and this turn must not count as a bend.
std::vector<Index> outside_of_junctions(const Graph& graph, const std::vector<Index>& path)
{
  std::vector<Index> kept{ path.front() };
  const auto is_near_junction = [&](Index v, Index end)
  {
    constexpr Index junction_degree = 3;
    return graph.degree(end) >= junction_degree &&
      (graph.position(v) - graph.position(end)).norm() <= graph.radius(end);
  };
  for (std::size_t i = 1; i + 1 < path.size(); ++i)
  {
    if (!is_near_junction(path[i], path.front()) && !is_near_junction(path[i], path.back()))
    {
      kept.push_back(path[i]);
    }
  }
  kept.push_back(path.back());
  return kept;
}

std::vector<Piece> split(const Graph& graph, double tolerance, double longest, Index maximum_pieces)
{
  std::vector<Piece> pieces;
  for (const Branch& branch : graph.branches())
  {
    pieces.push_back(
      make_piece(graph, outside_of_junctions(graph, branch.path), tolerance, longest));
  }
  while (maximum_pieces == 0 || static_cast<Index>(pieces.size()) < maximum_pieces)
  {
    const auto next_piece = std::max_element(pieces.begin(), pieces.end(),
      [](const Piece& a, const Piece& b) { return a.split_priority < b.split_priority; });
    if (next_piece == pieces.end() || next_piece->split_priority <= 1.0)
    {
      break;
    }
    const std::vector<Index> path = next_piece->path;
    const auto at = path.begin() + static_cast<std::ptrdiff_t>(next_piece->at);
    *next_piece = make_piece(graph, { path.begin(), at + 1 }, tolerance, longest);
    pieces.push_back(make_piece(graph, { at, path.end() }, tolerance, longest));
  }
  return pieces;
}

/// Return length times squared radius, an estimate of the volume around a piece.
double volume_of(const Graph& graph, const Piece& piece)
{
  double sum = 0.0;
  for (std::size_t i = 1; i < piece.path.size(); ++i)
  {
    const Index a = piece.path[i - 1];
    const Index b = piece.path[i];
    const double radius = 0.5 * (graph.radius(a) + graph.radius(b));
    sum += radius * radius * (graph.position(a) - graph.position(b)).norm();
  }
  return sum;
}

/// Converts pieces to bones with heads, tails and parents.
class Orientation
{
public:
  Orientation(const Graph& graph, const std::vector<Piece>& pieces, SkeletonBones& result)
    : graph_(graph), pieces_(pieces), result_(result),
      pieces_at_joint_(static_cast<std::size_t>(graph.size())), done_(pieces.size(), 0)
  {
    for (std::size_t i = 0; i < pieces.size(); ++i)
    {
      this->pieces_at_joint_[pieces[i].path.front()].push_back(static_cast<Index>(i));
      this->pieces_at_joint_[pieces[i].path.back()].push_back(static_cast<Index>(i));
    }
  }

  /// Create bones that are directed away from the roots, parents before children. The component
  /// with the largest volume comes first, because the first bones of the other components get their
  /// parents from it.
  void run(Index parts)
  {
    std::vector<double> volumes(static_cast<std::size_t>(parts), 0.0);
    for (const Piece& piece : this->pieces_)
    {
      volumes[this->graph_.part(piece.path.front())] += volume_of(this->graph_, piece);
    }
    std::vector<Index> order(volumes.size());
    std::iota(order.begin(), order.end(), Index(0));
    std::stable_sort(
      order.begin(), order.end(), [&](Index a, Index b) { return volumes[a] > volumes[b]; });
    const auto first_bone = static_cast<Index>(this->result_.handles.size());
    Index last_bone = first_bone; // end of the range of bones of the first component
    for (const Index part : order)
    {
      const Index root = this->root_of(part);
      if (root >= 0)
      {
        this->add_bones_from(
          root, this->nearest(this->graph_.position(root), first_bone, last_bone));
        last_bone =
          last_bone > first_bone ? last_bone : static_cast<Index>(this->result_.handles.size());
      }
    }
    for (Index h = 0; h < first_bone; ++h) // all point handles come before the first bone
    {
      this->result_.handles[h].parent =
        this->nearest(this->result_.handles[h].head, first_bone, last_bone);
    }
    this->result_.joints.resize(static_cast<Index>(this->joints_.size()), 3);
    for (std::size_t j = 0; j < this->joints_.size(); ++j)
    {
      this->result_.joints.row(static_cast<Index>(j)) = this->joints_[j].transpose();
    }
  }

private:
  /// Return the root of a component: if the component had cycles, the root that cut_cycles() chose,
  /// otherwise the joint nearest to the centroid. Return -1 if the component has no bones.
  Index root_of(Index part) const
  {
    const auto distance = [&](Index v)
    {
      return this->graph_.is_root(v)
        ? -1.0
        : (this->graph_.position(v) - this->graph_.centroid(part)).norm();
    };
    Index root = -1;
    for (Index v = 0; v < this->graph_.size(); ++v)
    {
      if (this->graph_.part(v) == part && !this->pieces_at_joint_[v].empty() &&
        (root < 0 || distance(v) < distance(root)))
      {
        root = v;
      }
    }
    return root;
  }

  /// Return the bone in [begin, end) nearest to a point, or -1 if the range is empty.
  Index nearest(const Vec3& position, Index begin, Index end) const
  {
    Index best = -1;
    double minimum_distance = infinite;
    for (Index h = begin; h < end; ++h)
    {
      const Handle& bone = this->result_.handles[h];
      const Vec3 vector = bone.tail - bone.head;
      const double fraction = fraction_along_bone(position, bone.head, vector);
      const double distance = (bone.head + fraction * vector - position).norm();
      if (distance < minimum_distance)
      {
        minimum_distance = distance;
        best = h;
      }
    }
    return best;
  }

  void add_joint(Index v)
  {
    this->joints_.push_back(this->graph_.position(v));
    this->result_.junctions += this->pieces_at_joint_[v].size() >= 3 ? 1 : 0;
  }

  /// Create the bones of one component. Of the bones that begin at the root, the bone with the
  /// largest volume is the parent of the others.
  /// @param trunk_parent parent of the first bone, or -1.
  void add_bones_from(Index root, Index trunk_parent)
  {
    std::vector<Index>& first = this->pieces_at_joint_[root];
    std::iter_swap(first.begin(),
      std::max_element(first.begin(), first.end(),
        [&](Index a, Index b) {
          return volume_of(this->graph_, this->pieces_[a]) <
            volume_of(this->graph_, this->pieces_[b]);
        }));
    const auto trunk = static_cast<Index>(this->result_.handles.size());
    this->result_.roots.push_back(static_cast<Index>(this->joints_.size()));
    this->add_joint(root);
    std::queue<std::pair<Index, Index>> open; // a joint, and the bone that ends at this joint
    open.push({ root, trunk });
    while (!open.empty())
    {
      const auto [head, parent] = open.front();
      open.pop();
      for (const Index i : this->pieces_at_joint_[head])
      {
        if (this->done_[i])
        {
          continue;
        }
        this->done_[i] = 1;
        const Piece& piece = this->pieces_[i];
        const Index tail = piece.path.front() == head ? piece.path.back() : piece.path.front();
        this->add_joint(tail);
        const auto number = static_cast<Index>(this->result_.handles.size());
        Handle bone;
        bone.kind = HandleKind::bone;
        bone.name = "b" + std::to_string(++this->bones_);
        bone.head = this->graph_.position(head);
        bone.tail = this->graph_.position(tail);
        bone.parent = number == trunk ? trunk_parent : parent;
        open.push({ tail, number });
        this->result_.handles.push_back(std::move(bone));
      }
    }
  }

  const Graph& graph_;
  const std::vector<Piece>& pieces_;
  SkeletonBones& result_;
  std::vector<std::vector<Index>> pieces_at_joint_; ///< pieces at each joint
  std::vector<char> done_; ///< 1 for each piece that has become a bone
  std::vector<Vec3> joints_;
  Index bones_ = 0;
};

Status check_options(const SkeletonBonesOptions& options)
{
  const auto out_of_range = [](const char* name, const char* range, double value)
  {
    return Status::invalid_input(
      std::string(name) + " must be " + range + ", not " + short_number(value));
  };
  constexpr double least_tolerance = 1e-3;
  constexpr double minimum_bone_length = 0.01;
  constexpr double maximum_prune = 10.0;
  if (!(options.tolerance >= least_tolerance && options.tolerance <= 1.0))
  {
    return out_of_range("bone_tolerance", "from 0.001 to 1", options.tolerance);
  }
  if (!(options.longest_bone == 0.0 || options.longest_bone >= minimum_bone_length) ||
    !std::isfinite(options.longest_bone))
  {
    return out_of_range("longest_bone", "0 (no limit) or at least 0.01", options.longest_bone);
  }
  if (options.maximum_bones < 0)
  {
    return out_of_range("maximum_bones", "at least 0", static_cast<double>(options.maximum_bones));
  }
  if (!(options.prune >= 0.0 && options.prune <= maximum_prune))
  {
    return out_of_range("prune", "from 0 to 10", options.prune);
  }
  return {};
}
} // namespace

Status skeleton_bones(const CurveSkeleton& skeleton, double diagonal,
  const SkeletonBonesOptions& options, SkeletonBones& bones)
{
  bones = SkeletonBones();
  Status status = check_options(options);
  if (!status.ok())
  {
    return status;
  }
  Graph graph(skeleton, options.inside);
  const auto parts = static_cast<Index>(skeleton.centroids.size());
  for (Index part = 0; part < parts; ++part)
  {
    bones.cut_cycles += graph.cut_cycles(part);
  }
  simplify(graph, options, bones);
  collapse_balls(graph, parts, options.prune);
  for (Index v = 0; v < graph.size(); ++v)
  {
    if (graph.is_alive(v) && graph.degree(v) == 0)
    {
      Handle point;
      point.head = point.tail = graph.position(v);
      point.name = "p" + std::to_string(bones.handles.size() + 1);
      bones.handles.push_back(std::move(point));
    }
  }
  for (const Branch& branch : graph.branches())
  {
    graph.trim(branch);
  }
  const std::vector<Piece> pieces = split(
    graph, options.tolerance * diagonal, options.longest_bone * diagonal, options.maximum_bones);
  Orientation(graph, pieces, bones).run(parts);
  if (bones.cut_cycles > 0)
  {
    status.warnings.push_back("the skeleton has " + std::to_string(bones.cut_cycles) +
      (bones.cut_cycles == 1 ? " loop, which was" : " loops, which were") +
      " opened at the point farthest from the root, because a bone has only one parent");
  }
  if (options.maximum_bones > 0 && static_cast<Index>(pieces.size()) > options.maximum_bones)
  {
    status.warnings.push_back("the skeleton has " + std::to_string(pieces.size()) +
      " bones, more than maximum_bones (" + std::to_string(options.maximum_bones) +
      "), because each component needs at least one");
  }
  return status;
}

} // namespace bindpose
