// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/point_cloud.hpp"

#include <gtest/gtest.h>
#include <sensor_msgs/point_cloud2_iterator.h>

#include <cmath>
#include <limits>

#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_ros {
namespace {

using urban_nav_core::Beam;
using urban_nav_core::Sweep;

Sweep twoBeams() {
  Sweep sweep;
  sweep.beams.push_back({1'000'000'000, Eigen::Vector3f(0.6F, -0.8F, 0.0F), 5.0F, 40.0F, 3, 700});
  sweep.beams.push_back({1'050'000'000, Eigen::Vector3f::UnitZ(), 2.0F, 200.0F, 127, 1000});
  return sweep;
}

TEST(SweepMessage, HasVelodynesFields) {
  const sensor_msgs::PointCloud2 cloud = toSweepMessage(twoBeams(), 1'100'000'000);
  EXPECT_EQ(toStampNs(cloud.header.stamp), 1'100'000'000);
  ASSERT_EQ(cloud.fields.size(), 6U);
  EXPECT_EQ(cloud.width, 2U);
  EXPECT_EQ(cloud.height, 1U);
  EXPECT_EQ(cloud.data.size(), 44U);
  EXPECT_TRUE(cloud.is_dense);
  sensor_msgs::PointCloud2ConstIterator<float> x(cloud, "x"), intensity(cloud, "intensity"), time(cloud, "time");
  sensor_msgs::PointCloud2ConstIterator<std::uint16_t> ring(cloud, "ring");
  EXPECT_FLOAT_EQ(x[0], 3.0F);
  EXPECT_FLOAT_EQ(x[1], -4.0F);
  EXPECT_FLOAT_EQ(x[2], 0.0F);
  EXPECT_EQ(*intensity, 40.0F);
  EXPECT_EQ(*ring, 3);
  EXPECT_FLOAT_EQ(*time, -0.1F);
  ++x, ++intensity, ++time, ++ring;
  EXPECT_FLOAT_EQ(x[2], 2.0F);
  EXPECT_EQ(*ring, 127);
  EXPECT_FLOAT_EQ(*time, -0.05F);
}

TEST(SweepMessage, IsNotDenseWithInvalidRanges) {
  Sweep sweep = twoBeams();
  sweep.beams[0].range = std::numeric_limits<float>::quiet_NaN();
  const sensor_msgs::PointCloud2 cloud = toSweepMessage(sweep, 1'100'000'000);
  EXPECT_FALSE(cloud.is_dense);
  EXPECT_TRUE(std::isnan(*sensor_msgs::PointCloud2ConstIterator<float>(cloud, "x")));
}

TEST(SweepMessage, MayBeEmpty) {
  const sensor_msgs::PointCloud2 cloud = toSweepMessage(Sweep(), 5);
  EXPECT_EQ(cloud.width, 0U);
  EXPECT_EQ(cloud.fields.size(), 6U);
}

}  // namespace
}  // namespace urban_nav_ros
