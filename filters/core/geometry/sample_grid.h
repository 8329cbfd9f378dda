#ifndef bindpose_geometry_sample_grid_h
#define bindpose_geometry_sample_grid_h

#include "geometry/mesh.h"

#include <algorithm>
#include <array>

namespace bindpose
{

/// Samples in a box, x fastest: sample (i, j, k) of the extent is at origin + spacing * (i, j, k).
/// The point of a sample depends only on (i, j, k), so results are bit-identical for every
/// sub-extent.
struct SampleGrid
{
  Vec3 origin = Vec3::Zero();
  Vec3 spacing = Vec3::Ones();
  /// First and last index along x, y, z, inclusive, as in VTK. Empty by default.
  std::array<Index, 6> extent{ 0, -1, 0, -1, 0, -1 };

  /// Return the number of samples along an axis, never negative.
  Index size(int axis) const
  {
    return std::max<Index>(0, this->extent[2 * axis + 1] - this->extent[2 * axis] + 1);
  }
  Index count() const { return this->size(0) * this->size(1) * this->size(2); }
  Vec3 point(Index i, Index j, Index k) const
  {
    return this->origin +
      this->spacing.cwiseProduct(
        Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)));
  }
  /// Return the point of a sample.
  /// @param number index of the sample within the extent, from 0
  Vec3 point(Index number) const
  {
    const Index nx = this->size(0), ny = this->size(1);
    return this->point(this->extent[0] + number % nx, this->extent[2] + number / nx % ny,
      this->extent[4] + number / nx / ny);
  }
};

} // namespace bindpose

#endif
