// SPDX-License-Identifier: BSD-3-Clause
#include "front_end/patch_residual_test.hpp"

#include <gtest/gtest.h>

#include <random>

namespace swf_vo {
namespace {

TEST(PatchResidualTest, LetsNoiseThroughAndStopsWhatIsTwoSurfaces) {
  for (const double level : {1.0, 6.0}) {
    PatchResidualTest misfit;
    std::mt19937 random(1);
    std::normal_distribution<double> noise(level, 0.08 * level);
    int refused = 0;
    for (int i = 0; i < 1000; ++i) refused += misfit.isTypical(noise(random)) ? 0 : 1;
    EXPECT_LT(refused, 5) << level;
    EXPECT_FALSE(misfit.isTypical(2.0 * level));
  }
}

TEST(PatchResidualTest, AdaptsToAChangeOfLight) {
  PatchResidualTest misfit;
  for (int i = 0; i < 500; ++i) misfit.isTypical(1.0 + 0.001 * (i % 50));
  EXPECT_FALSE(misfit.isTypical(4.0));
  for (int i = 0; i < 128; ++i) misfit.isTypical(4.0 + 0.001 * (i % 50));
  EXPECT_TRUE(misfit.isTypical(4.0));
}

TEST(PatchResidualTest, ReportsNothingWithoutEnoughData) {
  PatchResidualTest misfit;
  EXPECT_TRUE(misfit.isTypical(1.0));
  EXPECT_TRUE(misfit.isTypical(100.0));
}

}  // namespace
}  // namespace swf_vo
