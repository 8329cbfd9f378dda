// What is to be held, the material, is the surface and what it encloses. It is taken apart into
// atoms, each in one lattice tet: a piece of a triangle, or a sample of the inside. Two atoms are
// connected when the straight line between them stays in the material; both its tets' nodes then
// see them as one part, for the tets around a node fill a convex body (a rhombic dodecahedron), so
// that the line does not leave it.
//
// 1. The lattice's spacing, what triangles go through, and cubes that are inside as a whole
//    (lattice_cover.h).
// 2. The other cubes at the surface are sampled on a sub-grid.
// 3. Lines between neighbouring samples are cut where triangles cross them. A stretch between two
//    crossings is inside or not, by the winding number at its middle. Inside stretches connect what
//    is at their ends. So a wall is never missed, however thin the gap behind it; connections that
//    are thinner than the samples' distance are seen by the triangles around them.
// 4. Triangles connect by shared vertices, and by shared edges in the tets that the edge goes
//    through; within the tets around a node a triangle is one piece, being convex.
// 5. Atoms that are connected in one tet make its parts. A union-find over (part, corner of its
//    tet) finds the copies of nodes; parts with the same four copies are one tet.
// 6. Where the tets around a node hold but a slice of material, no line between samples may lie in
//    it. So before the last step, nodes with several copies are looked at again: straight probes
//    from one copy's atoms to the nearest of another's, against all triangles around the node.
//
// Every union keeps the smaller id, so that nothing depends on the order, nor on threads.
#include "inside/embedding_tets.h"

#include "base/exact.h"
#include "base/gather.h"
#include "base/parallel_sort.h"
#include "inside/disphenoid_lattice.h"
#include "inside/lattice_cover.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>
#include <unordered_map>

namespace bindpose
{

namespace
{
using Key = DisphenoidLattice::Key;
using Cube = DisphenoidLattice::Cube;
using Id = LatticeCover::Id;
constexpr int halves = DisphenoidLattice::halves;

// Samples of a cube. They lie off the planes of the lattice, so that a sample is in one tet.
constexpr int samples_along = 6;
constexpr int samples_of_cube = samples_along * samples_along * samples_along;
constexpr double sample_shift[3] = { 0.62, 0.41, 0.53 };

constexpr Index most_sampled_cubes = 1000000;
constexpr Index often = 1 << 15; // items between two looks at cancel

class UnionFind
{
public:
  void reset(std::size_t count)
  {
    this->parent_.resize(count);
    std::iota(this->parent_.begin(), this->parent_.end(), Id(0));
  }
  Id find(Id i)
  {
    while (this->parent_[i] != i)
    {
      this->parent_[i] = this->parent_[this->parent_[i]];
      i = this->parent_[i];
    }
    return i;
  }
  void unite(Id i, Id j)
  {
    i = this->find(i);
    j = this->find(j);
    (i < j ? this->parent_[j] : this->parent_[i]) = std::min(i, j);
  }

private:
  std::vector<Id> parent_;
};

template <typename Item>
void sort_unique(std::vector<Item>& items)
{
  std::sort(items.begin(), items.end());
  items.erase(std::unique(items.begin(), items.end()), items.end());
}

/// The place of a key that is there.
Id place_in(const std::vector<Key>& sorted, Key key)
{
  return static_cast<Id>(std::lower_bound(sorted.begin(), sorted.end(), key) - sorted.begin());
}

Cube moved(Cube cube, int axis, int by)
{
  cube[axis] += by;
  return cube;
}

/// Whole numbers of a sample, over all cubes.
using Sample = std::array<Id, 3>;

class Embedding
{
public:
  Embedding(PointsView points, const LatticeSurface& surface, const WindingNumber& winding,
    double threshold, const LatticeCover& cover, ExecutionContext& context)
    : points_(points), surface_(surface), winding_(winding), threshold_(threshold), cover_(cover),
      context_(context)
  {
  }

  Status run(EmbeddingTets& result)
  {
    Status status;
    {
      const Phase phase(this->context_, "samples", 0.0, 0.6);
      if (!this->number_atoms())
      {
        return this->cancelled_or(LatticeCover::too_many_cubes());
      }
      status = this->sample();
      if (!status.ok())
      {
        return status;
      }
    }
    const Phase phase(this->context_, "connect", 0.6, 1.0);
    if (!this->cut_lines())
    {
      return Status::cancelled();
    }
    status = this->connect_crossings();
    if (!status.ok())
    {
      return status;
    }
    if (!this->connect_samples() || !this->connect_triangles())
    {
      return Status::cancelled();
    }
    this->connect_cubes();
    if (!this->find_parts() || !this->join_corners() || !this->probe_nodes() ||
      !this->write(result))
    {
      return Status::cancelled();
    }
    return this->context_.cancelled() ? Status::cancelled() : Status();
  }

private:
  Status cancelled_or(const Status& status) const
  {
    return this->context_.cancelled() ? Status::cancelled() : status;
  }

