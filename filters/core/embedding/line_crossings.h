#ifndef bindpose_embedding_line_crossings_h
#define bindpose_embedding_line_crossings_h

#include "embedding/cube_samples.h"
#include "embedding/lattice_cover.h"

#include <array>
#include <vector>

namespace bindpose
{

/// The intersection of a triangle with a line. A line is the segment from a sample to the next
/// sample along an axis.
struct LineCrossing
{
  using Key = LatticeCover::Key;
  using Id = LatticeCover::Id;
  using Sample = CubeSamples::Sample;

  /// Two crossings of the same line count as one if they are closer than this fraction of the
  /// sample distance.
  static constexpr double merge_distance = 1e-9;

  Key line; ///< key of the line, from its axis and its first sample
  double at; ///< position on the line, 0 … 1
  Id triangle;

  int axis() const { return static_cast<int>(this->line >> 60); }
  Sample sample() const
  {
    constexpr Key mask = (1 << 20) - 1;
    return { static_cast<Id>(this->line & mask), static_cast<Id>(this->line >> 20 & mask),
      static_cast<Id>(this->line >> 40 & mask) };
  }
  /// Return a position on the line, in units of cubes.
  Vec3 position(double along_line) const;
};

/// Append all crossings of a triangle (corners in units of cubes) with the lines along an axis. If
/// a line passes through the common edge of two triangles, it crosses both. A triangle that is
/// parallel to the axis has no crossings.
void add_line_crossings(
  LatticeCover::Id triangle, std::array<Vec3, 3> corner, int axis, std::vector<LineCrossing>& list);

} // namespace bindpose

#endif
