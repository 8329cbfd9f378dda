#include "inside/tet_cavity.h"

#include "base/tet_facets.h"

#include <algorithm>

namespace bindpose
{

namespace
{
// Tets. Where all vertices of a surface lie on one quadric, its first tets are all in one cavity:
// with smaller ones slivers would stay.
constexpr std::size_t largest_cavity = 6000;
} // namespace

Index fill_cavity(TetComplex& tets, const Vec3& p, const TetCavity& cavity)
{
  const Index v = tets.add_vertex(p, false);
  for (const Index t : cavity.tets)
  {
    tets.remove(t);
  }
  for (const TetComplex::Facet& f : cavity.facets)
  {
    tets.add({ f[0], f[1], f[2], v });
  }
  return v;
}

bool CavitySearch::find(const Vec3& p, Index start, double least, TetCavity& cavity)
{
  const auto tets = static_cast<std::size_t>(this->tets_.tet_ids());
  this->cavity_.resize(tets, 0);
  this->site_ids_.resize(tets, 0);
  this->reached_.resize(tets, 0);
  this->collect_sphere(p, start, cavity.tets);
  return this->shrink(p, start, least, cavity) && this->keeps_all(p, cavity);
}

bool CavitySearch::in_sphere(const Tet& tet, const Vec3& p) const
{
  const Vec3& a = this->tets_.point(tet[0]);
  const Vec3 u = this->tets_.point(tet[1]) - a, v = this->tets_.point(tet[2]) - a,
             w = this->tets_.point(tet[3]) - a, q = p - a;
  const Vec3 vw = v.cross(w);
  const Vec3 center = u.squaredNorm() * vw + v.squaredNorm() * w.cross(u) +
    w.squaredNorm() * u.cross(v); // times twice the determinant
  return q.squaredNorm() * u.dot(vw) < q.dot(center);
}

void CavitySearch::add_site(Index t, std::vector<Index>& tets)
{
  this->cavity_[t] = this->searches_;
  this->site_ids_[t] = static_cast<Index>(this->sites_.size());
  this->sites_.emplace_back();
  tets.push_back(t);
}

/// The tet beyond facet k of a tet of the cavity.
Index CavitySearch::beyond_of_site(Index t, int k)
{
  Index& next = this->site_of(t).beyond[k];
  if (next == Site::unknown)
  {
    const Tet& tet = this->tets_.tet(t);
    const auto& f = facet_corners[k];
    next = this->tets_.beyond(t, tet[f[0]], tet[f[1]], tet[f[2]]);
  }
  return next;
}

void CavitySearch::collect_sphere(const Vec3& p, Index start, std::vector<Index>& tets)
{
  const Index in = ++this->searches_;
  this->sites_.clear();
  tets.clear();
  this->add_site(start, tets);
  for (std::size_t i = 0; i < tets.size() && tets.size() < largest_cavity; ++i)
  {
    for (int k = 0; k < 4; ++k)
    {
      const Index next = this->beyond_of_site(tets[i], k);
      if (next >= 0 && this->cavity_[next] != in && this->in_sphere(this->tets_.tet(next), p))
      {
        this->add_site(next, tets);
      }
    }
  }
}

bool CavitySearch::shrink(const Vec3& p, Index start, double least, TetCavity& cavity)
{
  const Index in = this->searches_;
  for (;;)
  {
    // Collect the tets still connected to the start. A tet with a facet that makes too flat a tet
    // with p leaves the cavity.
    const Index now = ++this->walks_;
    cavity.tets.assign(1, start);
    cavity.facets.clear();
    this->reached_[start] = now;
    bool whole = true;
    for (std::size_t i = 0; i < cavity.tets.size(); ++i)
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
        const Tet& tet = this->tets_.tet(t);
        const auto& f = facet_corners[k];
        const Facet inwards{ tet[f[0]], tet[f[2]], tet[f[1]] };
        double& fit = this->site_of(t).fits[k];
        if (std::isnan(fit))
        {
          ++this->evaluations_;
          fit = TetComplex::quality(this->tets_.point(inwards[0]), this->tets_.point(inwards[1]),
            this->tets_.point(inwards[2]), p);
        }
        if (fit < least)
        {
          if (t == start)
          {
            return false;
          }
          this->cavity_[t] = 0;
          whole = false;
          break;
        }
        cavity.facets.push_back(inwards);
      }
    }
    if (whole)
    {
      return true;
    }
  }
}

/// The new tets fill the same volume, and no vertex is lost.
bool CavitySearch::keeps_all(const Vec3& p, const TetCavity& cavity) const
{
  double new_volume = 0.0;
  std::vector<Index> kept;
  for (const Facet& f : cavity.facets)
  {
    new_volume +=
      tet_volume(this->tets_.point(f[0]), this->tets_.point(f[1]), this->tets_.point(f[2]), p);
    kept.insert(kept.end(), f.begin(), f.end());
  }
  std::sort(kept.begin(), kept.end());
  double old_volume = 0.0;
  for (const Index t : cavity.tets)
  {
    old_volume += this->tets_.volume(this->tets_.tet(t));
    for (const Index w : this->tets_.tet(t))
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

} // namespace bindpose
