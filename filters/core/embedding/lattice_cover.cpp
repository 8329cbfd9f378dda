// Find the tets and cubes that a surface passes through or encloses (see lattice_cover.h).
// Triangles are cut by the planes of the lattice. Cubes without triangles are completely inside or
// outside. Inside cubes are found by flooding from cube to cube, starting at the surface. The flood
// reaches all inside cubes, because every connected inside region touches a triangle: the winding
// number is harmonic away from triangles and tends to zero far away.
#include "embedding/lattice_cover.h"

#include "base/gather.h"
#include "base/parallel_sort.h"
#include "base/sort_unique.h"

#include <cmath>
#include <numeric>

namespace bindpose
{

namespace
{
using Key = LatticeCover::Key;
using Cube = LatticeCover::Cube;
using Id = LatticeCover::Id;

// Accepted numbers of tets, as fractions of the target number.
constexpr double minimum_tet_ratio = 2.0 / 3.0;
constexpr double maximum_tet_ratio = 1.5;
constexpr double maximum_pieces = 2e8;
// Maximum number of pieces, in addition to one per triangle, if the resolution is automatic.
constexpr double maximum_added_pieces = 1e6;

/// Return the neighboring cube at one of the six faces of a cube.
Cube neighbor_of(Key cube_key, int side)
{
  Cube cube = DisphenoidLattice::cube_of(cube_key);
  cube[side / 2] += side % 2 ? 1 : -1;
  return cube;
}

/// Measures of a surface. `longest` is the longest side of its bounding box and the unit of length
/// of `volume`, `area` and `perimeter`. `perimeter` is the sum of the perimeters of all triangles;
/// `triangles` is their number.
struct SurfaceMeasures
{
  double longest = 0.0;
  double volume = 0.0, area = 0.0, perimeter = 0.0, triangles = 0.0;

  SurfaceMeasures(const LatticeSurface& surface, const Box& box) : longest(box.size().maxCoeff())
  {
    const double unit = this->longest > 0.0 ? this->longest : 1.0;
    for (const auto& t : surface.triangles)
    {
      const Vec3 a = (surface.points[t[0]] - box.lower) / unit;
      const Vec3 b = (surface.points[t[1]] - box.lower) / unit;
      const Vec3 c = (surface.points[t[2]] - box.lower) / unit;
      this->area += 0.5 * (b - a).cross(c - a).norm();
      this->volume += a.dot(b.cross(c)) / 6.0;
      this->perimeter += (b - a).norm() + (c - b).norm() + (a - c).norm();
    }
    const Vec3 size = box.size() / unit;
    this->volume = std::min(std::abs(this->volume), size.prod());
    this->triangles = static_cast<double>(surface.triangles.size());
  }
  /// Estimate the number of tets from the number of cubes along the longest side. The estimate uses
  /// the mean number of lattice tets per volume and the mean number of additional tets per surface
  /// area.
  double tets(double cubes) const
  {
    const double most = 12.0 * std::pow(cubes + 2.0, 3);
    return std::min(
      most, 12.0 * this->volume * cubes * cubes * cubes + 6.0 * this->area * cubes * cubes);
  }
  /// Estimate the number of pieces of triangles plus the number of crossings of triangles with the
  /// lines between samples.
  double pieces(double cubes) const
  {
    return this->triangles + 4.0 * this->perimeter * cubes + 65.0 * this->area * cubes * cubes;
  }
  /// Return the largest number of cubes along the longest side for which count(cubes) is below a
  /// bound.
  template <typename Count>
  static double maximum_cubes_along(double bound, const Count& count)
  {
    double low = 1.0;
    double high = static_cast<double>(LatticeCover::largest_resolution);
    constexpr int steps = 40;
    for (int s = 0; s < steps; ++s)
    {
      const double middle = 0.5 * (low + high);
      (count(middle) < bound ? low : high) = middle;
    }
    return low;
  }
};

} // namespace

bool LatticeSurface::build(ExecutionContext& context, PointsView all, TrianglesView faces,
  const std::vector<PartLink>& links)
{
  std::vector<Id> order;
  this->vertex_of_point.assign(static_cast<std::size_t>(all.rows()), -1);
  for (Index i = 0; i < faces.size(); ++i)
  {
    Id& id = this->vertex_of_point[faces.data()[i]];
    if (id < 0)
    {
      id = 0;
      order.push_back(static_cast<Id>(faces.data()[i]));
    }
  }
  std::sort(order.begin(), order.end());
  const auto compare = [&](Id i, Id j)
  {
    const double* p = all.data() + 3 * static_cast<Index>(i);
    const double* q = all.data() + 3 * static_cast<Index>(j);
    return std::lexicographical_compare(p, p + 3, q, q + 3);
  };
  if (!parallel_sort(context, order, compare))
  {
    return false;
  }
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    if (i == 0 || compare(order[i - 1], order[i]))
    {
      this->points.emplace_back(all.row(order[i]));
    }
    this->vertex_of_point[order[i]] = static_cast<Id>(this->points.size()) - 1;
  }
  this->triangles.resize(static_cast<std::size_t>(faces.rows()));
  for (Index f = 0; f < faces.rows(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      this->triangles[f][k] = this->vertex_of_point[faces(f, k)];
    }
  }
  for (const PartLink& link : links)
  {
    const auto from = static_cast<Id>(this->points.size());
    const auto id = static_cast<Id>(this->triangles.size());
    this->points.insert(this->points.end(), link.positions.begin(), link.positions.end());
    this->triangles.push_back({ from, from + 1, from + 1 });
    for (int k = 0; k < 2; ++k)
    {
      this->ends.push_back({ from + k, id, static_cast<Id>(link.triangles[k]) });
    }
  }
  return true;
}

