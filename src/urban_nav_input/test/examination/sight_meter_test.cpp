// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/examination/sight_meter.hpp"

#include <gtest/gtest.h>

#include <random>

#include "urban_nav_input/session/open.hpp"
#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav_input {
namespace {

using urban_nav_core::Vector3d;

/// A level ground 1 m below the camera, with `walls` points on two walls.
std::vector<Vector3d> street(int ground, int walls) {
  std::mt19937 random(5);
  const auto uniform = [&](double from, double to) {
    return from + (to - from) * static_cast<double>(random()) / 4294967296.0;
  };
  std::vector<Vector3d> points;
  for (int i = 0; i < ground; ++i) {
    const double x = uniform(1.5, 9.0);
    points.emplace_back(x, uniform(-2.0, 2.0), -1.0 + 0.003 * x * uniform(-1.0, 1.0));
  }
  for (int i = 0; i < walls; ++i) points.emplace_back(uniform(3.0, 9.0), i % 2 == 0 ? 2.5 : -2.5, uniform(-1.0, 2.0));
  return points;
}

TEST(FindGround, IsThePlaneBelowTheCamera) {
  const auto ground = findGround(street(150, 60));
  ASSERT_TRUE(ground);
  EXPECT_GT(ground->up.z(), 0.9998);
  EXPECT_NEAR(ground->drop, 1.0, 0.02);
  EXPECT_FALSE(findGround(street(20, 20))) << "few points";
  EXPECT_FALSE(findGround(street(0, 300))) << "walls alone";
}

TEST(SightMeter, MeasuresTheMotionOfARenderedRoom) {
  const testing::TemporaryFolder folder;
  testing::makeKittiFolder(folder.file("room"));
  const std::unique_ptr<Source> source = openSource({folder.file("room")}, {});
  SightMeter meter(source->info().camera, source->info().T_base_camera);
  std::vector<SourceItem> items;
  while (auto item = source->next()) items.push_back(std::move(*item));
  for (std::size_t i = 0; i + 2 < items.size(); i += 2) meter.add(items[i].assembled.pair, items[i + 2].assembled.pair);
  ASSERT_GE(meter.sight().motions.size(), 3U);
  for (const SeenMotion& motion : meter.sight().motions) {
    EXPECT_EQ(motion.to - motion.from, 100'000'000);
    EXPECT_TRUE(motion.T_from_to.t().allFinite());
    EXPECT_LT(motion.T_from_to.t().norm(), 0.5);
  }
}

}  // namespace
}  // namespace urban_nav_input
