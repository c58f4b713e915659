// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/labelling/labeler.hpp"

#include <gtest/gtest.h>

#include "support/yard.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/types/error.hpp"

namespace scene_labeler {
namespace {

double shareOfRightLabels(const SceneLabels& labels, const std::vector<SceneClass>& truth) {
  double right = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) right += labels.labels[i] == truth[i] ? 1.0 : 0.0;
  return right / static_cast<double>(truth.size());
}

class Labeler : public ::testing::TestWithParam<ClassifierKind> {};

TEST_P(Labeler, FindsTheClassesOfAnotherYard) {
  const testing::Yard yard = testing::makeYard(9);
  for (const FeatureSet features : {FeatureSet::Paper, FeatureSet::All}) {
    const LabelModel model = testing::trainOnYards(GetParam(), features);
    const SceneLabels labels = labelScene(model, yard.scene, 12);
    EXPECT_GT(shareOfRightLabels(labels, yard.labels), 0.93) << toString(features);
    EXPECT_TRUE(labels.image.empty());
    for (std::size_t i = 0; i < yard.labels.size(); ++i) {
      float sum = 0.0F;
      for (std::size_t k = 0; k < labels.classes.size(); ++k)
        sum += labels.probabilities[i * labels.classes.size() + k];
      ASSERT_NEAR(sum, 1.0F, 1e-4F);
      ASSERT_TRUE(labels.probability(i) >= 0.5F || labels.unsure[i] == 1);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, Labeler,
                         ::testing::Values(ClassifierKind::Svm, ClassifierKind::Forest, ClassifierKind::Boosted));

TEST(LabelerAnswers, AreNoneForReturnsThatAreNotFiniteAndTheSameForAnyNumberOfThreads) {
  testing::Yard yard = testing::makeYard(4);
  yard.scene.points[3].y() = std::numeric_limits<float>::quiet_NaN();
  const LabelModel model = testing::trainOnYards(ClassifierKind::Boosted);
  const auto label = [&](int threads) {
    const urban_nav_core::ThreadLimit limit(threads);
    return labelScene(model, yard.scene, 12);
  };
  const SceneLabels one = label(1), three = label(3);
  EXPECT_EQ(one.labels[3], SceneClass::None);
  EXPECT_EQ(one.probability(3), 0.0F);
  EXPECT_EQ(one.labels, three.labels);
  EXPECT_EQ(one.probabilities, three.probabilities);
  EXPECT_EQ(one.unsure, three.unsure);
}

TEST(LabelerAnswers, AreUnsureFarOutsideTheTrainingData) {
  const LabelModel model = testing::trainOnYards(ClassifierKind::Boosted);
  testing::Yard yard = testing::makeYard(6);
  const SceneLabels usual = labelScene(model, yard.scene, 12);
  const std::size_t count = yard.scene.points.size();
  for (std::size_t i = 0; i < 400; ++i)  // a mast of 40 m
    yard.scene.points.emplace_back(4.0F, 4.0F, 0.1F * static_cast<float>(i));
  const SceneLabels labels = labelScene(model, yard.scene, 12);
  std::size_t unsure = 0, before = 0;
  for (std::size_t i = count + 100; i < count + 400; ++i) unsure += labels.unsure[i];
  for (std::size_t i = 0; i < count; ++i) before += usual.unsure[i];
  EXPECT_GT(unsure, 270u);
  EXPECT_LT(before, count / 10);
}

TEST(Superpixels, ArePaintedWhereReturnsAreOnly) {
  testing::Yard yard = testing::makeYard(2);
  yard.scene.view.image = cv::Mat(240, 320, CV_8UC3, cv::Scalar(90, 110, 120));
  Eigen::Matrix<double, 3, 4> projection;  // from (0, 4, 1.5), along x
  projection << 160, -160, 0, 640, 120, 0, -160, 240, 1, 0, 0, 0;
  projectScene(projection, yard.scene);
  const LabelModel model = testing::trainOnYards(ClassifierKind::Boosted);
  const SceneLabels labels = labelScene(model, yard.scene, 12);
  ASSERT_EQ(labels.image.size(), yard.scene.view.image.size());
  EXPECT_EQ(labels.image.at<std::uint8_t>(5, 160), 255);  // sky
  EXPECT_EQ(labels.image.at<std::uint8_t>(140, 160), static_cast<std::uint8_t>(SceneClass::Wall));
}

TEST(Training, RefusesFewerThanTwoClasses) {
  testing::Yard yard = testing::makeYard(1);
  for (SceneClass& label : yard.labels)
    if (label != SceneClass::Paved) label = SceneClass::None;
  std::vector<TrainingFold> folds;
  addHalves({"yard", measureFeatures(yard.scene, FeatureSet::All), yard.labels, makePatches(yard.scene, {})},
            yard.scene, {}, folds);
  EXPECT_EQ(folds.size(), 2u);
  try {
    trainModel(folds, {}, [](double) {});
    FAIL();
  } catch (const urban_nav_core::DataError& error) {
    EXPECT_NE(error.parts().found.find("paved"), std::string::npos);
  }
}

TEST(Training, GivesTheSameModelForAnyOrderOfScenes) {
  std::vector<TrainingFold> folds = testing::yardFolds(FeatureSet::Paper);
  TrainingOptions options;
  options.features = FeatureSet::Paper;
  options.samples_per_class = 300;
  const std::string bytes = printModel(trainModel(folds, options, [](double) {}).model);
  std::reverse(folds.begin(), folds.end());
  EXPECT_EQ(printModel(trainModel(folds, options, [](double) {}).model), bytes);
}

}  // namespace
}  // namespace scene_labeler
