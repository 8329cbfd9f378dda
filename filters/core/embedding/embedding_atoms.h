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

/// Number of atoms, or pairs of atoms, between two checks for a cancel request.
constexpr std::int32_t atoms_per_check = 1 << 15;

/// The atoms of a surface and its inside: indivisible pieces of material, each in one tet of the
/// lattice. An atom is a sample point in a cube at the surface, a half of a tet in a cube that is
/// completely inside, or a piece of a triangle. Atoms are numbered in this order.
class EmbeddingAtoms
{
public:
  using Key = DisphenoidLattice::Key;
  using Cube = DisphenoidLattice::Cube;
  using Id = LatticeCover::Id;
  using Sample = CubeSamples::Sample;
  static constexpr int halves = DisphenoidLattice::halves; ///< number of halves of tets per cube

  /// `cover` must outlive this object.
  explicit EmbeddingAtoms(const LatticeCover& cover) : cover_(cover) {}

  /// Number the atoms. Return invalid_input if there are more than a million cubes at the surface.
  Status number(ExecutionContext& context);
  /// Find the samples that are inside. Cost: one winding number per sample.
  Status find_inside(ExecutionContext& context, const WindingNumber& winding, double threshold);

  Id count() const { return this->first_piece + static_cast<Id>(this->piece_tets_.size()); }
  /// Return the coordinates of a sample in the integer grid of the samples of all cubes.
  /// @param sampled_cube index in `sampled_cubes` of the cube that contains the sample.
  /// @param s number of the sample within this cube.
  Sample global_coordinates(Id sampled_cube, int s) const
  {
    const Cube cube = DisphenoidLattice::cube_of(this->sampled_cubes[sampled_cube]);
    Sample at = CubeSamples::local_coordinates(s);
    for (int k = 0; k < 3; ++k)
    {
      at[k] += CubeSamples::samples_per_edge * cube[k];
    }
    return at;
  }
  /// Return the atom that contains a sample; -1: the sample is in none of the cubes. In a cube at
  /// the surface, the sample itself is the atom, and it may be outside; see is_inside().
  Id atom_of(const Sample& at) const
  {
    const Cube cube{ at[0] / CubeSamples::samples_per_edge, at[1] / CubeSamples::samples_per_edge,
      at[2] / CubeSamples::samples_per_edge };
    const auto found = this->cube_id_.find(DisphenoidLattice::cube_key(cube));
    if (found == this->cube_id_.end())
    {
      return -1;
    }
    const int s = ((at[2] % CubeSamples::samples_per_edge) * CubeSamples::samples_per_edge +
                    at[1] % CubeSamples::samples_per_edge) *
        CubeSamples::samples_per_edge +
      at[0] % CubeSamples::samples_per_edge;
    return found->second >= 0
      ? found->second * CubeSamples::samples_per_cube + s
      : this->first_full_atom + (-1 - found->second) * halves + this->half_of_sample_[s];
  }
  /// Return false for -1 and for an atom that is a sample outside of the surface, true for all
  /// other atoms.
  bool is_inside(Id atom) const
  {
    return atom >= this->first_full_atom || (atom >= 0 && this->inside_[atom] != 0);
  }
  /// Return the index of the atom's tet in `tets`.
  Id tet_of(Id atom) const
  {
    if (atom >= this->first_piece)
    {
      return this->piece_tets_[atom - this->first_piece];
    }
    if (atom >= this->first_full_atom)
    {
      return this->half_tets_[this->sampled_cubes.size() * halves + (atom - this->first_full_atom)];
    }
    return this->half_tets_[(atom / CubeSamples::samples_per_cube) * halves +
      this->half_of_sample_[atom % CubeSamples::samples_per_cube]];
  }
  /// Return the atom of a triangle's piece in a tet; -1: no such piece, because of rounding.
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
  /// Return the index of a tet in `tets`; -1: the tet is unused.
  Id index_of_tet(Key tet) const;
  /// Return a position in the atom, in units of cubes.
  Vec3 lattice_position(Id atom) const;
  /// Return the index of a cube in `full_cubes`; -1: the cube is not completely inside.
  Id full_cube(const Cube& cube) const
  {
    const auto found = this->cube_id_.find(DisphenoidLattice::cube_key(cube));
    return found != this->cube_id_.end() && found->second < 0 ? -1 - found->second : -1;
  }

  /// Two sorted lists: the keys of the cubes at the surface, and the keys of the cubes that are
  /// completely inside.
  std::vector<Key> sampled_cubes, full_cubes;
  std::vector<Key> tets; ///< keys of the tets that contain atoms, sorted
  std::vector<std::array<Key, 4>> nodes; ///< #tets: keys of the tet's nodes
  std::array<int, halves> samples_of_half{};
  Id first_full_atom = 0; ///< index of the first atom in the cubes of `full_cubes`
  Id first_piece = 0;

private:
  const LatticeCover& cover_;
  /// Cube key -> index i in `sampled_cubes`, or -1 - i for index i in `full_cubes`.
  std::unordered_map<Key, Id> cube_id_;
  /// The tet of each half, as an index in `tets`: 24 halves per sampled cube, then 24 per full
  /// cube.
  std::vector<Id> half_tets_;
  std::vector<Id> piece_tets_; ///< the tet of each piece in cover_.pieces, as an index in `tets`
  std::array<int, CubeSamples::samples_per_cube> half_of_sample_{};
  std::vector<std::uint8_t> inside_; ///< 1 for samples that are inside
};

} // namespace bindpose

#endif
