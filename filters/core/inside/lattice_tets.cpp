// Isosurface stuffing of a body-centered cubic lattice (Labelle and Shewchuk 2007).
//
// Lattice vertices are numbered: the corners first (x fastest), then the centers. All loops run in
// the order of the ids, so results are the same for any number of threads.
//
// Stuffing:
// 1. Label each lattice vertex + if it is inside, else -.
// 2. Find the cut point of each edge between + and - by bisection. Winding numbers jump at the
//    surface, so no faster method is safe.
// 3. If a cut point is nearer to a vertex than alpha times the edge length, move the vertex to the
//    cut point and label it 0.
// 4. Keep each tet with a + vertex and no - vertex. If a tet has both + and - vertices, keep the
//    part at the + vertices, with cut points instead of the - vertices. If this part has a
//    quadrilateral on a face, both tets at the face must divide the quadrilateral along the same
//    diagonal: see diagonal_at_first().
#include "inside/lattice_tets.h"

#include "base/parallel.h"
#include "tets/tet_quality.h"

#include <algorithm>
#include <cmath>

namespace bindpose
{

namespace
{
using Tet = std::array<Index, 4>;
using LatticeEdge = std::pair<Index, Index>;

// The largest distances, in edge lengths, at which a vertex moves to a cut point. With these
// distances, all dihedral angles are above 10.78 degrees (Labelle and Shewchuk, table 1).
constexpr double alpha_long = 0.24999;
constexpr double alpha_short = 0.41189;

class Numbering
{
public:
  explicit Numbering(const Lattice& lattice) : lattice_(lattice)
  {
    for (int k = 0; k < 3; ++k)
    {
      this->size_[k] = lattice.cubes[k] + 1;
    }
    this->corners_ = this->size_[0] * this->size_[1] * this->size_[2];
    this->vertices_ = this->corners_ + lattice.cubes[0] * lattice.cubes[1] * lattice.cubes[2];
  }
  Index corner(Index i, Index j, Index k) const
  {
    return (k * this->size_[1] + j) * this->size_[0] + i;
  }
  Index center(Index i, Index j, Index k) const
  {
    return this->corners_ + (k * this->lattice_.cubes[1] + j) * this->lattice_.cubes[0] + i;
  }
  Index vertices() const { return this->vertices_; }
  Index corners() const { return this->corners_; }
  bool is_center(Index v) const { return v >= this->corners_; }

  std::array<Index, 3> position(Index v) const
  {
    const bool center = this->is_center(v);
    Index rest = center ? v - this->corners_ : v;
    const Index nx = center ? this->lattice_.cubes[0] : this->size_[0];
    const Index ny = center ? this->lattice_.cubes[1] : this->size_[1];
    const Index i = rest % nx;
    rest /= nx;
    return { i, rest % ny, rest / ny };
  }
  Vec3 point(Index v) const
  {
    const auto location = this->position(v);
    const double shift = this->is_center(v) ? 0.5 : 0.0;
    return this->lattice_.origin +
      this->lattice_.spacing * Vec3(location[0] + shift, location[1] + shift, location[2] + shift);
  }
  /// Return the parity of a vertex. The two ends of a long edge have different parities.
  bool is_even(Index v) const
  {
    const auto location = this->position(v);
    return (location[0] + location[1] + location[2]) % 2 == 0;
  }
  /// Report whether an edge is long: it joins two corners or two centers and its length is 1. An
  /// edge between a corner and a center is short; its length is sqrt(3)/2.
  bool is_long(Index v, Index w) const { return this->is_center(v) == this->is_center(w); }

