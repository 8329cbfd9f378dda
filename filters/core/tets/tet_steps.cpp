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
// 5. Insert a vertex in the middle of the tet or of one of its edges, if insertion is allowed.
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
constexpr double better = 0.02;
constexpr double never = std::numeric_limits<double>::infinity();
// Cosines of limits for the angle between the normals of boundary triangles.
constexpr double flat_cosine = 0.966; // 15 degrees: below this angle an edge may be swapped
constexpr double crease_cosine = 0.766; // 40 degrees: above this angle a vertex may not move

bool turned_less(const Vec3& one, const Vec3& other, double cosine)
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
std::ptrdiff_t shared(const std::vector<T>& one, const std::vector<T>& other)
{
  return std::count_if(one.begin(), one.end(),
    [&](const T& x) { return std::binary_search(other.begin(), other.end(), x); });
}
} // namespace

void TetStep::clear()
{
  this->kind = Kind::none;
  this->removed.clear();
  this->fresh.clear();
  this->vertex = -1;
  this->stay.clear();
}

bool may_move(const TetComplex& tets, const TetStepRules& rules, Index v)
{
  return (!rules.held[v] || rules.release) && (!tets.on_boundary(v) || rules.surface) &&
    rules.stays[v] != tets.stamp(v);
}

TetStepSearch::TetStepSearch(const TetComplex& tets, const TetStepRules& rules)
  : tets_(tets), rules_(rules), good_(TetComplex::quality_of_angle(rules.options.angle)),
    bad_(TetComplex::quality_of_angle(rules.options.insert_angle)), cavities_(tets)
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
  for (const auto& f : facet_corners)
  {
    if (this->remove_facet(t, tet[f[0]], tet[f[1]], tet[f[2]], step))
    {
      return;
    }
  }
  // Fraction of the longest edge. If an edge is shorter than this, moving its vertices cannot
  // improve the tet.
  constexpr double too_near = 0.01;
  if (this->contract_any(tet, too_near, step))
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
  if (!this->contract_any(tet, 1.0, step) && this->rules_.insert &&
    this->tets_.quality(t) < this->bad_)
  {
    this->insert_near(t, step);
  }
}

double TetStepSearch::quality(const Tet& tet)
{
  ++this->evaluations_;
  return this->tets_.quality(tet);
}