  /// Atoms: samples of sampled cubes, then halves of inside cubes, then pieces of triangles.
  bool number_atoms()
  {
    for (const auto& [key, kind] : this->cover_.kinds)
    {
      (kind == LatticeCover::Kind::cut ? this->sampled_ : this->full_).push_back(key);
    }
    if (static_cast<Index>(this->sampled_.size()) > most_sampled_cubes)
    {
      return false;
    }
    std::sort(this->sampled_.begin(), this->sampled_.end());
    std::sort(this->full_.begin(), this->full_.end());
    for (const auto* cubes : { &this->sampled_, &this->full_ })
    {
      for (const Key key : *cubes)
      {
        for (int half = 0; half < halves; ++half)
        {
          this->tets_.push_back(
            DisphenoidLattice::tet_of_half(DisphenoidLattice::cube_of(key), half));
        }
      }
    }
    std::vector<Key> of_half = this->tets_;
    for (const LatticeCover::Piece& piece : this->cover_.pieces)
    {
      this->tets_.push_back(piece.tet);
    }
    if (!parallel_sort(this->context_, this->tets_, std::less<>()))
    {
      return false;
    }
    this->tets_.erase(std::unique(this->tets_.begin(), this->tets_.end()), this->tets_.end());
    this->half_tets_.resize(of_half.size());
    for (std::size_t i = 0; i < of_half.size(); ++i)
    {
      this->half_tets_[i] = place_in(this->tets_, of_half[i]);
    }
    this->piece_tets_.resize(this->cover_.pieces.size());
    for (std::size_t i = 0; i < this->piece_tets_.size(); ++i)
    {
      this->piece_tets_[i] = place_in(this->tets_, this->cover_.pieces[i].tet);
    }
    this->nodes_.resize(this->tets_.size());
    for (std::size_t i = 0; i < this->tets_.size(); ++i)
    {
      this->nodes_[i] = DisphenoidLattice::corners(this->tets_[i]);
    }
    for (int s = 0; s < samples_of_cube; ++s)
    {
      this->half_of_sample_[s] = DisphenoidLattice::half_of(place_of_sample(position_of(s)));
      ++this->samples_of_half_[this->half_of_sample_[s]];
    }
    for (std::size_t i = 0; i < this->sampled_.size(); ++i)
    {
      this->cube_id_[this->sampled_[i]] = static_cast<Id>(i);
    }
    for (std::size_t i = 0; i < this->full_.size(); ++i)
    {
      this->cube_id_[this->full_[i]] = -1 - static_cast<Id>(i);
    }
    this->first_full_ = static_cast<Id>(this->sampled_.size()) * samples_of_cube;
    this->first_piece_ = this->first_full_ + static_cast<Id>(this->full_.size()) * halves;
    const std::size_t atoms =
      static_cast<std::size_t>(this->first_piece_) + this->piece_tets_.size();
    this->atoms_.reset(atoms);
    this->shares_.assign(atoms, 0.0F);
    this->inside_.assign(static_cast<std::size_t>(this->first_full_), 0);
    this->cut_.assign(static_cast<std::size_t>(this->first_full_), 0);
    return !this->context_.cancelled();
  }

  static Sample position_of(int s)
  {
    return { s % samples_along, s / samples_along % samples_along,
      s / (samples_along * samples_along) };
  }
  static Vec3 place_of_sample(const Sample& at)
  {
    return Vec3(at[0] + sample_shift[0], at[1] + sample_shift[1], at[2] + sample_shift[2]) /
      samples_along;
  }
  Sample sample_of(Id sampled_cube, int s) const
  {
    const Cube cube = DisphenoidLattice::cube_of(this->sampled_[sampled_cube]);
    Sample at = position_of(s);
    for (int k = 0; k < 3; ++k)
    {
      at[k] += samples_along * cube[k];
    }
    return at;
  }

  /// A sample's atom; -1: it is outside of all cubes. In a sampled cube it may not be inside.
  Id atom_of(const Sample& at) const
  {
    const Cube cube{ at[0] / samples_along, at[1] / samples_along, at[2] / samples_along };
    const auto found = this->cube_id_.find(DisphenoidLattice::cube_key(cube));
    if (found == this->cube_id_.end())
    {
      return -1;
    }
    const int s =
      ((at[2] % samples_along) * samples_along + at[1] % samples_along) * samples_along +
      at[0] % samples_along;
    return found->second >= 0
      ? found->second * samples_of_cube + s
      : this->first_full_ + (-1 - found->second) * halves + this->half_of_sample_[s];
  }
  /// All atoms are but those of samples outside.
  bool is_inside(Id atom) const
  {
    return atom >= this->first_full_ || (atom >= 0 && this->inside_[atom] != 0);
  }
  Id tet_of(Id atom) const
  {
    if (atom >= this->first_piece_)
    {
      return this->piece_tets_[atom - this->first_piece_];
    }
    if (atom >= this->first_full_)
    {
      return this->half_tets_[this->sampled_.size() * halves + (atom - this->first_full_)];
    }
    return this->half_tets_[(atom / samples_of_cube) * halves +
      this->half_of_sample_[atom % samples_of_cube]];
  }
  /// The atom of a triangle in a tet, -1 when rounding left none there.
  Id atom_of(Id triangle, Key tet) const
  {
    const auto begin = this->cover_.pieces.begin() + this->cover_.first_piece[triangle];
    const auto end = this->cover_.pieces.begin() + this->cover_.first_piece[triangle + 1];
    const auto at = std::lower_bound(
      begin, end, tet, [](const LatticeCover::Piece& piece, Key key) { return piece.tet < key; });
    return at == end || at->tet != tet
      ? -1
      : this->first_piece_ + static_cast<Id>(at - this->cover_.pieces.begin());
  }

  void connect(Id a, Id b)
  {
    if (a < 0 || b < 0)
    {
      return;
    }
    if (this->tet_of(a) == this->tet_of(b))
    {
      this->atoms_.unite(a, b);
    }
    else
    {
      this->across_.emplace_back(a, b);
    }
  }

  Status sample()
  {
    constexpr Index cubes_at_once = 4096;
    const auto count = static_cast<Index>(this->sampled_.size());
    for (Index begin = 0; begin < count; begin += cubes_at_once)
    {
      const Index end = std::min(count, begin + cubes_at_once);
      const ProgressRange range(this->context_,
        static_cast<double>(begin) / static_cast<double>(count),
        static_cast<double>(end) / static_cast<double>(count));
      Points points((end - begin) * samples_of_cube, 3);
      for (Index i = 0; i < points.rows(); ++i)
      {
        const Sample at = this->sample_of(
          static_cast<Id>(begin + i / samples_of_cube), static_cast<int>(i % samples_of_cube));
        points.row(i) = this->cover_.lattice.point_at(place_of_sample(at));
      }
      Eigen::VectorXd w;
      const Status status = this->winding_.evaluate(points, this->context_, w);
      if (!status.ok())
      {
        return status;
      }
      for (Index i = 0; i < w.size(); ++i)
      {
        this->inside_[begin * samples_of_cube + i] = w[i] >= this->threshold_ ? 1 : 0;
      }
    }
    return {};
  }