  /// Call visit(tet) for the tets between cube (i, j, k) and the next cube along each of the three
  /// axes. The first two vertices of a tet are centers, the last two are corners.
  template <typename Visitor>
  void tets_of_cube(Index i, Index j, Index k, const Visitor& visit) const
  {
    const std::array<Index, 3> location{ i, j, k };
    for (int axis = 0; axis < 3; ++axis)
    {
      if (location[axis] + 1 >= this->lattice_.cubes[axis])
      {
        continue;
      }
      std::array<Index, 3> next = location;
      next[axis] += 1;
      const Index c0 = this->center(location[0], location[1], location[2]);
      const Index c1 = this->center(next[0], next[1], next[2]);
      const int u = (axis + 1) % 3;
      const int v = (axis + 2) % 3;
      // The corners of the face, counter-clockwise seen from the upper cube.
      constexpr int ring[4][2] = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } };
      std::array<Index, 4> corners{};
      for (int r = 0; r < 4; ++r)
      {
        std::array<Index, 3> c = next;
        c[u] += ring[r][0];
        c[v] += ring[r][1];
        corners[r] = this->corner(c[0], c[1], c[2]);
      }
      for (int r = 0; r < 4; ++r)
      {
        visit(Tet{ c0, c1, corners[r], corners[(r + 1) % 4] });
      }
    }
  }

  /// Collect all tets for which keep() returns true, in order.
  template <typename Keep>
  bool collect_tets(ExecutionContext& context, const Keep& keep, std::vector<Tet>& tets) const
  {
    const auto& n = this->lattice_.cubes;
    std::vector<std::vector<Tet>> tets_of_row(static_cast<std::size_t>(n[2] * n[1]));
    const bool completed = parallel_for(context, n[2] * n[1], 4,
      [&](Index begin, Index end)
      {
        for (Index row = begin; row < end; ++row)
        {
          for (Index i = 0; i < n[0]; ++i)
          {
            this->tets_of_cube(i, row % n[1], row / n[1],
              [&](const Tet& tet)
              {
                if (keep(tet))
                {
                  tets_of_row[row].push_back(tet);
                }
              });
          }
        }
      });
    for (const auto& list : tets_of_row)
    {
      tets.insert(tets.end(), list.begin(), list.end());
    }
    return completed;
  }

private:
  const Lattice& lattice_;
  std::array<Index, 3> size_{};
  Index corners_ = 0;
  Index vertices_ = 0;
};

SampleGrid grid_of(const Lattice& lattice, bool centers)
{
  SampleGrid grid;
  const double shift = centers ? 0.5 : 0.0;
  grid.origin = lattice.origin + Vec3::Constant(shift * lattice.spacing);
  grid.spacing = Vec3::Constant(lattice.spacing);
  for (int k = 0; k < 3; ++k)
  {
    grid.extent[2 * k] = 0;
    grid.extent[2 * k + 1] = centers ? lattice.cubes[k] - 1 : lattice.cubes[k];
  }
  return grid;
}

/// Remove unused vertices, keep the order of the other vertices, and orient all tets positively.
void compact(const std::vector<Vec3>& points, std::vector<Tet>& tets, TetMesh& mesh)
{
  std::vector<Index> id(points.size(), -1);
  for (const Tet& tet : tets)
  {
    for (const Index v : tet)
    {
      id[v] = 0;
    }
  }
  Index count = 0;
  for (Index& i : id)
  {
    i = i < 0 ? -1 : count++;
  }
  mesh.points.resize(count, 3);
  for (std::size_t v = 0; v < id.size(); ++v)
  {
    if (id[v] >= 0)
    {
      mesh.points.row(id[v]) = points[v];
    }
  }
  mesh.tets.resize(static_cast<Index>(tets.size()), 4);
  for (Index t = 0; t < mesh.tets.rows(); ++t)
  {
    mesh.tets.row(t) << id[tets[t][0]], id[tets[t][1]], id[tets[t][2]], id[tets[t][3]];
    if (tet_volume(mesh.points.row(mesh.tets(t, 0)), mesh.points.row(mesh.tets(t, 1)),
          mesh.points.row(mesh.tets(t, 2)), mesh.points.row(mesh.tets(t, 3))) < 0.0)
    {
      std::swap(mesh.tets(t, 0), mesh.tets(t, 1));
    }
  }
}