double TetStepSearch::penalty(double quality) const
{
  if (quality >= this->good_)
  {
    return 0.0;
  }
  constexpr double least = 1e-24;
  // The logarithm is halved, because the quality is the square of the sine.
  constexpr double half = 0.5;
  return half * std::log(this->good_ / std::max(quality, least));
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

/// Return the minimum quality of tets that replace tets with this cost.
double TetStepSearch::least_after(const Cost& cost) const
{
  return std::min(
    this->rules_.options.slack * this->rules_.options.slack * cost.worst, this->good_);
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
  const Cost old = this->cost(ring.tets);
  const double least = this->least_after(old);
  const std::vector<Index>& r = ring.vertices;
  const std::size_t n = r.size();
  constexpr std::size_t most = TetComplex::longest_ring + 1;
  // best[i][j]: the cost of the best triangulation of the polygon r[i] … r[j].
  std::array<std::array<double, most>, most> best;
  std::array<std::array<std::size_t, most>, most> apex{};
  for (std::size_t i = 0; i + 1 < n; ++i)
  {
    best[i][i + 1] = 0.0;
  }
  const double enough = old.sum - better;
  for (std::size_t span = 2; span < n; ++span)
  {
    for (std::size_t i = 0; i + span < n; ++i)
    {
      const std::size_t j = i + span;
      best[i][j] = never;
      for (std::size_t k = i + 1; k < j; ++k)
      {
        const double rest = best[i][k] + best[k][j];
        if (!(rest < best[i][j]) || !(rest < enough))
        {
          continue;
        }
        const double one = this->quality({ r[i], r[k], r[j], b });
        if (!(one > 0.0) || one < least)
        {
          continue;
        }
        const double other = this->quality({ r[k], r[i], r[j], a });
        if (!(other > 0.0) || other < least)
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
  if (!(best[0][n - 1] < enough))
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
    step.fresh.push_back({ r[i], r[k], r[j], b });
    step.fresh.push_back({ r[k], r[i], r[j], a });
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
  const Vec3 new_one = (p - this->point(first)).cross(this->point(last) - this->point(first));
  const Vec3 new_other = (this->point(last) - this->point(first)).cross(q - this->point(first));
  const auto flat = [](const Vec3& x, const Vec3& y) { return turned_less(x, y, flat_cosine); };
  if (!flat(one, other) || !flat(new_one, new_other) || !flat(one, new_one))
  {
    return false;
  }
  if (this->rules_.options.keep_boundary)
  {
    const double largest = std::max({ one.norm(), other.norm(), new_one.norm(), new_other.norm() });
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

bool TetStepSearch::remove_facet(Index t, Index a, Index b, Index c, TetStep& step)
{
  const Index other = this->tets_.beyond(t, a, b, c);
  if (other < 0)
  {
    return false;
  }
  const auto apex = [&](Index s)
  {
    for (const Index v : this->tets_.tet(s))
    {
      if (v != a && v != b && v != c)
      {
        return v;
      }
    }
    return Index(-1);
  };
  const Index d = apex(t), e = apex(other);
  std::array<Tet, 3> fresh{ { { a, b, e, d }, { b, c, e, d }, { c, a, e, d } } };
  if (this->tets_.volume({ a, b, c, d }) < 0.0)
  {
    for (Tet& tet : fresh)
    {
      std::swap(tet[0], tet[1]);
    }
  }
  const Cost old = this->cost({ t, other });
  const double least = this->least_after(old);
  double sum = 0.0;
  for (const Tet& tet : fresh)
  {
    const double value = this->quality(tet);
    if (!(value > 0.0) || value < least)
    {
      return false;
    }
    sum += this->penalty(value);
  }
  if (!(sum < old.sum - better) || this->tets_.has_edge(d, e))
  {
    return false;
  }
  step.kind = TetStep::Kind::swap;
  step.removed = { t, other };
  step.fresh.assign(fresh.begin(), fresh.end());
  return true;
}

// ---- Vertices --------------------------------------------------------------------------------

/// Return the patch of boundary triangles `skin` with vertex `moved` at the position p.
TetStepSearch::Patch TetStepSearch::patch_of(
  const std::vector<Facet>& skin, Index moved, const Vec3& p) const
{
  const auto at = [&](Index v) -> const Vec3& { return v == moved ? p : this->point(v); };
  std::vector<Vec3> normals;
  Patch patch;
  for (const auto& f : skin)
  {
    normals.push_back((at(f[1]) - at(f[0])).cross(at(f[2]) - at(f[0])));
    patch.normal += normals.back();
  }
  patch.normal.normalize();
  patch.smooth = std::all_of(normals.begin(), normals.end(),
    [&](const Vec3& n) { return turned_less(n, patch.normal, crease_cosine); });
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
  std::vector<Facet> skin;
  Patch patch;
  if (on_boundary)
  {
    skin = this->tets_.skin_at(v);
    patch = this->patch_of(skin, v, start);
    if (!patch.smooth)
    {
      step.stay.push_back(v);
      return false;
    }
  }
  this->star_ = this->tets_.tets_at(v);
  double shortest = never;
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
  const Cost old = this->cost(this->star_);
  const double least = this->least_after(old);
  double value = old.sum;
  Vec3 at = start;
  // Sort the most expensive tets first, because they exclude most directions.
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
      const double there = this->sum_of_star(v, p, least, value - better);
      if (there < value - better && (skin.empty() || this->patch_of(skin, v, p).smooth))
      {
        value = there;
        at = p;
        found = true;
      }
    }
    length *= found ? 1.0 : 0.5;
  }
  if (!(value < old.sum - better))
  {
    step.stay.push_back(v);
    return false;
  }
  step.kind = TetStep::Kind::move;
  step.vertex = v;
  step.place = at;
  return true;
}

/// Return the sum of the costs of new tets, one per item. The result is infinity if the sum exceeds
/// `most` or if the quality of a tet is less than `least`.
template <typename Items, typename QualityOf>
double TetStepSearch::sum_of(
  const Items& items, const QualityOf& quality_of, double least, double most)
{
  double sum = 0.0;
  for (const auto& item : items)
  {
    ++this->evaluations_;
    const double value = quality_of(item);
    sum += this->penalty(value);
    if (!(value > 0.0) || value < least || sum > most)
    {
      return never;
    }
  }
  return sum;
}

/// Return the cost of the tets in star_ with vertex v at p.
double TetStepSearch::sum_of_star(Index v, const Vec3& p, double least, double most)
{
  return this->sum_of(
    this->star_, [&](Index t) { return this->tets_.quality_with(t, v, p); }, least, most);
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
  const Cost old = this->cost(step.cavity.tets);
  const double least = this->least_after(old);
  double shortest = never;
  for (const Facet& f : step.cavity.facets)
  {
    for (const Index w : f)
    {
      shortest = std::min(shortest, (this->point(w) - p).norm());
    }
  }
  constexpr double margin = 0.3; // minimum decrease of the cost by a new vertex
  const double enough = old.sum - margin;
  // Limits relative to the old cost. The search ends if the cost of the first position exceeds the
  // first limit. It also ends if the cost of the best position after the first search step exceeds
  // the second limit.
  constexpr double hopeful = 3.0;
  constexpr double promising = 1.5;
  double value = this->sum_of_cavity(step.cavity, p, least, never);
  if (!(value < hopeful * old.sum))
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
      const Vec3 place = p + length * direction(k);
      const double there = this->sum_of_cavity(step.cavity, place, least, value);
      if (there < value - better)
      {
        value = there;
        p = place;
        found = true;
      }
    }
    if (!(value < promising * old.sum))
    {
      return false;
    }
    length *= found ? 1.0 : 0.5;
  }
  if (!(value < enough))
  {
    return false;
  }
  step.kind = TetStep::Kind::insert;
  step.place = p;
  return true;
}

/// Return the cost of the tets between p and the cavity's facets.
double TetStepSearch::sum_of_cavity(
  const TetCavity& cavity, const Vec3& p, double least, double most)
{
  return this->sum_of(
    cavity.facets,
    [&](const Facet& f)
    { return TetComplex::quality(this->point(f[0]), this->point(f[1]), this->point(f[2]), p); },
    least, most);
}

// ---- Contraction -----------------------------------------------------------------------------

/// Find a step that contracts an edge of the tet. The edge is at most `share` times as long as the
/// tet's longest edge.
bool TetStepSearch::contract_any(const Tet& tet, double share, TetStep& step)
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
    if (k / 4 != k % 4 && length(k / 4, k % 4) <= share * longest &&
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
  if (this->rules_.held[a] || (on_boundary && this->rules_.options.keep_boundary))
  {
    return false;
  }
  const std::vector<Index> old = this->tets_.tets_at(a);
  const Cost before = this->cost(old);
  const double least = this->least_after(before);
  std::vector<Tet>& fresh = step.fresh;
  fresh.clear();
  double sum = 0.0;
  for (const Index other : old)
  {
    if (TetComplex::has(this->tets_.tet(other), b))
    {
      continue;
    }
    fresh.push_back(this->tets_.tet(other));
    std::replace(fresh.back().begin(), fresh.back().end(), a, b);
    const double value = this->quality(fresh.back());
    sum += this->penalty(value);
    if (!(value > 0.0) || value < least || !(sum < before.sum - better))
    {
      return false;
    }
  }
  const std::vector<Facet> skin = on_boundary ? this->tets_.skin_at(a) : std::vector<Facet>();
  const auto has_b = [b](const Facet& f) { return std::find(f.begin(), f.end(), b) != f.end(); };
  if (on_boundary && std::none_of(skin.begin(), skin.end(), has_b))
  {
    return false; // a-b is an inner edge, so the boundary would move inwards
  }
  if (fresh.empty() || !this->keeps_shape(skin, a, b) || !this->keeps_topology(skin, a, b))
  {
    return false;
  }
  step.kind = TetStep::Kind::contract;
  step.removed = old;
  return true;
}

/// Report whether the normals of the boundary triangles at vertex a change little if a is replaced
/// by b. A vertex of a crease may be contracted along the crease only. A vertex at which creases
/// meet or end must not be contracted. skin: the boundary triangles at a.
bool TetStepSearch::keeps_shape(const std::vector<Facet>& skin, Index a, Index b) const
{
  // Pairs (other end of an edge at a, normal of a triangle at this edge).
  std::vector<std::pair<Index, Vec3>> sides;
  for (const auto& f : skin)
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
      if (!turned_less(n, (p[1] - p[0]).cross(p[2] - p[0]), flat_cosine))
      {
        return false;
      }
    }
  }
  int creases = 0;
  bool along = false;
  for (std::size_t i = 0; i < sides.size(); ++i)
  {
    for (std::size_t j = 0; j < i; ++j)
    {
      if (sides[i].first == sides[j].first &&
        !turned_less(sides[i].second, sides[j].second, crease_cosine))
      {
        ++creases;
        along = along || sides[i].first == b;
      }
    }
  }
  return creases == 0 || (creases == 2 && along);
}