Status LatticeCover::build(ExecutionContext& context, double spacing)
{
  this->pieces.clear();
  this->kinds.clear();
  this->lattice = DisphenoidLattice(this->box_, spacing);
  this->first_cube_ = DisphenoidLattice::cube_of(this->lattice.lattice_position(this->box_.lower));
  this->last_cube_ = DisphenoidLattice::cube_of(this->lattice.lattice_position(this->box_.upper));
  const auto count = static_cast<Index>(this->surface_.points.size());
  this->positions.resize(this->surface_.points.size());
  this->tet_of_point.resize(this->surface_.points.size());
  constexpr Index block = 4096;
  if (!parallel_for(context, count, block,
        [&](Index begin, Index end)
        {
          for (Index i = begin; i < end; ++i)
          {
            this->positions[i] = this->lattice.lattice_position(this->surface_.points[i]);
            this->tet_of_point[i] = DisphenoidLattice::locate(this->positions[i]).tet;
          }
        }) ||
    !this->find_pieces(context))
  {
    return Status::canceled();
  }
  return this->find_cubes(context);
}

bool LatticeCover::find_pieces(ExecutionContext& context)
{
  struct SurfacePiece
  {
    Key tet;
    Key cube;
    Id triangle;
    Vec3 middle;
  };
  std::vector<SurfacePiece> found;
  const auto triangles = static_cast<Index>(this->surface_.triangles.size());
  const bool completed = gather(context, triangles, found,
    [&](Index f, std::vector<SurfacePiece>& list)
    {
      const auto& t = this->surface_.triangles[f];
      const std::size_t first = list.size();
      const auto id = static_cast<Id>(f);
      const auto add = [&](const Vec3& middle, const Vec3& lower, const Vec3& upper)
      {
        const Key tet = DisphenoidLattice::locate(middle).tet;
        const Cube from = DisphenoidLattice::cube_of(lower);
        const Cube to = DisphenoidLattice::cube_of(upper);
        for (Id k = from[2]; k <= to[2]; ++k)
        {
          for (Id j = from[1]; j <= to[1]; ++j)
          {
            for (Id i = from[0]; i <= to[0]; ++i)
            {
              list.push_back({ tet, DisphenoidLattice::cube_key({ i, j, k }), id, middle });
            }
          }
        }
      };
      for (const Id v : t)
      {
        const Vec3& p = this->positions[v];
        add(p, p, p);
      }
      if (this->tet_of_point[t[0]] != this->tet_of_point[t[1]] ||
        this->tet_of_point[t[1]] != this->tet_of_point[t[2]])
      {
        DisphenoidLattice::for_each_piece(this->corners_of(f), add);
        for (int k = 0; k < 3; ++k)
        {
          const Id v = t[k];
          const Id w = t[(k + 1) % 3];
          if (this->tet_of_point[v] != this->tet_of_point[w])
          {
            const Vec3& p = this->positions[std::min(v, w)];
            const Vec3& q = this->positions[std::max(v, w)];
            DisphenoidLattice::for_each_piece({ p, q, q }, add);
          }
        }
      }
      const auto key = [](const SurfacePiece& x) { return std::make_pair(x.tet, x.cube); };
      std::stable_sort(list.begin() + first, list.end(),
        [&](const SurfacePiece& x, const SurfacePiece& y) { return key(x) < key(y); });
      list.erase(std::unique(list.begin() + first, list.end(),
                   [&](const SurfacePiece& x, const SurfacePiece& y) { return key(x) == key(y); }),
        list.end());
    });
  if (!completed)
  {
    return false;
  }
  this->first_piece.assign(static_cast<std::size_t>(triangles) + 1, 0);
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    if (i == 0 || found[i].tet != found[i - 1].tet || found[i].triangle != found[i - 1].triangle)
    {
      this->pieces.push_back({ found[i].tet, found[i].triangle, found[i].middle });
      ++this->first_piece[static_cast<std::size_t>(found[i].triangle) + 1];
    }
    if (i == 0 || found[i].cube != found[i - 1].cube)
    {
      this->kinds.emplace(found[i].cube, Kind::cut);
    }
  }
  std::partial_sum(this->first_piece.begin(), this->first_piece.end(), this->first_piece.begin());
  return true;
}