class IsosurfaceStuffing
{
public:
  IsosurfaceStuffing(const Lattice& lattice, const LatticeRegion& region)
    : numbering_(lattice), region_(region)
  {
  }

  Status run(ExecutionContext& context, TetMesh& mesh)
  {
    const Index count = this->numbering_.vertices();
    this->sign_.resize(static_cast<std::size_t>(count));
    this->points_.resize(this->sign_.size());
    for (Index v = 0; v < count; ++v)
    {
      this->points_[v] = this->numbering_.point(v);
      this->sign_[v] = this->region_.inside[v] ? 1 : -1;
    }
    const Phase phase(context, "cut");
    std::vector<Tet> tets;
    const auto any_inside = [&](const Tet& tet)
    { return std::any_of(tet.begin(), tet.end(), [&](Index v) { return this->sign_[v] > 0; }); };
    if (!this->numbering_.collect_tets(context, any_inside, tets) ||
      !this->find_cuts(context, tets))
    {
      return Status::canceled();
    }
    this->snap();
    std::vector<Tet> result;
    for (const Tet& tet : tets)
    {
      this->fill(tet, result);
    }
    compact(this->points_, result, mesh);
    return {};
  }

private:
  bool find_cuts(ExecutionContext& context, const std::vector<Tet>& tets)
  {
    for (const Tet& tet : tets)
    {
      for (int i = 0; i < 4; ++i)
      {
        for (int j = i + 1; j < 4; ++j)
        {
          if (this->sign_[tet[i]] != this->sign_[tet[j]])
          {
            this->edges_.push_back(std::minmax(tet[i], tet[j]));
          }
        }
      }
    }
    std::sort(this->edges_.begin(), this->edges_.end());
    this->edges_.erase(std::unique(this->edges_.begin(), this->edges_.end()), this->edges_.end());
    this->cut_parameters_.resize(this->edges_.size());
    constexpr Index block = 32;
    return parallel_for(context, static_cast<Index>(this->edges_.size()), block,
      [&](Index begin, Index end)
      {
        for (Index e = begin; e < end; ++e)
        {
          this->cut_parameters_[e] = this->cut_of(this->edges_[e]);
        }
      });
  }

  /// Return the position at which the edge crosses the boundary of the region, from 0 at the first
  /// vertex of the edge to 1 at the second.
  double cut_of(const LatticeEdge& edge) const
  {
    const bool first_inside = this->sign_[edge.first] > 0;
    double lower = 0.0;
    double upper = 1.0;
    for (int s = 0; s < this->region_.bisections; ++s)
    {
      const double middle = 0.5 * (lower + upper);
      const bool inside = this->region_.contains(edge.first, edge.second, middle);
      (inside == first_inside ? lower : upper) = middle;
    }
    return 0.5 * (lower + upper);
  }

