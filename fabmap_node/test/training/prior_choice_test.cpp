// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/training/prior_choice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "urban_nav_core/parallel/for_each.hpp"

namespace fabmap_node {
namespace {

constexpr std::size_t kSiteCount = 8;

/// 120 samples of each site; `separation`: between the means of both kinds, in standard deviations of the evidence.
std::vector<CalibrationSample> drawSites(double separation, unsigned seed, std::size_t sites = kSiteCount) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<CalibrationSample> samples;
  for (std::size_t site = 0; site < sites; ++site)
    for (int i = 0; i < 120; ++i) {
      CalibrationSample sample;
      sample.is_same_place = i % 2 == 0;
      sample.site = site;
      const double shift = sample.is_same_place ? separation : 0.0;
      sample.evidence.word_ratio = shift + normal(random);
      sample.evidence.look = normal(random);
      sample.evidence.look_margin = normal(random);
      samples.push_back(sample);
    }
  return samples;
}

/// Returns the log loss of the chosen standard deviation.
const HeldOutLoss& chosenLoss(const PriorChoice& choice) {
  return *std::find_if(choice.losses.begin(), choice.losses.end(),
                       [&choice](const HeldOutLoss& loss) { return loss.prior_deviation == choice.prior_deviation; });
}

TEST(ChoosePrior, NoiseGetsTheStrongestPrior) {
  const PriorChoice choice = choosePrior(drawSites(0.0, 1));
  ASSERT_FALSE(choice.losses.empty());
  EXPECT_EQ(choice.prior_deviation, choice.losses.front().prior_deviation);
  EXPECT_NEAR(choice.losses.front().log_loss, std::log(2.0), 0.02);
}

TEST(ChoosePrior, SeparableSitesGetAWeakPrior) {
  const PriorChoice noise = choosePrior(drawSites(0.0, 1)), separable = choosePrior(drawSites(9.0, 2));
  EXPECT_GT(separable.prior_deviation, 4.0 * noise.prior_deviation);
  EXPECT_LT(chosenLoss(separable).log_loss, 0.02);
}

TEST(ChoosePrior, EvidenceThatMisleadsAtOneSiteGetsAStrongerPriorThanTheSameThatHoldsEverywhere) {
  std::vector<CalibrationSample> misleading = drawSites(9.0, 2);
  for (CalibrationSample& sample : misleading)
    if (sample.site == 3 && !sample.is_same_place) sample.evidence.word_ratio += 9.0;
  EXPECT_LT(choosePrior(misleading).prior_deviation, choosePrior(drawSites(9.0, 2)).prior_deviation);
}

TEST(ChoosePrior, TheSmallestLossIsChosen) {
  for (const double separation : {0.5, 2.0, 4.0}) {
    const PriorChoice choice = choosePrior(drawSites(separation, 3));
    for (const HeldOutLoss& loss : choice.losses) {
      EXPECT_GT(loss.standard_error, 0.0);
      EXPECT_GE(loss.log_loss, chosenLoss(choice).log_loss) << loss.prior_deviation;
    }
  }
}

/// A site at which the evidence is the same for both kinds.
TEST(ChoosePrior, ADifficultSiteDoesNotHideTheLossOfAStrongPrior) {
  std::vector<CalibrationSample> samples = drawSites(3.0, 3);
  for (CalibrationSample sample : drawSites(0.0, 5, 1)) {
    sample.site = kSiteCount;
    sample.evidence.word_ratio = 1.5;
    samples.push_back(sample);
  }
  const PriorChoice choice = choosePrior(samples);
  ASSERT_FALSE(choice.losses.empty());
  EXPECT_GT(choice.prior_deviation, choice.losses.front().prior_deviation);
  EXPECT_LT(choice.losses.front().log_loss - chosenLoss(choice).log_loss, chosenLoss(choice).standard_error);
}

TEST(ChoosePrior, DifferentSitesHaveALargerStandardErrorThanSimilarOnes) {
  std::vector<CalibrationSample> misleading = drawSites(2.0, 2);
  for (CalibrationSample& sample : misleading)
    if (sample.site < 3 && !sample.is_same_place) sample.evidence.word_ratio += 3.0;
  const PriorChoice alike = choosePrior(drawSites(2.0, 2)), differing = choosePrior(misleading);
  for (std::size_t i = 0; i < alike.losses.size(); ++i)
    EXPECT_GT(differing.losses[i].standard_error, 2.0 * alike.losses[i].standard_error);
}

TEST(ChoosePrior, TooFewSitesGetTheDefault) {
  for (const auto& samples : {drawSites(9.0, 2, 4), std::vector<CalibrationSample>()}) {
    const PriorChoice choice = choosePrior(samples);
    EXPECT_EQ(choice.prior_deviation, kDefaultPriorDeviation);
    EXPECT_TRUE(choice.losses.empty());
  }
  std::vector<CalibrationSample> one_revisited = drawSites(9.0, 2);
  for (CalibrationSample& sample : one_revisited) sample.is_same_place = sample.is_same_place && sample.site == 0;
  EXPECT_TRUE(choosePrior(one_revisited).losses.empty());
}

TEST(ChoosePrior, DoesNotDependOnTheNumberOfThreads) {
  const std::vector<CalibrationSample> samples = drawSites(1.0, 4);
  const PriorChoice many = choosePrior(samples);
  const urban_nav_core::ThreadLimit limit(1);
  const PriorChoice one = choosePrior(samples);
  EXPECT_EQ(one.prior_deviation, many.prior_deviation);
  ASSERT_EQ(one.losses.size(), many.losses.size());
  for (std::size_t i = 0; i < one.losses.size(); ++i) EXPECT_EQ(one.losses[i].log_loss, many.losses[i].log_loss);
}

}  // namespace
}  // namespace fabmap_node
