// SPDX-License-Identifier: BSD-3-Clause
#include "proprioception/random_walk.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace urban_nav_sim {
namespace {

constexpr int kWalks = 3000;

template <typename Make>
double sigmaAt(double t, const Make& make) {
  double square = 0.0;
  for (std::uint64_t i = 0; i < kWalks; ++i) square += make(Noise(i, "walk")).at(t).squaredNorm() / (3.0 * kWalks);
  return std::sqrt(square);
}

TEST(RandomWalk, FreeOnesSpreadWithTheRootOfTime) {
  const auto make = [](const Noise& noise) { return RandomWalk::free(2.0, 0.5, 100.0, noise); };
  EXPECT_NEAR(sigmaAt(0.0, make), 2.0, 0.08);
  EXPECT_NEAR(sigmaAt(100.0, make), std::sqrt(4.0 + 25.0), 0.2);
}

TEST(RandomWalk, MeanRevertingOnesKeepTheirSpreadAndDecorrelate) {
  const auto make = [](const Noise& noise) { return RandomWalk::drawnBack(2.0, 20.0, 100.0, noise); };
  EXPECT_NEAR(sigmaAt(0.0, make), 2.0, 0.08);
  EXPECT_NEAR(sigmaAt(100.0, make), 2.0, 0.08);
  double product = 0.0;
  for (std::uint64_t i = 0; i < kWalks; ++i) {
    const RandomWalk walk = make(Noise(i, "walk"));
    product += walk.at(30.0).dot(walk.at(50.0)) / (3.0 * kWalks);
  }
  EXPECT_NEAR(product, 4.0 * std::exp(-1.0), 0.25);
}

TEST(RandomWalk, GoesStraightFromNodeToNodeAndStopsAtTheEnd) {
  const RandomWalk walk = RandomWalk::free(1.0, 1.0, 10.0, Noise(1, "walk"));
  EXPECT_LT((walk.at(3.25) - 0.75 * walk.at(3.0) - 0.25 * walk.at(4.0)).norm(), 1e-12);
  EXPECT_EQ(walk.at(-1.0), walk.at(0.0));
  EXPECT_EQ(walk.at(500.0), walk.at(600.0));
}

}  // namespace
}  // namespace urban_nav_sim
