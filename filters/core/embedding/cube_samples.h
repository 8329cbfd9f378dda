#ifndef bindpose_embedding_cube_samples_h
#define bindpose_embedding_cube_samples_h

#include "geometry/mesh.h"

#include <array>
#include <cstdint>

namespace bindpose
{

/// A sub-grid of sample points in the cubes of a lattice. No sample is on a plane of the lattice,
/// so that each sample is in exactly one tet. Samples that are inside a surface represent its
/// volume in the embedding.
struct CubeSamples
{
  using Id = std::int32_t;
  /// Integer coordinates of a sample, either in the grid of the samples of all cubes or in the
  /// sub-grid of one cube.
  using Sample = std::array<Id, 3>;

  static constexpr int samples_per_edge = 6; ///< number of samples along the edge of a cube
  static constexpr int samples_per_cube = samples_per_edge * samples_per_edge * samples_per_edge;
  /// Offset of the first sample of a cube from the cube's lowest corner, in units of the sample
  /// distance.
  static constexpr double shift[3] = { 0.62, 0.41, 0.53 };

  /// Return the integer coordinates of sample s within its cube.
  static Sample local_coordinates(int s)
  {
    return { s % samples_per_edge, s / samples_per_edge % samples_per_edge,
      s / (samples_per_edge * samples_per_edge) };
  }
  static Sample next_sample(Sample s, int axis)
  {
    ++s[axis];
    return s;
  }
  /// Return the position of a sample, in units of cubes.
  static Vec3 lattice_position(const Sample& at)
  {
    return Vec3(at[0] + shift[0], at[1] + shift[1], at[2] + shift[2]) / samples_per_edge;
  }
};

} // namespace bindpose

#endif
