// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/model/calibration.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace scene_labeler {
namespace {

TEST(Calibration, RecoversTheScaleAndTheFrequenciesOfOverconfidentScores) {
  // Labels are drawn from softmax(score / 3 + bias): scale 1/3 and these biases are the truth.
  const std::vector<double> bias = {1.0, 0.0, -1.0};
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal(0.0, 4.0);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  HeldOutScores samples;
  samples.classes = 3;
  for (int i = 0; i < 20000; ++i) {
    std::vector<double> p(3);
    double sum = 0.0, drawn = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      samples.scores.push_back(static_cast<float>(normal(random)));
      sum += p[k] = std::exp(static_cast<double>(samples.scores.back()) / 3.0 + bias[k]);
    }
    const double at = uniform(random) * sum;
    std::uint8_t label = 0;
    while (label < 2 && (drawn += p[label]) < at) ++label;
    samples.labels.push_back(label);
    samples.weights.push_back(1.0F);
  }
  const Calibration calibration = fitCalibration(samples);
  EXPECT_NEAR(calibration.scale, 1.0 / 3.0, 0.02);
  EXPECT_NEAR(static_cast<double>(calibration.bias[0] - calibration.bias[1]), 1.0, 0.1);
  EXPECT_NEAR(static_cast<double>(calibration.bias[1] - calibration.bias[2]), 1.0, 0.1);
}

TEST(Calibration, GivesLogProbabilitiesThatSumToOne) {
  const Calibration calibration{0.5, {0.1F, -0.2F, 3.0F}};
  std::vector<float> scores = {-800.0F, 2.0F, 500.0F};
  calibration.apply(scores.data());
  EXPECT_NEAR(std::exp(scores[0]) + std::exp(scores[1]) + std::exp(scores[2]), 1.0F, 1e-5F);
}

TEST(Calibration, LeavesAClassThatNoSampleHasAsItIs) {
  HeldOutScores samples;
  samples.classes = 3;
  for (int i = 0; i < 2000; ++i) {
    const bool is_first = i % 2 == 0;
    for (const float score : {is_first ? 0.5F : 0.0F, is_first ? 0.0F : 0.5F, 1.0F}) samples.scores.push_back(score);
    samples.labels.push_back(is_first ? 0 : 1);
    samples.weights.push_back(1.0F);
  }
  const Calibration calibration = fitCalibration(samples);
  EXPECT_NEAR(calibration.bias[2], 0.0F, 1e-4F) << "although its score is always the highest";
  EXPECT_GT(calibration.scale, 1.5) << "the others are always right";
}

}  // namespace
}  // namespace scene_labeler
