// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/sensors/accelerometer_finding.hpp"

#include <gtest/gtest.h>

#include "urban_nav_core/inertial/axis_map.hpp"

namespace urban_nav_input {
namespace {

using Eigen::Vector3d;
using urban_nav_core::AccelerometerCheck;
using urban_nav_core::AccelerometerConvention;

std::vector<Finding> examine(const Vector3d& force, const AccelerometerConvention& present = {}) {
  AccelerometerCheck check;
  for (int i = 0; i < 100; ++i) check.add(present.scale * (present.axes * force), Vector3d::Zero());
  return accelerometerFindings("/imu/data", check.verdict(Vector3d::UnitZ(), Vector3d::UnitY()), present);
}

using Options = std::vector<std::string>;

TEST(AccelerometerFindings, OfASoundOneAreEmpty) { EXPECT_TRUE(examine({0.1, -0.2, 9.79}).empty()); }

TEST(AccelerometerFindings, StateTheConventionThatRepairsThem) {
  const std::vector<Finding> down = examine({0.1, -0.2, -9.79});
  ASSERT_EQ(down.size(), 1U);
  EXPECT_EQ(down[0].kind, FindingKind::Imu);
  EXPECT_EQ(down[0].options, (Options{"--set", "input.accelerometer_axes=-x,-y,-z"}));
  EXPECT_NE(down[0].text.find("/imu/data"), std::string::npos);
  EXPECT_NE(down[0].remedy.find("input.accelerometer_axes=-x,-y,-z"), std::string::npos);
  EXPECT_EQ(examine({0.0, 0.0, 1.0})[0].options, (Options{"--set", "input.accelerometer_scale=9.80665"}));
  EXPECT_EQ(examine({0.0, 0.0, -1.0})[0].options.size(), 4U);
}

TEST(AccelerometerFindings, ComposeWithTheConventionThatWasStated) {
  AccelerometerConvention wrong;
  wrong.axes = *urban_nav_core::parseAxisMap("x,y,-z");
  EXPECT_EQ(examine({0.0, 0.0, 9.8}, wrong)[0].options.at(1), "input.accelerometer_axes=-x,-y,z");
  wrong.axes = *urban_nav_core::parseAxisMap("-x,-y,-z");
  EXPECT_TRUE(examine({0.0, 0.0, -9.8}, wrong).empty());
  EXPECT_EQ(examine({0.0, 0.0, 9.8}, wrong)[0].options.at(1), "input.accelerometer_axes=x,y,z");
}

TEST(AccelerometerFindings, WithoutARepairStateWhatToChange) {
  const std::vector<Finding> without_gravity = examine({0.1, 0.0, 0.05});
  ASSERT_EQ(without_gravity.size(), 1U);
  EXPECT_TRUE(without_gravity[0].options.empty());
  EXPECT_NE(without_gravity[0].text.find("subtracts gravity"), std::string::npos);
  EXPECT_FALSE(without_gravity[0].remedy.empty());
}

}  // namespace
}  // namespace urban_nav_input
