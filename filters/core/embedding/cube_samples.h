#ifndef bindpose_embedding_cube_samples_h
#define bindpose_embedding_cube_samples_h

#include "base/mesh.h"

#include <array>
#include <cstdint>

namespace bindpose
{

/// A sub-grid of samples through all cubes of a lattice. They lie off the planes of the lattice, so
/// that a sample is in one tet.
struct CubeSamples
{
  using Id = std::int32_t;
  /// Whole numbers of a sample, over all cubes or within one.
  using Sample = std::array<Id, 3>;

  static constexpr int along = 6; ///< a side of a cube
  static constexpr int of_cube = along * along * along;
  static constexpr double shift[3] = { 0.62, 0.41, 0.53 }; ///< of the first, in samples' distances

  /// Of the sample with this number in a cube.
  static Sample position_of(int s) { return { s % along, s / along % along, s / (along * along) }; }
  static Sample next_of(Sample s, int axis)
  {
    ++s[axis];
    return s;
  }
  /// In cubes.
  static Vec3 place_of(const Sample& at)
  {
    return Vec3(at[0] + shift[0], at[1] + shift[1], at[2] + shift[2]) / along;
  }
};

} // namespace bindpose

#endif
