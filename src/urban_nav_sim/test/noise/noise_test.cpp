// SPDX-License-Identifier: BSD-3-Clause
#include "noise/noise.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <vector>

namespace urban_nav_sim {
namespace {

constexpr std::uint64_t kDraws = 200000;

struct Moments {
  double mean = 0.0, variance = 0.0, third = 0.0, fourth = 0.0, most = 0.0;
};

template <typename Draw>
Moments computeMoments(const Draw& draw) {
  Moments sums;
  for (std::uint64_t i = 0; i < kDraws; ++i) {
    const double x = draw(i);
    sums.mean += x / kDraws;
    sums.variance += x * x / kDraws;
    sums.third += x * x * x / kDraws;
    sums.fourth += x * x * x * x / kDraws;
    sums.most = std::max(sums.most, std::abs(x));
  }
  sums.variance -= sums.mean * sums.mean;
  return sums;
}

template <typename A, typename B>
double computeCorrelation(const A& a, const B& b) {
  double sum = 0.0;
  for (std::uint64_t i = 0; i < kDraws; ++i) sum += a(i) * b(i);
  return sum / kDraws;
}

constexpr double kFiveSigma = 5.0 / 447.2;  // of a mean of kMany unit variances

TEST(Noise, UniformFillsItsRangeEvenly) {
  const Noise noise(7, "uniform");
  std::vector<int> counts(64);
  double least = 1.0, most = 0.0;
  for (std::uint64_t i = 0; i < kDraws; ++i) {
    const double x = noise.uniform(i);
    ASSERT_GE(x, 0.0);
    ASSERT_LT(x, 1.0);
    ++counts[static_cast<std::size_t>(x * 64)];
    least = std::min(least, x);
    most = std::max(most, x);
  }
  EXPECT_LT(least, 1e-3);
  EXPECT_GT(most, 1.0 - 1e-3);
  double chi2 = 0.0;
  for (const int count : counts) chi2 += std::pow(count - kDraws / 64.0, 2) / (kDraws / 64.0);
  EXPECT_GT(chi2, 25.0);  // 63 degrees of freedom: both ends one in 100 000
  EXPECT_LT(chi2, 120.0);
}

TEST(Noise, NormalHasTheMomentsOfANormal) {
  const Noise noise(7, "normal");
  const Moments m = computeMoments([&](std::uint64_t i) { return noise.normal(i); });
  EXPECT_NEAR(m.mean, 0.0, kFiveSigma);
  EXPECT_NEAR(m.variance, 1.0, kFiveSigma * std::sqrt(2.0));
  EXPECT_NEAR(m.third, 0.0, kFiveSigma * std::sqrt(15.0));
  EXPECT_NEAR(m.fourth, 3.0, kFiveSigma * std::sqrt(96.0));
  EXPECT_GT(m.most, 4.0);
  EXPECT_LT(m.most, 6.8);
}

TEST(Noise, NormalAgreesWithBoxAndMullerByTheLibrary) {
  const Noise noise(11, "formula");
  for (std::uint64_t i = 0; i < 10000; ++i) {
    const std::uint64_t both = noise.bits(i);
    const double u = (static_cast<double>(both >> 32) + 0.5) / 4294967296.0;
    const double v = static_cast<double>(both & 0xffffffffU) / 4294967296.0;
    EXPECT_NEAR(noise.normal(i), std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * M_PI * v), 1e-13);
  }
}

TEST(Noise, RoughNormalHasItsStatedMoments) {
  const Noise noise(7, "pixels");
  const Moments m = computeMoments([&](std::uint64_t i) { return static_cast<double>(noise.roughNormal(i)); });
  EXPECT_NEAR(m.mean, 0.0, kFiveSigma);
  EXPECT_NEAR(m.variance, 1.0, kFiveSigma * std::sqrt(2.0));
  EXPECT_NEAR(m.fourth, 2.85, kFiveSigma * std::sqrt(96.0));
  EXPECT_LT(m.most, 4.9);
}

TEST(Noise, StreamsAreIndependent) {
  const Noise base(7, "laser_left");
  const auto draws = [](const Noise& noise) { return [noise](std::uint64_t i) { return noise.normal(i); }; };
  for (const Noise& other :
       {Noise(7, "laser_right"), Noise(8, "laser_left"), Noise(7, 0), base.of(0), base.of(1), base.of("laser_left")}) {
    EXPECT_NEAR(computeCorrelation(draws(base), draws(other)), 0.0, kFiveSigma);
  }
  EXPECT_NEAR(computeCorrelation(draws(base.of(1)), draws(base.of(2))), 0.0, kFiveSigma);
}

TEST(Noise, NeighboursAreIndependent) {
  const Noise noise(7, "neighbours");
  for (const std::uint64_t lag : {1, 2, 181, 512, 65536}) {
    EXPECT_NEAR(computeCorrelation([&](std::uint64_t i) { return noise.normal(i); },
                                   [&](std::uint64_t i) { return noise.normal(i + lag); }),
                0.0, kFiveSigma);
  }
  // The first number of neighbouring streams, as where each row of a picture has its own.
  const auto first = [&](std::uint64_t i) { return noise.of(i).normal(0); };
  EXPECT_NEAR(computeMoments(first).variance, 1.0, kFiveSigma * std::sqrt(2.0));
  EXPECT_NEAR(computeCorrelation(first, [&](std::uint64_t i) { return noise.of(i + 1).normal(0); }), 0.0, kFiveSigma);
}

TEST(Noise, EveryBitOfTheCounterChangesHalfTheBits) {
  const Noise noise(7, "avalanche");
  for (int bit = 0; bit < 64; ++bit) {
    double changed = 0.0;
    for (std::uint64_t i = 0; i < 500; ++i) {
      changed += __builtin_popcountll(noise.bits(i) ^ noise.bits(i ^ (std::uint64_t{1} << bit))) / 500.0;
    }
    EXPECT_NEAR(changed, 32.0, 1.0) << bit;
  }
}

TEST(Noise, VectorsHaveIndependentParts) {
  const Noise noise(7, "vectors");
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (std::uint64_t i = 0; i < kDraws; ++i) sum += noise.normal3(i) * noise.normal3(i).transpose() / kDraws;
  EXPECT_LT((sum - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), kFiveSigma * 1.5);
}

TEST(Noise, BelowIsEvenAndChanceHasItsProbability) {
  const Noise noise(7, "below");
  std::vector<int> counts(7);
  double hits = 0.0;
  for (std::uint64_t i = 0; i < kDraws; ++i) {
    const std::uint64_t x = noise.below(i, 7);
    ASSERT_LT(x, 7U);
    ++counts[x];
    hits += noise.chance(i, 0.2) ? 1.0 / kDraws : 0.0;
  }
  for (const int count : counts) EXPECT_NEAR(count, kDraws / 7.0, 5.0 * std::sqrt(kDraws / 7.0));
  EXPECT_NEAR(hits, 0.2, 0.4 * kFiveSigma);
  EXPECT_EQ(noise.below(3, 1), 0U);
}

// What other machines must give as well; a change here changes every simulated byte.
TEST(Noise, SameBitsEverywhere) {
  const auto toBits = [](double x) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &x, sizeof(bits));
    return bits;
  };
  const Noise noise(7, "same");
  EXPECT_EQ(noise.bits(0), 9406206974837856439U);
  EXPECT_EQ(noise.of(3).bits(1U << 20), 9970584337589087420U);
  std::uint64_t all = 0;
  for (std::uint64_t i = 0; i < 10000; ++i) all = all * 31 + toBits(noise.normal(i));
  EXPECT_EQ(all, 15259115872865884821U);
}

}  // namespace
}  // namespace urban_nav_sim
