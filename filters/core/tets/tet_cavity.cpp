// Cavities for the insertion of a vertex: the tets whose circumspheres contain it, reduced until
// all new tets are good enough.
#include "tets/tet_cavity.h"

#include "geometry/tet_facets.h"

#include <algorithm>

namespace bindpose
{

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

bool CavitySearch::find(const Vec3& p, Index start, double minimum_quality, TetCavity& cavity)
{
  const auto tets = static_cast<std::size_t>(this->tets_.tet_id_limit());
  this->cavity_.resize(tets, 0);
  this->collected_.resize(tets, 0);
  if (!this->collect_sphere(p, start, minimum_quality) || !this->shrink(p, start, minimum_quality))
  {
    return false;
  }
  this->collect_connected(start, cavity);
  return this->preserves_volume(p, cavity);
}

bool CavitySearch::is_in_sphere(const Tet& tet, const Vec3& p) const
{
  const Vec3& a = this->tets_.point(tet[0]);
  const Vec3 u = this->tets_.point(tet[1]) - a, v = this->tets_.point(tet[2]) - a,
             w = this->tets_.point(tet[3]) - a, q = p - a;
  const Vec3 vw = v.cross(w);
  const Vec3 center = u.squaredNorm() * vw + v.squaredNorm() * w.cross(u) +
    // Circumcenter relative to a, multiplied by 2 det(u, v, w).
    w.squaredNorm() * u.cross(v);
  return q.squaredNorm() * u.dot(vw) < q.dot(center);
}

void CavitySearch::add(Index t)
{
  this->cavity_[t] = this->searches_;
  this->collected_[t] = static_cast<Index>(this->qualities_.size());
  this->qualities_.push_back({ NAN, NAN, NAN, NAN });
  this->queue_.push_back(t);
}

/// Collect the tets around `start`, connected by facets, whose circumspheres contain p. @return
/// false if the new tet on a facet of `start` that bounds the cavity is below minimum_quality.
bool CavitySearch::collect_sphere(const Vec3& p, Index start, double minimum_quality)
{
  ++this->searches_;
  this->qualities_.clear();
  this->queue_.clear();
  this->add(start);
  for (std::size_t i = 0; i < this->queue_.size(); ++i)
  {
    for (int k = 0; k < 4; ++k)
    {
      const Index next = this->tets_.neighbor_tet(this->queue_[i], k);
      if (this->is_in_cavity(next))
      {
        continue;
      }
      if (next >= 0 && this->is_in_sphere(this->tets_.tet(next), p))
      {
        this->add(next);
        ++this->evaluations_;
      }
      else if (i == 0 && !this->facet_fits(p, start, k, minimum_quality))
      {
        return false;
      }
    }
  }
  return true;
}

bool CavitySearch::facet_fits(const Vec3& p, Index t, int k, double minimum_quality)
{
  double& fit = this->qualities_[this->collected_[t]][k];
  if (std::isnan(fit))
  {
    ++this->evaluations_;
    const Facet f = this->facet_inwards(t, k);
    fit = TetComplex::quality(
      this->tets_.point(f[0]), this->tets_.point(f[1]), this->tets_.point(f[2]), p);
  }
  return fit >= minimum_quality;
}

/// Return facet k of a tet, oriented as seen from inside the tet.
CavitySearch::Facet CavitySearch::facet_inwards(Index t, int k) const
{
  const Tet& tet = this->tets_.tet(t);
  const auto& f = facet_corners[k];
  return { tet[f[0]], tet[f[2]], tet[f[1]] };
}

/// Remove tets of the cavity until p and every facet that bounds the cavity form a tet of at least
/// `minimum_quality`. If a facet does not satisfy this condition, remove its tet and check the
/// neighbors of the removed tet again. @return false if `start` would have to be removed.
bool CavitySearch::shrink(const Vec3& p, Index start, double minimum_quality)
{
  for (std::size_t next = 0; next < this->queue_.size(); ++next)
  {
    const Index t = this->queue_[next];
    if (!this->is_in_cavity(t))
    {
      continue;
    }
    for (int k = 0; k < 4; ++k)
    {
      if (this->is_in_cavity(this->tets_.neighbor_tet(t, k)) ||
        this->facet_fits(p, t, k, minimum_quality))
      {
        continue;
      }
      if (t == start)
      {
        return false;
      }
      this->cavity_[t] = 0;
      for (int other = 0; other < 4; ++other)
      {
        const Index neighbor = this->tets_.neighbor_tet(t, other);
        if (this->is_in_cavity(neighbor))
        {
          this->queue_.push_back(neighbor);
        }
      }
      break;
    }
  }
  return true;
}

/// Collect the tets of the cavity that are connected to the tet `start`.
void CavitySearch::collect_connected(Index start, TetCavity& cavity)
{
  const Index reached_mark = -this->searches_;
  cavity.tets.assign(1, start);
  cavity.facets.clear();
  this->cavity_[start] = reached_mark;
  for (std::size_t i = 0; i < cavity.tets.size(); ++i)
  {
    const Index t = cavity.tets[i];
    for (int k = 0; k < 4; ++k)
    {
      const Index next = this->tets_.neighbor_tet(t, k);
      if (this->is_in_cavity(next))
      {
        this->cavity_[next] = reached_mark;
        cavity.tets.push_back(next);
      }
      else if (next < 0 || this->cavity_[next] != reached_mark)
      {
        cavity.facets.push_back(this->facet_inwards(t, k));
      }
    }
  }
}

/// Report whether the new tets fill the same volume as the cavity and use all its vertices.
bool CavitySearch::preserves_volume(const Vec3& p, const TetCavity& cavity) const
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
