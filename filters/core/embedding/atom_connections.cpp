// Connections of atoms by lines between samples, by triangles and by links (see
// atom_connections.h). These are steps 3 and 4 of the method in embedding_tets.cpp. A line is the
// segment between two samples that are neighbors along an axis; a line is cut if a triangle crosses
// it.
#include "embedding/atom_connections.h"

#include "base/gather.h"
#include "base/parallel_sort.h"
#include "embedding/line_crossings.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace bindpose
{

namespace
{
using Key = EmbeddingAtoms::Key;
using Cube = EmbeddingAtoms::Cube;
using Id = EmbeddingAtoms::Id;
using Sample = EmbeddingAtoms::Sample;

Cube moved(Cube cube, int axis, int by)
{
  cube[axis] += by;
  return cube;
}

class Connector
{
public:
  Connector(ExecutionContext& context, const LatticeSurface& surface, const WindingNumber& winding,
    double threshold, const LatticeCover& cover, const EmbeddingAtoms& atoms,
    AtomConnections& result)
    : surface_(surface), winding_(winding), threshold_(threshold), cover_(cover), atoms_(atoms),
      result_(result), context_(context)
  {
  }

  Status run()
  {
    const auto count = static_cast<std::size_t>(this->atoms_.count());
    this->result_.within_tets.reset(count);
    this->result_.inside_volume.assign(count, 0.0F);
    this->cut_.assign(static_cast<std::size_t>(this->atoms_.first_full_atom), 0);
    if (!this->cut_lines())
    {
      return Status::canceled();
    }
    const Status status = this->connect_crossings();
    if (!status.ok())
    {
      return status;
    }
    if (!this->connect_samples() || !this->connect_triangles())
    {
      return Status::canceled();
    }
    this->connect_links();
    this->connect_cubes();
    return {};
  }

private:
  void connect(Id a, Id b)
  {
    if (a < 0 || b < 0)
    {
      return;
    }
    if (this->atoms_.tet_of(a) == this->atoms_.tet_of(b))
    {
      this->result_.within_tets.unite(a, b);
    }
    else
    {
      this->result_.between_tets.emplace_back(a, b);
    }
  }

  // ---- Lines between samples ----

  bool cut_lines()
  {
    if (!gather(this->context_, static_cast<Index>(this->surface_.triangles.size()),
          this->crossings_,
          [&](Index f, std::vector<LineCrossing>& list)
          {
            for (int axis = 0; axis < 3; ++axis)
            {
              add_line_crossings(static_cast<Id>(f), this->cover_.corners_of(f), axis, list);
            }
          }))
    {
      return false;
    }
    return parallel_sort(this->context_, this->crossings_,
      [](const LineCrossing& a, const LineCrossing& b)
      {
        return a.line != b.line ? a.line < b.line
          : a.at != b.at        ? a.at < b.at
                                : a.triangle < b.triangle;
      });
  }

  /// Connect atoms along the cut lines, and measure how much of each line is inside.
  Status connect_crossings()
  {
    const auto& list = this->crossings_;
    // Intervals between two crossings on one line. Each interval is represented by the index of its
    // first crossing.
    std::vector<Index> intervals;
    for (std::size_t i = 0; i + 1 < list.size(); ++i)
    {
      if (list[i].line == list[i + 1].line &&
        list[i + 1].at - list[i].at > LineCrossing::merge_distance)
      {
        intervals.push_back(static_cast<Index>(i));
      }
    }
    std::vector<char> inside_after(list.size(), 0);
    {
      Points middles(static_cast<Index>(intervals.size()), 3);
      for (Index i = 0; i < middles.rows(); ++i)
      {
        const LineCrossing& crossing = list[intervals[i]];
        middles.row(i) = this->cover_.lattice.world_point(
          crossing.position(0.5 * (crossing.at + list[intervals[i] + 1].at)));
      }
      Eigen::VectorXd w;
      const Status status = this->winding_.evaluate(this->context_, middles, w);
      if (!status.ok())
      {
        return status;
      }
      for (Index i = 0; i < w.size(); ++i)
      {
        inside_after[intervals[i]] = w[i] >= this->threshold_ ? 1 : 0;
      }
    }
    // Mark the cut lines at each sample: bits 0 to 2 for the lines to the next samples along x, y,
    // z, bits 3 to 5 for the lines to the previous samples.
    for (const LineCrossing& crossing : list)
    {
      const int axis = crossing.axis();
      const Id lower = this->atoms_.atom_of(crossing.sample());
      const Id upper = this->atoms_.atom_of(CubeSamples::next_sample(crossing.sample(), axis));
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
      if (begin / atoms_per_check != end / atoms_per_check && this->context_.canceled())
      {
        return Status::canceled();
      }
      this->connect_line(begin, end, inside_after);
      begin = end;
    }
    return {};
  }

  void mark(Id sample, int line)
  {
    if (sample >= 0 && sample < this->atoms_.first_full_atom)
    {
      this->cut_[sample] = static_cast<std::uint8_t>(this->cut_[sample] | 1U << line);
    }
  }

  void connect_line(std::size_t begin, std::size_t end, const std::vector<char>& inside_after)
  {
    const auto& list = this->crossings_;
    const int axis = list[begin].axis();
    const Id lower = this->atoms_.atom_of(list[begin].sample());
    const Id upper = this->atoms_.atom_of(CubeSamples::next_sample(list[begin].sample(), axis));
    Id last = this->atoms_.is_inside(lower) ? lower : -1;
    double at = 0.0;
    bool inside = last >= 0;
    for (std::size_t i = begin; i < end; ++i)
    {
      const Key tet = DisphenoidLattice::locate(list[i].position(list[i].at)).tet;
      const Id atom = this->atoms_.atom_of(list[i].triangle, tet);
      if (inside)
      {
        this->measure(lower, upper, at, list[i].at, last >= 0 ? last : atom);
      }
      if (i > begin ? inside || list[i].at - at <= LineCrossing::merge_distance : inside)
      {
        this->connect(last, atom);
      }
      last = atom;
      at = list[i].at;
      inside = inside_after[i] != 0;
    }
    if (this->atoms_.is_inside(upper))
    {
      this->measure(lower, upper, at, 1.0, upper);
      this->connect(last, upper);
    }
  }

  /// Add an interval of a line to the volume of an atom. The interval is inside; `from` and `to`
  /// are its ends, as positions 0 … 1 on the line. Each half of the line belongs to the cell of the
  /// nearer sample. `lower` and `upper` are the samples at the ends of the line.
  void measure(Id lower, Id upper, double from, double to, Id atom)
  {
    if (atom < 0)
    {
      return;
    }
    this->add_volume(lower, std::min(to, 0.5) - from, atom);
    this->add_volume(upper, to - std::max(from, 0.5), atom);
  }
  void add_volume(Id sample, double length, Id atom)
  {
    if (length > 0.0 && sample >= 0 && sample < this->atoms_.first_full_atom)
    {
      this->result_.inside_volume[atom] +=
        static_cast<float>(length / cut_axes(this->cut_[sample]));
    }
  }
  static int cut_axes(unsigned cut)
  {
    const unsigned axes = (cut | cut >> 3) & 7U;
    return static_cast<int>((axes & 1U) + (axes >> 1 & 1U) + (axes >> 2));
  }

  /// Connect neighboring samples if no triangle crosses the line between them, and measure how much
  /// of each sample's cell is inside. A cell is completely inside if no triangle crosses a line at
  /// its sample. Otherwise, consider the axes along which a line at the sample is crossed. For each
  /// such axis, find which fraction of the line within the cell is inside. The inside fraction of
  /// the cell is the mean of these fractions.
  bool connect_samples()
  {
    for (Id cube = 0; cube < static_cast<Id>(this->atoms_.sampled_cubes.size()); ++cube)
    {
      if (cube % 64 == 0 && this->context_.canceled())
      {
        return false;
      }
      for (int s = 0; s < CubeSamples::samples_per_cube; ++s)
      {
        const Id atom = cube * CubeSamples::samples_per_cube + s;
        if (!this->atoms_.is_inside(atom))
        {
          continue;
        }
        const unsigned cut = this->cut_[atom];
        const Sample position = CubeSamples::local_coordinates(s);
        double fraction = cut == 0 ? 1.0 : 0.0;
        int stride = 1;
        for (int axis = 0; axis < 3; ++axis, stride *= CubeSamples::samples_per_edge)
        {
          const bool up_is_cut = (cut >> axis & 1U) != 0;
          const bool down_is_cut = (cut >> (axis + 3) & 1U) != 0;
          if (up_is_cut != down_is_cut)
          {
            fraction += 0.5 / cut_axes(cut);
          }
          if (!up_is_cut)
          {
            const Id next = position[axis] + 1 < CubeSamples::samples_per_edge
              ? atom + stride
              : this->atoms_.atom_of(
                  CubeSamples::next_sample(this->atoms_.global_coordinates(cube, s), axis));
            if (this->atoms_.is_inside(next))
            {
              this->connect(atom, next);
            }
          }
          if (!down_is_cut && position[axis] == 0)
          {
            // The previous point along the axis is in the adjacent cube. If that cube is sampled,
            // the connection is made when the lines of its samples are processed. If that cube is
            // completely inside, the connection is made here.
            Sample previous = this->atoms_.global_coordinates(cube, s);
            --previous[axis];
            const Id last = this->atoms_.atom_of(previous);
            if (last >= this->atoms_.first_full_atom)
            {
              this->connect(atom, last);
            }
          }
        }
        this->result_.inside_volume[atom] += static_cast<float>(fraction);
      }
    }
    return true;
  }

  /// Connect neighboring cubes that are completely inside. No triangle separates them.
  void connect_cubes()
  {
    for (Id i = 0; i < static_cast<Id>(this->atoms_.full_cubes.size()); ++i)
    {
      const Cube cube = DisphenoidLattice::cube_of(this->atoms_.full_cubes[i]);
      for (int half = 0; half < EmbeddingAtoms::halves; ++half)
      {
        const Id atom = this->atoms_.first_full_atom + i * EmbeddingAtoms::halves + half;
        this->result_.inside_volume[atom] = static_cast<float>(this->atoms_.samples_of_half[half]);
        if (half % 2 == 0)
        {
          continue;
        }
        // This half is in the lower cube of its tet. The other half of the tet is in the next cube
        // along the normal axis of the face between the two cubes.
        const Id adjacent_cube = this->atoms_.full_cube(moved(cube, half / 8, 1));
        if (adjacent_cube >= 0)
        {
          this->result_.within_tets.unite(
            atom, this->atoms_.first_full_atom + adjacent_cube * EmbeddingAtoms::halves + half - 1);
        }
      }
    }
  }

  // ---- Triangles ----

  bool connect_triangles()
  {
    // Connect the triangles around each vertex.
    const auto& triangles = this->surface_.triangles;
    std::vector<Id> first_at(this->surface_.points.size(), -1);
    struct Side
    {
      Id a, b, triangle;
    };
    std::vector<Side> sides;
    for (std::size_t f = 0; f < triangles.size(); ++f)
    {
      if (f % atoms_per_check == 0 && this->context_.canceled())
      {
        return false;
      }
      for (int k = 0; k < 3; ++k)
      {
        const Id v = triangles[f][k];
        const Id w = triangles[f][(k + 1) % 3];
        const Id atom = this->atoms_.atom_of(static_cast<Id>(f), this->cover_.tet_of_point[v]);
        Id& first = first_at[v];
        if (first >= 0)
        {
          this->result_.within_tets.unite(first, atom);
        }
        first = first >= 0 ? first : atom;
        // If both ends of an edge are in one tet, the whole edge is in this tet. The triangles at
        // the edge are then already connected in this tet, because they share the ends of the edge.
        if (this->cover_.tet_of_point[v] != this->cover_.tet_of_point[w])
        {
          sides.push_back({ std::min(v, w), std::max(v, w), static_cast<Id>(f) });
        }
      }
    }
    this->result_.atom_of_vertex = std::move(first_at);
    if (!parallel_sort(this->context_, sides,
          [](const Side& x, const Side& y) { return x.a != y.a ? x.a < y.a : x.b < y.b; }))
    {
      return false;
    }
    for (std::size_t i = 0; i + 1 < sides.size(); ++i)
    {
      if (i % atoms_per_check == 0 && this->context_.canceled())
      {
        return false;
      }
      if (sides[i].a == sides[i + 1].a && sides[i].b == sides[i + 1].b)
      {
        this->cover_.tets_of_edge(sides[i].a, sides[i].b,
          [&](Key tet)
          {
            this->connect(this->atoms_.atom_of(sides[i].triangle, tet),
              this->atoms_.atom_of(sides[i + 1].triangle, tet));
          });
      }
    }
    return true;
  }

  /// Connect the degenerate triangle of each link to the triangles that contain the link's ends.
  void connect_links()
  {
    for (const LatticeSurface::End& end : this->surface_.ends)
    {
      const Key tet = this->cover_.tet_of_point[end.point];
      Id end_atom = this->atoms_.atom_of(end.triangle, tet);
      if (end_atom < 0) // because of rounding, the triangle has a piece only in a neighboring tet
      {
        end_atom = this->nearest_piece(end.triangle, this->cover_.positions[end.point]);
      }
      this->connect(this->atoms_.atom_of(end.link, tet), end_atom);
    }
  }

  /// Compare the pieces of a triangle by the distances of their middles from a position. Return the
  /// atom of the nearest piece.
  Id nearest_piece(Id triangle, const Vec3& position) const
  {
    const auto& pieces = this->cover_.pieces;
    const auto begin = pieces.begin() + this->cover_.first_piece[triangle];
    const auto end = pieces.begin() + this->cover_.first_piece[triangle + 1];
    const auto nearest = std::min_element(begin, end,
      [&](const LatticeCover::Piece& a, const LatticeCover::Piece& b)
      { return (a.middle - position).squaredNorm() < (b.middle - position).squaredNorm(); });
    return this->atoms_.first_piece + static_cast<Id>(nearest - pieces.begin());
  }

  const LatticeSurface& surface_;
  const WindingNumber& winding_;
  double threshold_;
  const LatticeCover& cover_;
  const EmbeddingAtoms& atoms_;
  AtomConnections& result_;
  ExecutionContext& context_;

  std::vector<std::uint8_t> cut_; // #samples: bits of the lines that are cut
  // Crossings of lines with triangles, sorted by line, then by position on the line.
  std::vector<LineCrossing> crossings_;
};
} // namespace

Status connect_atoms(ExecutionContext& context, const LatticeSurface& surface,
  const WindingNumber& winding, double threshold, const LatticeCover& cover,
  const EmbeddingAtoms& atoms, AtomConnections& result)
{
  return Connector(context, surface, winding, threshold, cover, atoms, result).run();
}

} // namespace bindpose
