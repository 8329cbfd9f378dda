// Pass after pass over the tets that are too flat, worst first; a tet is looked at again only when
// the tets at one of its vertices have changed. Each is tried in turn to be made better by
// 1. removing one of its edges: the tets around it are replaced by tets between its ends and a
//    triangulation of the ring of their other vertices, the best one by dynamic programming. An
//    edge of the boundary that is nearly flat can go as well; with a single tet that removes it.
// 2. removing one of its facets: two tets become three around a new edge;
// 3. moving one of its vertices: a search in a few directions with shrinking steps;
// 4. contracting one of its edges into one of its ends, when no vertex could be moved;
// 5. inserting a vertex in the middle of one of its edges, where that is allowed.
// In the last passes held vertices of tets that are still too flat may move. What is left of them
// goes when it is a tet by itself.
#include "inside/tet_improvement.h"

#include "base/tet_facets.h"
#include "inside/tet_complex.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

namespace bindpose
{

namespace
{
using Tet = TetComplex::Tet;
using Facet = TetComplex::Facet;
using Ring = TetComplex::Ring;
constexpr double better = 0.02; // what counts as an improvement: a fiftieth of a tet's angle
// Cosines between the normals of boundary triangles.
constexpr double flat_cosine = 0.966; // 15 degrees: an edge that may be swapped
constexpr double crease_cosine = 0.766; // 40 degrees: a vertex that may not move

/// Cost of a set of tets: 0 where all are good enough.
struct Cost
{
  double sum = 0.0; ///< of log(sine wanted / sine of the smallest dihedral angle)
  double worst = 1.0; ///< smallest quality
};

class Improver
{
public:
  Improver(TetMesh& mesh, std::vector<char> held, const OntoSurface& surface,
    const ImproveOptions& options, Improvement& done)
    : mesh_(mesh), tets_(mesh), held_(std::move(held)), surface_(surface), options_(options),
      done_(done), good_(TetComplex::quality_of_angle(options.angle)),
      moved_(static_cast<std::size_t>(mesh.points.rows()), 0),
      stays_(static_cast<std::size_t>(mesh.points.rows()), 0)
  {
    const auto tets = static_cast<double>(mesh.tets.rows() + small);
    this->most_evaluations_ = std::min(options.effort * tets, large + per_tet_of_large * tets);
  }

  bool run(ExecutionContext& context)
  {
    constexpr Index last_passes = 4; // in which held vertices move
    constexpr Index first_passes = 3; // before vertices are added
    const Index passes = this->options_.passes - last_passes;
    bool whole =
      this->passes(this->options_.insert ? first_passes : passes, this->options_.angle, context);
    if (whole && this->options_.insert)
    {
      this->insert_ = true;
      this->tried_.clear();
      whole = this->passes(passes - first_passes, this->options_.angle, context);
    }
    if (whole && this->options_.least_angle > 0.0)
    {
      this->release_ = true;
      this->tried_.clear();
      whole = this->passes(last_passes, this->options_.least_angle, context);
      this->release_ = false;
    }
    if (whole && !this->options_.keep_boundary)
    {
      this->drop_lone_tets();
    }
    this->tets_.write(this->mesh_);
    return whole;
  }

private:
  /// Small meshes get more evaluations per tet, large ones get fewer.
  static constexpr Index small = 1000; // tets
  static constexpr double large = 2.5e7; // evaluations
  static constexpr double per_tet_of_large = 140.0;

  const Vec3& point(Index v) const { return this->tets_.point(v); }

  bool exhausted() const
  {
    return static_cast<double>(this->tets_.evaluations()) > this->most_evaluations_;
  }

  /// @return false when cancelled.
  bool passes(Index most, double angle, ExecutionContext& context)
  {
    const double enough = TetComplex::quality_of_angle(angle);
    for (Index pass = 0; pass < most; ++pass)
    {
      const std::vector<Index> flat = this->flat_tets(enough);
      std::size_t tried = 0;
      std::size_t better_now = 0;
      for (std::size_t i = 0; i < flat.size() && !this->exhausted(); ++i)
      {
        const Index t = flat[i];
        if (this->tets_.quality(t) < enough && this->changed(t)) // it may be gone or better by now
        {
          this->tried_[t] = this->newest(t);
          ++tried;
          better_now += this->improve(t);
        }
        constexpr std::size_t often = 64;
        if (i % often == 0 && context.cancelled())
        {
          return false;
        }
      }
      context.progress(static_cast<double>(pass + 1) / static_cast<double>(most));
      constexpr std::size_t worth_a_pass = 20; // one in so many
      if (worth_a_pass * better_now <= tried)
      {
        break;
      }
    }
    return true;
  }

