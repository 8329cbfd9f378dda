#ifndef bindpose_embedding_line_crossings_h
#define bindpose_embedding_line_crossings_h

#include "embedding/cube_samples.h"
#include "embedding/lattice_cover.h"

#include <array>
#include <vector>

namespace bindpose
{

/// Where a triangle meets the line from a sample to the next along an axis.
struct LineCrossing
{
  using Key = LatticeCover::Key;
  using Id = LatticeCover::Id;
  using Sample = CubeSamples::Sample;

  /// Crossings nearer than this share of the samples' distance are one.
  static constexpr double touching = 1e-9;

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
  /// A place on its line, in cubes.
  Vec3 place(double along_line) const;
};

/// Appends all crossings of a triangle, its corners in cubes, with lines along an axis. Lines that
/// touch the border count for both triangles at it; a triangle that is seen from its edge has none.
void add_line_crossings(
  LatticeCover::Id triangle, std::array<Vec3, 3> corner, int axis, std::vector<LineCrossing>& list);

} // namespace bindpose

#endif
