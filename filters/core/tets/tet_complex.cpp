// A tet mesh that is edited in place, with lists of tets per vertex and neighbors per tet.
#include "tets/tet_complex.h"

#include "geometry/tet_facets.h"
#include "surface/triangle_predicates.h"

#include <algorithm>
#include <cmath>

namespace bindpose
{

namespace
{
// If the quality is below this (0.001 degrees), the sign of a volume in doubles is not reliable.
constexpr double unreliable_quality = 3e-10;
// The sign of a volume is also unreliable if q is at most this. Here q is (6 volume)^2, divided by
// the product of the squared lengths of the three edges at one vertex.
constexpr double unreliable_square = 1e-26;
// The largest possible quality is 8/9; larger values are rounding errors.
constexpr double largest_quality = 0.9;
} // namespace

TetComplex::TetComplex(TetMesh& mesh)
{
  this->points_.resize(static_cast<std::size_t>(mesh.points.rows()));
  for (Index v = 0; v < mesh.points.rows(); ++v)
  {
    this->points_[v] = mesh.points.row(v);
  }
  this->vertex_tets_.resize(this->points_.size());
  this->boundary_.resize(this->points_.size(), 0);
  this->stamp_.resize(this->points_.size(), 0);
  const auto tets = static_cast<std::size_t>(mesh.tets.rows());
  this->tets_.reserve(tets);
  this->neighbors_.reserve(tets);
  this->quality_.reserve(tets);
  for (Index t = 0; t < mesh.tets.rows(); ++t)
  {
    this->add({ mesh.tets(t, 0), mesh.tets(t, 1), mesh.tets(t, 2), mesh.tets(t, 3) });
  }
  for (Index t = 0; t < this->tet_id_limit(); ++t)
  {
    for (int k = 0; k < 4; ++k)
    {
      if (this->neighbors_[t][k] < 0)
      {
        for (const int corner : facet_corners[k])
        {
          this->boundary_[this->tets_[t][corner]] = 1;
        }
      }
    }
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
  for (Index t = 0; t < this->tet_id_limit(); ++t)
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

double TetComplex::quality(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
  const Vec3 ab = b - a, ac = c - a, ad = d - a, bc = c - b, bd = d - b;
  const Vec3 nd = ac.cross(ab);
  const double volume = -nd.dot(ad); // six times the volume
  if (!(volume > 0.0))
  {
    return -1.0;
  }
  // Outward normals of the facets, with lengths of twice the areas. The sine of the angle between
  // two facets is 6 volume * (length of their shared edge) / (product of the lengths of the two
  // normals).
  const Vec3 na = bc.cross(bd), nb = ad.cross(ac), nc = ab.cross(ad);
  const double la = na.squaredNorm(), lb = nb.squaredNorm(), lc = nc.squaredNorm(),
               ld = nd.squaredNorm();
  double least = 1.0;
  const auto add = [&](const Vec3& m, const Vec3& n, double edge, double lengths)
  {
    // True if the dihedral angle is acute and its sine is the smallest so far.
    if (m.dot(n) < 0.0 && !(edge >= least * lengths))
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
  // If the sign of the volume is unreliable, the exact and the double-precision volume are tested,
  // as in check_tets().
  const bool is_reliable = least >= unreliable_quality &&
    square > unreliable_square * ab.squaredNorm() * ac.squaredNorm() * ad.squaredNorm();
  if (!is_reliable && (orientation_3d(a, b, c, d) <= 0 || !(tet_volume(a, b, c, d) > 0.0)))
  {
    return -1.0;
  }
  return least <= largest_quality ? least : least_quality;
}

double TetComplex::quality_with(Index t, Index v, const Vec3& p) const
{
  const Tet& tet = this->tets_[t];
  const auto at = [&](int k) -> const Vec3& { return tet[k] == v ? p : this->points_[tet[k]]; };
  return quality(at(0), at(1), at(2), at(3));
}

Index TetComplex::add_vertex(const Vec3& p, bool on_boundary)
{
  this->points_.push_back(p);
  this->vertex_tets_.emplace_back();
  this->boundary_.push_back(on_boundary ? 1 : 0);
  this->stamp_.push_back(++this->changes_);
  return this->vertex_count() - 1;
}

void TetComplex::move(Index v, const Vec3& p)
{
  this->points_[v] = p;
  ++this->changes_;
  for (const Index t : this->vertex_tets_[v])
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
  const Index id = this->tet_id_limit();
  this->tets_.push_back(tet);
  this->quality_.push_back(this->quality(tet));
  this->link_neighbors(id);
  ++this->changes_;
  for (const Index v : tet)
  {
    this->vertex_tets_[v].push_back(id);
    this->stamp_[v] = this->changes_;
  }
  ++this->count_;
  return id;
}

void TetComplex::remove(Index t)
{
  ++this->changes_;
  for (const Index v : this->tets_[t])
  {
    auto& list = this->vertex_tets_[v];
    list.erase(std::find(list.begin(), list.end(), t));
    this->stamp_[v] = this->changes_;
  }
  this->unlink_neighbors(t);
  this->quality_[t] = removed_quality;
  --this->count_;
}

/// Find the neighbors of the last tet, t. The lists of tets per vertex do not contain t yet.
void TetComplex::link_neighbors(Index t)
{
  std::array<Index, 4>& neighbors = this->neighbors_.emplace_back();
  for (int k = 0; k < 4; ++k)
  {
    const auto& f = facet_corners[k];
    Index a = this->tets_[t][f[0]], b = this->tets_[t][f[1]], c = this->tets_[t][f[2]];
    // Search the shortest of the three lists of tets.
    if (this->vertex_tets_[b].size() < this->vertex_tets_[a].size())
    {
      std::swap(a, b);
    }
    if (this->vertex_tets_[c].size() < this->vertex_tets_[a].size())
    {
      std::swap(a, c);
    }
    const std::vector<Index>& list = this->vertex_tets_[a];
    const auto found = std::find_if(list.begin(), list.end(),
      [&](Index s) { return has_vertex(this->tets_[s], b) && has_vertex(this->tets_[s], c); });
    neighbors[k] = found == list.end() ? -1 : *found;
    if (found != list.end())
    {
      this->neighbors_[*found][opposite_corner(this->tets_[*found], a, b, c)] = t;
    }
  }
}

void TetComplex::unlink_neighbors(Index t)
{
  for (const Index neighbor : this->neighbors_[t])
  {
    if (neighbor >= 0)
    {
      std::array<Index, 4>& back = this->neighbors_[neighbor];
      std::replace(back.begin(), back.end(), t, Index(-1));
    }
  }
}

std::vector<Index> TetComplex::compact(Index ids)
{
  std::vector<Index> new_ids(this->tets_.size(), -1);
  Index count = 0;
  for (Index t = 0; t < this->tet_id_limit(); ++t)
  {
    if (this->alive(t))
    {
      this->tets_[count] = this->tets_[t];
      this->neighbors_[count] = this->neighbors_[t];
      this->quality_[count] = this->quality_[t];
      new_ids[t] = count++;
    }
  }
  this->tets_.resize(static_cast<std::size_t>(count));
  this->neighbors_.resize(static_cast<std::size_t>(count));
  this->quality_.resize(static_cast<std::size_t>(count));
  this->tets_.reserve(static_cast<std::size_t>(ids));
  this->neighbors_.reserve(static_cast<std::size_t>(ids));
  this->quality_.reserve(static_cast<std::size_t>(ids));
  for (std::array<Index, 4>& neighbors : this->neighbors_)
  {
    for (Index& t : neighbors)
    {
      t = t >= 0 ? new_ids[t] : -1;
    }
  }
  for (std::vector<Index>& list : this->vertex_tets_)
  {
    for (Index& t : list)
    {
      t = new_ids[t];
    }
  }
  return new_ids;
}

void TetComplex::find_edge_tets(Index a, Index b, std::vector<Index>& found) const
{
  found.clear();
  const bool swap = this->vertex_tets_[b].size() < this->vertex_tets_[a].size();
  const Index other = swap ? a : b;
  for (const Index t : this->vertex_tets_[swap ? b : a])
  {
    if (has_vertex(this->tets_[t], other))
    {
      found.push_back(t);
    }
  }
}

bool TetComplex::has_edge(Index a, Index b) const
{
  const bool swap = this->vertex_tets_[b].size() < this->vertex_tets_[a].size();
  const Index other = swap ? a : b;
  const auto& list = this->vertex_tets_[swap ? b : a];
  return std::any_of(
    list.begin(), list.end(), [&](Index t) { return has_vertex(this->tets_[t], other); });
}

std::pair<Index, Index> TetComplex::opposite_edge(Index t, Index a, Index b) const
{
  Tet tet = this->tets_[t];
  int swaps = 0;
  for (int k = 0; k < 2; ++k)
  {
    const Index vertex = k == 0 ? a : b;
    const auto at = std::find(tet.begin(), tet.end(), vertex) - tet.begin();
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
  this->find_edge_tets(a, b, left);
  if (left.empty() || left.size() > maximum_ring_size)
  {
    return false;
  }
  std::vector<std::pair<Index, Index>> sides;
  sides.reserve(left.size());
  for (const Index t : left)
  {
    sides.push_back(this->opposite_edge(t, a, b));
  }
  // Start at the ring edge whose first vertex is not the end of another ring edge, if there is one.
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

std::vector<TetComplex::Facet> TetComplex::boundary_facets_at(Index v) const
{
  std::vector<Facet> boundary_facets;
  for (const Index t : this->vertex_tets_[v])
  {
    const Tet& tet = this->tets_[t];
    for (int k = 0; k < 4; ++k)
    {
      if (tet[k] != v && this->neighbor_tet(t, k) < 0)
      {
        const auto& f = facet_corners[k];
        boundary_facets.push_back({ tet[f[0]], tet[f[1]], tet[f[2]] });
      }
    }
  }
  return boundary_facets;
}

bool TetComplex::may_split_edge(
  Index a, Index b, const std::vector<Index>& tets, const Vec3& p) const
{
  return std::all_of(tets.begin(), tets.end(),
    [&](Index t)
    { return this->quality_with(t, a, p) > 0.0 && this->quality_with(t, b, p) > 0.0; });
}

Index TetComplex::split_edge(Index a, Index b, const Vec3& p)
{
  std::vector<Index> old_tets;
  this->find_edge_tets(a, b, old_tets);
  if (!this->may_split_edge(a, b, old_tets, p))
  {
    return -1;
  }
  bool open = false;
  for (const Index t : old_tets)
  {
    const auto [c, d] = this->opposite_edge(t, a, b);
    open = open || this->neighbor_across(t, c) < 0 || this->neighbor_across(t, d) < 0;
  }
  const Index v = this->add_vertex(p, open);
  for (const Index t : old_tets)
  {
    const Tet tet = this->tets_[t];
    this->remove(t);
    for (const Index end : { a, b })
    {
      Tet half = tet;
      std::replace(half.begin(), half.end(), end, v);
      this->add(half);
    }
  }
  return v;
}

} // namespace bindpose