  /// The last change at a vertex of the tet.
  std::uint64_t newest(Index t) const
  {
    std::uint64_t last = 0;
    for (const Index v : this->tets_.tet(t))
    {
      last = std::max(last, this->tets_.stamp(v));
    }
    return last;
  }

  /// A vertex of the tet has seen a change since the tet was tried.
  bool changed(Index t)
  {
    if (static_cast<Index>(this->tried_.size()) <= t)
    {
      this->tried_.resize(static_cast<std::size_t>(this->tets_.tet_ids()), 0);
    }
    return this->tried_[t] < this->newest(t);
  }

  std::vector<Index> flat_tets(double enough) const
  {
    std::vector<Index> flat;
    for (Index t = 0; t < this->tets_.tet_ids(); ++t)
    {
      if (this->tets_.quality(t) < enough)
      {
        flat.push_back(t);
      }
    }
    std::sort(flat.begin(), flat.end(),
      [&](Index a, Index b)
      {
        return this->tets_.quality(a) != this->tets_.quality(b)
          ? this->tets_.quality(a) < this->tets_.quality(b)
          : a < b;
      });
    return flat;
  }

  double penalty(double quality) const
  {
    if (quality >= this->good_)
    {
      return 0.0;
    }
    constexpr double least = 1e-24;
    constexpr double half = 0.5; // the quality is a square
    return half * std::log(this->good_ / std::max(quality, least));
  }

  Cost cost(const std::vector<Index>& tets) const
  {
    Cost cost;
    for (const Index t : tets)
    {
      cost.sum += this->penalty(this->tets_.quality(t));
      cost.worst = std::min(cost.worst, this->tets_.quality(t));
    }
    return cost;
  }

  /// The smallest quality that a tet may have which replaces tets of that cost.
  double least_after(const Cost& cost) const
  {
    return std::min(this->options_.slack * this->options_.slack * cost.worst, this->good_);
  }

  bool improve(Index t)
  {
    const Tet tet = this->tets_.tet(t);
    for (int i = 0; i < 4; ++i)
    {
      for (int j = i + 1; j < 4; ++j)
      {
        if (this->remove_edge(tet[i], tet[j]))
        {
          return true;
        }
      }
    }
    for (const auto& f : facet_corners)
    {
      if (this->remove_facet(t, tet[f[0]], tet[f[1]], tet[f[2]]))
      {
        return true;
      }
    }
    constexpr double too_near = 0.01; // of the longest edge: no move makes up for that
    bool moved = false;
    bool any = this->contract_any(tet, too_near);
    for (int k = 0; k < 4 && !any; ++k)
    {
      moved = this->move(tet[k]) || moved;
    }
    any = any || moved || this->contract_any(tet, 1.0);
    return any || (this->insert_ && this->tets_.quality(t) < this->bad_ && this->insert_near(t));
  }

  // ---- Edges and facets ------------------------------------------------------------------------

  bool remove_edge(Index a, Index b)
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
    constexpr double never = std::numeric_limits<double>::infinity();
    // best[i][j]: what the best triangulation of the polygon r[i] … r[j] costs.
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
          const double one = this->tets_.quality({ r[i], r[k], r[j], b });
          if (!(one > 0.0) || one < least)
          {
            continue;
          }
          const double other = this->tets_.quality({ r[k], r[i], r[j], a });
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
    for (const Index t : ring.tets)
    {
      this->tets_.remove(t);
    }
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
      this->tets_.add({ r[i], r[k], r[j], b });
      this->tets_.add({ r[k], r[i], r[j], a });
      open.emplace_back(i, k);
      open.emplace_back(k, j);
    }
    this->done_.removed_tets += n == 2;
    return true;
  }

