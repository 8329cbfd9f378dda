// Numbering of the atoms and their positions (see embedding_atoms.h).
#include "embedding/embedding_atoms.h"

#include "base/parallel_sort.h"

#include <algorithm>
#include <functional>

namespace bindpose
{

namespace
{
using Key = EmbeddingAtoms::Key;
using Id = EmbeddingAtoms::Id;

constexpr Index most_sampled_cubes = 1000000;

/// Return the index of a key in a sorted list, or of the first larger key.
Id sorted_index(const std::vector<Key>& sorted, Key key)
{
  return static_cast<Id>(std::lower_bound(sorted.begin(), sorted.end(), key) - sorted.begin());
}
} // namespace

Status EmbeddingAtoms::number(ExecutionContext& context)
{
  for (const auto& [key, kind] : this->cover_.kinds)
  {
    (kind == LatticeCover::Kind::cut ? this->sampled_cubes : this->full_cubes).push_back(key);
  }
  if (static_cast<Index>(this->sampled_cubes.size()) > most_sampled_cubes)
  {
    return context.canceled() ? Status::canceled() : LatticeCover::too_many_cubes();
  }
  std::sort(this->sampled_cubes.begin(), this->sampled_cubes.end());
  std::sort(this->full_cubes.begin(), this->full_cubes.end());
  for (const auto* cubes : { &this->sampled_cubes, &this->full_cubes })
  {
    for (const Key key : *cubes)
    {
      for (int half = 0; half < halves; ++half)
      {
        this->tets.push_back(DisphenoidLattice::tet_of_half(DisphenoidLattice::cube_of(key), half));
      }
    }
  }
  std::vector<Key> half_tets = this->tets;
  for (const LatticeCover::Piece& piece : this->cover_.pieces)
  {
    this->tets.push_back(piece.tet);
  }
  if (!parallel_sort(context, this->tets, std::less<>()))
  {
    return Status::canceled();
  }
  this->tets.erase(std::unique(this->tets.begin(), this->tets.end()), this->tets.end());
  this->half_tets_.resize(half_tets.size());
  for (std::size_t i = 0; i < half_tets.size(); ++i)
  {
    this->half_tets_[i] = sorted_index(this->tets, half_tets[i]);
  }
  this->piece_tets_.resize(this->cover_.pieces.size());
  for (std::size_t i = 0; i < this->piece_tets_.size(); ++i)
  {
    this->piece_tets_[i] = sorted_index(this->tets, this->cover_.pieces[i].tet);
  }
  this->nodes.resize(this->tets.size());
  for (std::size_t i = 0; i < this->tets.size(); ++i)
  {
    this->nodes[i] = DisphenoidLattice::corners(this->tets[i]);
  }
  for (int s = 0; s < CubeSamples::samples_per_cube; ++s)
  {
    this->half_of_sample_[s] =
      DisphenoidLattice::half_of(CubeSamples::lattice_position(CubeSamples::local_coordinates(s)));
    ++this->samples_of_half[this->half_of_sample_[s]];
  }
  for (std::size_t i = 0; i < this->sampled_cubes.size(); ++i)
  {
    this->cube_id_[this->sampled_cubes[i]] = static_cast<Id>(i);
  }
  for (std::size_t i = 0; i < this->full_cubes.size(); ++i)
  {
    this->cube_id_[this->full_cubes[i]] = -1 - static_cast<Id>(i);
  }
  this->first_full_atom =
    static_cast<Id>(this->sampled_cubes.size()) * CubeSamples::samples_per_cube;
  this->first_piece = this->first_full_atom + static_cast<Id>(this->full_cubes.size()) * halves;
  this->inside_.assign(static_cast<std::size_t>(this->first_full_atom), 0);
  return context.canceled() ? Status::canceled() : Status();
}

Status EmbeddingAtoms::find_inside(
  ExecutionContext& context, const WindingNumber& winding, double threshold)
{
  constexpr Index cubes_at_once = 4096;
  const auto count = static_cast<Index>(this->sampled_cubes.size());
  for (Index begin = 0; begin < count; begin += cubes_at_once)
  {
    const Index end = std::min(count, begin + cubes_at_once);
    const ProgressRange range(context, static_cast<double>(begin) / static_cast<double>(count),
      static_cast<double>(end) / static_cast<double>(count));
    Points points((end - begin) * CubeSamples::samples_per_cube, 3);
    for (Index i = 0; i < points.rows(); ++i)
    {
      const Sample at =
        this->global_coordinates(static_cast<Id>(begin + i / CubeSamples::samples_per_cube),
          static_cast<int>(i % CubeSamples::samples_per_cube));
      points.row(i) = this->cover_.lattice.world_point(CubeSamples::lattice_position(at));
    }
    Eigen::VectorXd w;
    const Status status = winding.evaluate(context, points, w);
    if (!status.ok())
    {
      return status;
    }
    for (Index i = 0; i < w.size(); ++i)
    {
      this->inside_[begin * CubeSamples::samples_per_cube + i] = w[i] >= threshold ? 1 : 0;
    }
  }
  return {};
}

Id EmbeddingAtoms::index_of_tet(Key tet) const
{
  const Id at = sorted_index(this->tets, tet);
  return at < static_cast<Id>(this->tets.size()) && this->tets[at] == tet ? at : -1;
}

Vec3 EmbeddingAtoms::lattice_position(Id atom) const
{
  if (atom >= this->first_piece)
  {
    return this->cover_.pieces[atom - this->first_piece].middle;
  }
  if (atom < this->first_full_atom)
  {
    return CubeSamples::lattice_position(this->global_coordinates(
      atom / CubeSamples::samples_per_cube, atom % CubeSamples::samples_per_cube));
  }
  const auto& corners = this->nodes[this->tet_of(atom)];
  const auto& lattice = this->cover_.lattice;
  const Cube cube =
    DisphenoidLattice::cube_of(this->full_cubes[(atom - this->first_full_atom) / halves]);
  // Return the middle of the segment from the center of the cube to the midpoint of the tet's edge
  // in the face between two cubes.
  const Vec3 edge = 0.5 * (lattice.node_point(corners[2]) + lattice.node_point(corners[3]));
  return 0.5 * (lattice.lattice_position(edge) + Vec3(cube[0] + 0.5, cube[1] + 0.5, cube[2] + 0.5));
}

} // namespace bindpose
