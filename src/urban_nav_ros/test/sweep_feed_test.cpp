// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/sweep_feed.hpp"

#include <gtest/gtest.h>

#include <boost/make_shared.hpp>
#include <cmath>
#include <cstring>

#include "urban_nav_ros/cloud_view.hpp"

namespace urban_nav_ros {
namespace {

constexpr std::uint32_t kPoints = 800;

/// Revolution of 0.1 s from the stamp on, with times in us.
sensor_msgs::PointCloud2ConstPtr cloudAt(int i, float height = 0.2F) {
  auto cloud = boost::make_shared<sensor_msgs::PointCloud2>();
  cloud->header.stamp = ros::Time(1'600'000'000, static_cast<std::uint32_t>(100'000'000 * i));
  cloud->width = kPoints;
  cloud->height = 1;
  cloud->point_step = 16;
  cloud->row_step = 16 * kPoints;
  const std::pair<const char*, std::uint8_t> fields[] = {{"x", sensor_msgs::PointField::FLOAT32},
                                                         {"y", sensor_msgs::PointField::FLOAT32},
                                                         {"z", sensor_msgs::PointField::FLOAT32},
                                                         {"t", sensor_msgs::PointField::UINT32}};
  for (const auto& [name, type] : fields) {
    sensor_msgs::PointField field;
    field.name = name;
    field.offset = static_cast<std::uint32_t>(4 * cloud->fields.size());
    field.datatype = type;
    field.count = 1;
    cloud->fields.push_back(field);
  }
  cloud->data.resize(cloud->row_step);
  for (std::uint32_t k = 0; k < kPoints; ++k) {
    const float azimuth = 3.14159F - 6.28318F * static_cast<float>(k) / kPoints;
    const float place[] = {5.0F * std::cos(azimuth), 5.0F * std::sin(azimuth), height * static_cast<float>(k % 4)};
    const std::uint32_t time = 125 * k;
    std::memcpy(&cloud->data[16 * k], place, sizeof(place));
    std::memcpy(&cloud->data[16 * k + 12], &time, sizeof(time));
  }
  return cloud;
}

TEST(CloudView, HasAllThatAMessageHolds) {
  const sensor_msgs::PointCloud2ConstPtr cloud = cloudAt(2);
  const urban_nav_core::CloudView view = toCloudView(*cloud);
  EXPECT_EQ(view.stamp, 1'600'000'000'200'000'000);
  EXPECT_EQ(view.width, kPoints);
  EXPECT_EQ(view.size, 16U * kPoints);
  ASSERT_EQ(view.fields.size(), 4U);
  EXPECT_EQ(view.fields[3].number, urban_nav_core::CloudField::Number::UInt32);
  EXPECT_EQ(view.fields[3].offset, 12U);
}

TEST(SweepFeed, CloudsWaitUntilItIsDecidedHowTheyAreRead) {
  SweepFeed feed;
  std::vector<urban_nav_core::ReadSweep> sweeps;
  for (int i = 0; i < 9; ++i) {
    for (urban_nav_core::ReadSweep& sweep : feed.add(cloudAt(i))) sweeps.push_back(std::move(sweep));
    EXPECT_EQ(sweeps.size(), i < 7 ? 0U : static_cast<std::size_t>(i + 1));
    EXPECT_EQ(feed.convention().has_value(), i >= 7);
  }
  EXPECT_EQ(printPointTimes(feed.convention()->times), "t,us,header");
  for (std::size_t i = 0; i < sweeps.size(); ++i) {
    EXPECT_EQ(sweeps[i].sweep.beams.size(), kPoints);
    EXPECT_EQ(sweeps[i].sweep.beams.front().stamp,
              1'600'000'000'000'000'000 + 100'000'000 * static_cast<std::int64_t>(i));
  }
}

TEST(SweepFeed, APlanarLaserIsNamedAndGivesNoSweeps) {
  SweepFeed feed;
  for (int i = 0; i < 12; ++i) {
    EXPECT_TRUE(feed.add(cloudAt(i, 0.0F)).empty());
    EXPECT_EQ(feed.fault().find("planar laser") != std::string::npos, i >= 7) << feed.fault();
  }
}

}  // namespace
}  // namespace urban_nav_ros
