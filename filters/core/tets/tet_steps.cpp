// Search for local modifications that improve a tet. A tet is improved by the first of these steps
// that lowers the cost:
// 1. Remove one of its edges. The other vertices of the tets around the edge form a ring, which is
//    triangulated. New tets connect the triangles of the ring with the two ends of the edge. The
//    best triangulation is found by dynamic programming. A boundary edge that is nearly flat can
//    also be removed; if it has a single tet, that tet is removed.
// 2. Remove one of its facets: two tets are replaced by three tets around a new edge.
// 3. Move one of its vertices: the new position is searched in a few directions with decreasing
//    step length. Before this step, an edge that is shorter than 1 % of the tet's longest edge is
//    contracted, because moving a vertex cannot improve such a tet.
// 4. Contract one of its edges into one of its ends, if no vertex could be moved.
// 5. Insert a vertex in the middle of the tet or of one of its edges, if insertion is allowed and
//    at most two searches for such a vertex have failed.
#include "tets/tet_steps.h"

#include "base/sort_unique.h"
#include "geometry/tet_facets.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bindpose
{

namespace
{
// Minimum decrease of the cost. It corresponds to an increase of one tet's smallest angle by 2 %.
constexpr double minimum_gain = 0.02;
constexpr double infinite_cost = std::numeric_limits<double>::infinity();
// Cosines of limits for the angle between the normals of boundary triangles.
constexpr double flat_cosine = 0.966; // 15 degrees: below this angle an edge may be swapped
// 40 degrees. An edge is a crease if the normals of its two triangles form a larger angle. A
// boundary vertex does not move if the mean normal of the triangles at the vertex forms a larger
// angle with one of their normals.
constexpr double crease_cosine = 0.766;

bool is_angle_below(const Vec3& one, const Vec3& other, double cosine)
{
  return one.dot(other) > cosine * one.norm() * other.norm();
}

constexpr int directions_count = 14;
/// Return direction k: first the axes, then the diagonals of a cube.
Vec3 direction(int k)
{
  if (k < 6)
  {
    return (k % 2 ? -1.0 : 1.0) * Vec3::Unit(k / 2);
  }
  const int bits = k - 6;
  return Vec3(bits & 1 ? -1.0 : 1.0, bits & 2 ? -1.0 : 1.0, bits & 4 ? -1.0 : 1.0) / std::sqrt(3.0);
}

template <typename T>
std::ptrdiff_t count_shared(const std::vector<T>& one, const std::vector<T>& other)
{
  return std::count_if(one.begin(), one.end(),
    [&](const T& x) { return std::binary_search(other.begin(), other.end(), x); });
}
} // namespace

void TetStep::clear()
{
  this->kind = Kind::none;
  this->removed.clear();
  this->added.clear();
  this->vertex = -1;
  this->immovable.clear();
  this->insertion_failed = false;
}

bool may_move(const TetComplex& tets, const TetStepRules& rules, Index v)
{
  return (!rules.constrained[v] || rules.may_move_constrained) &&
    (!tets.on_boundary(v) || rules.surface) && rules.immovable_since[v] != tets.stamp(v);
}

bool may_insert(const TetStepRules& rules, Index t)
{
  constexpr std::uint8_t maximum_failures = 3;
  return rules.insert && rules.failed_insertions[t] < maximum_failures;
}

TetStepSearch::TetStepSearch(const TetComplex& tets, const TetStepRules& rules)
  : tets_(tets), rules_(rules), good_quality_(TetComplex::quality_of_angle(rules.options.angle)),
    insertion_quality_(TetComplex::quality_of_angle(rules.options.insert_angle)), cavities_(tets)
{
}

void TetStepSearch::find(Index t, TetStep& step)
{
  step.clear();
  const Tet tet = this->tets_.tet(t);
  for (int i = 0; i < 4; ++i)
  {
    for (int j = i + 1; j < 4; ++j)
    {
      if (this->remove_edge(tet[i], tet[j], step))
      {
        return;
      }
    }
  }
  for (int k = 0; k < 4; ++k)
  {
    if (this->remove_facet(t, k, step))
    {
      return;
    }
  }
  // Fraction of the longest edge. If an edge is shorter than this, moving its vertices cannot
  // improve the tet.
  constexpr double short_edge_ratio = 0.01;
  if (this->contract_short_edge(tet, short_edge_ratio, step))
  {
    return;
  }
  for (const Index v : tet)
  {
    if (this->move(v, step))
    {
      return;
    }
  }
  if (!this->contract_short_edge(tet, 1.0, step) && may_insert(this->rules_, t) &&
    this->tets_.quality(t) < this->insertion_quality_)
  {
    step.insertion_failed = !this->insert_near(t, step);
  }
}

double TetStepSearch::quality(const Tet& tet)
{
  ++this->evaluations_;
  return this->tets_.quality(tet);
}

/// Return the quality of the tet that connects facet f to p.
double TetStepSearch::quality(const Facet& f, const Vec3& p)
{
  ++this->evaluations_;
  return TetComplex::quality(this->point(f[0]), this->point(f[1]), this->point(f[2]), p);
}

double TetStepSearch::penalty(double quality) const
{
  if (quality >= this->good_quality_)
  {
    return 0.0;
  }
  // The logarithm is halved, because the quality is the square of the sine.
  constexpr double half = 0.5;
  return half * std::log(this->good_quality_ / std::max(quality, TetComplex::least_quality));
}

TetStepSearch::Cost TetStepSearch::cost(const std::vector<Index>& tets) const
{
  Cost cost;
  for (const Index t : tets)
  {
    cost.sum += this->penalty(this->tets_.quality(t));
    cost.worst = std::min(cost.worst, this->tets_.quality(t));
  }
  return cost;
}

/// Return the minimum quality that new tets must have. `cost` is the cost of the tets that they
/// replace.
double TetStepSearch::minimum_quality_after(const Cost& cost) const
{
  return std::min(
    this->rules_.options.slack * this->rules_.options.slack * cost.worst, this->good_quality_);
}

// ---- Edges and facets ------------------------------------------------------------------------

bool TetStepSearch::remove_edge(Index a, Index b, TetStep& step)
{
  Ring& ring = this->ring_;
  if (!this->tets_.find_ring(a, b, ring) || (ring.closed && ring.tets.size() < 3))
  {
    return false;
  }
  if (!ring.closed && !this->may_swap_boundary(a, b, ring))
  {
    return false;
  }
  const Cost old_cost = this->cost(ring.tets);
  const double minimum_quality = this->minimum_quality_after(old_cost);
  const std::vector<Index>& r = ring.vertices;
  const std::size_t n = r.size();
  constexpr std::size_t upper_limit = TetComplex::maximum_ring_size + 1;
  // best[i][j]: the cost of the best triangulation of the polygon r[i] … r[j].
  std::array<std::array<double, upper_limit>, upper_limit> best;
  std::array<std::array<std::size_t, upper_limit>, upper_limit> apex{};
  for (std::size_t i = 0; i + 1 < n; ++i)
  {
    best[i][i + 1] = 0.0;
  }
  const double maximum_cost = old_cost.sum - minimum_gain;
  for (std::size_t span = 2; span < n; ++span)
  {
    for (std::size_t i = 0; i + span < n; ++i)
    {
      const std::size_t j = i + span;
      best[i][j] = infinite_cost;
      for (std::size_t k = i + 1; k < j; ++k)
      {
        const double rest = best[i][k] + best[k][j];
        if (!(rest < best[i][j]) || !(rest < maximum_cost))
        {
          continue;
        }
        const double one = this->quality({ r[i], r[k], r[j], b });
        if (!(one > 0.0) || one < minimum_quality)
        {
          continue;
        }
        const double other = this->quality({ r[k], r[i], r[j], a });
        if (!(other > 0.0) || other < minimum_quality)
        {
          continue;
        }
        const double value = rest + this->penalty(one) + this->penalty(other);
        if (value < best[i][j])
        {
          best[i][j] = value;
          apex[i][j] = k;
        }
      }
    }
  }
  if (!(best[0][n - 1] < maximum_cost))
  {
    return false;
  }
  step.kind = TetStep::Kind::swap;
  step.removed = ring.tets;
  std::vector<std::pair<std::size_t, std::size_t>> open{ { 0, n - 1 } };
  while (!open.empty())
  {
    const auto [i, j] = open.back();
    open.pop_back();
    if (j - i < 2)
    {
      continue;
    }
    const std::size_t k = apex[i][j];
    step.added.push_back({ r[i], r[k], r[j], b });
    step.added.push_back({ r[k], r[i], r[j], a });
    open.emplace_back(i, k);
    open.emplace_back(k, j);
  }
  return true;
}

/// Report whether the boundary edge a-b may be swapped: the boundary must be flat enough at the
/// edge, and the new edge must not make the boundary touch itself.
bool TetStepSearch::may_swap_boundary(Index a, Index b, const Ring& ring) const
{
  if (this->rules_.options.keep_boundary && !(this->rules_.options.coplanar > 0.0))
  {
    return false;
  }
  const Index first = ring.vertices.front();
  const Index last = ring.vertices.back();
  const Vec3 p = this->point(a), q = this->point(b);
  const Vec3 one = (q - p).cross(this->point(first) - p);
  const Vec3 other = (this->point(last) - p).cross(q - p);
  const Vec3 new_normal = (p - this->point(first)).cross(this->point(last) - this->point(first));
  const Vec3 other_new_normal =
    (this->point(last) - this->point(first)).cross(q - this->point(first));
  const auto is_flat = [](const Vec3& x, const Vec3& y)
  { return is_angle_below(x, y, flat_cosine); };
  if (!is_flat(one, other) || !is_flat(new_normal, other_new_normal) || !is_flat(one, new_normal))
  {
    return false;
  }
  if (this->rules_.options.keep_boundary)
  {
    const double largest =
      std::max({ one.norm(), other.norm(), new_normal.norm(), other_new_normal.norm() });
    const double volume = std::abs(one.dot(this->point(last) - p)); // six times the volume
    if (volume > this->rules_.options.coplanar * largest)
    {
      return false;
    }
  }
  if (ring.tets.size() == 1)
  {
    Ring opposite;
    return this->tets_.find_ring(first, last, opposite) && opposite.closed;
  }
  return !this->tets_.has_edge(first, last);
}

bool TetStepSearch::remove_facet(Index t, int k, TetStep& step)
{
  const Index other = this->tets_.neighbor_tet(t, k);
  if (other < 0)
  {
    return false;
  }
  const Tet& tet = this->tets_.tet(t);
  const Tet& other_tet = this->tets_.tet(other);
  const auto& f = facet_corners[k];
  const Index a = tet[f[0]], b = tet[f[1]], c = tet[f[2]], d = tet[k];
  const Index e = other_tet[TetComplex::opposite_corner(other_tet, a, b, c)];
  const std::array<Tet, 3> added{ { { b, a, e, d }, { c, b, e, d }, { a, c, e, d } } };
  const Cost old_cost = this->cost({ t, other });
  const double minimum_quality = this->minimum_quality_after(old_cost);
  double sum = 0.0;
  for (const Tet& one : added)
  {
    const double value = this->quality(one);
    if (!(value > 0.0) || value < minimum_quality)
    {
      return false;
    }
    sum += this->penalty(value);
  }
  if (!(sum < old_cost.sum - minimum_gain) || this->tets_.has_edge(d, e))
  {
    return false;
  }
  step.kind = TetStep::Kind::swap;
  step.removed = { t, other };
  step.added.assign(added.begin(), added.end());
  return true;
}

// ---- Vertices --------------------------------------------------------------------------------

/// Return the patch that the triangles `boundary_facets` would form if vertex `moved` were at p.
TetStepSearch::Patch TetStepSearch::patch_of(
  const std::vector<Facet>& boundary_facets, Index moved, const Vec3& p) const
{
  const auto at = [&](Index v) -> const Vec3& { return v == moved ? p : this->point(v); };
  std::vector<Vec3> normals;
  Patch patch;
  for (const auto& f : boundary_facets)
  {
    normals.push_back((at(f[1]) - at(f[0])).cross(at(f[2]) - at(f[0])));
    patch.normal += normals.back();
  }
  patch.normal.normalize();
  patch.smooth = std::all_of(normals.begin(), normals.end(),
    [&](const Vec3& n) { return is_angle_below(n, patch.normal, crease_cosine); });
  return patch;
}

bool TetStepSearch::move(Index v, TetStep& step)
{
  if (!may_move(this->tets_, this->rules_, v))
  {
    return false;
  }
  const bool on_boundary = this->tets_.on_boundary(v);
  const Vec3 start = this->point(v);
  std::vector<Facet> boundary_facets;
  Patch patch;
  if (on_boundary)
  {
    boundary_facets = this->tets_.boundary_facets_at(v);
    patch = this->patch_of(boundary_facets, v, start);
    if (!patch.smooth)
    {
      step.immovable.push_back(v);
      return false;
    }
  }
  this->star_ = this->tets_.tets_of_vertex(v);
  double shortest = infinite_cost;
  for (const Index t : this->star_)
  {
    for (const Index w : this->tets_.tet(t))
    {
      if (w != v)
      {
        shortest = std::min(shortest, (this->point(w) - start).norm());
      }
    }
  }
  const Cost old_cost = this->cost(this->star_);
  const double minimum_quality = this->minimum_quality_after(old_cost);
  double value = old_cost.sum;
  Vec3 at = start;
  // Test the worst tets first. Most of the rejected positions fail at these tets, so the test of a
  // position ends early.
  std::stable_sort(this->star_.begin(), this->star_.end(),
    [&](Index s, Index t) { return this->tets_.quality(s) < this->tets_.quality(t); });
  constexpr double first_step = 0.3;
  constexpr double last_step = 0.08;
  for (double length = first_step * shortest; length > last_step * shortest && value > 0.0;)
  {
    bool found = false;
    for (int k = 0; k < directions_count && !found; ++k)
    {
      Vec3 d = direction(k);
      if (on_boundary)
      {
        d -= d.dot(patch.normal) * patch.normal;
      }
      Vec3 p = at + length * d;
      if (on_boundary && !this->rules_.surface(p, patch.normal, length))
      {
        continue;
      }
      const double moved_cost = this->star_cost(v, p, minimum_quality, value - minimum_gain);
      if (moved_cost < value - minimum_gain &&
        (boundary_facets.empty() || this->patch_of(boundary_facets, v, p).smooth))
      {
        value = moved_cost;
        at = p;
        found = true;
      }
    }
    length *= found ? 1.0 : 0.5;
  }
  if (!(value < old_cost.sum - minimum_gain))
  {
    step.immovable.push_back(v);
    return false;
  }
  step.kind = TetStep::Kind::move;
  step.vertex = v;
  step.position = at;
  return true;
}

/// Return the sum of the costs of new tets. Each item represents one new tet, whose quality is
/// quality_of(item). The result is infinity if the sum exceeds `upper_limit` or if the quality of a
/// tet is less than `minimum_quality`.
template <typename Items, typename QualityOf>
double TetStepSearch::total_cost(
  const Items& items, const QualityOf& quality_of, double minimum_quality, double upper_limit)
{
  double sum = 0.0;
  for (const auto& item : items)
  {
    const double value = quality_of(item);
    if (!(value > 0.0) || value < minimum_quality)
    {
      return infinite_cost;
    }
    sum += this->penalty(value);
    if (sum > upper_limit)
    {
      return infinite_cost;
    }
  }
  return sum;
}

/// Return the cost that the tets in star_ would have if vertex v were at p.
double TetStepSearch::star_cost(Index v, const Vec3& p, double minimum_quality, double upper_limit)
{
  const auto quality_of = [&](Index t)
  {
    ++this->evaluations_;
    return this->tets_.quality_with(t, v, p);
  };
  return this->total_cost(this->star_, quality_of, minimum_quality, upper_limit);
}

// ---- New vertices ------------------------------------------------------------------------------

/// Find a step that inserts a vertex in the middle of the tet or of one of its edges. The new
/// vertex replaces the tets around it whose circumspheres contain the vertex. Then the vertex is
/// moved to the position of least cost.
bool TetStepSearch::insert_near(Index t, TetStep& step)
{
  const Tet& tet = this->tets_.tet(t);
  constexpr double quarter = 0.25;
  constexpr double half = 0.5;
  if (this->insert(t,
        quarter *
          (this->point(tet[0]) + this->point(tet[1]) + this->point(tet[2]) + this->point(tet[3])),
        step))
  {
    return true;
  }
  for (int i = 0; i < 4; ++i)
  {
    for (int j = i + 1; j < 4; ++j)
    {
      if (this->insert(t, half * (this->point(tet[i]) + this->point(tet[j])), step))
      {
        return true;
      }
    }
  }
  return false;
}

bool TetStepSearch::insert(Index t, Vec3 p, TetStep& step)
{
  constexpr double tiny = 0.25;
  if (!this->cavities_.find(p, t, tiny * this->tets_.quality(t), step.cavity))
  {
    return false;
  }
  const Cost old_cost = this->cost(step.cavity.tets);
  const double minimum_quality = this->minimum_quality_after(old_cost);
  double shortest = infinite_cost;
  for (const Facet& f : step.cavity.facets)
  {
    for (const Index w : f)
    {
      shortest = std::min(shortest, (this->point(w) - p).norm());
    }
  }
  constexpr double margin = 0.3; // a new vertex must lower the cost by more than this
  const double maximum_cost = old_cost.sum - margin;
  // Limits relative to the old cost. The search ends if the cost of the first position exceeds the
  // first limit. It also ends if the cost of the best position after the first search step exceeds
  // the second limit.
  constexpr double first_cost_limit = 3.0;
  constexpr double second_cost_limit = 1.5;
  this->sort_facets(step.cavity, p);
  double value =
    this->cavity_cost(step.cavity, p, minimum_quality, first_cost_limit * old_cost.sum);
  if (!(value < first_cost_limit * old_cost.sum))
  {
    return false;
  }
  constexpr double first_step = 0.3;
  constexpr double last_step = 0.1;
  for (double length = first_step * shortest; length > last_step * shortest && value > 0.0;)
  {
    bool found = false;
    for (int k = 0; k < directions_count && !found; ++k)
    {
      const Vec3 position = p + length * direction(k);
      const double moved_cost = this->cavity_cost(step.cavity, position, minimum_quality, value);
      if (moved_cost < value - minimum_gain)
      {
        value = moved_cost;
        p = position;
        found = true;
      }
    }
    if (!(value < second_cost_limit * old_cost.sum))
    {
      return false;
    }
    length *= found ? 1.0 : 0.5;
  }
  if (!(value < maximum_cost))
  {
    return false;
  }
  step.kind = TetStep::Kind::insert;
  step.position = p;
  return true;
}

/// Sort the facets of the cavity by the qualities of the tets that connect them to p, worst first.
/// Most of the rejected positions fail at the worst tets, so the test of a position ends early.
void TetStepSearch::sort_facets(TetCavity& cavity, const Vec3& p)
{
  std::vector<std::pair<double, Facet>>& ranked = this->ranked_facets_;
  ranked.clear();
  for (const Facet& f : cavity.facets)
  {
    ranked.emplace_back(this->quality(f, p), f);
  }
  std::sort(ranked.begin(), ranked.end());
  std::transform(ranked.begin(), ranked.end(), cavity.facets.begin(),
    [](const std::pair<double, Facet>& rank) { return rank.second; });
}

/// Return the cost of the new tets, each of which connects a facet of the cavity to p.
double TetStepSearch::cavity_cost(
  const TetCavity& cavity, const Vec3& p, double minimum_quality, double upper_limit)
{
  return this->total_cost(
    cavity.facets, [&](const Facet& f) { return this->quality(f, p); }, minimum_quality,
    upper_limit);
}

// ---- Contraction -----------------------------------------------------------------------------

/// Find a step that contracts an edge of the tet. The edge is at most `maximum_ratio` times as long
/// as the tet's longest edge.
bool TetStepSearch::contract_short_edge(const Tet& tet, double maximum_ratio, TetStep& step)
{
  double longest = 0.0;
  const auto length = [&](int i, int j)
  { return (this->point(tet[i]) - this->point(tet[j])).norm(); };
  for (int k = 0; k < 16; ++k)
  {
    longest = std::max(longest, length(k / 4, k % 4));
  }
  for (int k = 0; k < 16; ++k)
  {
    if (k / 4 != k % 4 && length(k / 4, k % 4) <= maximum_ratio * longest &&
      this->contract(tet[k / 4], tet[k % 4], step))
    {
      return true;
    }
  }
  return false;
}

/// Find the step that replaces vertex a by vertex b. The tets that contain both vertices are
/// removed.
bool TetStepSearch::contract(Index a, Index b, TetStep& step)
{
  const bool on_boundary = this->tets_.on_boundary(a);
  if (this->rules_.constrained[a] || (on_boundary && this->rules_.options.keep_boundary))
  {
    return false;
  }
  const std::vector<Index> old_tets = this->tets_.tets_of_vertex(a);
  const Cost before = this->cost(old_tets);
  const double minimum_quality = this->minimum_quality_after(before);
  std::vector<Tet>& added = step.added;
  added.clear();
  double sum = 0.0;
  for (const Index other : old_tets)
  {
    if (TetComplex::has_vertex(this->tets_.tet(other), b))
    {
      continue;
    }
    added.push_back(this->tets_.tet(other));
    std::replace(added.back().begin(), added.back().end(), a, b);
    const double value = this->quality(added.back());
    sum += this->penalty(value);
    if (!(value > 0.0) || value < minimum_quality || !(sum < before.sum - minimum_gain))
    {
      return false;
    }
  }
  const std::vector<Facet> boundary_facets =
    on_boundary ? this->tets_.boundary_facets_at(a) : std::vector<Facet>();
  const auto has_b = [b](const Facet& f) { return std::find(f.begin(), f.end(), b) != f.end(); };
  if (on_boundary && std::none_of(boundary_facets.begin(), boundary_facets.end(), has_b))
  {
    return false; // contracting an inner edge would move the boundary inwards
  }
  if (added.empty() || !this->keeps_shape(boundary_facets, a, b) ||
    !this->keeps_topology(boundary_facets, a, b))
  {
    return false;
  }
  step.kind = TetStep::Kind::contract;
  step.removed = old_tets;
  return true;
}

/// Report whether the normals of the boundary triangles at vertex a change little if a is replaced
/// by b. A vertex of a crease may be contracted along the crease only. A vertex at which creases
/// meet or end must not be contracted. boundary_facets: the boundary triangles at a.
bool TetStepSearch::keeps_shape(const std::vector<Facet>& boundary_facets, Index a, Index b) const
{
  // One pair for each boundary edge from vertex a to a vertex v and each boundary triangle at this
  // edge: v and the normal of the triangle.
  std::vector<std::pair<Index, Vec3>> sides;
  for (const auto& f : boundary_facets)
  {
    std::array<Vec3, 3> p{ this->point(f[0]), this->point(f[1]), this->point(f[2]) };
    const Vec3 n = (p[1] - p[0]).cross(p[2] - p[0]);
    for (const Index v : f)
    {
      if (v != a)
      {
        sides.emplace_back(v, n);
      }
    }
    if (std::find(f.begin(), f.end(), b) == f.end())
    {
      p[std::find(f.begin(), f.end(), a) - f.begin()] = this->point(b);
      if (!is_angle_below(n, (p[1] - p[0]).cross(p[2] - p[0]), flat_cosine))
      {
        return false;
      }
    }
  }
  int creases = 0;
  bool is_on_crease = false;
  for (std::size_t i = 0; i < sides.size(); ++i)
  {
    for (std::size_t j = 0; j < i; ++j)
    {
      if (sides[i].first == sides[j].first &&
        !is_angle_below(sides[i].second, sides[j].second, crease_cosine))
      {
        ++creases;
        is_on_crease = is_on_crease || sides[i].first == b;
      }
    }
  }
  return creases == 0 || (creases == 2 && is_on_crease);
}

/// Check the link condition: the intersection of the links of a and b must be the link of the edge
/// a-b. The outside is represented by an additional vertex that forms tets with the boundary
/// triangles.
bool TetStepSearch::keeps_topology(
  const std::vector<Facet>& boundary_facets, Index a, Index b) const
{
  const Link link_a = this->link_of(a, boundary_facets);
  const Link link_b = this->link_of(
    b, this->tets_.on_boundary(b) ? this->tets_.boundary_facets_at(b) : std::vector<Facet>());
  // The link of the edge is a cycle (or more than one, if the boundary touches itself).
  std::vector<Index> at_edge;
  this->tets_.find_edge_tets(a, b, at_edge);
  const auto cycle = static_cast<std::ptrdiff_t>(at_edge.size()) +
    std::count_if(boundary_facets.begin(), boundary_facets.end(),
      [&](const auto& f) { return std::find(f.begin(), f.end(), b) != f.end(); });
  return count_shared(link_a.vertices, link_b.vertices) == cycle &&
    count_shared(link_a.edges, link_b.edges) == cycle &&
    count_shared(link_a.triangles, link_b.triangles) == 0;
}

TetStepSearch::Link TetStepSearch::link_of(Index v, const std::vector<Facet>& boundary_facets) const
{
  constexpr Index outside = -1;
  Link link;
  for (const Index t : this->tets_.tets_of_vertex(v))
  {
    Tet tet = this->tets_.tet(t);
    std::swap(*std::find(tet.begin(), tet.end(), v), tet[3]);
    link.triangles.push_back({ tet[0], tet[1], tet[2] });
  }
  for (auto f : boundary_facets)
  {
    *std::find(f.begin(), f.end(), v) = outside;
    link.triangles.push_back(f);
  }
  for (auto& f : link.triangles)
  {
    std::sort(f.begin(), f.end());
    link.edges.insert(link.edges.end(), { { f[0], f[1] }, { f[0], f[2] }, { f[1], f[2] } });
    link.vertices.insert(link.vertices.end(), f.begin(), f.end());
  }
  sort_unique(link.vertices);
  sort_unique(link.edges);
  sort_unique(link.triangles);
  return link;
}

} // namespace bindpose
