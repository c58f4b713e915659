// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/baseline_check.hpp"

#include <gtest/gtest.h>

namespace urban_nav_ros {
namespace {

TEST(DescribeBaseline, IsEmptyForABaselineThatAVehicleHas) {
  for (const double baseline : {0.05, 0.12, 0.54, 2.0}) EXPECT_EQ(describeBaseline(baseline), "");
}

TEST(DescribeBaseline, NamesWhatIsWrongWithOneInMillimetres) {
  const std::string text = describeBaseline(120.0);
  EXPECT_NE(text.find("120 m"), std::string::npos) << text;
  EXPECT_NE(text.find("P[3] of the right camera_info"), std::string::npos) << text;
  EXPECT_FALSE(describeBaseline(1.2e-4).empty());
}

}  // namespace
}  // namespace urban_nav_ros