  /// The boundary is flat enough at the edge, and its new edge makes it touch itself nowhere.
  bool may_swap_boundary(Index a, Index b, const Ring& ring) const
  {
    if (this->options_.keep_boundary && !(this->options_.coplanar > 0.0))
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
    if (this->options_.keep_boundary)
    {
      const double largest =
        std::max({ one.norm(), other.norm(), new_one.norm(), new_other.norm() });
      const double volume = std::abs(one.dot(this->point(last) - p)); // six times
      if (volume > this->options_.coplanar * largest)
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

  bool remove_facet(Index t, Index a, Index b, Index c)
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
      const double value = this->tets_.quality(tet);
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
    this->tets_.remove(t);
    this->tets_.remove(other);
    for (const Tet& tet : fresh)
    {
      this->tets_.add(tet);
    }
    return true;
  }

  // ---- Vertices --------------------------------------------------------------------------------

  struct Patch
  {
    bool smooth = true;
    Vec3 normal = Vec3::Zero();
  };

  Patch patch_of(const std::vector<Facet>& skin) const
  {
    std::vector<Vec3> normals;
    Patch patch;
    for (const auto& f : skin)
    {
      const Vec3 p = this->point(f[0]);
      normals.push_back((this->point(f[1]) - p).cross(this->point(f[2]) - p));
      patch.normal += normals.back();
    }
    patch.normal.normalize();
    patch.smooth = std::all_of(normals.begin(), normals.end(),
      [&](const Vec3& n) { return turned_less(n, patch.normal, crease_cosine); });
    return patch;
  }

  bool move(Index v)
  {
    if ((this->held_[v] && !this->release_) || this->stays_[v] == this->tets_.stamp(v))
    {
      return false;
    }
    this->stays_[v] = this->tets_.stamp(v);
    const bool on_boundary = this->tets_.on_boundary(v);
    std::vector<Facet> skin;
    Patch patch;
    if (on_boundary)
    {
      if (!this->surface_)
      {
        return false;
      }
      skin = this->tets_.skin_at(v);
      patch = this->patch_of(skin);
      if (!patch.smooth)
      {
        return false;
      }
    }
    const Vec3 start = this->point(v);
    double shortest = 1e300;
    for (const Index t : this->tets_.tets_at(v))
    {
      for (const Index w : this->tets_.tet(t))
      {
        if (w != v)
        {
          shortest = std::min(shortest, (this->point(w) - start).norm());
        }
      }
    }
    const Cost old = this->cost(this->tets_.tets_at(v));
    const double least = this->least_after(old);
    double value = old.sum;
    Vec3 at = start;
    // Those that cost something first: they rule out most directions.
    this->star_ = this->tets_.tets_at(v);
    std::stable_sort(this->star_.begin(), this->star_.end(),
      [&](Index s, Index t) { return this->tets_.quality(s) < this->tets_.quality(t); });
    constexpr double first_step = 0.3;
    constexpr double last_step = 0.08;
    for (double step = first_step * shortest; step > last_step * shortest && value > 0.0;)
    {
      bool found = false;
      for (int k = 0; k < directions_count && !found; ++k)
      {
        Vec3 d = direction(k);
        if (on_boundary)
        {
          d -= d.dot(patch.normal) * patch.normal;
        }
        Vec3 p = at + step * d;
        if (on_boundary && !this->surface_(p, patch.normal, step))
        {
          continue;
        }
        this->tets_.set_point(v, p);
        const double there = this->sum_of_star(least, value - better);
        if (there < value - better && (skin.empty() || this->patch_of(skin).smooth))
        {
          value = there;
          at = p;
          found = true;
        }
      }
      step *= found ? 1.0 : 0.5;
    }
    if (!(value < old.sum - better))
    {
      this->tets_.set_point(v, start);
      return false;
    }
    this->tets_.set_point(v, at);
    this->tets_.requalify(v);
    (this->held_[v] ? this->done_.released_vertices : this->done_.moved_vertices) +=
      !this->moved_[v];
    this->moved_[v] = 1;
    return true;
  }

  /// Cost of the tets of star_: infinity above `most` and where one of them is worse than
  /// `least`.
  double sum_of_star(double least, double most) const
  {
    double sum = 0.0;
    for (const Index t : this->star_)
    {
      const double value = this->tets_.quality(this->tets_.tet(t));
      sum += this->penalty(value);
      if (!(value > 0.0) || value < least || sum > most)
      {
        return std::numeric_limits<double>::infinity();
      }
    }
    return sum;
  }

  // ---- New vertices ----------------------------------------------------------------------------

  /// Inserts a vertex in the middle of the tet or of one of its edges, with the tets around it that
  /// its circumsphere takes in, then moved to where that costs least.
  bool insert_near(Index t)
  {
    const Tet tet = this->tets_.tet(t);
    Vec3 center = Vec3::Zero();
    for (const Index v : tet)
    {
      center += 0.25 * this->point(v);
    }
    if (this->insert(t, center))
    {
      return true;
    }
    for (int i = 0; i < 4; ++i)
    {
      for (int j = i + 1; j < 4; ++j)
      {
        if (this->insert(t, 0.5 * (this->point(tet[i]) + this->point(tet[j]))))
        {
          return true;
        }
      }
    }
    return false;
  }

  bool insert(Index t, Vec3 p)
  {
    constexpr double tiny = 0.25;
    if (!this->tets_.find_cavity(p, t, tiny * this->tets_.quality(t), this->cavity_))
    {
      return false;
    }
    const Cost old = this->cost(this->cavity_.tets);
    const double least = this->least_after(old);
    double shortest = 1e300;
    for (const Facet& f : this->cavity_.facets)
    {
      for (const Index w : f)
      {
        shortest = std::min(shortest, (this->point(w) - p).norm());
      }
    }
    constexpr double margin = 0.3; // a vertex more must be worth it
    const double enough = old.sum - margin;
    const Index v = this->tets_.add_vertex(p, false);
    constexpr double never = std::numeric_limits<double>::infinity();
    const auto value_at = [&](const Vec3& place, double most)
    {
      this->tets_.set_point(v, place);
      double sum = 0.0;
      for (const Facet& f : this->cavity_.facets)
      {
        const double value = this->tets_.quality({ f[0], f[1], f[2], v });
        sum += this->penalty(value);
        if (!(value > 0.0) || value < least || sum > most)
        {
          return never;
        }
      }
      return sum;
    };
    double value = value_at(p, never);
    constexpr double hopeful = 3;
    if (!(value < hopeful * old.sum))
    {
      this->tets_.drop_last_vertex();
      return false;
    }
    constexpr double first_step = 0.3;
    constexpr double last_step = 0.1;
    for (double step = first_step * shortest; step > last_step * shortest && value > 0.0;)
    {
      bool found = false;
      for (int k = 0; k < directions_count && !found; ++k)
      {
        const Vec3 place = p + step * direction(k);
        const double there = value_at(place, value);
        if (there < value - better)
        {
          value = there;
          p = place;
          found = true;
        }
      }
      step *= found ? 1.0 : 0.5;
    }
    this->tets_.drop_last_vertex();
    if (!(value < enough))
    {
      return false;
    }
    this->tets_.fill_cavity(p, this->cavity_);
    this->held_.push_back(0);
    this->moved_.push_back(1);
    this->stays_.push_back(0);
    ++this->done_.inserted_vertices;
    return true;
  }

  // ---- Contraction -----------------------------------------------------------------------------

  /// Contracts an edge that is no longer than `share` of the tet's longest.
  bool contract_any(const Tet& tet, double share)
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
        this->contract(tet[k / 4], tet[k % 4]))
      {
        return true;
      }
    }
    return false;
  }

  /// Vertex a becomes b; the tets at both are gone.
  bool contract(Index a, Index b)
  {
    const bool on_boundary = this->tets_.on_boundary(a);
    if (this->held_[a] || (on_boundary && this->options_.keep_boundary))
    {
      return false;
    }
    const std::vector<Index> old = this->tets_.tets_at(a);
    const Cost before = this->cost(old);
    const double least = this->least_after(before);
    std::vector<Tet> fresh;
    double sum = 0.0;
    for (const Index other : old)
    {
      if (TetComplex::has(this->tets_.tet(other), b))
      {
        continue;
      }
      fresh.push_back(this->tets_.tet(other));
      std::replace(fresh.back().begin(), fresh.back().end(), a, b);
      const double value = this->tets_.quality(fresh.back());
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
      return false; // the boundary would be drawn inwards
    }
    if (fresh.empty() || !this->keeps_shape(skin, a, b) || !this->keeps_topology(skin, a, b))
    {
      return false;
    }
    for (const Index other : old)
    {
      this->tets_.remove(other);
    }
    for (const Tet& tet : fresh)
    {
      this->tets_.add(tet);
    }
    ++this->done_.collapsed_edges;
    return true;
  }

  /// No boundary triangle at a turns by more than what is flat when a becomes b; a vertex of a
  /// crease goes along the crease, and where creases meet or end none goes. skin: the boundary
  /// triangles at a.
  bool keeps_shape(const std::vector<Facet>& skin, Index a, Index b) const
  {
    std::vector<std::pair<Index, Vec3>> sides; // (other end of an edge at a, normal beside it)
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

  static bool turned_less(const Vec3& one, const Vec3& other, double cosine)
  {
    return one.dot(other) > cosine * one.norm() * other.norm();
  }

  /// The link condition: what is around a and around b is around the edge a-b, too. The outside
  /// counts as one more vertex that the boundary's triangles make tets with.
  bool keeps_topology(const std::vector<Facet>& skin, Index a, Index b) const
  {
    const Link link_a = this->link_of(a, skin);
    const Link link_b =
      this->link_of(b, this->tets_.on_boundary(b) ? this->tets_.skin_at(b) : std::vector<Facet>());
    // Around the edge is a cycle (or more than one, where the boundary touches itself).
    std::vector<Index> at_edge;
    this->tets_.tets_with(a, b, at_edge);
    const auto cycle = static_cast<std::ptrdiff_t>(at_edge.size()) +
      std::count_if(skin.begin(), skin.end(),
        [&](const auto& f) { return std::find(f.begin(), f.end(), b) != f.end(); });
    return shared(link_a.vertices, link_b.vertices) == cycle &&
      shared(link_a.edges, link_b.edges) == cycle &&
      shared(link_a.triangles, link_b.triangles) == 0;
  }

  /// Sorted, and so are the vertices of each.
  struct Link
  {
    std::vector<Index> vertices;
    std::vector<std::array<Index, 2>> edges;
    std::vector<std::array<Index, 3>> triangles;
  };

  Link link_of(Index v, const std::vector<Facet>& skin) const
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
    make_set(link.vertices);
    make_set(link.edges);
    make_set(link.triangles);
    return link;
  }

  template <typename T>
  static void make_set(std::vector<T>& list)
  {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }

  template <typename T>
  static std::ptrdiff_t shared(const std::vector<T>& one, const std::vector<T>& other)
  {
    return std::count_if(one.begin(), one.end(),
      [&](const T& x) { return std::binary_search(other.begin(), other.end(), x); });
  }

  /// Removes tets that share no facet with another and stayed too flat.
  void drop_lone_tets()
  {
    const std::vector<Index> flat =
      this->flat_tets(TetComplex::quality_of_angle(this->options_.least_angle));
    for (const Index t : flat)
    {
      const Tet& tet = this->tets_.tet(t);
      const bool held =
        std::any_of(tet.begin(), tet.end(), [&](Index v) { return this->held_[v]; });
      const bool alone = std::all_of(std::begin(facet_corners), std::end(facet_corners),
        [&](const auto& f) { return this->tets_.beyond(t, tet[f[0]], tet[f[1]], tet[f[2]]) < 0; });
      if (!held && alone)
      {
        this->tets_.remove(t);
        ++this->done_.removed_tets;
      }
    }
  }

  static constexpr int directions_count = 14;
  /// Along the axes, then along the diagonals of a cube.
  static Vec3 direction(int k)
  {
    if (k < 6)
    {
      return (k % 2 ? -1.0 : 1.0) * Vec3::Unit(k / 2);
    }
    const int bits = k - 6;
    return Vec3(bits & 1 ? -1.0 : 1.0, bits & 2 ? -1.0 : 1.0, bits & 4 ? -1.0 : 1.0) /
      std::sqrt(3.0);
  }

  TetMesh& mesh_;
  TetComplex tets_;
  std::vector<char> held_;
  const OntoSurface& surface_;
  const ImproveOptions& options_;
  Improvement& done_;
  const double good_; ///< quality of tets that are left as they are
  const double bad_ = TetComplex::quality_of_angle(this->options_.insert_angle);
  double most_evaluations_ = 0.0;
  bool release_ = false; ///< held vertices may move
  bool insert_ = false; ///< vertices may be added
  std::vector<char> moved_;
  /// Per vertex: its newest change when no better place was found for it; 0: none was looked for.
  std::vector<std::uint64_t> stays_;
  std::vector<std::uint64_t> tried_; ///< per tet: its newest change when it was tried
  Ring ring_;
  std::vector<Index> star_;
  TetComplex::Cavity cavity_;
};
} // namespace

bool improve_tets(TetMesh& mesh, std::vector<char> held, const OntoSurface& surface,
  const ImproveOptions& options, Improvement& done, ExecutionContext& context)
{
  done = Improvement();
  return Improver(mesh, std::move(held), surface, options, done).run(context);
}

} // namespace bindpose
