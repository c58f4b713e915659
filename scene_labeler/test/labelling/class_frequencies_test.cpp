// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/labelling/class_frequencies.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace scene_labeler {
namespace {

LabelModel trainedWith(std::vector<float> frequencies) {
  LabelModel model;
  model.classes = {SceneClass::Paved, SceneClass::DirtPath, SceneClass::Wall};
  model.samples.frequencies = std::move(frequencies);
  return model;
}

void addRow(const std::vector<double>& probabilities, std::vector<float>& logs) {
  for (const double p : probabilities) logs.push_back(static_cast<float>(std::log(p)));
}

/// Corrects this many returns with equal probabilities.
void see(int count, const std::vector<double>& probabilities, ClassFrequencies& frequencies) {
  std::vector<float> logs;
  for (int i = 0; i < count; ++i) addRow(probabilities, logs);
  frequencies.correct(logs);
}

/// Returns the corrected probabilities of one return.
std::vector<float> corrected(const std::vector<double>& probabilities, ClassFrequencies& frequencies) {
  std::vector<float> row;
  addRow(probabilities, row);
  frequencies.correct(row);
  for (float& value : row) value = std::exp(value);
  return row;
}

/// Log probabilities of returns whose classes have these frequencies, from a sensor with normally distributed readings,
/// by a model trained with other frequencies; and the classes.
std::pair<std::vector<float>, std::vector<std::size_t>> readings(const std::vector<double>& here,
                                                                 const std::vector<double>& trained, std::size_t count,
                                                                 double spread) {
  std::mt19937 random(3);
  std::discrete_distribution<std::size_t> draw(here.begin(), here.end());
  std::normal_distribution<double> noise(0.0, spread);
  std::vector<float> logs;
  std::vector<std::size_t> classes;
  for (std::size_t i = 0; i < count; ++i) {
    classes.push_back(draw(random));
    const double reading = static_cast<double>(classes.back()) + noise(random);
    std::vector<double> p;
    double sum = 0.0;
    for (std::size_t k = 0; k < trained.size(); ++k) {
      p.push_back(trained[k] * std::exp(-0.5 * std::pow((reading - static_cast<double>(k)) / spread, 2)) + 1e-9);
      sum += p.back();
    }
    for (double& value : p) value /= sum;
    addRow(p, logs);
  }
  return {logs, classes};
}

double shareRight(const std::vector<float>& logs, const std::vector<std::size_t>& classes) {
  std::size_t right = 0;
  for (std::size_t i = 0; i < classes.size(); ++i) {
    const auto row = logs.begin() + static_cast<std::ptrdiff_t>(3 * i);
    right += static_cast<std::size_t>(std::max_element(row, row + 3) - row) == classes[i];
  }
  return static_cast<double>(right) / static_cast<double>(classes.size());
}

TEST(ClassFrequencies, MoreIsRightWhereClassesAreNotAsFrequentAsInTraining) {
  const LabelModel model = trainedWith({500, 200, 300});
  ClassFrequencies frequencies(model);
  for (int stretch = 0; stretch < 3; ++stretch) {
    auto [logs, classes] = readings({0.02, 0.68, 0.3}, {0.5, 0.2, 0.3}, 20000, 0.6);
    const double before = shareRight(logs, classes);
    frequencies.correct(logs);
    EXPECT_GT(shareRight(logs, classes), before + 0.05) << stretch;
    for (std::size_t i = 0; i < logs.size(); i += 3)
      ASSERT_NEAR(std::exp(logs[i]) + std::exp(logs[i + 1]) + std::exp(logs[i + 2]), 1.0F, 1e-4F);
  }
}

TEST(ClassFrequencies, HardlyChangesWhatIsAsInTraining) {
  const LabelModel model = trainedWith({500, 200, 300});
  ClassFrequencies frequencies(model);
  const auto [logs, classes] = readings({0.5, 0.2, 0.3}, {0.5, 0.2, 0.3}, 20000, 0.6);
  std::vector<float> corrected = logs;
  frequencies.correct(corrected);
  for (std::size_t i = 0; i < logs.size(); ++i) ASSERT_NEAR(std::exp(corrected[i]), std::exp(logs[i]), 0.03F);
}

TEST(ClassFrequencies, WhatIsSureStaysHoweverRare) {
  const LabelModel model = trainedWith({500, 200, 300});
  ClassFrequencies frequencies(model);
  see(300000, {0.001, 0.998, 0.001}, frequencies);
  EXPECT_GT(corrected({0.99, 0.005, 0.005}, frequencies)[0], 0.7F);
}

TEST(ClassFrequencies, FollowsTheRobotToAnotherPlace) {
  const LabelModel model = trainedWith({500, 200, 300});
  ClassFrequencies frequencies(model);
  for (int stretch = 0; stretch < 20; ++stretch) see(50000, {0.001, 0.998, 0.001}, frequencies);
  EXPECT_LT(corrected({0.5, 0.49, 0.01}, frequencies)[0], 0.2F);
  for (int stretch = 0; stretch < 20; ++stretch) see(50000, {0.998, 0.001, 0.001}, frequencies);
  EXPECT_GT(corrected({0.5, 0.49, 0.01}, frequencies)[0], 0.6F);
}

TEST(ClassFrequencies, WhatIsLeftOutStaysAsItIsAndDoesNotCount) {
  const LabelModel model = trainedWith({500, 200, 300});
  ClassFrequencies frequencies(model), all(model);
  std::vector<float> logs;
  for (int i = 0; i < 100000; ++i) addRow({0.001, 0.998, 0.001}, logs);
  std::vector<float> same = logs;
  frequencies.correct(same, std::vector<std::uint8_t>(100000, 1));
  EXPECT_EQ(same, logs);
  EXPECT_NEAR(corrected({0.5, 0.49, 0.01}, frequencies)[0], 0.5F, 0.01F);
  all.correct(logs);
  EXPECT_LT(corrected({0.5, 0.49, 0.01}, all)[0], 0.2F);
}

TEST(ClassFrequencies, AModelWithoutFrequenciesOfItsTrainingChangesNothing) {
  std::vector<float> logs;
  addRow({0.6, 0.3, 0.1}, logs);
  const std::vector<float> before = logs;
  for (const std::vector<float>& unknown : {std::vector<float>(), std::vector<float>(3, 0.0F)}) {
    ClassFrequencies frequencies(trainedWith(unknown));
    frequencies.correct(logs);
    EXPECT_EQ(logs, before);
  }
}

TEST(ClassFrequencies, AClassThatTrainingHadNoFrequencyOfKeepsItsPlace) {
  const LabelModel model = trainedWith({500, 500, 0});
  ClassFrequencies frequencies(model);
  see(1000, {0.1, 0.1, 0.8}, frequencies);
  EXPECT_GT(corrected({0.1, 0.1, 0.8}, frequencies)[2], 0.7F);
}

}  // namespace
}  // namespace scene_labeler
