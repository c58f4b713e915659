// SPDX-License-Identifier: BSD-3-Clause
#include "session/given_transforms.hpp"

#include <gtest/gtest.h>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav_input {
namespace {

TEST(GivenTransforms, AreReadAndTakePrecedence) {
  urban_nav_ros::StaticTransforms transforms;
  transforms.add(urban_nav_ros::toStaticTransform("base_link", "laser_left", urban_nav_core::Pose()));
  giveTransforms({"base_link,laser_left:0.5,-1e-1,2,0,0,1,0"}, transforms);
  const auto pose = transforms.lookup("base_link", "laser_left");
  ASSERT_TRUE(pose);
  EXPECT_LT((pose->t() - Eigen::Vector3d(0.5, -0.1, 2.0)).norm(), 1e-12);
  EXPECT_LT((pose->R() * Eigen::Vector3d::UnitX() + Eigen::Vector3d::UnitX()).norm(), 1e-12) << "half a turn";
}

TEST(GivenTransforms, RefuseWhatIsNone) {
  for (const char* text :
       {"", "a,b", "a:0,0,0,0,0,0,1", ",b:0,0,0,0,0,0,1", "a,:0,0,0,0,0,0,1", "a,b:0,0,0,0,0,1", "a,b:0,0,0,0,0,0,2",
        "a,b:0,0,0,0,0,0,1,0", "a,b:x,0,0,0,0,0,1", "a,b:nan,0,0,0,0,0,1", "a,b:0,0,,0,0,0,1"}) {
    urban_nav_ros::StaticTransforms transforms;
    EXPECT_THROW(giveTransforms({text}, transforms), urban_nav_core::UserError) << text;
    EXPECT_TRUE(transforms.empty()) << text;
  }
}

}  // namespace
}  // namespace urban_nav_input
