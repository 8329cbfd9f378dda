#include "inside/tet_complex.h"

#include "base/tet_facets.h"
#include "surface/triangle_predicates.h"

#include <algorithm>
#include <cmath>

namespace bindpose
{

namespace
{
/// Below this quality the sign of a volume in doubles is not trusted: 0.001 degrees.
constexpr double doubtful = 3e-10;
constexpr std::size_t largest_cavity = 128; // tets
} // namespace

TetComplex::TetComplex(TetMesh& mesh)
{
  this->points_.resize(static_cast<std::size_t>(mesh.points.rows()));
  for (Index v = 0; v < mesh.points.rows(); ++v)
  {
    this->points_[v] = mesh.points.row(v);
  }
  this->at_.resize(this->points_.size());
  this->boundary_.resize(this->points_.size(), 0);
  this->stamp_.resize(this->points_.size(), 0);
  const auto tets = static_cast<std::size_t>(mesh.tets.rows());
  this->tets_.reserve(tets);
  this->quality_.reserve(tets);
  this->cavity_.reserve(tets);
  this->site_ids_.reserve(tets);
  this->reached_.reserve(tets);
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

void TetComplex::write(TetMesh& mesh)
{
  mesh.points.resize(this->vertex_count(), 3);
  for (Index v = 0; v < this->vertex_count(); ++v)
  {
    mesh.points.row(v) = this->points_[v];
  }
  Index count = 0;
  mesh.tets.resize(this->count_, 4);
  for (Index t = 0; t < this->tet_ids(); ++t)
  {
    if (this->alive(t))
    {
      const Tet& tet = this->tets_[t];
      mesh.tets.row(count++) << tet[0], tet[1], tet[2], tet[3];
    }
  }
}

double TetComplex::quality_of_angle(double degrees)
{
  constexpr double radians = 0.017453292519943295769;
  const double sine = std::sin(radians * degrees);
  return sine * sine;
}

double TetComplex::volume(const Tet& t) const
{
  return tet_volume(
    this->points_[t[0]], this->points_[t[1]], this->points_[t[2]], this->points_[t[3]]);
}

double TetComplex::quality(const Tet& t) const
{
  ++this->evaluations_;
  const Vec3 &a = this->points_[t[0]], &b = this->points_[t[1]], &c = this->points_[t[2]],
             &d = this->points_[t[3]];
  const Vec3 ab = b - a, ac = c - a, ad = d - a, bc = c - b, bd = d - b;
  const Vec3 nd = ac.cross(ab);
  const double volume = -nd.dot(ad); // six times
  if (!(volume > 0.0))
  {
    return -1.0;
  }
  // Outward normals of the sides, of lengths twice the sides' areas. The sine of the angle between
  // two sides is 6 volume * length of their edge / product of these lengths.
  const Vec3 na = bc.cross(bd), nb = ad.cross(ac), nc = ab.cross(ad);
  const double la = na.squaredNorm(), lb = nb.squaredNorm(), lc = nc.squaredNorm(),
               ld = nd.squaredNorm();
  double least = 1.0;
  const auto add = [&](const Vec3& m, const Vec3& n, double edge, double lengths)
  {
    if (m.dot(n) < 0.0 && !(edge >= least * lengths)) // an acute angle
    {
      least = edge / lengths;
    }
  };
  const double square = volume * volume;
  add(na, nb, square * (d - c).squaredNorm(), la * lb);
  add(na, nc, square * bd.squaredNorm(), la * lc);
  add(na, nd, square * bc.squaredNorm(), la * ld);
  add(nb, nc, square * ad.squaredNorm(), lb * lc);
  add(nb, nd, square * ac.squaredNorm(), lb * ld);
  add(nc, nd, square * ab.squaredNorm(), lc * ld);
  if (!(least >= doubtful) && orientation_3d(a, b, c, d) <= 0)
  {
    return -1.0;
  }
  return least;
}

double TetComplex::worst(const std::vector<Index>& tets) const
{
  double least = 1.0;
  for (const Index t : tets)
  {
    least = std::min(least, this->quality_[t]);
  }
  return least;
}

Index TetComplex::add_vertex(const Vec3& p, bool on_boundary)
{
  this->points_.push_back(p);
  this->at_.emplace_back();
  this->boundary_.push_back(on_boundary ? 1 : 0);
  this->stamp_.push_back(++this->changes_);
  return this->vertex_count() - 1;
}

void TetComplex::drop_last_vertex()
{
  this->points_.pop_back();
  this->at_.pop_back();
  this->boundary_.pop_back();
  this->stamp_.pop_back();
}

void TetComplex::requalify(Index v)
{
  ++this->changes_;
  for (const Index t : this->at_[v])
  {
    this->quality_[t] = this->quality(this->tets_[t]);
    for (const Index w : this->tets_[t])
    {
      this->stamp_[w] = this->changes_;
    }
  }
}

Index TetComplex::add(const Tet& tet)
{
  const Index id = this->tet_ids();
  this->tets_.push_back(tet);
  this->quality_.push_back(this->quality(tet));
  this->cavity_.push_back(0);
  this->site_ids_.push_back(0);
  this->reached_.push_back(0);
  ++this->changes_;
  for (const Index v : tet)
  {
    this->at_[v].push_back(id);
    this->stamp_[v] = this->changes_;
  }
  ++this->count_;
  return id;
}

void TetComplex::remove(Index t)
{
  for (const Index v : this->tets_[t])
  {
    auto& list = this->at_[v];
    list.erase(std::find(list.begin(), list.end(), t));
  }
  this->quality_[t] = gone;
  --this->count_;
}

void TetComplex::tets_with(Index a, Index b, std::vector<Index>& found) const
{
  found.clear();
  const bool swap = this->at_[b].size() < this->at_[a].size();
  const Index other = swap ? a : b;
  for (const Index t : this->at_[swap ? b : a])
  {
    if (has(this->tets_[t], other))
    {
      found.push_back(t);
    }
  }
}

bool TetComplex::has_edge(Index a, Index b) const
{
  const bool swap = this->at_[b].size() < this->at_[a].size();
  const Index other = swap ? a : b;
  const auto& list = this->at_[swap ? b : a];
  return std::any_of(list.begin(), list.end(), [&](Index t) { return has(this->tets_[t], other); });
}

std::pair<Index, Index> TetComplex::others(Index t, Index a, Index b) const
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

bool TetComplex::find_ring(Index a, Index b, Ring& ring) const
{
  std::vector<Index> left;
  this->tets_with(a, b, left);
  if (left.empty() || left.size() > longest_ring)
  {
    return false;
  }
  std::vector<std::pair<Index, Index>> sides;
  sides.reserve(left.size());
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
  ring.tets.clear();
  ring.vertices.clear();
  ring.closed = false;
  ring.vertices.push_back(sides[first].first);
  Index end = sides[first].first;
  for (std::size_t n = 0; n < sides.size(); ++n)
  {
    const auto next =
      std::find_if(sides.begin(), sides.end(), [&](const auto& side) { return side.first == end; });
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

Index TetComplex::beyond(Index t, Index a, Index b, Index c) const
{
  // Look through the shortest list.
  if (this->at_[b].size() < this->at_[a].size())
  {
    std::swap(a, b);
  }
  if (this->at_[c].size() < this->at_[a].size())
  {
    std::swap(a, c);
  }
  for (const Index s : this->at_[a])
  {
    if (s != t && has(this->tets_[s], b) && has(this->tets_[s], c))
    {
      return s;
    }
  }
  return -1;
}

std::vector<TetComplex::Facet> TetComplex::skin_at(Index v) const
{
  std::vector<Facet> skin;
  for (const Index t : this->at_[v])
  {
    const Tet& tet = this->tets_[t];
    for (const auto& f : facet_corners)
    {
      const Facet facet{ tet[f[0]], tet[f[1]], tet[f[2]] };
      if ((facet[0] == v || facet[1] == v || facet[2] == v) && this->boundary_[facet[0]] &&
        this->boundary_[facet[1]] && this->boundary_[facet[2]] &&
        this->beyond(t, facet[0], facet[1], facet[2]) < 0)
      {
        skin.push_back(facet);
      }
    }
  }
  return skin;
}

Index TetComplex::split_edge(Index a, Index b, const Vec3& p)
{
  std::vector<Index> old;
  this->tets_with(a, b, old);
  bool open = false;
  for (const Index t : old)
  {
    const auto [c, d] = this->others(t, a, b);
    open = open || this->beyond(t, a, b, c) < 0 || this->beyond(t, a, b, d) < 0;
  }
  const Index v = this->add_vertex(p, open);
  std::vector<Tet> fresh;
  fresh.reserve(2 * old.size());
  for (const Index t : old)
  {
    for (const Index end : { a, b })
    {
      Tet tet = this->tets_[t];
      std::replace(tet.begin(), tet.end(), end, v);
      if (!(this->quality(tet) > 0.0))
      {
        this->drop_last_vertex();
        return -1;
      }
      fresh.push_back(tet);
    }
  }
  for (const Index t : old)
  {
    this->remove(t);
  }
  for (const Tet& tet : fresh)
  {
    this->add(tet);
  }
  return v;
}

bool TetComplex::in_sphere(const Tet& tet, const Vec3& p) const
{
  const Vec3& a = this->points_[tet[0]];
  const Vec3 u = this->points_[tet[1]] - a, v = this->points_[tet[2]] - a,
             w = this->points_[tet[3]] - a, q = p - a;
  const Vec3 vw = v.cross(w);
  const Vec3 center = u.squaredNorm() * vw + v.squaredNorm() * w.cross(u) +
    w.squaredNorm() * u.cross(v); // times twice the determinant
  return q.squaredNorm() * u.dot(vw) < q.dot(center);
}

bool TetComplex::find_cavity(const Vec3& p, Index start, double least, Cavity& cavity)
{
  this->collect_sphere(p, start, cavity.tets);
  const Index v = this->add_vertex(p, false); // for qualities
  const bool found = this->shrink_cavity(v, start, least, cavity);
  this->drop_last_vertex();
  if (!found)
  {
    return false;
  }
  // The same volume, and no vertex is lost.
  double new_volume = 0.0;
  std::vector<Index> kept;
  for (const Facet& f : cavity.facets)
  {
    new_volume += tet_volume(this->points_[f[0]], this->points_[f[1]], this->points_[f[2]], p);
    kept.insert(kept.end(), f.begin(), f.end());
  }
  std::sort(kept.begin(), kept.end());
  double old_volume = 0.0;
  for (const Index t : cavity.tets)
  {
    old_volume += this->volume(this->tets_[t]);
    for (const Index w : this->tets_[t])
    {
      if (!std::binary_search(kept.begin(), kept.end(), w))
      {
        return false;
      }
    }
  }
  constexpr double rounding = 1e-9;
  return std::abs(new_volume - old_volume) <= rounding * old_volume;
}

TetComplex::Site& TetComplex::site_of(Index t)
{
  return this->sites_[this->site_ids_[t]];
}

void TetComplex::add_site(Index t, std::vector<Index>& tets)
{
  this->cavity_[t] = this->cavities_;
  this->site_ids_[t] = static_cast<Index>(this->sites_.size());
  this->sites_.emplace_back();
  tets.push_back(t);
}

/// The tet beyond facet k of a tet of the cavity.
Index TetComplex::beyond_of_site(Index t, int k)
{
  Index& next = this->site_of(t).beyond[k];
  if (next == Site::unknown)
  {
    const Tet& tet = this->tets_[t];
    const auto& f = facet_corners[k];
    next = this->beyond(t, tet[f[0]], tet[f[1]], tet[f[2]]);
  }
  return next;
}

void TetComplex::collect_sphere(const Vec3& p, Index start, std::vector<Index>& tets)
{
  const Index in = ++this->cavities_;
  this->sites_.clear();
  tets.clear();
  this->add_site(start, tets);
  for (std::size_t i = 0; i < tets.size() && tets.size() < largest_cavity; ++i)
  {
    for (int k = 0; k < 4; ++k)
    {
      const Index next = this->beyond_of_site(tets[i], k);
      if (next >= 0 && this->cavity_[next] != in && this->in_sphere(this->tets_[next], p))
      {
        this->add_site(next, tets);
      }
    }
  }
}

bool TetComplex::shrink_cavity(Index v, Index start, double least, Cavity& cavity)
{
  const Index in = this->cavities_;
  for (;;)
  {
    // Those that facets still join to the start, until one is met that v does not fit to.
    const Index now = ++this->searches_;
    cavity.tets.assign(1, start);
    cavity.facets.clear();
    this->reached_[start] = now;
    Index bad = -1;
    for (std::size_t i = 0; i < cavity.tets.size() && bad < 0; ++i)
    {
      const Index t = cavity.tets[i];
      for (int k = 0; k < 4; ++k)
      {
        const Index next = this->beyond_of_site(t, k);
        if (next >= 0 && this->cavity_[next] == in)
        {
          if (this->reached_[next] != now)
          {
            this->reached_[next] = now;
            cavity.tets.push_back(next);
          }
          continue;
        }
        const Tet& tet = this->tets_[t];
        const auto& f = facet_corners[k];
        const Facet inwards{ tet[f[0]], tet[f[2]], tet[f[1]] };
        double& fit = this->site_of(t).fits[k];
        if (std::isnan(fit))
        {
          fit = this->quality({ inwards[0], inwards[1], inwards[2], v });
        }
        if (fit < least)
        {
          bad = t;
          break;
        }
        cavity.facets.push_back(inwards);
      }
    }
    if (bad < 0 || bad == start)
    {
      return bad < 0;
    }
    this->cavity_[bad] = 0;
  }
}

Index TetComplex::fill_cavity(const Vec3& p, const Cavity& cavity)
{
  const Index v = this->add_vertex(p, false);
  for (const Index t : cavity.tets)
  {
    this->remove(t);
  }
  for (const Facet& f : cavity.facets)
  {
    this->add({ f[0], f[1], f[2], v });
  }
  return v;
}

} // namespace bindpose
