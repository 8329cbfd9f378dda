// Order of vertices by their coordinates, and vertices at equal positions.
#include "surface/vertex_order.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace bindpose;
using testing::ElementsAre;

TEST(VertexOrder, IsByCoordinatesThenById)
{
  Points points(6, 3);
  points << 1, 0, 0, /**/ 0, 2, 1, /**/ 0, 2, 0, /**/ 1, 0, 0, /**/ -1, 9, 9, /**/ 0, 1, 5;
  EXPECT_THAT(lexicographic_order(points, { 1, 1, 1, 1, 0, 1 }), ElementsAre(5, 2, 1, 0, 3));
  EXPECT_TRUE(are_coincident(points, 0, 3));
  EXPECT_FALSE(are_coincident(points, 1, 2));
  EXPECT_TRUE(lexicographic_order(points, std::vector<char>(6, 0)).empty());
  EXPECT_THAT(find_representatives(points, std::vector<char>(6, 1)), ElementsAre(0, 1, 2, 0, 4, 5));
  EXPECT_THAT(find_representatives(points, { 0, 1, 1, 1, 1, 1 }), ElementsAre(0, 1, 2, 3, 4, 5));
}

TEST(VertexOrder, TakesNoDifferenceBetweenZeros)
{
  Points points(2, 3);
  points << 0.0, 1, 1, /**/ -0.0, 1, 1;
  EXPECT_TRUE(are_coincident(points, 0, 1));
  EXPECT_THAT(lexicographic_order(points, { 1, 1 }), ElementsAre(0, 1));
}