bool LatticeCover::is_in_box(const Cube& cube) const
{
  for (int k = 0; k < 3; ++k)
  {
    if (cube[k] < this->first_cube_[k] || cube[k] > this->last_cube_[k])
    {
      return false;
    }
  }
  return true;
}

LatticeCover::Kind LatticeCover::kind_of(const Cube& cube) const
{
  const auto found = this->kinds.find(DisphenoidLattice::cube_key(cube));
  return found == this->kinds.end() ? Kind::outside : found->second;
}

Status LatticeCover::find_cubes(ExecutionContext& context)
{
  std::vector<Key> frontier; // cubes whose neighbors have not been visited
  for (const auto& [key, kind] : this->kinds)
  {
    frontier.push_back(key);
  }
  std::sort(frontier.begin(), frontier.end());
  std::vector<Key> outside;
  while (!frontier.empty())
  {
    std::vector<Key> next;
    for (const Key key : frontier)
    {
      for (int side = 0; side < 6; ++side)
      {
        const Cube cube = neighbor_of(key, side);
        const Key neighbor = DisphenoidLattice::cube_key(cube);
        if (this->is_in_box(cube) && this->kinds.count(neighbor) == 0)
        {
          next.push_back(neighbor);
        }
      }
    }
    sort_unique(next);
    Points centers(static_cast<Index>(next.size()), 3);
    for (std::size_t i = 0; i < next.size(); ++i)
    {
      const Cube cube = DisphenoidLattice::cube_of(next[i]);
      centers.row(static_cast<Index>(i)) =
        this->lattice.world_point(Vec3(cube[0] + 0.5, cube[1] + 0.5, cube[2] + 0.5));
    }
    Eigen::VectorXd w;
    const Status status = this->winding_.evaluate(context, centers, w);
    if (!status.ok())
    {
      return status;
    }
    frontier.clear();
    for (std::size_t i = 0; i < next.size(); ++i)
    {
      const bool inside = w[static_cast<Index>(i)] >= this->threshold_;
      this->kinds[next[i]] = inside ? Kind::inside : Kind::outside;
      (inside ? frontier : outside).push_back(next[i]);
    }
    if (static_cast<Index>(this->kinds.size()) > maximum_cubes)
    {
      return too_many_cubes();
    }
  }
  // At an opening of the surface, an inside cube can be adjacent to an outside cube. Both then
  // count as cubes at the surface.
  std::vector<Key> open;
  for (const Key key : outside)
  {
    bool has_inside_neighbor = false;
    for (int side = 0; side < 6; ++side)
    {
      const Cube cube = neighbor_of(key, side);
      if (this->kind_of(cube) == Kind::inside)
      {
        open.push_back(DisphenoidLattice::cube_key(cube));
        has_inside_neighbor = true;
      }
    }
    if (has_inside_neighbor)
    {
      open.push_back(key);
    }
  }
  for (const Key key : open)
  {
    this->kinds[key] = Kind::cut;
  }
  for (const Key key : outside)
  {
    const auto at = this->kinds.find(key);
    if (at->second == Kind::outside)
    {
      this->kinds.erase(at);
    }
  }
  return {};
}