  // ---- Lines between samples ----

  /// Where a triangle meets the line from a sample to the next along an axis.
  struct Crossing
  {
    Key line; ///< axis and sample
    double at; ///< 0 … 1 along the line
    Id triangle;

    int axis() const { return static_cast<int>(this->line >> 60); }
    Sample sample() const
    {
      constexpr Key mask = (1 << 20) - 1;
      return { static_cast<Id>(this->line & mask), static_cast<Id>(this->line >> 20 & mask),
        static_cast<Id>(this->line >> 40 & mask) };
    }
  };
  static Key line_key(int axis, const Sample& s)
  {
    return ((static_cast<Key>(axis) << 20 | static_cast<Key>(s[2])) << 20 | static_cast<Key>(s[1]))
      << 20 |
      static_cast<Key>(s[0]);
  }

  /// All crossings with lines along an axis: row by row in the projection along it, the exact sign
  /// of three areas for every line between the triangle's borders. Lines that touch the border
  /// count for both triangles at it.
  static void crossings_of(
    Id triangle, std::array<Vec3, 3> corner, int axis, std::vector<Crossing>& list)
  {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    for (Vec3& p : corner)
    {
      p = samples_along * p - Vec3(sample_shift[0], sample_shift[1], sample_shift[2]);
    }
    const int turn = orientation_2d(
      corner[0][u], corner[0][v], corner[1][u], corner[1][v], corner[2][u], corner[2][v]);
    if (turn == 0)
    {
      return; // seen from its edge: its neighbours are met
    }
    const auto range = [&](int k) {
      return std::minmax({ corner[0][k], corner[1][k], corner[2][k] });
    };
    const auto [lowest, highest] = range(v);
    const auto [left, right] = range(u);
    const auto [near, far] = range(axis);
    constexpr double slack = 1e-6;
    for (double y = std::ceil(lowest); y <= highest; y += 1.0)
    {
      double from = right;
      double to = left;
      for (int k = 0; k < 3; ++k)
      {
        const Vec3& p = corner[k];
        const Vec3& q = corner[(k + 1) % 3];
        if (std::min(p[v], q[v]) <= y && y <= std::max(p[v], q[v]))
        {
          const double t = p[v] == q[v] ? 0.0 : (y - p[v]) / (q[v] - p[v]);
          const double x = p[u] + t * (q[u] - p[u]);
          from = std::min({ from, x, p[v] == q[v] ? q[u] : x });
          to = std::max({ to, x, p[v] == q[v] ? q[u] : x });
        }
      }
      for (double x = std::ceil(from - slack); x <= to + slack; x += 1.0)
      {
        bool hit = true;
        double depth = 0.0;
        double area = 0.0;
        for (int k = 0; k < 3 && hit; ++k)
        {
          const Vec3& p = corner[(k + 1) % 3];
          const Vec3& q = corner[(k + 2) % 3];
          hit = turn * orientation_2d(p[u], p[v], q[u], q[v], x, y) >= 0;
          const double part = std::abs((p[u] - x) * (q[v] - y) - (q[u] - x) * (p[v] - y));
          area += part;
          depth += part * corner[k][axis];
        }
        if (hit)
        {
          const double z = area > 0.0 ? std::clamp(depth / area, near, far) : near;
          Sample s{};
          s[axis] = static_cast<Id>(std::floor(z));
          s[u] = static_cast<Id>(x);
          s[v] = static_cast<Id>(y);
          list.push_back({ line_key(axis, s), z - std::floor(z), triangle });
        }
      }
    }
  }

  bool cut_lines()
  {
    if (!gather(this->context_, static_cast<Index>(this->surface_.triangles.size()),
          this->crossings_,
          [&](Index f, std::vector<Crossing>& list)
          {
            for (int axis = 0; axis < 3; ++axis)
            {
              crossings_of(static_cast<Id>(f), this->cover_.corners_of(f), axis, list);
            }
          }))
    {
      return false;
    }
    return parallel_sort(this->context_, this->crossings_,
      [](const Crossing& a, const Crossing& b)
      {
        return a.line != b.line ? a.line < b.line
          : a.at != b.at        ? a.at < b.at
                                : a.triangle < b.triangle;
      });
  }

  Vec3 place_on_line(const Crossing& crossing, double at) const
  {
    const Sample s = crossing.sample();
    Vec3 place = place_of_sample(s);
    place[crossing.axis()] =
      (s[crossing.axis()] + at + sample_shift[crossing.axis()]) / samples_along;
    return place;
  }

  /// Connects along the lines that are cut, and measures how much of them is inside.
  Status connect_crossings()
  {
    const auto& list = this->crossings_;
    // Stretches between two crossings, by the first of them.
    std::vector<Index> stretches;
    for (std::size_t i = 0; i + 1 < list.size(); ++i)
    {
      if (list[i].line == list[i + 1].line && list[i + 1].at - list[i].at > touching)
      {
        stretches.push_back(static_cast<Index>(i));
      }
    }
    std::vector<char> inside_after(list.size(), 0);
    {
      Points middles(static_cast<Index>(stretches.size()), 3);
      for (Index i = 0; i < middles.rows(); ++i)
      {
        const Crossing& crossing = list[stretches[i]];
        middles.row(i) = this->cover_.lattice.point_at(
          this->place_on_line(crossing, 0.5 * (crossing.at + list[stretches[i] + 1].at)));
      }
      Eigen::VectorXd w;
      const Status status = this->winding_.evaluate(middles, this->context_, w);
      if (!status.ok())
      {
        return status;
      }
      for (Index i = 0; i < w.size(); ++i)
      {
        inside_after[stretches[i]] = w[i] >= this->threshold_ ? 1 : 0;
      }
    }
    // Which lines at a sample are cut: bits for lines up along x, y, z, then down.
    for (const Crossing& crossing : list)
    {
      const int axis = crossing.axis();
      const Id lower = this->atom_of(crossing.sample());
      const Id upper = this->atom_of(next_of(crossing.sample(), axis));
      this->mark(lower, axis);
      this->mark(upper, axis + 3);
    }
    for (std::size_t begin = 0; begin < list.size();)
    {
      std::size_t end = begin;
      while (end < list.size() && list[end].line == list[begin].line)
      {
        ++end;
      }
      if (begin / often != end / often && this->context_.cancelled())
      {
        return Status::cancelled();
      }
      this->connect_line(begin, end, inside_after);
      begin = end;
    }
    return {};
  }