/// Check the link condition: the intersection of the links of a and b must be the link of the edge
/// a-b. The outside is represented by an additional vertex that forms tets with the boundary
/// triangles.
bool TetStepSearch::keeps_topology(const std::vector<Facet>& skin, Index a, Index b) const
{
  const Link link_a = this->link_of(a, skin);
  const Link link_b =
    this->link_of(b, this->tets_.on_boundary(b) ? this->tets_.skin_at(b) : std::vector<Facet>());
  // The link of the edge is a cycle (or more than one, if the boundary touches itself).
  std::vector<Index> at_edge;
  this->tets_.tets_with(a, b, at_edge);
  const auto cycle = static_cast<std::ptrdiff_t>(at_edge.size()) +
    std::count_if(skin.begin(), skin.end(),
      [&](const auto& f) { return std::find(f.begin(), f.end(), b) != f.end(); });
  return shared(link_a.vertices, link_b.vertices) == cycle &&
    shared(link_a.edges, link_b.edges) == cycle && shared(link_a.triangles, link_b.triangles) == 0;
}

TetStepSearch::Link TetStepSearch::link_of(Index v, const std::vector<Facet>& skin) const
{
  constexpr Index outside = -1;
  Link link;
  for (const Index t : this->tets_.tets_at(v))
  {
    Tet tet = this->tets_.tet(t);
    std::swap(*std::find(tet.begin(), tet.end(), v), tet[3]);
    link.triangles.push_back({ tet[0], tet[1], tet[2] });
  }
  for (auto f : skin)
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
