// Pass after pass over the tets that are too flat, worst first. Each is tried in turn to be made
// better by
// 1. removing one of its edges: the tets around it are replaced by tets between its ends and a
//    triangulation of the ring of their other vertices, the best one by dynamic programming. An
//    edge of the boundary that is nearly flat can go as well; with a single tet that removes it.
// 2. removing one of its facets: two tets become three around a new edge;
// 3. moving one of its vertices: a search in a few directions with shrinking steps;
// 4. contracting one of its edges into one of its ends, when no vertex could be moved.
// In the last passes held vertices of tets that are still too flat may move. What is left of them
// goes when it is a tet by itself.
#include "inside/tet_improvement.h"

#include "base/tet_facets.h"
#include "inside/tet_quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace bindpose
{

namespace
{
using Tet = std::array<Index, 4>;
constexpr double better = 1e-3; // degrees: what counts as an improvement
constexpr std::size_t longest_ring = 8;
// Cosines between the normals of boundary triangles.
constexpr double flat_cosine = 0.966; // 15 degrees: an edge that may be swapped
constexpr double crease_cosine = 0.766; // 40 degrees: a vertex that may not move

/// The tets around an edge a-b: the tets and their other vertices in order. Open for an edge of the
/// boundary: there is one more vertex than tets.
struct Ring
{
  std::vector<Index> tets;
  std::vector<Index> vertices;
  bool closed = false;
};

class Improver
{
public:
  Improver(TetMesh& mesh, std::vector<char> held, const OntoSurface& surface,
    const ImproveOptions& options, Improvement& done)
    : mesh_(mesh), held_(std::move(held)), surface_(surface), options_(options), done_(done)
  {
    this->at_.resize(static_cast<std::size_t>(mesh.points.rows()));
    this->boundary_.resize(this->at_.size(), 0);
    this->moved_.resize(this->at_.size(), 0);
    for (Index t = 0; t < mesh.tets.rows(); ++t)
    {
      this->add({ mesh.tets(t, 0), mesh.tets(t, 1), mesh.tets(t, 2), mesh.tets(t, 3) });
    }
    const Triangles skin = boundary_triangles(mesh.tets);
    for (Index k = 0; k < skin.size(); ++k)
    {
      this->boundary_[skin.data()[k]] = 1;
    }
  }

  bool run(ExecutionContext& context)
  {
    bool whole = true;
    bool release = false;
    for (Index pass = 0; pass < this->options_.passes && whole; ++pass)
    {
      const double angle = release ? this->options_.least_angle : this->options_.angle;
      const std::vector<Index> flat = this->flat_tets(angle);
      this->release_ = release;
      bool any = false;
      for (std::size_t i = 0; i < flat.size() && whole; ++i)
      {
        if (this->quality_[flat[i]] < angle) // it may be gone or better by now
        {
          any = this->improve(flat[i]) || any;
        }
        constexpr std::size_t often = 64;
        whole = i % often != 0 || !context.cancelled();
      }
      context.progress(static_cast<double>(pass + 1) / static_cast<double>(this->options_.passes));
      if (flat.empty() || !any)
      {
        if (release)
        {
          break;
        }
        release = true;
      }
      release = release || pass + 4 >= this->options_.passes;
    }
    if (whole && !this->options_.keep_boundary)
    {
      this->drop_lone_tets();
    }
    this->finish();
    return whole;
  }

private:
  Vec3 point(Index v) const { return this->mesh_.points.row(v); }

  /// Smallest dihedral angle; negative when turned over or flat.
  double quality(const Tet& t) const
  {
    const Vec3 a = this->point(t[0]), b = this->point(t[1]), c = this->point(t[2]),
               d = this->point(t[3]);
    return tet_volume(a, b, c, d) > 0.0 ? min_dihedral_angle(a, b, c, d) : -1.0;
  }

  void add(const Tet& tet)
  {
    const auto id = static_cast<Index>(this->tets_.size());
    this->tets_.push_back(tet);
    this->quality_.push_back(this->quality(tet));
    for (const Index v : tet)
    {
      this->at_[v].push_back(id);
    }
  }

  void remove(Index t)
  {
    for (const Index v : this->tets_[t])
    {
      auto& list = this->at_[v];
      list.erase(std::find(list.begin(), list.end(), t));
    }
    this->quality_[t] = gone;
  }

  std::vector<Index> flat_tets(double angle) const
  {
    std::vector<Index> flat;
    for (std::size_t t = 0; t < this->tets_.size(); ++t)
    {
      if (this->quality_[t] < angle)
      {
        flat.push_back(static_cast<Index>(t));
      }
    }
    std::sort(flat.begin(), flat.end(),
      [&](Index a, Index b) {
        return this->quality_[a] != this->quality_[b] ? this->quality_[a] < this->quality_[b]
                                                      : a < b;
      });
    return flat;
  }

  static bool has(const Tet& tet, Index v)
  {
    return std::find(tet.begin(), tet.end(), v) != tet.end();
  }

  std::vector<Index> tets_with(Index a, Index b) const
  {
    std::vector<Index> found;
    for (const Index t : this->at_[a])
    {
      if (has(this->tets_[t], b))
      {
        found.push_back(t);
      }
    }
    return found;
  }

  /// The two other vertices, so that (a, b, first, second) is positive.
  std::pair<Index, Index> others(Index t, Index a, Index b) const
  {
    Tet tet = this->tets_[t];
    int swaps = 0;
    for (int k = 0; k < 2; ++k)
    {
      const Index wanted = k == 0 ? a : b;
      const auto at = std::find(tet.begin(), tet.end(), wanted) - tet.begin();
      if (at != k)
      {
        std::swap(tet[at], tet[k]);
        ++swaps;
      }
    }
    return swaps % 2 == 0 ? std::make_pair(tet[2], tet[3]) : std::make_pair(tet[3], tet[2]);
  }

  /// @return false when the tets at the edge are no single ring, or too many.
  bool find_ring(Index a, Index b, Ring& ring) const
  {
    std::vector<Index> left = this->tets_with(a, b);
    if (left.empty() || left.size() > longest_ring)
    {
      return false;
    }
    std::vector<std::pair<Index, Index>> sides;
    for (const Index t : left)
    {
      sides.push_back(this->others(t, a, b));
    }
    // Start at the side that no other tet ends at, if there is one.
    std::size_t first = 0;
    for (std::size_t i = 0; i < sides.size(); ++i)
    {
      if (std::none_of(sides.begin(), sides.end(),
            [&](const auto& side) { return side.second == sides[i].first; }))
      {
        first = i;
        break;
      }
    }
    ring = Ring();
    ring.vertices.push_back(sides[first].first);
    Index end = sides[first].first;
    for (std::size_t n = 0; n < sides.size(); ++n)
    {
      const auto next = std::find_if(
        sides.begin(), sides.end(), [&](const auto& side) { return side.first == end; });
      if (next == sides.end())
      {
        return false;
      }
      ring.tets.push_back(left[static_cast<std::size_t>(next - sides.begin())]);
      end = next->second;
      if (end == ring.vertices.front())
      {
        ring.closed = true;
        return ring.tets.size() == left.size();
      }
      ring.vertices.push_back(end);
    }
    return true;
  }

  double worst(const std::vector<Index>& tets) const
  {
    double least = 180.0;
    for (const Index t : tets)
    {
      least = std::min(least, this->quality_[t]);
    }
    return least;
  }

  bool improve(Index t)
  {
    const Tet tet = this->tets_[t];
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
    bool any = false;
    for (const Index v : tet)
    {
      any = this->move(v) || any;
    }
    for (int k = 0; k < 16 && !any; ++k)
    {
      any = k / 4 != k % 4 && this->contract(t, tet[k / 4], tet[k % 4]);
    }
    return any;
  }

  // ---- Edges and facets ------------------------------------------------------------------------

  bool remove_edge(Index a, Index b)
  {
    Ring ring;
    if (!this->find_ring(a, b, ring) || (ring.closed && ring.tets.size() < 3))
    {
      return false;
    }
    if (!ring.closed && (this->options_.keep_boundary || !this->may_swap_boundary(a, b, ring)))
    {
      return false;
    }
    const std::vector<Index>& r = ring.vertices;
    const std::size_t n = r.size();
    // best[i][j]: the worst tet of the best triangulation of the polygon r[i] … r[j].
    std::array<std::array<double, longest_ring + 1>, longest_ring + 1> best;
    std::array<std::array<std::size_t, longest_ring + 1>, longest_ring + 1> apex{};
    for (std::size_t i = 0; i + 1 < n; ++i)
    {
      best[i][i + 1] = 180.0;
    }
    for (std::size_t span = 2; span < n; ++span)
    {
      for (std::size_t i = 0; i + span < n; ++i)
      {
        const std::size_t j = i + span;
        best[i][j] = -1.0;
        for (std::size_t k = i + 1; k < j; ++k)
        {
          const double rest = std::min(best[i][k], best[k][j]);
          if (rest <= best[i][j])
          {
            continue;
          }
          const double value = std::min({ rest, this->quality({ r[i], r[k], r[j], b }),
            this->quality({ r[k], r[i], r[j], a }) });
          if (value > best[i][j])
          {
            best[i][j] = value;
            apex[i][j] = k;
          }
        }
      }
    }
    if (best[0][n - 1] <= this->worst(ring.tets) + better)
    {
      return false;
    }
    for (const Index t : ring.tets)
    {
      this->remove(t);
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
      this->add({ r[i], r[k], r[j], b });
      this->add({ r[k], r[i], r[j], a });
      open.emplace_back(i, k);
      open.emplace_back(k, j);
    }
    this->done_.removed_tets += n == 2;
    return true;
  }

  /// The boundary is flat enough at the edge, and its new edge makes it touch itself nowhere.
  bool may_swap_boundary(Index a, Index b, const Ring& ring) const
  {
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
    if (ring.tets.size() == 1)
    {
      Ring opposite;
      return this->find_ring(first, last, opposite) && opposite.closed;
    }
    return this->tets_with(first, last).empty();
  }

  /// The tet on the other side of a facet, -1 on the boundary.
  Index beyond(Index t, Index a, Index b, Index c) const
  {
    for (const Index s : this->at_[a])
    {
      if (s != t && has(this->tets_[s], b) && has(this->tets_[s], c))
      {
        return s;
      }
    }
    return -1;
  }

  bool remove_facet(Index t, Index a, Index b, Index c)
  {
    const Index other = this->beyond(t, a, b, c);
    if (other < 0)
    {
      return false;
    }
    const auto apex = [&](Index s)
    {
      for (const Index v : this->tets_[s])
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
    if (tet_volume(this->point(a), this->point(b), this->point(c), this->point(d)) < 0.0)
    {
      for (Tet& tet : fresh)
      {
        std::swap(tet[0], tet[1]);
      }
    }
    double least = 180.0;
    for (const Tet& tet : fresh)
    {
      least = std::min(least, this->quality(tet));
    }
    if (least <= this->worst({ t, other }) + better || !this->tets_with(d, e).empty())
    {
      return false;
    }
    this->remove(t);
    this->remove(other);
    for (const Tet& tet : fresh)
    {
      this->add(tet);
    }
    return true;
  }

  // ---- Vertices --------------------------------------------------------------------------------

  struct Patch
  {
    bool smooth = true;
    Vec3 normal = Vec3::Zero();
  };

  /// The boundary triangles at v.
  std::vector<std::array<Index, 3>> skin_at(Index v) const
  {
    std::vector<std::array<Index, 3>> skin;
    for (const Index t : this->at_[v])
    {
      const Tet& tet = this->tets_[t];
      for (const auto& f : facet_corners)
      {
        const std::array<Index, 3> facet{ tet[f[0]], tet[f[1]], tet[f[2]] };
        if (std::find(facet.begin(), facet.end(), v) == facet.end() || !this->boundary_[facet[0]] ||
          !this->boundary_[facet[1]] || !this->boundary_[facet[2]])
        {
          continue;
        }
        const auto& list = this->at_[v];
        const bool shared = std::any_of(list.begin(), list.end(),
          [&](Index s)
          {
            return s != t && has(this->tets_[s], facet[0]) && has(this->tets_[s], facet[1]) &&
              has(this->tets_[s], facet[2]);
          });
        if (!shared)
        {
          skin.push_back(facet);
        }
      }
    }
    return skin;
  }

  Patch patch_of(const std::vector<std::array<Index, 3>>& skin) const
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
    if (this->held_[v] && !this->release_)
    {
      return false;
    }
    std::vector<std::array<Index, 3>> skin;
    Patch patch;
    if (this->boundary_[v])
    {
      skin = this->skin_at(v);
      patch = this->patch_of(skin);
      if (!this->surface_ || !patch.smooth)
      {
        return false;
      }
    }
    const Vec3 start = this->point(v);
    double shortest = 1e300;
    for (const Index t : this->at_[v])
    {
      for (const Index w : this->tets_[t])
      {
        if (w != v)
        {
          shortest = std::min(shortest, (this->point(w) - start).norm());
        }
      }
    }
    double value = this->worst(this->at_[v]);
    const double before = value;
    Vec3 at = start;
    constexpr double first_step = 0.3;
    constexpr double last_step = 0.01;
    for (double step = first_step * shortest; step > last_step * shortest;)
    {
      bool found = false;
      for (int k = 0; k < directions_count && !found; ++k)
      {
        Vec3 d = direction(k);
        if (this->boundary_[v])
        {
          d -= d.dot(patch.normal) * patch.normal;
        }
        Vec3 p = at + step * d;
        if (this->boundary_[v] && !this->surface_(p, patch.normal, step))
        {
          continue;
        }
        this->mesh_.points.row(v) = p;
        const double there = this->value_at(v, value + better);
        if (there > value + better && (skin.empty() || this->patch_of(skin).smooth))
        {
          value = there;
          at = p;
          found = true;
        }
      }
      step *= found ? 1.0 : 0.5;
    }
    this->mesh_.points.row(v) = at;
    if (value <= before + better)
    {
      this->mesh_.points.row(v) = start;
      return false;
    }
    for (const Index t : this->at_[v])
    {
      this->quality_[t] = this->quality(this->tets_[t]);
    }
    (this->held_[v] ? this->done_.released_vertices : this->done_.moved_vertices) +=
      !this->moved_[v];
    this->moved_[v] = 1;
    return true;
  }

  /// The worst tet at v; less than `enough` may be any such number.
  double value_at(Index v, double enough) const
  {
    double least = 180.0;
    for (const Index t : this->at_[v])
    {
      least = std::min(least, this->quality(this->tets_[t]));
      if (least < enough)
      {
        break;
      }
    }
    return least;
  }

  // ---- Contraction -----------------------------------------------------------------------------

  /// Vertex a becomes b; the tets at both, t among them, are gone. The others at a become better
  /// than t, or no worse than they were.
  bool contract(Index t, Index a, Index b)
  {
    if (this->held_[a] || (this->boundary_[a] && this->options_.keep_boundary))
    {
      return false;
    }
    const std::vector<Index> old = this->at_[a];
    std::vector<Tet> fresh;
    for (const Index other : old)
    {
      if (has(this->tets_[other], b))
      {
        continue;
      }
      fresh.push_back(this->tets_[other]);
      std::replace(fresh.back().begin(), fresh.back().end(), a, b);
      const double value = this->quality(fresh.back());
      if (!(value > 0.0) || value < std::min(this->quality_[other], this->quality_[t] + better))
      {
        return false;
      }
    }
    const std::vector<std::array<Index, 3>> skin =
      this->boundary_[a] ? this->skin_at(a) : std::vector<std::array<Index, 3>>();
    if (fresh.empty() || !this->keeps_shape(skin, a, b) || !this->keeps_topology(skin, a, b))
    {
      return false;
    }
    for (const Index other : old)
    {
      this->remove(other);
    }
    for (const Tet& tet : fresh)
    {
      this->add(tet);
    }
    ++this->done_.collapsed_edges;
    return true;
  }

  /// No boundary triangle at a turns by more than what is flat when a becomes b; a vertex of a
  /// crease goes along the crease, and where creases meet or end none goes. skin: the boundary
  /// triangles at a.
  bool keeps_shape(const std::vector<std::array<Index, 3>>& skin, Index a, Index b) const
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
  bool keeps_topology(const std::vector<std::array<Index, 3>>& skin, Index a, Index b) const
  {
    const Link link_a = this->link_of(a, skin);
    const Link link_b =
      this->link_of(b, this->boundary_[b] ? this->skin_at(b) : std::vector<std::array<Index, 3>>());
    // Around the edge is a cycle (or more than one, where the boundary touches itself).
    const auto cycle = static_cast<std::ptrdiff_t>(this->tets_with(a, b).size()) +
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

  Link link_of(Index v, const std::vector<std::array<Index, 3>>& skin) const
  {
    constexpr Index outside = -1;
    Link link;
    for (const Index t : this->at_[v])
    {
      Tet tet = this->tets_[t];
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
    const std::vector<Index> flat = this->flat_tets(this->options_.least_angle);
    for (const Index t : flat)
    {
      const Tet& tet = this->tets_[t];
      const bool held =
        std::any_of(tet.begin(), tet.end(), [&](Index v) { return this->held_[v]; });
      const bool alone = std::all_of(std::begin(facet_corners), std::end(facet_corners),
        [&](const auto& f) { return this->beyond(t, tet[f[0]], tet[f[1]], tet[f[2]]) < 0; });
      if (!held && alone)
      {
        this->remove(t);
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

  void finish()
  {
    Index count = 0;
    this->mesh_.tets.resize(static_cast<Index>(this->tets_.size()), 4);
    for (std::size_t t = 0; t < this->tets_.size(); ++t)
    {
      if (this->quality_[t] < gone)
      {
        const Tet& tet = this->tets_[t];
        this->mesh_.tets.row(count++) << tet[0], tet[1], tet[2], tet[3];
      }
    }
    this->mesh_.tets.conservativeResize(count, 4);
  }

  static constexpr double gone = 1e9; ///< quality of a tet that was removed: never too flat

  TetMesh& mesh_;
  std::vector<char> held_;
  const OntoSurface& surface_;
  const ImproveOptions& options_;
  Improvement& done_;
  bool release_ = false;
  std::vector<Tet> tets_;
  std::vector<double> quality_;
  std::vector<std::vector<Index>> at_; ///< tets at each vertex
  std::vector<char> boundary_, moved_;
};
} // namespace

bool improve_tets(TetMesh& mesh, std::vector<char> held, const OntoSurface& surface,
  const ImproveOptions& options, Improvement& done, ExecutionContext& context)
{
  done = Improvement();
  return Improver(mesh, std::move(held), surface, options, done).run(context);
}

} // namespace bindpose