  static Sample next_of(Sample s, int axis)
  {
    ++s[axis];
    return s;
  }
  void mark(Id sample, int line)
  {
    if (sample >= 0 && sample < this->first_full_)
    {
      this->cut_[sample] = static_cast<std::uint8_t>(this->cut_[sample] | 1U << line);
    }
  }

  void connect_line(std::size_t begin, std::size_t end, const std::vector<char>& inside_after)
  {
    const auto& list = this->crossings_;
    const int axis = list[begin].axis();
    const Id lower = this->atom_of(list[begin].sample());
    const Id upper = this->atom_of(next_of(list[begin].sample(), axis));
    Id last = this->is_inside(lower) ? lower : -1;
    double at = 0.0;
    bool inside = last >= 0;
    for (std::size_t i = begin; i < end; ++i)
    {
      const Key tet = DisphenoidLattice::locate(this->place_on_line(list[i], list[i].at)).tet;
      const Id atom = this->atom_of(list[i].triangle, tet);
      if (inside)
      {
        this->measure(lower, upper, at, list[i].at, last >= 0 ? last : atom);
      }
      if (i > begin ? inside || list[i].at - at <= touching : inside)
      {
        this->connect(last, atom);
      }
      last = atom;
      at = list[i].at;
      inside = inside_after[i] != 0;
    }
    if (this->is_inside(upper))
    {
      this->measure(lower, upper, at, 1.0, upper);
      this->connect(last, upper);
    }
  }

  /// Adds a stretch of a line that is inside to its atom, half a line to each sample's cell.
  void measure(Id lower, Id upper, double from, double to, Id atom)
  {
    if (atom < 0)
    {
      return;
    }
    this->add_share(lower, std::min(to, 0.5) - from, atom);
    this->add_share(upper, to - std::max(from, 0.5), atom);
  }
  void add_share(Id sample, double length, Id atom)
  {
    if (length > 0.0 && sample >= 0 && sample < this->first_full_)
    {
      this->shares_[atom] += static_cast<float>(length / cut_axes(this->cut_[sample]));
    }
  }
  static int cut_axes(unsigned cut)
  {
    const unsigned axes = (cut | cut >> 3) & 7U;
    return static_cast<int>((axes & 1U) + (axes >> 1 & 1U) + (axes >> 2));
  }

  /// Connects samples along lines that are not cut, and measures their cells: as much of one is
  /// inside as of the lines through the sample that are cut.
  bool connect_samples()
  {
    for (Id cube = 0; cube < static_cast<Id>(this->sampled_.size()); ++cube)
    {
      if (cube % 64 == 0 && this->context_.cancelled())
      {
        return false;
      }
      for (int s = 0; s < samples_of_cube; ++s)
      {
        const Id atom = cube * samples_of_cube + s;
        if (this->inside_[atom] == 0)
        {
          continue;
        }
        const unsigned cut = this->cut_[atom];
        const Sample position = position_of(s);
        double share = cut == 0 ? 1.0 : 0.0;
        int stride = 1;
        for (int axis = 0; axis < 3; ++axis, stride *= samples_along)
        {
          const bool up_is_cut = (cut >> axis & 1U) != 0;
          const bool down_is_cut = (cut >> (axis + 3) & 1U) != 0;
          if (up_is_cut != down_is_cut)
          {
            share += 0.5 / cut_axes(cut);
          }
          if (!up_is_cut)
          {
            const Id next = position[axis] + 1 < samples_along
              ? atom + stride
              : this->atom_of(next_of(this->sample_of(cube, s), axis));
            if (this->is_inside(next))
            {
              this->connect(atom, next);
            }
          }
          if (!down_is_cut && position[axis] == 0)
          {
            // Sampled neighbours look up themselves.
            Sample below = this->sample_of(cube, s);
            --below[axis];
            const Id last = this->atom_of(below);
            if (last >= this->first_full_)
            {
              this->connect(atom, last);
            }
          }
        }
        this->shares_[atom] += static_cast<float>(share);
      }
    }
    return true;
  }

  /// Cubes inside hold nothing that separates.
  void connect_cubes()
  {
    for (Id i = 0; i < static_cast<Id>(this->full_.size()); ++i)
    {
      const Cube cube = DisphenoidLattice::cube_of(this->full_[i]);
      for (int half = 0; half < halves; ++half)
      {
        const Id atom = this->first_full_ + i * halves + half;
        this->shares_[atom] = static_cast<float>(this->samples_of_half_[half]);
        if (half % 2 == 0)
        {
          continue;
        }
        const auto above = this->cube_id_.find(
          DisphenoidLattice::cube_key(moved(cube, half / 8, 1))); // across the half's face
        if (above != this->cube_id_.end() && above->second < 0)
        {
          this->atoms_.unite(atom, this->first_full_ + (-1 - above->second) * halves + half - 1);
        }
      }
    }
  }

  // ---- Triangles ----