  /// Move each vertex to its nearest cut point, if the cut point is within the snapping distance.
  void snap()
  {
    struct EdgeEnd
    {
      Index vertex, edge;
      // Distance of the vertex from the cut point, in units of the length of a long edge.
      double distance;
      bool is_too_near;
    };
    std::vector<EdgeEnd> ends;
    for (std::size_t e = 0; e < this->edges_.size(); ++e)
    {
      const auto [v, w] = this->edges_[e];
      const bool is_long = this->numbering_.is_long(v, w);
      const double alpha = is_long ? alpha_long : alpha_short;
      const double length = is_long ? 1.0 : std::sqrt(0.75);
      const auto edge = static_cast<Index>(e);
      ends.push_back(
        { v, edge, this->cut_parameters_[e] * length, this->cut_parameters_[e] < alpha });
      ends.push_back({ w, edge, (1.0 - this->cut_parameters_[e]) * length,
        1.0 - this->cut_parameters_[e] < alpha });
    }
    std::sort(ends.begin(), ends.end(),
      [](const EdgeEnd& x, const EdgeEnd& y)
      { return x.vertex != y.vertex ? x.vertex < y.vertex : x.edge < y.edge; });
    std::vector<Vec3> cut_points(this->edges_.size());
    for (std::size_t e = 0; e < this->edges_.size(); ++e)
    {
      const auto [v, w] = this->edges_[e];
      cut_points[e] =
        this->points_[v] + this->cut_parameters_[e] * (this->points_[w] - this->points_[v]);
    }
    for (std::size_t i = 0; i < ends.size();)
    {
      const EdgeEnd* nearest = nullptr;
      std::size_t j = i;
      for (; j < ends.size() && ends[j].vertex == ends[i].vertex; ++j)
      {
        const auto [v, w] = this->edges_[ends[j].edge];
        const bool is_cut = this->sign_[v] * this->sign_[w] < 0;
        if (is_cut && ends[j].is_too_near && (!nearest || ends[j].distance < nearest->distance))
        {
          nearest = &ends[j];
        }
      }
      if (nearest)
      {
        this->points_[nearest->vertex] = cut_points[nearest->edge];
        this->sign_[nearest->vertex] = 0;
      }
      i = j;
    }
    // The remaining cut points become vertices.
    this->cut_vertex_.assign(this->edges_.size(), -1);
    for (std::size_t e = 0; e < this->edges_.size(); ++e)
    {
      const auto [v, w] = this->edges_[e];
      if (this->sign_[v] * this->sign_[w] < 0)
      {
        this->cut_vertex_[e] = static_cast<Index>(this->points_.size());
        this->points_.push_back(cut_points[e]);
      }
    }
  }

  Index cut_vertex(Index v, Index w) const
  {
    const LatticeEdge edge = std::minmax(v, w);
    const auto location = std::lower_bound(this->edges_.begin(), this->edges_.end(), edge);
    return this->cut_vertex_[static_cast<std::size_t>(location - this->edges_.begin())];
  }

  /// Select the diagonal of the quadrilateral a, b, bc, ac. The quadrilateral is the remaining part
  /// of a face whose vertices a and b are + and whose vertex c is -; ac and bc are cut points.
  /// Return true if the diagonal starts at a, false if it starts at b. The face has one long edge.
  /// If the long edge is a-b, the diagonal starts at the even one of these two vertices. Otherwise
  /// it starts at the + vertex that is not on the long edge, so that it ends at the long edge's cut
  /// point. The result is the same for both tets of the face.
  bool diagonal_at_first(Index a, Index b, Index c) const
  {
    if (this->numbering_.is_long(a, b))
    {
      return this->numbering_.is_even(a);
    }
    return this->numbering_.is_long(b, c);
  }

  void fill(const Tet& tet, std::vector<Tet>& out) const
  {
    std::array<Index, 4> plus{}, zero{}, minus{};
    int p = 0, z = 0, m = 0;
    for (const Index v : tet)
    {
      (this->sign_[v] > 0 ? plus[p++] : this->sign_[v] < 0 ? minus[m++] : zero[z++]) = v;
    }
    if (p == 0)
    {
      return;
    }
    if (m == 0)
    {
      out.push_back(tet);
    }
    else if (p == 1)
    {
      Tet cut = tet;
      for (Index& v : cut)
      {
        v = this->sign_[v] < 0 ? this->cut_vertex(plus[0], v) : v;
      }
      out.push_back(cut);
    }
    else if (p == 2 && m == 1)
    {
      const Index a = plus[0], b = plus[1], c = minus[0];
      const Index ac = this->cut_vertex(a, c), bc = this->cut_vertex(b, c);
      if (this->diagonal_at_first(a, b, c))
      {
        out.push_back({ a, b, bc, zero[0] });
        out.push_back({ a, bc, ac, zero[0] });
      }
      else
      {
        out.push_back({ b, bc, ac, zero[0] });
        out.push_back({ b, ac, a, zero[0] });
      }
    }
    else if (p == 2)
    {
      this->fill_wedge(plus[0], plus[1], minus[0], minus[1], out);
    }
    else
    {
      this->fill_cut_corner({ plus[0], plus[1], plus[2] }, minus[0], out);
    }
  }