Status LatticeCover::too_many_cubes()
{
  return Status::invalid_input("the lattice would have more than " + std::to_string(maximum_cubes) +
    " cubes; use a smaller resolution");
}

/// Return the number of tets that contain a piece of the surface or are in inside cubes.
double LatticeCover::count_tets() const
{
  std::vector<Key> tets;
  for (const Piece& piece : this->pieces)
  {
    tets.push_back(piece.tet);
  }
  for (const auto& [key, kind] : this->kinds)
  {
    for (int half = 0; half < DisphenoidLattice::halves && kind == Kind::inside; ++half)
    {
      tets.push_back(DisphenoidLattice::tet_of_half(DisphenoidLattice::cube_of(key), half));
    }
  }
  sort_unique(tets);
  return static_cast<double>(tets.size());
}

Status LatticeCover::choose(ExecutionContext& context, Index resolution, Index target)
{
  const auto target_tets = static_cast<double>(target);
  const SurfaceMeasures measures(this->surface_, this->box_);
  const double largest =
    this->box_.lower.cwiseAbs().cwiseMax(this->box_.upper.cwiseAbs()).maxCoeff();
  double minimum_spacing = DisphenoidLattice::minimum_spacing(largest);
  minimum_spacing = minimum_spacing > 0.0 ? minimum_spacing : 1.0;
  if (resolution > 0 || !(measures.longest > 0.0))
  {
    const auto cubes = static_cast<double>(std::max<Index>(1, resolution));
    return measures.pieces(cubes) > maximum_pieces
      ? too_many_cubes()
      : this->build(context, std::max(measures.longest / cubes, minimum_spacing));
  }
  const double most =
    std::min(SurfaceMeasures::maximum_cubes_along(measures.triangles + maximum_added_pieces,
               [&](double cubes) { return measures.pieces(cubes); }),
      std::max(1.0, measures.longest / minimum_spacing));
  double cubes = std::min(most,
    SurfaceMeasures::maximum_cubes_along(target_tets, [&](double c) { return measures.tets(c); }));
  double last_cubes = 0.0;
  double last_tets = 0.0;
  constexpr int rounds = 6;
  for (int round = 0;; ++round)
  {
    const ProgressRange range(context, 1.0 - std::pow(0.5, round), 1.0 - std::pow(0.5, round + 1));
    const Status status = this->build(context, std::max(measures.longest / cubes, minimum_spacing));
    const double tets = status.ok() ? this->count_tets() : 0.0;
    if (!status.ok() ||
      (tets >= minimum_tet_ratio * target_tets && tets <= maximum_tet_ratio * target_tets) ||
      round + 1 == rounds)
    {
      return status;
    }
    // The number of tets is modeled as a power of the resolution; the exponent is between 0.8
    // (threads) and 3.2 (solids).
    double power = tets < target_tets ? 2.5 : 2.0;
    if (last_cubes > 0.0 && last_cubes != cubes)
    {
      power = std::clamp(std::log(tets / last_tets) / std::log(cubes / last_cubes), 0.8, 3.2);
    }
    last_cubes = cubes;
    last_tets = tets;
    cubes = std::clamp(cubes * std::pow(target_tets / tets, 1.0 / power), 1.0, most);
    if (cubes == last_cubes)
    {
      return status;
    }
  }
}

} // namespace bindpose
