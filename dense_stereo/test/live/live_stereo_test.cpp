// SPDX-License-Identifier: BSD-3-Clause
#include "live/live_stereo.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/rendered_pair.hpp"
#include "urban_nav_core/testing/textured_room.hpp"
#include "urban_nav_core/types/error.hpp"

namespace dense_stereo {
namespace {

using urban_nav_core::SpecificForce;
using urban_nav_core::StampNs;

constexpr StampNs kTick = 10'000'000;  // 100 Hz

TEST(GravityFilter, PointsUpThroughShocks) {
  const Eigen::Vector3d up = Eigen::Vector3d(0.05, -0.1, 1.0).normalized();
  GravityFilter filter;
  EXPECT_FALSE(filter.up(0)) << "no sample";
  for (int i = 0; i < 300; ++i)
    filter.add({i * kTick, 9.81 * up + Eigen::Vector3d(i % 10 == 0 ? 3.0 : 0.0, std::sin(0.5 * i), 0.0)});
  ASSERT_TRUE(filter.up(300 * kTick));
  EXPECT_LT(std::acos(filter.up(300 * kTick)->dot(up)), 0.06);
  EXPECT_FALSE(filter.up(500 * kTick)) << "too old";
}

TEST(GravityFilter, NeedsASecondOfSomethingOfTheSizeOfGravity) {
  GravityFilter filter;
  for (int i = 0; i < 50; ++i) filter.add({i * kTick, {0.0, 0.0, 9.8}});
  EXPECT_FALSE(filter.up(50 * kTick)) << "too short";
  filter.add({50 * kTick, {0.0, std::numeric_limits<double>::quiet_NaN(), 9.8}});
  for (int i = 51; i < 200; ++i) filter.add({i * kTick, {0.0, 0.0, 9.8}});
  EXPECT_TRUE(filter.up(200 * kTick));
  filter.add({0, {0.0, 0.0, 9.8}});
  EXPECT_FALSE(filter.up(0)) << "time went back";
  GravityFilter units;
  for (int i = 0; i < 200; ++i) units.add({i * kTick, {0.0, 0.0, 1.0}});  // in g
  EXPECT_FALSE(units.up(200 * kTick));
}

TEST(LiveStereo, RefusesTheMethodsOfTheCommand) {
  Parameters parameters;
  parameters.method = "paper";
  try {
    LiveStereo live(parameters);
    FAIL();
  } catch (const urban_nav_core::UserError& error) {
    EXPECT_EQ(error.parts().found, "dense_stereo.method = paper");
    EXPECT_EQ(error.parts().allowed.substr(0, 4), "sgm;");
  }
}

TEST(LiveStereo, ReportsTheMeasuredGround) {
  const testing_support::RenderedPair view(urban_nav_core::testing::texturedRoom(), -2.0, 0.5, 0.9, 0.17, 0.0);
  LiveStereo live{Parameters()};
  EXPECT_TRUE(live.report().is_warning);
  live.begin(view.camera(), urban_nav_core::Pose(), false);
  ASSERT_TRUE(live.isRunning());
  const NearScene& scene = live.process(view.pair());
  EXPECT_TRUE(scene.ground.isFound()) << scene.ground.sentence;
  EXPECT_FALSE(live.report().is_warning);
  live.end("reset");
  EXPECT_FALSE(live.isRunning());
  EXPECT_EQ(live.report().summary, "no session (reset)");
}

}  // namespace
}  // namespace dense_stereo