  /// Add tets for the part of a lattice tet that is inside the region. The lattice tet has two +
  /// vertices a, b and two - vertices c, d. The part inside is a prism with the ends (a, ac, ad)
  /// and (b, bc, bd). The prism's face (ac, ad, bd, bc) is on the boundary of the region, so no
  /// other tet determines its diagonal. The diagonal that maximizes the smallest dihedral angle is
  /// used.
  void fill_wedge(Index a, Index b, Index c, Index d, std::vector<Tet>& out) const
  {
    std::vector<Tet> best;
    double best_angle = -1.0;
    for (const bool free_at_first : { true, false })
    {
      // The quadrilaterals of the prism are (a, b, bc, ac), (ac, bc, bd, ad) and (ad, bd, b, a).
      // Either diagonal of the second quadrilateral is allowed.
      std::vector<Tet> tets;
      const std::array<Index, 3> top{ a, this->cut_vertex(a, c), this->cut_vertex(a, d) };
      const std::array<Index, 3> bottom{ b, this->cut_vertex(b, c), this->cut_vertex(b, d) };
      // Quadrilateral k of the prism is between corners k and k + 1. Its diagonal starts at top[k]
      // (true) or at top[k + 1] (false).
      const std::array<bool, 3> diagonal_at_top{ this->diagonal_at_first(a, b, c), free_at_first,
        !this->diagonal_at_first(a, b, d) };
      if (!split_prism(top, bottom, diagonal_at_top, tets))
      {
        continue;
      }
      double angle = 180.0;
      for (const Tet& t : tets)
      {
        angle = std::min(angle,
          min_dihedral_angle(
            this->points_[t[0]], this->points_[t[1]], this->points_[t[2]], this->points_[t[3]]));
      }
      if (angle > best_angle)
      {
        best_angle = angle;
        best = tets;
      }
    }
    out.insert(out.end(), best.begin(), best.end());
  }

  /// Add tets for the part of a lattice tet that is inside the region. The lattice tet has three +
  /// vertices and one - vertex. The part inside is a prism: one end is the triangle of the three +
  /// vertices, the other end is the triangle of the three cut points.
  void fill_cut_corner(const std::array<Index, 3>& plus, Index minus, std::vector<Tet>& out) const
  {
    std::array<Index, 3> bottom{};
    std::array<bool, 3> diagonal_at_top{};
    for (int k = 0; k < 3; ++k)
    {
      bottom[k] = this->cut_vertex(plus[k], minus);
      diagonal_at_top[k] = this->diagonal_at_first(plus[k], plus[(k + 1) % 3], minus);
    }
    split_prism(plus, bottom, diagonal_at_top, out);
  }

  /// Divide a prism with the ends `top` and `bottom` into three tets. If diagonal_at_top[k] is
  /// true, the diagonal of the quadrilateral between corners k and k + 1 starts at top[k] and ends
  /// at bottom[k + 1]. Otherwise it starts at top[k + 1] and ends at bottom[k]. Return false if the
  /// three diagonals are cyclic, because then no three tets fill the prism.
  static bool split_prism(const std::array<Index, 3>& top, const std::array<Index, 3>& bottom,
    const std::array<bool, 3>& diagonal_at_top, std::vector<Tet>& out)
  {
    if (diagonal_at_top[0] == diagonal_at_top[1] && diagonal_at_top[1] == diagonal_at_top[2])
    {
      return false;
    }
    for (int k = 0; k < 3; ++k)
    {
      const int next = (k + 1) % 3;
      const int last = (k + 2) % 3;
      if (diagonal_at_top[k] && !diagonal_at_top[last])
      {
        // The two diagonals at corner k both start at its top vertex.
        out.push_back({ top[k], bottom[0], bottom[1], bottom[2] });
        if (diagonal_at_top[next])
        {
          out.push_back({ top[k], top[next], top[last], bottom[last] });
          out.push_back({ top[k], top[next], bottom[next], bottom[last] });
        }
        else
        {
          out.push_back({ top[k], top[next], top[last], bottom[next] });
          out.push_back({ top[k], top[last], bottom[next], bottom[last] });
        }
        return true;
      }
    }
    return false;
  }