  bool connect_triangles()
  {
    // Around vertices.
    const auto& triangles = this->surface_.triangles;
    std::vector<Id> first_at(this->surface_.points.size(), -1);
    struct Side
    {
      Id a, b, triangle;
    };
    std::vector<Side> sides;
    for (std::size_t f = 0; f < triangles.size(); ++f)
    {
      if (f % often == 0 && this->context_.cancelled())
      {
        return false;
      }
      for (int k = 0; k < 3; ++k)
      {
        const Id v = triangles[f][k];
        const Id w = triangles[f][(k + 1) % 3];
        const Id atom = this->atom_of(static_cast<Id>(f), this->cover_.tet_of_point[v]);
        Id& first = first_at[v];
        if (first >= 0)
        {
          this->atoms_.unite(first, atom);
        }
        first = first >= 0 ? first : atom;
        // An edge within one tet connects there as its vertices do.
        if (this->cover_.tet_of_point[v] != this->cover_.tet_of_point[w])
        {
          sides.push_back({ std::min(v, w), std::max(v, w), static_cast<Id>(f) });
        }
      }
    }
    this->atom_of_vertex_ = std::move(first_at);
    if (!parallel_sort(this->context_, sides,
          [](const Side& x, const Side& y) { return x.a != y.a ? x.a < y.a : x.b < y.b; }))
    {
      return false;
    }
    for (std::size_t i = 0; i + 1 < sides.size(); ++i)
    {
      if (i % often == 0 && this->context_.cancelled())
      {
        return false;
      }
      if (sides[i].a == sides[i + 1].a && sides[i].b == sides[i + 1].b)
      {
        this->cover_.tets_of_edge(sides[i].a, sides[i].b,
          [&](Key tet)
          {
            this->connect(
              this->atom_of(sides[i].triangle, tet), this->atom_of(sides[i + 1].triangle, tet));
          });
      }
    }
    return true;
  }

  // ---- Parts, copies of nodes, tets ----

  bool find_parts()
  {
    const Id count = this->first_piece_ + static_cast<Id>(this->piece_tets_.size());
    this->part_of_.assign(static_cast<std::size_t>(count), -1);
    for (Id atom = 0; atom < count; ++atom)
    {
      if (atom % often == 0 && this->context_.cancelled())
      {
        return false;
      }
      if (!this->is_inside(atom))
      {
        continue;
      }
      const Id root = this->atoms_.find(atom);
      if (root == atom)
      {
        this->part_of_[atom] = static_cast<Id>(this->part_tets_.size());
        this->part_tets_.push_back(this->tet_of(atom));
        this->part_shares_.push_back(0.0);
      }
      this->part_of_[atom] = this->part_of_[root];
      this->part_shares_[this->part_of_[atom]] += static_cast<double>(this->shares_[atom]);
    }
    this->corners_.reset(4 * this->part_tets_.size());
    return true;
  }

  /// Atoms of a convex piece of material: the nodes that two of them have in common see one part.
  template <typename AtomAt>
  void join_convex(Index count, const AtomAt& atom_at)
  {
    this->at_node_.clear();
    for (Index i = 0; i < count; ++i)
    {
      const Id part = this->part_of_[atom_at(i)];
      const auto& nodes = this->nodes_[this->part_tets_[part]];
      for (int k = 0; k < 4; ++k)
      {
        this->at_node_.emplace_back(nodes[k], 4 * part + k);
      }
    }
    std::sort(this->at_node_.begin(), this->at_node_.end());
    for (std::size_t i = 1; i < this->at_node_.size(); ++i)
    {
      if (this->at_node_[i].first == this->at_node_[i - 1].first)
      {
        this->corners_.unite(this->at_node_[i].second, this->at_node_[i - 1].second);
      }
    }
  }

  bool join_corners()
  {
    for (std::size_t i = 0; i < this->across_.size(); ++i)
    {
      if (i % often == 0 && this->context_.cancelled())
      {
        return false;
      }
      const Id p = this->part_of_[this->across_[i].first];
      const Id q = this->part_of_[this->across_[i].second];
      const auto& of_p = this->nodes_[this->part_tets_[p]];
      const auto& of_q = this->nodes_[this->part_tets_[q]];
      for (int k = 0; k < 4; ++k)
      {
        for (int l = 0; l < 4; ++l)
        {
          if (of_p[k] == of_q[l])
          {
            this->corners_.unite(4 * p + k, 4 * q + l);
          }
        }
      }
    }
    const auto& first = this->cover_.first_piece;
    for (std::size_t f = 0; f + 1 < first.size(); ++f)
    {
      if (f % often == 0 && this->context_.cancelled())
      {
        return false;
      }
      if (first[f + 1] - first[f] > 1)
      {
        this->join_convex(first[f + 1] - first[f],
          [&](Index i) { return this->first_piece_ + static_cast<Id>(first[f] + i); });
      }
    }
    for (Id cube = 0; cube < static_cast<Id>(this->full_.size()); ++cube)
    {
      this->join_convex(
        halves, [&](Index i) { return this->first_full_ + cube * halves + static_cast<Id>(i); });
    }
    return true;
  }

  // ---- Probes ----

  Vec3 place_of(Id atom) const
  {
    if (atom >= this->first_piece_)
    {
      return this->cover_.pieces[atom - this->first_piece_].middle;
    }
    if (atom < this->first_full_)
    {
      return place_of_sample(this->sample_of(atom / samples_of_cube, atom % samples_of_cube));
    }
    const auto& nodes = this->nodes_[this->tet_of(atom)];
    const auto& lattice = this->cover_.lattice;
    const Cube cube = DisphenoidLattice::cube_of(this->full_[(atom - this->first_full_) / halves]);
    // The half's face and the cube's centre.
    const Vec3 edge = 0.5 * (lattice.node_point(nodes[2]) + lattice.node_point(nodes[3]));
    return 0.5 * (lattice.place_of(edge) + Vec3(cube[0] + 0.5, cube[1] + 0.5, cube[2] + 0.5));
  }

  /// Where the line from a to b meets a triangle, as a share of it; hits just beside the triangle
  /// count too: all they do is to cut the line once more.
  static bool meets(const Vec3& a, const Vec3& b, const std::array<Vec3, 3>& t, double& at)
  {
    const Vec3 u = t[1] - t[0];
    const Vec3 v = t[2] - t[0];
    const Vec3 d = b - a;
    const Vec3 n = u.cross(v);
    const double along = -n.dot(d);
    if (along == 0.0)
    {
      return false;
    }
    const Vec3 p = a - t[0];
    const Vec3 e = p.cross(d);
    constexpr double slack = 1e-9;
    const double s = v.dot(e) / along;
    const double r = -u.dot(e) / along;
    at = n.dot(p) / along;
    return s >= -slack && r >= -slack && s + r <= 1.0 + slack && at > 0.0 && at < 1.0;
  }

