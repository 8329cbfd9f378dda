// Depth order of overlapping parts. The depth of a point is the weighted mean of the handles'
// layers. The depth is constant if all layers are equal. At a handle the depth is the layer of this
// handle. If depths are equal, the part of the later handle is in front.
#include "weight_uses/depth_order.h"

#include "weights_shapes.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace bindpose;

namespace
{
Weights random_weights(Index rows, Index handles)
{
  test::Random random(11);
  Weights weights(rows, handles);
  for (Index i = 0; i < weights.size(); ++i)
  {
    weights.data()[i] = random.uniform(-0.1, 1.0);
  }
  for (Index v = 0; v < rows; ++v)
  {
    weights.row(v) /= weights.row(v).sum();
  }
  weights.topRows(handles).setIdentity();
  return weights;
}

DepthOrder order_of(const Weights& weights, const Eigen::VectorXd& layers, double tie_offset = 1e-3)
{
  ExecutionContext context;
  DepthOrder order;
  EXPECT_TRUE(depth_order(context, weights, layers, { tie_offset }, order).ok());
  return order;
}
} // namespace

TEST(DepthOrder, EqualLayersAreConstantToTheLastBit)
{
  const Weights weights = random_weights(300, 4);
  for (const double layer : { 0.0, 1.0, -3.7 })
  {
    const DepthOrder order = order_of(weights, Eigen::VectorXd::Constant(4, layer));
    EXPECT_EQ(order.depth.minCoeff(), layer);
    EXPECT_EQ(order.depth.maxCoeff(), layer);
  }
}

TEST(DepthOrder, DepthIsTheSumAndALayerOnItsHandle)
{
  const Weights weights = random_weights(300, 4);
  const Eigen::Vector4d layers(2.0, 0.0, -1.0, 0.5);
  const DepthOrder order = order_of(weights, layers, 0.0);
  EXPECT_LT((order.depth - weights * layers).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((order.depth.head(4) - layers).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_EQ(order.depth, order.front);
}

TEST(DepthOrder, TiesGoToTheLaterHandleAndNeverOverruleALayer)
{
  Weights weights = Weights::Identity(3, 3);
  const DepthOrder equal = order_of(weights, Eigen::Vector3d::Zero());
  EXPECT_LT(equal.front[0], equal.front[1]);
  EXPECT_LT(equal.front[1], equal.front[2]);
  EXPECT_DOUBLE_EQ(equal.front[2] - equal.front[0], 1e-3);
  const DepthOrder layered = order_of(weights, Eigen::Vector3d(1, 0, 0));
  EXPECT_GT(layered.front[0], layered.front[2]);
}

TEST(DepthOrder, RowsThatDoNotSumToOneKeepTheirLayer)
{
  Weights weights(3, 2);
  weights << 0.2, 0.2, 0.0, 0.0, 3.0, 0.0;
  const DepthOrder order = order_of(weights, Eigen::Vector2d(4, 6));
  EXPECT_NEAR(order.depth[0], 5.0, 1e-12);
  EXPECT_EQ(order.depth[1], 0.0);
  EXPECT_EQ(order.depth[2], 4.0);
}

TEST(DepthOrder, WhatCannotBeUsedIsOneSentence)
{
  ExecutionContext context;
  DepthOrder order;
  const Weights weights = Weights::Constant(3, 2, 0.5);
  const auto message = [&](
                         const Weights& w, const Eigen::VectorXd& layers, double tie_offset = 1e-3)
  {
    const Status status = depth_order(context, w, layers, { tie_offset }, order);
    EXPECT_EQ(status.code, StatusCode::invalid_input);
    return status.message;
  };
  EXPECT_NE(message(weights, Eigen::Vector3d::Zero()).find("2 columns, but there are 3 layers"),
    std::string::npos);
  EXPECT_NE(message(weights, Eigen::Vector2d(0, std::nan(""))).find("handle 1"), std::string::npos);
  EXPECT_NE(message(weights, Eigen::Vector2d::Zero(), -1.0).find("tie"), std::string::npos);
  Weights bad = weights;
  bad(1, 1) = std::nan("");
  EXPECT_NE(message(bad, Eigen::Vector2d::Zero()).find("vertex 1"), std::string::npos);
  context.request_cancel();
  EXPECT_EQ(
    depth_order(context, weights, Eigen::Vector2d::Zero(), {}, order).code, StatusCode::canceled);
}
