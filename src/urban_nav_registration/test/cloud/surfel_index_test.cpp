// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/surfel_index.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "urban_nav_core/testing/dice.hpp"

namespace urban_nav_registration {
namespace {

using urban_nav_core::testing::Dice;

Eigen::Vector3f somewhere(Dice& dice, double size) {
  return {static_cast<float>(dice.uniform(-size, size)), static_cast<float>(dice.uniform(-size, size)),
          static_cast<float>(dice.uniform(-size, size))};
}

TEST(SurfelIndex, FindsTheSameAsAnExhaustiveSearch) {
  Dice dice(3);
  std::vector<Surfel> surfels;
  for (int i = 0; i < 8000; ++i)
    surfels.push_back({somewhere(dice, 4.0), somewhere(dice, 1.0).normalized(), dice.chance(0.9) ? 0.5F : 0.0F});
  for (const float reach : {0.3F, 1.0F, 2.0F}) {
    const SurfelIndex index(surfels, reach);
    int found = 0, moved_far = 0;
    for (int query = 0; query < 1000; ++query) {
      const Eigen::Vector3f point = somewhere(dice, 5.0), normal = somewhere(dice, 1.0).normalized();
      float least = std::numeric_limits<float>::infinity();
      for (const Surfel& surfel : surfels)
        if (surfel.planarity > 0.0F && std::abs(surfel.normal.dot(normal)) > 0.70710678F)
          least = std::min(least, (surfel.mean - point).norm());
      const auto [nearest, margin] = index.nearest(point, normal);
      ASSERT_EQ(nearest != nullptr, least < reach) << least;
      if (nearest == nullptr) continue;
      EXPECT_EQ((nearest->mean - point).norm(), least);
      EXPECT_GE(margin, 0.0F);
      for (int moved = 0; moved < 5; ++moved) {
        const Eigen::Vector3f there = point + 0.999F * margin * somewhere(dice, 1.0).normalized();
        EXPECT_EQ(index.nearest(there, normal).surfel, nearest) << margin;
      }
      moved_far += margin > 0.05F * reach ? 1 : 0;
      ++found;
    }
    EXPECT_GT(found, 100) << reach;
    EXPECT_GT(moved_far, found / 10) << reach;
  }
}

TEST(SurfelIndex, AFinerOneAnswersForWhatIsNear) {
  Dice dice(4);
  std::vector<Surfel> surfels;
  for (int i = 0; i < 3000; ++i) surfels.push_back({somewhere(dice, 4.0), somewhere(dice, 1.0).normalized(), 0.5F});
  const auto finer = std::make_shared<const SurfelIndex>(surfels, 0.4F);
  const SurfelIndex alone(surfels, 1.5F), index(surfels, 1.5F, finer);
  int near = 0, far = 0;
  for (int query = 0; query < 2000; ++query) {
    const Eigen::Vector3f point = somewhere(dice, 5.0), normal = somewhere(dice, 1.0).normalized();
    const auto expected = alone.nearest(point, normal), found = index.nearest(point, normal);
    ASSERT_EQ(found.surfel == nullptr, expected.surfel == nullptr);
    if (found.surfel == nullptr) continue;
    EXPECT_EQ(found.surfel->mean, expected.surfel->mean);
    ++((found.surfel->mean - point).norm() < 0.4F ? near : far);
  }
  EXPECT_GT(near, 300);
  EXPECT_GT(far, 300);
}

TEST(SurfelIndex, NothingIsNearWhatIsNoPlace) {
  const SurfelIndex index({{Eigen::Vector3f::Zero(), Eigen::Vector3f::UnitZ(), 1.0F}}, 1.0F);
  const Eigen::Vector3f up = Eigen::Vector3f::UnitZ();
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 1e30F})
    EXPECT_EQ(index.nearest(Eigen::Vector3f(bad, 0.0F, 0.0F), up).surfel, nullptr);
  EXPECT_EQ(SurfelIndex({}, 1.0F).nearest(Eigen::Vector3f::Zero(), up).surfel, nullptr);
  EXPECT_NE(index.nearest(Eigen::Vector3f(0.5F, 0.5F, 0.0F), up).surfel, nullptr);
}

}  // namespace
}  // namespace urban_nav_registration
