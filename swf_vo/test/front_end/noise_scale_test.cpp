// SPDX-License-Identifier: BSD-3-Clause
#include "front_end/noise_scale.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <vector>

namespace swf_vo {
namespace {

constexpr int kLandmarks = 60;

// Residuals of three coordinates over some frames, with these standard deviations relative to the stated ones.
struct Seen {
  NoiseScale scale{kLandmarks};
  std::vector<NoiseScale::Own> own = std::vector<NoiseScale::Own>(kLandmarks);

  template <typename Sigma>
  Seen(int frames, const Sigma& sigma) {
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    for (int frame = 0; frame < frames; ++frame) {
      for (int i = 0; i < kLandmarks; ++i) {
        double squared = 0.0;
        for (int c = 0; c < 3; ++c) squared += std::pow(sigma(i) * normal(random), 2);
        scale.see(squared, 3.0, own[static_cast<std::size_t>(i)]);
      }
      scale.learn();
    }
  }
};

TEST(NoiseScale, FindsWhatAllAreOffBy) {
  const Seen seen(100, [](int) { return 2.0; });
  EXPECT_NEAR(seen.scale.typical(), 4.0, 0.6);
  double mean = 0.0;
  for (const auto& own : seen.own) mean += seen.scale.of(own) / kLandmarks;
  EXPECT_NEAR(mean, 4.0, 0.2);
}

TEST(NoiseScale, DistinguishesThem) {
  const Seen seen(60, [](int i) { return i % 3 == 0 ? 4.0 : 1.2; });
  EXPECT_LT(seen.scale.typical(), 4.0) << "most are good";
  for (int i = 0; i < kLandmarks; ++i) {
    const double scale = seen.scale.of(seen.own[static_cast<std::size_t>(i)]);
    if (i % 3 == 0) EXPECT_GT(scale, 8.0) << i;
    else EXPECT_LT(scale, 3.0) << i;
  }
}

TEST(NoiseScale, NeverReducesTheStatedNoise) {
  const Seen seen(100, [](int) { return 0.5; });
  EXPECT_EQ(seen.scale.typical(), 1.0);
  for (const auto& own : seen.own) EXPECT_EQ(seen.scale.of(own), 1.0);
}

TEST(NoiseScale, IsNotMovedByOneThatIsFarOff) {
  Seen seen(60, [](int) { return 1.0; });
  const double before = seen.scale.typical();
  for (int frame = 0; frame < 5; ++frame) {
    seen.scale.see(1e9, 3.0, seen.own[0]);
    for (std::size_t i = 1; i < kLandmarks; ++i) seen.scale.see(3.0, 3.0, seen.own[i]);
    seen.scale.learn();
  }
  EXPECT_NEAR(seen.scale.typical(), before, 0.2);
  EXPECT_LT(seen.scale.of(seen.own[0]), 20.0);
}

TEST(NoiseScale, GoesByTheOthersAtFirst) {
  const Seen seen(100, [](int) { return 2.0; });
  EXPECT_EQ(seen.scale.of({}), seen.scale.typical());
}

}  // namespace
}  // namespace swf_vo