  /// True when the line from a to b, crossed by these triangles only, stays in the material.
  bool stays_inside(
    const Vec3& a, const Vec3& b, const std::vector<Id>& triangles, std::vector<double>& cuts) const
  {
    const double length = (b - a).norm();
    const auto inside_at = [&](double t)
    {
      const Vec3 p = this->cover_.lattice.point_at(a + t * (b - a));
      return this->winding_.evaluate_at(p) >= this->threshold_;
    };
    if (length > touching && !inside_at(0.5))
    {
      return false;
    }
    cuts.assign({ 0.0, 1.0 });
    for (const Id f : triangles)
    {
      double at = 0.0;
      if (meets(a, b, this->cover_.corners_of(f), at))
      {
        cuts.push_back(at);
      }
    }
    std::sort(cuts.begin(), cuts.end());
    for (std::size_t i = 1; i < cuts.size(); ++i)
    {
      if ((cuts[i] - cuts[i - 1]) * length > touching && !inside_at(0.5 * (cuts[i] + cuts[i - 1])))
      {
        return false;
      }
    }
    return true;
  }

  using Corner = std::pair<Key, Id>; ///< a node and a (part, corner) there

  /// Finds copies of one node that are connected: adds pairs of corners to unite.
  void probe_node(const Corner* begin, const Corner* end, const std::vector<Id>& roots,
    std::vector<std::pair<Id, Id>>& joined) const
  {
    struct Side
    {
      Id root;
      std::vector<Vec3> places;
    };
    std::vector<Side> sides;
    std::vector<Id> triangles;
    for (const Corner* c = begin; c != end; ++c)
    {
      const Id root = roots[c->second];
      auto side = std::find_if(
        sides.begin(), sides.end(), [&](const Side& other) { return other.root == root; });
      if (side == sides.end())
      {
        side = sides.insert(side, { root, {} });
      }
      const Id part = c->second / 4;
      for (Index i = this->first_of_part_[part]; i < this->first_of_part_[part + 1]; ++i)
      {
        const Id atom = this->of_part_[i];
        side->places.push_back(this->place_of(atom));
        if (atom >= this->first_piece_)
        {
          triangles.push_back(this->cover_.pieces[atom - this->first_piece_].triangle);
        }
      }
    }
    sort_unique(triangles);
    constexpr std::size_t most_places = 40;
    for (Side& side : sides)
    {
      const std::size_t count = side.places.size();
      for (std::size_t i = 0; i < most_places && count > most_places; ++i)
      {
        side.places[i] = side.places[i * count / most_places];
      }
      side.places.resize(std::min(count, most_places));
    }
    std::vector<double> cuts;
    UnionFind sides_joined;
    sides_joined.reset(sides.size());
    for (std::size_t i = 0; i < sides.size(); ++i)
    {
      for (std::size_t j = i + 1; j < sides.size(); ++j)
      {
        const auto a = static_cast<Id>(i);
        const auto b = static_cast<Id>(j);
        if (sides_joined.find(a) != sides_joined.find(b) &&
          this->probe(sides[i].places, sides[j].places, triangles, cuts))
        {
          sides_joined.unite(a, b);
          joined.emplace_back(sides[i].root, sides[j].root);
        }
      }
    }
  }

  bool probe(const std::vector<Vec3>& from, const std::vector<Vec3>& to,
    const std::vector<Id>& triangles, std::vector<double>& cuts) const
  {
    struct Line
    {
      double squared_length;
      std::size_t from, to;
      bool operator<(const Line& other) const
      {
        return std::tie(this->squared_length, this->from, this->to) <
          std::tie(other.squared_length, other.from, other.to);
      }
    };
    std::vector<Line> lines;
    for (std::size_t i = 0; i < from.size(); ++i)
    {
      for (std::size_t j = 0; j < to.size(); ++j)
      {
        lines.push_back({ (from[i] - to[j]).squaredNorm(), i, j });
      }
    }
    constexpr std::size_t most_lines = 12;
    const std::size_t count = std::min(lines.size(), most_lines);
    std::partial_sort(lines.begin(), lines.begin() + static_cast<Index>(count), lines.end());
    lines.resize(count);
    return std::any_of(lines.begin(), lines.end(),
      [&](const Line& line)
      { return this->stays_inside(from[line.from], to[line.to], triangles, cuts); });
  }

  bool probe_nodes()
  {
    const auto parts = static_cast<Id>(this->part_tets_.size());
    this->first_of_part_.assign(static_cast<std::size_t>(parts) + 1, 0);
    for (const Id part : this->part_of_)
    {
      if (part >= 0)
      {
        ++this->first_of_part_[part + 1];
      }
    }
    std::partial_sum(
      this->first_of_part_.begin(), this->first_of_part_.end(), this->first_of_part_.begin());
    this->of_part_.resize(static_cast<std::size_t>(this->first_of_part_.back()));
    std::vector<Index> next(this->first_of_part_.begin(), this->first_of_part_.end() - 1);
    for (std::size_t atom = 0; atom < this->part_of_.size(); ++atom)
    {
      if (this->part_of_[atom] >= 0)
      {
        this->of_part_[next[this->part_of_[atom]]++] = static_cast<Id>(atom);
      }
    }
    std::vector<Id> roots(4 * static_cast<std::size_t>(parts));
    std::vector<Corner> corners(roots.size());
    for (Id i = 0; i < 4 * parts; ++i)
    {
      roots[i] = this->corners_.find(i);
      corners[i] = { this->nodes_[this->part_tets_[i / 4]][i % 4], i };
    }
    if (!parallel_sort(this->context_, corners, std::less<>()))
    {
      return false;
    }
    constexpr std::size_t most_copies = 12; // more: a soup, not a slice
    std::vector<Id> copies;
    std::vector<std::pair<Index, Index>> several; // ranges of corners of nodes with copies
    for (std::size_t begin = 0; begin < corners.size();)
    {
      std::size_t end = begin;
      copies.clear();
      for (; end < corners.size() && corners[end].first == corners[begin].first; ++end)
      {
        copies.push_back(roots[corners[end].second]);
      }
      sort_unique(copies);
      if (copies.size() > 1 && copies.size() <= most_copies)
      {
        several.emplace_back(begin, end);
      }
      begin = end;
    }
    std::vector<std::pair<Id, Id>> joined;
    constexpr Index nodes_at_once = 16;
    if (!gather(
          this->context_, static_cast<Index>(several.size()), joined,
          [&](Index i, std::vector<std::pair<Id, Id>>& list)
          {
            this->probe_node(
              corners.data() + several[i].first, corners.data() + several[i].second, roots, list);
          },
          nodes_at_once))
    {
      return false;
    }
    for (const auto& [a, b] : joined)
    {
      this->corners_.unite(a, b);
    }
    return true;
  }

