#ifndef bindpose_tests_support_clouds_h
#define bindpose_tests_support_clouds_h

#include "geometry/mesh.h"

namespace bindpose::test
{

/// Samples of a surface. Each sample has a position, a normal and an area.
struct Cloud
{
  Points points, normals;
  Eigen::VectorXd areas;
};

} // namespace bindpose::test

#endif