  Numbering numbering_;
  const LatticeRegion& region_;
  std::vector<signed char> sign_;
  std::vector<Vec3> points_;
  std::vector<LatticeEdge> edges_; // lattice edges that the boundary of the region cuts, sorted
  // Position of the cut point on each edge, from 0 at the first vertex to 1 at the second.
  std::vector<double> cut_parameters_;
  std::vector<Index> cut_vertex_;
};
} // namespace

Lattice Lattice::around(const Box& box, Index resolution)
{
  Lattice lattice;
  const double longest = box.size().maxCoeff();
  lattice.spacing =
    longest > 0.0 ? longest / static_cast<double>(std::max<Index>(resolution, 1)) : 1.0;
  constexpr double margin = 2.0;
  for (int k = 0; k < 3; ++k)
  {
    const double cubes = std::ceil(box.size()[k] / lattice.spacing + 2.0 * margin - 1e-9);
    lattice.cubes[k] = static_cast<Index>(cubes);
    lattice.origin[k] = box.center()[k] - 0.5 * cubes * lattice.spacing;
  }
  return lattice;
}

Points lattice_points(const Lattice& lattice)
{
  const Numbering numbering(lattice);
  Points points(numbering.vertices(), 3);
  for (Index v = 0; v < points.rows(); ++v)
  {
    points.row(v) = numbering.point(v);
  }
  return points;
}

Status sample_lattice(ExecutionContext& context, const WindingNumber& winding,
  const Lattice& lattice, Eigen::VectorXd& winding_numbers)
{
  const Numbering numbering(lattice);
  winding_numbers.resize(numbering.vertices());
  Status status = winding.evaluate(context, grid_of(lattice, false), winding_numbers.data());
  if (status.ok())
  {
    status = winding.evaluate(
      context, grid_of(lattice, true), winding_numbers.data() + numbering.corners());
  }
  return status;
}

Status stuff_lattice(
  ExecutionContext& context, const Lattice& lattice, const LatticeRegion& region, TetMesh& mesh)
{
  mesh = TetMesh();
  return IsosurfaceStuffing(lattice, region).run(context, mesh);
}

Status stuff_lattice(ExecutionContext& context, const WindingNumber& winding,
  const Lattice& lattice, const Box& box, double threshold, TetMesh& mesh)
{
  mesh = TetMesh();
  Eigen::VectorXd w;
  {
    const Phase phase(context, "sample", 0.0, 0.4);
    Status status = sample_lattice(context, winding, lattice, w);
    if (!status.ok())
    {
      return status;
    }
  }
  const Points points = lattice_points(lattice);
  const auto is_in_box = [&box](const Vec3& p)
  { return (p.array() >= box.lower.array()).all() && (p.array() <= box.upper.array()).all(); };
  LatticeRegion region;
  region.inside.resize(static_cast<std::size_t>(w.size()));
  for (Index v = 0; v < w.size(); ++v)
  {
    region.inside[v] = w[v] >= threshold && is_in_box(points.row(v)) ? 1 : 0;
  }
  region.contains = [&](Index v, Index u, double t)
  {
    const Vec3 start = points.row(v);
    const Vec3 end = points.row(u);
    const Vec3 p = start + t * (end - start);
    return is_in_box(p) && winding.evaluate_at(p) >= threshold;
  };
  const ProgressRange range(context, 0.4, 1.0);
  return stuff_lattice(context, lattice, region, mesh);
}

} // namespace bindpose