  // ---- The result ----

  bool write(EmbeddingTets& result)
  {
    // Parts with the same tet and the same copies of its nodes are one tet.
    struct Copy
    {
      Id tet;
      std::array<Id, 4> corners;
      Id part;
    };
    std::vector<Copy> copies(this->part_tets_.size());
    for (std::size_t p = 0; p < copies.size(); ++p)
    {
      copies[p].tet = this->part_tets_[p];
      copies[p].part = static_cast<Id>(p);
      for (int k = 0; k < 4; ++k)
      {
        copies[p].corners[k] = this->corners_.find(static_cast<Id>(4 * p + k));
      }
    }
    const auto same = [](const Copy& a, const Copy& b)
    { return a.tet == b.tet && a.corners == b.corners; };
    if (!parallel_sort(this->context_, copies,
          [](const Copy& a, const Copy& b)
          { return a.tet != b.tet ? a.tet < b.tet : a.corners < b.corners; }))
    {
      return false;
    }
    std::vector<std::pair<Key, Id>> vertices; // node, copy
    std::vector<Index> tet_of_part(copies.size());
    std::vector<std::size_t> first_of_tet;
    for (std::size_t i = 0; i < copies.size(); ++i)
    {
      if (i == 0 || !same(copies[i - 1], copies[i]))
      {
        result.lattice_tets += i == 0 || copies[i - 1].tet != copies[i].tet ? 1 : 0;
        first_of_tet.push_back(i);
        for (int k = 0; k < 4; ++k)
        {
          vertices.emplace_back(this->nodes_[copies[i].tet][k], copies[i].corners[k]);
        }
      }
      tet_of_part[copies[i].part] = static_cast<Index>(first_of_tet.size()) - 1;
    }
    sort_unique(vertices);
    const auto vertex_count = static_cast<Index>(vertices.size());
    result.mesh.points.resize(vertex_count, 3);
    for (Index v = 0; v < vertex_count; ++v)
    {
      result.mesh.points.row(v) = this->cover_.lattice.node_point(vertices[v].first);
      result.duplicated_nodes += v > 0 && vertices[v].first == vertices[v - 1].first ? 1 : 0;
    }
    const auto tet_count = static_cast<Index>(first_of_tet.size());
    result.mesh.tets.resize(tet_count, 4);
    result.inside_fractions = Eigen::VectorXd::Zero(tet_count);
    for (Index t = 0; t < tet_count; ++t)
    {
      const Copy& copy = copies[first_of_tet[t]];
      for (int k = 0; k < 4; ++k)
      {
        const auto vertex = std::make_pair(this->nodes_[copy.tet][k], copy.corners[k]);
        result.mesh.tets(t, k) =
          std::lower_bound(vertices.begin(), vertices.end(), vertex) - vertices.begin();
      }
    }
    double shares = 0.0;
    for (const Copy& copy : copies)
    {
      result.inside_fractions[tet_of_part[copy.part]] += this->part_shares_[copy.part];
      shares += this->part_shares_[copy.part];
    }
    for (Index t = 0; t < tet_count; ++t)
    {
      const int number = 2 * DisphenoidLattice::number_of(this->tets_[copies[first_of_tet[t]].tet]);
      const int samples = this->samples_of_half_[number] + this->samples_of_half_[number + 1];
      result.inside_fractions[t] = std::min(1.0, result.inside_fractions[t] / samples);
    }
    // Tets hold 10 to 28 samples, by how they lie to the sub-grid: right for whole tets, but plates
    // along it would come out too thick or too thin. The samples' own volume has no such bias.
    constexpr double samples_of_tet = samples_of_cube / 12.0;
    const double whole = (result.inside_fractions.array() >= 1.0).count();
    const double cut = result.inside_fractions.sum() - whole;
    if (cut > 0.0)
    {
      const double right = std::clamp((shares / samples_of_tet - whole) / cut, 0.5, 2.0);
      for (double& fraction : result.inside_fractions)
      {
        fraction = fraction < 1.0 ? std::min(1.0, right * fraction) : fraction;
      }
    }
    this->bind(tet_of_part, result);
    return true;
  }

  void bind(const std::vector<Index>& tet_of_part, EmbeddingTets& result)
  {
    // For points that no triangle uses: of a tet's copies the one that holds most.
    std::vector<Index> fullest(this->tets_.size(), -1);
    for (std::size_t p = 0; p < tet_of_part.size(); ++p)
    {
      Index& best = fullest[this->part_tets_[p]];
      const Index t = tet_of_part[p];
      if (best < 0 || result.inside_fractions[t] > result.inside_fractions[best])
      {
        best = t;
      }
    }
    PointBinding& binding = result.binding;
    binding.tets.assign(static_cast<std::size_t>(this->points_.rows()), -1);
    binding.coordinates.setZero(this->points_.rows(), 4);
    for (Index i = 0; i < this->points_.rows(); ++i)
    {
      const Id vertex = this->surface_.of_point[i];
      const Vec3 place = this->cover_.lattice.place_of(this->points_.row(i));
      if (vertex < 0 && !((place.array() >= 0.0).all() && (place.array() < 65535.0).all()))
      {
        continue;
      }
      const auto location = DisphenoidLattice::locate(place);
      Index tet = -1;
      if (vertex >= 0)
      {
        tet = tet_of_part[this->part_of_[this->atom_of_vertex_[vertex]]];
      }
      else
      {
        const Id at = place_in(this->tets_, location.tet);
        tet = at < static_cast<Id>(this->tets_.size()) && this->tets_[at] == location.tet
          ? fullest[at]
          : -1;
      }
      binding.tets[i] = tet;
      for (int k = 0; k < 4 && tet >= 0; ++k)
      {
        binding.coordinates(i, k) = location.coordinates[k];
      }
    }
  }

