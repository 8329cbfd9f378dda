#include "inside/tet_insertion.h"

#include "base/tet_facets.h"
#include "inside/tet_cavity.h"
#include "inside/tet_complex.h"
#include "surface/triangle_predicates.h"

#include <algorithm>
#include <queue>
#include <tuple>

namespace bindpose
{

namespace
{
using Tet = TetComplex::Tet;

constexpr Index often = 256; // steps after which cancel is looked at

struct LongEdge
{
  double length;
  Index a, b;

  /// Longest first, then by ids.
  bool operator<(const LongEdge& other) const
  {
    return std::tie(this->length, other.a, other.b) < std::tie(other.length, this->a, this->b);
  }
};

class Inserter
{
public:
  explicit Inserter(TetComplex& tets) : tets_(tets), search_(tets) {}

  /// p becomes a vertex: with tets of some thickness, else on an edge that it is on but for
  /// rounding (points of a bone are on one line), else anyhow. @return -1 where nothing helps.
  Index insert(const Vec3& p)
  {
    const Index t = this->locate(p);
    if (t < 0)
    {
      return -1;
    }
    Index v = -1;
    if (this->search_.find(p, t, this->thick_, this->cavity_))
    {
      v = fill_cavity(this->tets_, p, this->cavity_);
    }
    v = v < 0 ? this->split_edge_at(p, t) : v;
    if (v < 0 && this->search_.find(p, t, 0.0, this->cavity_))
    {
      v = fill_cavity(this->tets_, p, this->cavity_);
    }
    this->near_ = v < 0 ? t : this->tets_.tets_at(v).front();
    return v;
  }

private:
  Index split_edge_at(const Vec3& p, Index t)
  {
    const Tet tet = this->tets_.tet(t);
    constexpr double rounding = 1e-9; // of the edge
    for (int i = 0; i < 4; ++i)
    {
      for (int j = 0; j < i; ++j)
      {
        const Vec3& a = this->tets_.point(tet[i]);
        const Vec3 edge = this->tets_.point(tet[j]) - a;
        const double off = edge.cross(p - a).norm() / edge.squaredNorm();
        const bool inside = off < rounding && this->tets_.find_ring(tet[i], tet[j], this->ring_) &&
          this->ring_.closed;
        const Index v = inside ? this->tets_.split_edge(tet[i], tet[j], p) : -1;
        if (v >= 0)
        {
          return v;
        }
      }
    }
    return -1;
  }

  /// The side of tet t behind which p lies, as an index into facet_corners; -1: p is in the tet.
  int side_towards(Index t, const Vec3& p, int first = 0) const
  {
    const Tet& tet = this->tets_.tet(t);
    for (int k = 0; k < 4; ++k)
    {
      const int side = (first + k) % 4;
      const auto& f = facet_corners[side];
      if (orientation_3d(this->tets_.point(tet[f[0]]), this->tets_.point(tet[f[1]]),
            this->tets_.point(tet[f[2]]), p) > 0)
      {
        return side;
      }
    }
    return -1;
  }

  /// The tet that contains p, -1 where none does: from tet to tet towards p, or all are tried where
  /// the boundary is in the way.
  Index locate(const Vec3& p) const
  {
    constexpr int longest = 200;
    Index t = this->near_;
    for (int step = 0; step < longest && t >= 0; ++step)
    {
      const int side =
        this->side_towards(t, p, step); // another first side: no way round in circles
      if (side < 0)
      {
        return t;
      }
      const Tet& tet = this->tets_.tet(t);
      const auto& f = facet_corners[side];
      t = this->tets_.beyond(t, tet[f[0]], tet[f[1]], tet[f[2]]);
    }
    for (t = 0; t < this->tets_.tet_ids(); ++t)
    {
      if (this->tets_.alive(t) && this->side_towards(t, p) < 0)
      {
        return t;
      }
    }
    return -1;
  }

  TetComplex& tets_;
  CavitySearch search_;
  TetCavity cavity_;
  TetComplex::Ring ring_;
  Index near_ = -1; ///< a tet near the last place
  const double thick_ = TetComplex::quality_of_angle(1.0);
};
} // namespace

bool split_long_edges(TetMesh& mesh, double longest, Index most_tets, ExecutionContext& context)
{
  TetComplex tets(mesh);
  std::priority_queue<LongEdge> queue;
  const auto push = [&](Index a, Index b)
  {
    const double length = (tets.point(a) - tets.point(b)).norm();
    if (length > longest)
    {
      queue.push({ length, std::min(a, b), std::max(a, b) });
    }
  };
  for (const Edge& edge : mesh_edges(boundary_triangles(mesh.tets)))
  {
    push(edge.a, edge.b);
  }
  bool whole = true;
  for (Index count = 0; whole && !queue.empty() && tets.tet_count() < most_tets; ++count)
  {
    const LongEdge edge = queue.top();
    queue.pop();
    if (!tets.has_edge(edge.a, edge.b))
    {
      continue; // it was there twice
    }
    const Index v =
      tets.split_edge(edge.a, edge.b, 0.5 * (tets.point(edge.a) + tets.point(edge.b)));
    if (v >= 0)
    {
      for (const TetComplex::Facet& f : tets.skin_at(v))
      {
        for (const Index w : f)
        {
          if (w != v)
          {
            push(v, w);
          }
        }
      }
    }
    whole = count % often != 0 || !context.cancelled();
  }
  tets.write(mesh);
  return whole;
}

bool insert_vertices(
  TetMesh& mesh, const Points& places, std::vector<Index>& vertices, ExecutionContext& context)
{
  TetComplex tets(mesh);
  Inserter inserter(tets);
  vertices.assign(static_cast<std::size_t>(places.rows()), -1);
  bool whole = true;
  for (Index i = 0; i < places.rows() && whole; ++i)
  {
    vertices[i] = inserter.insert(places.row(i));
    if (i % often == 0)
    {
      context.progress(static_cast<double>(i) / static_cast<double>(places.rows()));
      whole = !context.cancelled();
    }
  }
  tets.write(mesh);
  return whole;
}

} // namespace bindpose
