#include "geometry/working_frame.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace bindpose::test
{

namespace
{
using ::testing::HasSubstr;

Points box_points(const Vec3& lower, const Vec3& size)
{
  Points points(8, 3);
  for (int k = 0; k < 8; ++k)
  {
    points.row(k) << lower.x() + (k & 1) * size.x(), lower.y() + (k >> 1 & 1) * size.y(),
      lower.z() + (k >> 2) * size.z();
  }
  return points;
}

WorkingFrame frame_of(const Points& points)
{
  WorkingFrame frame;
  const Status status = WorkingFrame::choose(points, bounding_box(points), "the shape", frame);
  EXPECT_TRUE(status.ok()) << status.message;
  return frame;
}

std::string error_of(const Points& points)
{
  WorkingFrame frame;
  const Status status = WorkingFrame::choose(points, bounding_box(points), "the shape", frame);
  EXPECT_EQ(status.code, StatusCode::invalid_input);
  return status.message;
}
} // namespace

TEST(WorkingFrame, IsIdentityForOrdinaryShapes)
{
  EXPECT_TRUE(frame_of(box_points(Vec3(-1, 2, 900), Vec3(1, 2, 3))).is_identity());
  EXPECT_TRUE(frame_of(box_points(Vec3(0, 0, 0), Vec3(1e-25, 1e25, 0))).is_identity());
  EXPECT_TRUE(frame_of(Points(0, 3)).is_identity());
  EXPECT_TRUE(frame_of(Points::Constant(4, 3, 1e200)).is_identity());
}

TEST(WorkingFrame, MapsExtremeShapesExactly)
{
  for (const double size : { 1e-101, 1e-60, 1e60, 1e101 })
  {
    for (const double offset : { 0.0, 3.0, 1e5, -1e9 })
    {
      const Points points =
        box_points(Vec3(offset, -offset, 0.5) * size, Vec3(0.7, 0.3, 0.11) * size);
      const WorkingFrame frame = frame_of(points);
      const Points moved = frame.to_frame(points);
      const Box box = bounding_box(moved);
      EXPECT_GE(box.diagonal(), 1.0) << size << " " << offset;
      EXPECT_LT(box.diagonal(), 2.0) << size << " " << offset;
      EXPECT_LE(moved.cwiseAbs().maxCoeff(), 1024.0 * 2.0) << size << " " << offset;
      EXPECT_EQ(frame.from_frame(moved), points) << size << " " << offset;
      const Vec3 corner = points.row(3);
      EXPECT_EQ(frame.point_from_frame(frame.point_to_frame(corner)), corner);
      EXPECT_TRUE(frame_of(moved).is_identity()) << size << " " << offset;
    }
  }
}

TEST(WorkingFrame, MovesDistantShapesOfOrdinarySize)
{
  const WorkingFrame frame = frame_of(box_points(Vec3(1e6, 0, 0), Vec3(1, 2, 3)));
  EXPECT_FALSE(frame.is_identity());
  EXPECT_EQ(frame.center().y(), 0.0);
  EXPECT_NEAR(frame.center().x(), 1e6, 1.0);
}

TEST(WorkingFrame, ConvertsLengthsAreasAndVolumes)
{
  const WorkingFrame frame = frame_of(box_points(Vec3::Zero(), Vec3(1e60, 1e60, 1e60)));
  for (const int power : { -1, 1, 2, 3 })
  {
    EXPECT_NEAR(frame.size_to_frame(frame.size_from_frame(5.0, power), power), 5.0, 1e-12);
  }
  EXPECT_NEAR(
    frame.size_from_frame(1.0, 3) / std::pow(frame.size_from_frame(1.0, 1), 3), 1.0, 1e-12);
  Report report;
  report.set("length", 2.0);
  report.set("lengths[]", std::vector<double>{ 1.0, 3.0 });
  frame.convert_report(report, "length", 1);
  frame.convert_report(report, "lengths[]", 1);
  frame.convert_report(report, "absent", 1);
  EXPECT_EQ(report.number("length", 0.0), 2.0 / frame.scale());
  EXPECT_EQ(std::get<std::vector<double>>(*report.find("lengths[]"))[1], 3.0 / frame.scale());
  EXPECT_EQ(report.find("absent"), nullptr);
}

TEST(WorkingFrame, RefusesShapesOutOfRange)
{
  Points points = box_points(Vec3::Zero(), Vec3(1, 1, 1));
  points(5, 1) = 1e103;
  EXPECT_THAT(error_of(points),
    HasSubstr("the bounding-box diagonal of the shape is 1e+103; expected 1e-102 to 1e102"));
  EXPECT_THAT(error_of(points), HasSubstr("coordinate y of point 5 is 1e+103"));
  points(4, 1) = -std::numeric_limits<double>::max();
  points(5, 1) = std::numeric_limits<double>::max();
  EXPECT_THAT(error_of(points), HasSubstr("coordinate y of point 4 is -1.798e+308"));
  EXPECT_THAT(error_of(box_points(Vec3::Zero(), Vec3(1e-110, 1e-110, 0))),
    HasSubstr("expected 1e-102 to 1e102"));
  EXPECT_THAT(error_of(box_points(Vec3(0, 1e12, 0), Vec3(1, 1, 1))),
    HasSubstr("the shape is too far from the origin: coordinate y of point 2 is 1e+12"));
}

} // namespace bindpose::test