  /// Crossings nearer than this share of the samples' distance are one.
  static constexpr double touching = 1e-9;

  PointsView points_;
  const LatticeSurface& surface_;
  const WindingNumber& winding_;
  double threshold_;
  const LatticeCover& cover_;
  ExecutionContext& context_;

  std::vector<Key> sampled_, full_; // cubes, sorted
  std::unordered_map<Key, Id> cube_id_; // place in sampled_, or -1 - place in full_
  std::vector<Key> tets_; // sorted
  std::vector<std::array<Key, 4>> nodes_; // of tets_
  std::vector<Id> half_tets_; // places in tets_: 24 a sampled cube, then 24 a full one
  std::vector<Id> piece_tets_; // places in tets_ of cover_.pieces
  std::array<int, samples_of_cube> half_of_sample_{};
  std::array<int, halves> samples_of_half_{};
  Id first_full_ = 0; // of the atoms
  Id first_piece_ = 0;

  std::vector<std::uint8_t> inside_; // of the samples
  std::vector<std::uint8_t> cut_; // of the samples: which of the six lines are
  std::vector<Crossing> crossings_; // by line, then along it
  std::vector<float> shares_; // of the atoms: how much is inside, in cells of a sample
  std::vector<Id> atom_of_vertex_;
  UnionFind atoms_; // those of one tet
  std::vector<std::pair<Id, Id>> across_; // connected atoms of different tets

  std::vector<Id> part_of_; // of the atoms
  std::vector<Id> part_tets_; // places in tets_
  std::vector<double> part_shares_;
  std::vector<Index> first_of_part_; // of each part's atoms
  std::vector<Id> of_part_;
  UnionFind corners_; // 4 * part + corner
  std::vector<std::pair<Key, Id>> at_node_;
};

Index count_branching_facets(TetsView tets)
{
  std::vector<std::array<Index, 3>> facets;
  facets.reserve(static_cast<std::size_t>(4 * tets.rows()));
  for (Index t = 0; t < tets.rows(); ++t)
  {
    for (int k = 0; k < 4; ++k)
    {
      std::array<Index, 3> facet{ tets(t, (k + 1) % 4), tets(t, (k + 2) % 4),
        tets(t, (k + 3) % 4) };
      std::sort(facet.begin(), facet.end());
      facets.push_back(facet);
    }
  }
  std::sort(facets.begin(), facets.end());
  Index count = 0;
  for (std::size_t i = 0; i + 2 < facets.size(); ++i)
  {
    const bool first = i == 0 || facets[i - 1] != facets[i];
    count += first && facets[i] == facets[i + 2] ? 1 : 0;
  }
  return count;
}

Status check(PointsView points, TrianglesView triangles, const EmbeddingOptions& options)
{
  Status status = check_mesh(points, triangles);
  if (!status.ok())
  {
    return status;
  }
  if (triangles.rows() == 0)
  {
    return Status::invalid_input("the surface has no triangles");
  }
  constexpr Index most = std::numeric_limits<Id>::max() / 64;
  if (triangles.rows() > most || points.rows() > std::numeric_limits<Id>::max())
  {
    return Status::invalid_input(
      "the surface has more than " + std::to_string(most) + " triangles");
  }
  if (options.resolution < 0 || options.resolution > LatticeCover::largest_resolution)
  {
    return Status::invalid_input("resolution must be from 0 to " +
      std::to_string(LatticeCover::largest_resolution) + " cubes, not " +
      std::to_string(options.resolution));
  }
  if (!std::isfinite(options.winding_threshold) || options.winding_threshold <= 0.0)
  {
    return Status::invalid_input("winding_threshold must be positive");
  }
  return {};
}
} // namespace

Status embed_surface(PointsView points, TrianglesView triangles, const WindingNumber& winding,
  const EmbeddingOptions& options, EmbeddingTets& result, ExecutionContext& context)
{
  result = EmbeddingTets();
  Status status = check(points, triangles, options);
  if (!status.ok())
  {
    return status;
  }
  const Box box = bounding_box(points, triangles);
  constexpr double largest_size = 1e100; // its cube is a volume
  if (!(box.size().maxCoeff() <= largest_size))
  {
    return Status::invalid_input("the surface is larger than 1e100, too large for volumes");
  }
  LatticeSurface surface;
  LatticeCover cover(surface, winding, options.winding_threshold, box);
  {
    const Phase phase(context, "lattice", 0.0, 0.4);
    status = surface.build(points, triangles, context) ? cover.choose(options.resolution, context)
                                                       : Status::cancelled();
    if (!status.ok())
    {
      return status;
    }
  }
  {
    const Phase phase(context, "parts", 0.4, 1.0);
    status =
      Embedding(points, surface, winding, options.winding_threshold, cover, context).run(result);
  }
  if (!status.ok())
  {
    result = EmbeddingTets();
    return status;
  }
  result.spacing = cover.lattice.spacing();
  result.resolution = static_cast<Index>(std::ceil(box.size().maxCoeff() / result.spacing));
  result.branching_facets = count_branching_facets(result.mesh.tets);
  result.components = connected_components(result.mesh.points.rows(), result.mesh.tets).count;
  status.report.set("spacing", result.spacing);
  status.report.set("resolution", result.resolution);
  status.report.set("counts.lattice_tets", result.lattice_tets);
  status.report.set("counts.duplicated_nodes", result.duplicated_nodes);
  status.report.set("counts.branching_facets", result.branching_facets);
  status.report.set("counts.tet_components", result.components);
  return status;
}

} // namespace bindpose
