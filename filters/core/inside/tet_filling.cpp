#include "inside/tet_filling.h"

#include "base/tet_facets.h"
#include "inside/tet_complex.h"
#include "inside/tet_quality.h"
#include "surface/triangle_predicates.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace bindpose
{

namespace
{
using Tet = TetComplex::Tet;
using Facet = TetComplex::Facet;

/// A tet is split when it is larger than a regular one with edges of the wanted length, times this.
constexpr double largest_volume = 1.0;
/// Distances of a new vertex from others and from the boundary, by the wanted length.
constexpr double least_spacing = 0.6;
constexpr double least_height = 0.35;
/// Heights at which vertices are put in front of a boundary triangle that hides the circumcenter.
constexpr double good_height = 0.6;

class Filler
{
public:
  Filler(TetMesh& mesh, const SizingField& sizes, const FillOptions& options, Filling& done,
    ExecutionContext& context)
    : mesh_(mesh), tets_(mesh), field_(sizes), options_(options), done_(done), context_(context),
      first_new_(mesh.points.rows())
  {
    this->sizes_.resize(static_cast<std::size_t>(this->first_new_), 0.0);
    for (Index v = 0; v < this->first_new_; ++v)
    {
      if (!this->tets_.tets_at(v).empty())
      {
        this->sizes_[v] = this->field_.at(this->tets_.point(v));
      }
    }
  }

  bool run()
  {
    this->insert_required();
    bool whole =
      this->split_boundary(this->options_.longest_boundary_edge, this->options_.most_tets);
    whole = whole && this->refine(this->options_.most_tets);
    if (whole && this->tets_.tet_count() < this->options_.fewest_tets)
    {
      whole = this->refine_evenly();
    }
    whole = whole && this->smooth();
    this->tets_.write(this->mesh_);
    return whole;
  }

private:
  const Vec3& point(Index v) const { return this->tets_.point(v); }

  Vec3 center_of(const Tet& tet) const
  {
    return 0.25 *
      (this->point(tet[0]) + this->point(tet[1]) + this->point(tet[2]) + this->point(tet[3]));
  }

  /// The wanted length at p as seen from the vertices of a tet.
  double size_at(const Vec3& p, const Tet& tet) const
  {
    double size = this->largest_size_;
    for (const Index v : tet)
    {
      size = std::min(size, this->sizes_[v] + this->field_.growth() * (p - this->point(v)).norm());
    }
    return size;
  }

  void set_size(Index v)
  {
    this->sizes_.resize(static_cast<std::size_t>(this->tets_.vertex_count()), 0.0);
    this->sizes_[v] = std::min(this->field_.at(this->point(v)), this->largest_size_);
  }

  // ---- Points that must become vertices --------------------------------------------------------

  void insert_required()
  {
    TetComplex::Cavity cavity;
    Index hint = -1;
    for (Index i = 0; i < this->options_.required.rows(); ++i)
    {
      const Vec3 p = this->options_.required.row(i);
      const Index t = this->locate(p, hint);
      Index v = -1;
      if (t >= 0)
      {
        v = this->insert_at(p, t, cavity);
      }
      if (v >= 0)
      {
        this->set_size(v);
        hint = this->tets_.tets_at(v).front();
      }
      this->done_.required.push_back(v);
    }
    this->first_free_ = this->tets_.vertex_count();
  }

  /// p, in tet t, becomes a vertex: with tets of some thickness, else on an edge that it is on but
  /// for rounding (points of a bone are on one line), else anyhow. @return -1 where nothing helps.
  Index insert_at(const Vec3& p, Index t, TetComplex::Cavity& cavity)
  {
    if (this->tets_.find_cavity(p, t, this->least_new_quality_, cavity))
    {
      return this->tets_.fill_cavity(p, cavity);
    }
    const Tet tet = this->tets_.tet(t);
    constexpr double rounding = 1e-9; // of the edge
    for (int i = 0; i < 4; ++i)
    {
      for (int j = 0; j < i; ++j)
      {
        const Vec3& a = this->point(tet[i]);
        const Vec3 edge = this->point(tet[j]) - a;
        const double off = edge.cross(p - a).norm() / edge.squaredNorm();
        const Index v = off < rounding && this->is_inside(tet[i], tet[j])
          ? this->tets_.split_edge(tet[i], tet[j], p)
          : -1;
        if (v >= 0)
        {
          return v;
        }
      }
    }
    return this->tets_.find_cavity(p, t, 0.0, cavity) ? this->tets_.fill_cavity(p, cavity) : -1;
  }

  /// The tets around the edge close up.
  bool is_inside(Index a, Index b)
  {
    return this->tets_.find_ring(a, b, this->ring_) && this->ring_.closed;
  }

  bool contains(Index t, const Vec3& p) const
  {
    const Tet& tet = this->tets_.tet(t);
    for (const auto& f : facet_corners)
    {
      if (orientation_3d(
            this->point(tet[f[0]]), this->point(tet[f[1]]), this->point(tet[f[2]]), p) > 0)
      {
        return false;
      }
    }
    return true;
  }

  Index locate(const Vec3& p, Index hint) const
  {
    if (hint >= 0)
    {
      Facet hit{};
      Vec3 at;
      const Index t = this->walk(hint, p, hit, at);
      if (t >= 0 && this->contains(t, p))
      {
        return t;
      }
    }
    for (Index t = 0; t < this->tets_.tet_ids(); ++t)
    {
      if (this->tets_.alive(t) && this->contains(t, p))
      {
        return t;
      }
    }
    return -1;
  }

  /// Straight from the center of tet t to p. @return the tet at p, or -1 if a boundary facet `hit`
  /// is in the way at point `at`, or the way is too long (then hit[0] is -1).
  Index walk(Index t, const Vec3& p, Facet& hit, Vec3& at) const
  {
    const Vec3 start = this->center_of(this->tets_.tet(t));
    hit[0] = -1;
    Index from = -1;
    constexpr int longest = 100;
    for (int step = 0; step < longest; ++step)
    {
      const Tet& tet = this->tets_.tet(t);
      double first = 1.0;
      int side = -1;
      Index next = -1;
      for (int k = 0; k < 4; ++k)
      {
        const auto& f = facet_corners[k];
        const Vec3& a = this->point(tet[f[0]]);
        const Vec3 n = (this->point(tet[f[1]]) - a).cross(this->point(tet[f[2]]) - a);
        const double here = n.dot(start - a);
        const double there = n.dot(p - a);
        if (!(there > 0.0) || !(there > here))
        {
          continue;
        }
        const double when = std::max(here / (here - there), 0.0);
        if (when < first)
        {
          const Index beyond = this->tets_.beyond(t, tet[f[0]], tet[f[1]], tet[f[2]]);
          if (beyond >= 0 && beyond == from)
          {
            continue; // not back
          }
          first = when;
          side = k;
          next = beyond;
        }
      }
      if (side < 0)
      {
        return t;
      }
      if (next < 0)
      {
        const auto& f = facet_corners[side];
        hit = { tet[f[0]], tet[f[1]], tet[f[2]] };
        at = start + first * (p - start);
        return -1;
      }
      from = t;
      t = next;
    }
    return -1;
  }

  // ---- Edges of the boundary -------------------------------------------------------------------

  struct LongEdge
  {
    double length;
    Index a, b;
    bool operator<(const LongEdge& other) const
    {
      return this->length != other.length
        ? this->length < other.length
        : std::make_pair(this->a, this->b) > std::make_pair(other.a, other.b);
    }
  };

  /// Splits edges of the boundary that are longer than `longest` in the middle, longest first.
  bool split_boundary(double longest, Index most_tets)
  {
    if (!(longest > 0.0))
    {
      return true;
    }
    std::priority_queue<LongEdge> queue;
    const auto push = [&](Index a, Index b)
    {
      const double length = (this->point(a) - this->point(b)).norm();
      if (length > longest)
      {
        queue.push({ length, std::min(a, b), std::max(a, b) });
      }
    };
    for (Index t = 0; t < this->tets_.tet_ids(); ++t)
    {
      if (!this->tets_.alive(t))
      {
        continue;
      }
      const Tet& tet = this->tets_.tet(t);
      for (const auto& f : facet_corners)
      {
        if (this->tets_.beyond(t, tet[f[0]], tet[f[1]], tet[f[2]]) < 0)
        {
          for (int k = 0; k < 3; ++k)
          {
            if (tet[f[k]] < tet[f[(k + 1) % 3]])
            {
              push(tet[f[k]], tet[f[(k + 1) % 3]]);
            }
          }
        }
      }
    }
    for (Index count = 0; !queue.empty() && this->tets_.tet_count() < most_tets; ++count)
    {
      const LongEdge edge = queue.top();
      queue.pop();
      constexpr Index often = 256;
      if (count % often == 0 && this->context_.cancelled())
      {
        return false;
      }
      if (!this->tets_.has_edge(edge.a, edge.b))
      {
        continue; // it was there twice
      }
      const Index v =
        this->tets_.split_edge(edge.a, edge.b, 0.5 * (this->point(edge.a) + this->point(edge.b)));
      if (v < 0)
      {
        continue;
      }
      this->set_size(v);
      ++this->done_.boundary_vertices;
      for (const Facet& f : this->tets_.skin_at(v))
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
    return true;
  }

  /// The same length everywhere, so that there are enough tets.
  bool refine_evenly()
  {
    double volume = 0.0;
    for (Index t = 0; t < this->tets_.tet_ids(); ++t)
    {
      volume += this->tets_.alive(t) ? this->tets_.volume(this->tets_.tet(t)) : 0.0;
    }
    const auto wanted = static_cast<double>(this->options_.fewest_tets);
    this->largest_size_ = std::cbrt(volume / (wanted * regular_tet_volume * largest_volume));
    for (double& size : this->sizes_)
    {
      size = std::min(size, this->largest_size_);
    }
    constexpr double longest = 2.0;
    constexpr double share = 0.6; // of the tets for the boundary
    return this->split_boundary(
             longest * this->largest_size_, static_cast<Index>(share * wanted)) &&
      this->refine(this->options_.fewest_tets);
  }

  // ---- Vertices inside -------------------------------------------------------------------------

  struct LargeTet
  {
    double size;
    Index tet;
    bool operator<(const LargeTet& other) const
    {
      return this->size != other.size ? this->size < other.size : this->tet > other.tet;
    }
  };

  /// Volume by the wanted one; larger than 1 where a vertex is wanted.
  double relative_size(Index t) const
  {
    const Tet& tet = this->tets_.tet(t);
    const double size = this->size_at(this->center_of(tet), tet);
    return this->tets_.volume(tet) / (largest_volume * regular_tet_volume * size * size * size);
  }

  bool refine(Index most_tets)
  {
    std::priority_queue<LargeTet> queue;
    const auto push = [&](Index t)
    {
      const double size = this->relative_size(t);
      if (size > 1.0)
      {
        queue.push({ size, t });
      }
    };
    for (Index t = 0; t < this->tets_.tet_ids(); ++t)
    {
      if (this->tets_.alive(t))
      {
        push(t);
      }
    }
    TetComplex::Cavity cavity;
    for (Index count = 0; !queue.empty() && this->tets_.tet_count() < most_tets; ++count)
    {
      const Index t = queue.top().tet;
      queue.pop();
      constexpr Index often = 256;
      if (count % often == 0)
      {
        if (this->context_.cancelled())
        {
          return false;
        }
        this->context_.progress(std::min(
          1.0, static_cast<double>(this->tets_.tet_count()) / static_cast<double>(most_tets)));
      }
      Vec3 p;
      if (!this->tets_.alive(t) || !this->find_place(t, p, cavity))
      {
        continue;
      }
      const Index v = this->tets_.fill_cavity(p, cavity);
      this->set_size(v);
      ++this->done_.inner_vertices;
      for (const Index s : this->tets_.tets_at(v))
      {
        push(s);
      }
    }
    return true;
  }

  /// Finds the place of a new vertex for a tet that is too large, and the tets that it replaces.
  bool find_place(Index t, Vec3& p, TetComplex::Cavity& cavity)
  {
    const Tet tet = this->tets_.tet(t);
    p = this->circumcenter(tet);
    Facet hit{};
    Vec3 at;
    Index s = p.allFinite() ? this->walk(t, p, hit, at) : -1;
    if (s < 0 && p.allFinite() && hit[0] >= 0)
    {
      p = at - good_height * this->size_at(at, tet) * this->normal_of(hit);
      s = this->walk(t, p, hit, at);
    }
    if (s >= 0 && this->fits(p, s, cavity))
    {
      return true;
    }
    p = this->center_of(tet);
    return this->fits(p, t, cavity);
  }

  Vec3 normal_of(const Facet& f) const
  {
    const Vec3& a = this->point(f[0]);
    return (this->point(f[1]) - a).cross(this->point(f[2]) - a).normalized();
  }

  Vec3 circumcenter(const Tet& tet) const
  {
    const Vec3& a = this->point(tet[0]);
    const Vec3 u = this->point(tet[1]) - a, v = this->point(tet[2]) - a,
               w = this->point(tet[3]) - a;
    const Vec3 vw = v.cross(w);
    return a +
      (u.squaredNorm() * vw + v.squaredNorm() * w.cross(u) + w.squaredNorm() * u.cross(v)) /
      (2.0 * u.dot(vw));
  }

  /// p, in tet s, is far enough from all vertices and from the boundary; moved away from the
  /// boundary once if need be. Fills the cavity.
  bool fits(Vec3& p, Index s, TetComplex::Cavity& cavity)
  {
    for (int attempt = 0; attempt < 2; ++attempt)
    {
      if (!this->tets_.find_cavity(p, s, this->least_new_quality_, cavity))
      {
        return false;
      }
      const double size = this->size_at(p, this->tets_.tet(s));
      double nearest = std::numeric_limits<double>::infinity();
      Facet below{};
      for (std::size_t i = 0; i < cavity.facets.size(); ++i)
      {
        const Facet& f = cavity.facets[i];
        for (const Index v : f)
        {
          if ((this->point(v) - p).norm() < least_spacing * size)
          {
            return false;
          }
        }
        if (cavity.on_boundary[i])
        {
          const double distance =
            (closest_point(p, this->point(f[0]), this->point(f[1]), this->point(f[2])) - p).norm();
          if (distance < nearest)
          {
            nearest = distance;
            below = f;
          }
        }
      }
      if (nearest >= least_height * size)
      {
        return true;
      }
      p += (good_height * size - nearest) * this->normal_of(below); // facets face the cavity
      Facet hit{};
      Vec3 at;
      s = this->walk(s, p, hit, at);
      if (s < 0)
      {
        return false;
      }
    }
    return false;
  }

  // ---- Smoothing -------------------------------------------------------------------------------

  /// Moves new vertices inside to the center of gravity of their tets where that does not make the
  /// flattest of these flatter.
  bool smooth()
  {
    constexpr int sweeps = 3;
    const double good = TetComplex::quality_of_angle(20.0); // good enough to be made worse
    for (int sweep = 0; sweep < sweeps; ++sweep)
    {
      if (this->context_.cancelled())
      {
        return false;
      }
      for (Index v = this->first_free_; v < this->tets_.vertex_count(); ++v)
      {
        if (this->tets_.on_boundary(v) || this->tets_.tets_at(v).empty())
        {
          continue;
        }
        Vec3 sum = Vec3::Zero();
        double weight = 0.0;
        for (const Index t : this->tets_.tets_at(v))
        {
          const double volume = this->tets_.volume(this->tets_.tet(t));
          sum += volume * this->center_of(this->tets_.tet(t));
          weight += volume;
        }
        const Vec3 old = this->point(v);
        const double least = std::min(this->tets_.worst(this->tets_.tets_at(v)), good);
        this->tets_.set_point(v, sum / weight);
        const auto& at = this->tets_.tets_at(v);
        if (std::all_of(at.begin(), at.end(),
              [&](Index t) { return this->tets_.quality(this->tets_.tet(t)) >= least; }))
        {
          this->tets_.requalify(v);
        }
        else
        {
          this->tets_.set_point(v, old);
        }
      }
    }
    return true;
  }

  /// A new vertex makes no tet worse than this.
  const double least_new_quality_ = TetComplex::quality_of_angle(1.0);

  TetMesh& mesh_;
  TetComplex tets_;
  const SizingField& field_;
  const FillOptions& options_;
  Filling& done_;
  ExecutionContext& context_;
  Index first_new_; ///< vertices of the input come before
  Index first_free_ = 0; ///< vertices from here on may move, but those of the boundary
  std::vector<double> sizes_; ///< per vertex: the wanted length
  double largest_size_ = std::numeric_limits<double>::infinity();
  TetComplex::Ring ring_;
};
} // namespace

bool fill_tets(TetMesh& mesh, const SizingField& sizes, const FillOptions& options, Filling& done,
  ExecutionContext& context)
{
  done = Filling();
  return Filler(mesh, sizes, options, done, context).run();
}

} // namespace bindpose
