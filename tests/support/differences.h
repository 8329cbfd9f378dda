#ifndef bindpose_tests_support_differences_h
#define bindpose_tests_support_differences_h

#include "geometry/mesh.h"

namespace bindpose::test
{

/// Return the largest distance between points of the same index.
inline double largest_distance(const Points& a, const Points& b)
{
  return (a - b).rowwise().norm().maxCoeff();
}

/// Return the largest difference between entries at the same place of two matrices.
template <typename A, typename B>
double largest_difference(const Eigen::MatrixBase<A>& a, const Eigen::MatrixBase<B>& b)
{
  return (a - b).cwiseAbs().maxCoeff();
}

} // namespace bindpose::test

#endif
