// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/sweep/sweep_labeler.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/yard.hpp"
#include "urban_nav_core/parallel/for_each.hpp"

namespace scene_labeler {
namespace {

using urban_nav_core::LaserPoint;

const Eigen::Vector3f kPlace(4.0F, 4.0F, 1.0F);

std::shared_ptr<const LabelModel> yardModel() {
  return std::make_shared<const LabelModel>(testing::trainOnYards(ClassifierKind::Boosted));
}

/// Every fifth point of a yard, beginning with one of the first five.
std::vector<LaserPoint> everyFifth(const testing::Yard& yard, std::size_t first) {
  std::vector<LaserPoint> points;
  for (std::size_t i = first; i < yard.labels.size(); i += 5) {
    points.emplace_back();
    points.back().p = yard.scene.points[i];
  }
  return points;
}

double shareRight(const testing::Yard& yard, const SweepLabels& labels, std::size_t first) {
  std::size_t right = 0;
  for (std::size_t i = 0; i < labels.answer_of_return.size(); ++i) {
    const std::uint32_t row = labels.answer_of_return[i];
    if (row != SweepLabels::kNoAnswer) right += labels.answers.labels[row] == yard.labels[first + 5 * i] ? 1U : 0U;
  }
  return static_cast<double>(right) / static_cast<double>(labels.answer_of_return.size());
}

TEST(SweepLabeler, LabelsAllReturnsOfASweepInTheCloudOfThoseBefore) {
  const testing::Yard yard = testing::makeYard(51);
  SweepLabeler labeler(yardModel(), 12);
  double first_right = 0.0, right = 0.0;
  for (std::size_t sweep = 0; sweep < 5; ++sweep) {
    const SweepLabels labels = labeler.label(everyFifth(yard, sweep), kPlace);
    right = shareRight(yard, labels, sweep);
    if (sweep == 0) first_right = right;
    for (const std::uint32_t row : labels.answer_of_return) ASSERT_LT(row, labels.answers.labels.size());
    for (std::size_t row = 0; row < labels.answers.labels.size(); ++row) {
      float sum = 0.0F;
      for (std::size_t k = 0; k < labels.answers.classes.size(); ++k)
        sum += labels.answers.probabilities[row * labels.answers.classes.size() + k];
      ASSERT_NEAR(sum, 1.0F, 1e-3F);
    }
  }
  EXPECT_GT(right, 0.9);
  EXPECT_GE(right, first_right);
}

TEST(SweepLabeler, GivesNoAnswerBeyondItsReachAndToReturnsThatAreNotFinite) {
  const testing::Yard yard = testing::makeYard(52);
  std::vector<LaserPoint> points = everyFifth(yard, 0);
  const std::size_t count = points.size();
  points.emplace_back();
  points.back().p = kPlace + Eigen::Vector3f(static_cast<float>(SweepLabeler::reach()) + 1.0F, 0.0F, 0.0F);
  points.emplace_back();
  points.back().p.y() = std::numeric_limits<float>::quiet_NaN();
  SweepLabeler labeler(yardModel(), 12);
  const SweepLabels labels = labeler.label(points, kPlace);
  EXPECT_EQ(labels.answer_of_return[count], SweepLabels::kNoAnswer);
  EXPECT_EQ(labels.answer_of_return[count + 1], SweepLabels::kNoAnswer);
  EXPECT_NE(labels.answer_of_return[count - 1], SweepLabels::kNoAnswer);
  EXPECT_TRUE(labeler.label({}, kPlace).answer_of_return.empty());
}

TEST(SweepLabeler, ForgetsThePlacesThatTheSensorHasLeft) {
  const testing::Yard yard = testing::makeYard(53);
  SweepLabeler labeler(yardModel(), 12);
  std::size_t most = 0;
  for (int step = 0; step < 30; ++step) {
    std::vector<LaserPoint> points = everyFifth(yard, 0);
    const Eigen::Vector3f offset(12.0F * static_cast<float>(step), 0.0F, 0.0F);
    for (LaserPoint& point : points) point.p += offset;
    labeler.label(points, kPlace + offset);
    most = std::max(most, labeler.cloudSize());
  }
  const std::size_t of_all = labeler.cloudSize();
  SweepLabeler once(yardModel(), 12);
  once.label(everyFifth(yard, 0), kPlace);
  EXPECT_LT(most, 12 * once.cloudSize()) << "45 m around, not 360 m";
  EXPECT_LT(of_all, 12 * once.cloudSize());
}

TEST(SweepLabeler, UsesTheModelOfOtherDevicesIfThereIsOne) {
  const testing::Yard yard = testing::makeYard(55);
  const auto clouds =
      std::make_shared<const LabelModel>(testing::trainOnYards(ClassifierKind::Boosted, FeatureSet::Cloud));
  LabelModel both = *yardModel();
  both.of_other_devices = clouds;
  SweepLabeler labeler(std::make_shared<const LabelModel>(both), 12), of_clouds(clouds, 12), of_one(yardModel(), 12);
  const auto probabilities = [&](SweepLabeler& one) {
    return one.label(everyFifth(yard, 0), kPlace).answers.probabilities;
  };
  const std::vector<float> answer = probabilities(labeler);
  EXPECT_EQ(answer, probabilities(of_clouds));
  EXPECT_NE(answer, probabilities(of_one));
}

TEST(SweepLabeler, DoesNotDependOnTheNumberOfThreads) {
  const testing::Yard yard = testing::makeYard(54);
  const auto label = [&] {
    SweepLabeler labeler(yardModel(), 12);
    labeler.label(everyFifth(yard, 0), kPlace);
    return labeler.label(everyFifth(yard, 1), kPlace);
  };
  const SweepLabels many = label();
  urban_nav_core::ThreadLimit one(1);
  const SweepLabels single = label();
  EXPECT_EQ(many.answers.probabilities, single.answers.probabilities);
  EXPECT_EQ(many.answers.unsure, single.answers.unsure);
  EXPECT_EQ(many.answer_of_return, single.answer_of_return);
}

}  // namespace
}  // namespace scene_labeler
