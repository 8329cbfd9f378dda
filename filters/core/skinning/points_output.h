#ifndef bindpose_skinning_points_output_h
#define bindpose_skinning_points_output_h

#include "base/mesh_types.h"

namespace bindpose
{

/// Destination of #V x 3 points: either a matrix, which is resized, or memory of the caller with
/// the right number of rows, for example the memory of a VTK or numpy array. Points are then
/// computed in place instead of being copied.
class PointsOutput
{
public:
  PointsOutput(Points& matrix) : matrix_(&matrix), memory_(nullptr, 0, 3) {}
  PointsOutput(const Eigen::Map<Points>& memory) : memory_(memory) {}

  /// Return the destination with the given number of rows. A matrix is resized; memory of the
  /// caller must already have this number of rows.
  Eigen::Map<Points> resized(Index rows) const
  {
    if (this->matrix_)
    {
      this->matrix_->resize(rows, 3);
      return { this->matrix_->data(), rows, 3 };
    }
    eigen_assert(this->memory_.rows() == rows);
    return this->memory_;
  }

private:
  Points* matrix_ = nullptr;
  Eigen::Map<Points> memory_;
};

} // namespace bindpose

#endif
