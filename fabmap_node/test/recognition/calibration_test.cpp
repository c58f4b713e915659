// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/recognition/calibration.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace fabmap_node {
namespace {

/// Draws samples with log odds 8 look - 4 + 6 word_ratio.
std::vector<CalibrationSample> drawSamples(int count) {
  std::mt19937 random(5);
  const auto uniform = [&random] { return static_cast<double>(random() % 10000) / 10000.0; };
  std::vector<CalibrationSample> samples;
  for (int i = 0; i < count; ++i) {
    CalibrationSample sample;
    sample.evidence.word_ratio = uniform() - 0.5;
    sample.evidence.look = uniform();
    const double logit = 8.0 * sample.evidence.look - 4.0 + 6.0 * sample.evidence.word_ratio;
    sample.is_same_place = uniform() < 1.0 / (1.0 + std::exp(-logit));
    samples.push_back(sample);
  }
  return samples;
}

/// Both kinds have equal total weight in a fit, which shifts log odds by those of the kinds.
double shiftOfKinds(const std::vector<CalibrationSample>& samples) {
  double right = 0.0;
  for (const CalibrationSample& sample : samples) right += sample.is_same_place ? 1.0 : 0.0;
  return std::log((static_cast<double>(samples.size()) - right) / right);
}

TEST(FitCalibration, RecoversTheModelThatDrewTheSamples) {
  const auto samples = drawSamples(20000);
  const PlaceCalibration calibration = fitCalibration(samples);
  EXPECT_NEAR(calibration.weights[0], 6.0, 0.4);
  EXPECT_NEAR(calibration.weights[2], 8.0, 0.4);
  EXPECT_NEAR(calibration.bias, -4.0 + shiftOfKinds(samples), 0.3);
  EXPECT_EQ(calibration.weights[1], 0.0);
}

TEST(FitCalibration, SeparableSamplesClaimNoMoreThanTheirNumberSupports) {
  std::vector<CalibrationSample> samples;
  for (int i = 0; i < 50; ++i) {
    samples.push_back({{0.3, 0.2, 0.7, 0.5}, true});
    samples.push_back({{0.0, 0.0, 0.1, 0.0}, false});
  }
  const PlaceCalibration calibration = fitCalibration(samples);
  EXPECT_GT(calibration.probability({0.3, 0.2, 0.7, 0.5}), 0.9);
  EXPECT_LT(calibration.probability({0.0, 0.0, 0.1, 0.0}), 0.1);
  EXPECT_LE(calibration.probability({9.0, 9.0, 9.0, 9.0}), 51.0 / 52.0);
  EXPECT_GE(calibration.probability({-9.0, -9.0, -9.0, -9.0}), 1.0 / 52.0);
}

TEST(FitCalibration, MoreEvidenceIsNeverLessProbable) {
  for (const double weight : fitCalibration(drawSamples(500)).weights) EXPECT_GE(weight, 0.0);
}

TEST(FitCalibration, SamplesOfOneKindAnnounceNothing) {
  const std::vector<CalibrationSample> right(10, {{1.0, 1.0, 1.0, 1.0}, true});
  EXPECT_LT(fitCalibration(right).probability({1.0, 1.0, 1.0, 1.0}), 0.5);
  EXPECT_LT(fitCalibration({}).probability({1.0, 1.0, 1.0, 1.0}), 0.5);
}

}  // namespace
}  // namespace fabmap_node
