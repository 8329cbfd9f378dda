#ifndef bindpose_embedding_embedding_atoms_h
#define bindpose_embedding_embedding_atoms_h

#include "base/execution.h"
#include "embedding/cube_samples.h"
#include "embedding/disphenoid_lattice.h"
#include "embedding/lattice_cover.h"
#include "winding/winding_number.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace bindpose
{

/// What a surface and its inside are taken apart into, each atom in one tet of the lattice: samples
/// of the cubes at the surface, then halves of the cubes inside, then pieces of triangles.
class EmbeddingAtoms
{
public:
  using Key = DisphenoidLattice::Key;
  using Cube = DisphenoidLattice::Cube;
  using Id = LatticeCover::Id;
  using Sample = CubeSamples::Sample;
  static constexpr int halves = DisphenoidLattice::halves; ///< of a cube

  /// The cover must outlive the atoms.
  explicit EmbeddingAtoms(const LatticeCover& cover) : cover_(cover) {}

  /// invalid_input: more than a million cubes at the surface.
  Status number(ExecutionContext& context);
  /// Which samples are inside. Cost: a winding number each.
  Status find_inside(const WindingNumber& winding, double threshold, ExecutionContext& context);

  Id count() const { return this->first_piece + static_cast<Id>(this->piece_tets_.size()); }
  /// Over all cubes, of a sample's number in the cube at this place in `sampled`.
  Sample sample_of(Id sampled_cube, int s) const
  {
    const Cube cube = DisphenoidLattice::cube_of(this->sampled[sampled_cube]);
    Sample at = CubeSamples::position_of(s);
    for (int k = 0; k < 3; ++k)
    {
      at[k] += CubeSamples::along * cube[k];
    }
    return at;
  }
  /// A sample's atom; -1: it is outside of all cubes. In a sampled cube it may not be inside.
  Id atom_of(const Sample& at) const
  {
    const Cube cube{ at[0] / CubeSamples::along, at[1] / CubeSamples::along,
      at[2] / CubeSamples::along };
    const auto found = this->cube_id_.find(DisphenoidLattice::cube_key(cube));
    if (found == this->cube_id_.end())
    {
      return -1;
    }
    const int s = ((at[2] % CubeSamples::along) * CubeSamples::along + at[1] % CubeSamples::along) *
        CubeSamples::along +
      at[0] % CubeSamples::along;
    return found->second >= 0
      ? found->second * CubeSamples::of_cube + s
      : this->first_full + (-1 - found->second) * halves + this->half_of_sample_[s];
  }
  /// All atoms are, but those of samples outside, and -1.
  bool is_inside(Id atom) const
  {
    return atom >= this->first_full || (atom >= 0 && this->inside_[atom] != 0);
  }
  /// Its place in `tets`.
  Id tet_of(Id atom) const
  {
    if (atom >= this->first_piece)
    {
      return this->piece_tets_[atom - this->first_piece];
    }
    if (atom >= this->first_full)
    {
      return this->half_tets_[this->sampled.size() * halves + (atom - this->first_full)];
    }
    return this->half_tets_[(atom / CubeSamples::of_cube) * halves +
      this->half_of_sample_[atom % CubeSamples::of_cube]];
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
      : this->first_piece + static_cast<Id>(at - this->cover_.pieces.begin());
  }
  /// Place in `tets`; -1: not there.
  Id place_of_tet(Key tet) const;
  /// A place in the atom, in cubes.
  Vec3 place_of(Id atom) const;
  /// The inside cube's place in `full`; -1: the cube is not inside as a whole.
  Id full_cube(const Cube& cube) const
  {
    const auto found = this->cube_id_.find(DisphenoidLattice::cube_key(cube));
    return found != this->cube_id_.end() && found->second < 0 ? -1 - found->second : -1;
  }

  std::vector<Key> sampled, full; ///< cubes at the surface, and inside, sorted
  std::vector<Key> tets; ///< sorted
  std::vector<std::array<Key, 4>> nodes; ///< of tets
  std::array<int, halves> samples_of_half{};
  Id first_full = 0; ///< of the atoms
  Id first_piece = 0;

private:
  const LatticeCover& cover_;
  std::unordered_map<Key, Id> cube_id_; ///< place in sampled, or -1 - place in full
  std::vector<Id> half_tets_; ///< places in tets: 24 a sampled cube, then 24 a full one
  std::vector<Id> piece_tets_; ///< places in tets of cover_.pieces
  std::array<int, CubeSamples::of_cube> half_of_sample_{};
  std::vector<std::uint8_t> inside_; ///< of the samples
};

} // namespace bindpose

#endif
