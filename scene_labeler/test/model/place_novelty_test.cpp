// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/model/place_novelty.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "scene_labeler/labelling/labeler.hpp"
#include "support/pictured_yard.hpp"

namespace scene_labeler {
namespace {

/// A yard in an image, half of whose ground is a green lawn; streaks give each yard its own shades.
testing::Yard makeLawnYard(unsigned seed) {
  testing::Yard yard = testing::makePicturedYard(seed);
  cv::Mat& image = yard.scene.view.image;
  image.rowRange(130, 240).colRange(0, 160).setTo(cv::Scalar(50, 140, 70));
  cv::Mat shades(image.size(), CV_8UC3);
  cv::RNG random(seed);
  random.fill(shades, cv::RNG::UNIFORM, 0, 40);
  image += shades;
  for (std::size_t i = 0; i < yard.labels.size(); ++i)
    if (yard.labels[i] == SceneClass::Paved && yard.scene.points[i].y() > 4.0F) yard.labels[i] = SceneClass::Grass;
  return yard;
}

TrainingFold makeLawnFold(unsigned seed) {
  const testing::Yard yard = makeLawnYard(seed);
  std::vector<TrainingFold> folds;
  addScene({yard.scene.name, measureFeatures(yard.scene, FeatureSet::All), yard.labels,
            makePatches(yard.scene, makeSuperpixels(yard.scene.view.image, 12))},
           {}, folds);
  return folds.front();
}

const LabelModel& trainOnLawnYards() {
  static const LabelModel model = [] {
    TrainingOptions options;
    options.samples_per_class = 400;
    return trainModel({makeLawnFold(1), makeLawnFold(2), makeLawnFold(3)}, options, [](double) {}).model;
  }();
  return model;
}

/// The same yard in other colours.
testing::Yard makeStrangeYard(unsigned seed) {
  testing::Yard yard = makeLawnYard(seed);
  cv::cvtColor(yard.scene.view.image, yard.scene.view.image, cv::COLOR_BGR2RGB);
  yard.scene.view.image.rowRange(130, 240).colRange(160, 320).setTo(cv::Scalar(140, 60, 130));
  return yard;
}

struct Shares {
  double unsure = 0.0, right = 0.0;
};

/// Returns of some class that are visible in the image.
Shares measureShares(SceneClass wanted, const testing::Yard& yard, const SceneLabels& labels) {
  double count = 0.0;
  Shares shares;
  for (std::size_t i = 0; i < yard.labels.size(); ++i) {
    if (yard.labels[i] != wanted || yard.scene.view.is_visible[i] == 0) continue;
    count += 1.0;
    shares.unsure += labels.unsure[i];
    shares.right += labels.labels[i] == wanted ? 1.0 : 0.0;
  }
  shares.unsure /= count;
  shares.right /= count;
  return shares;
}

TEST(PlaceNovelty, LabelsAreUnsureInColoursAbsentFromTraining) {
  const testing::Yard known = makeLawnYard(9), strange = makeStrangeYard(9);
  const SceneLabels at_home = labelScene(trainOnLawnYards(), known.scene, 12);
  EXPECT_LT(at_home.share_unlike, 0.15);
  EXPECT_FALSE(isNewPlace(at_home.share_unlike));
  const SceneLabels abroad = labelScene(trainOnLawnYards(), strange.scene, 12);
  EXPECT_GT(abroad.share_unlike, 0.5);
  EXPECT_TRUE(isNewPlace(abroad.share_unlike));
  for (const SceneClass ground : {SceneClass::Grass, SceneClass::Paved}) {
    EXPECT_GT(measureShares(ground, known, at_home).right, 0.9) << toString(ground);
    EXPECT_LT(measureShares(ground, known, at_home).unsure, 0.1) << toString(ground);
    EXPECT_GT(measureShares(ground, strange, abroad).unsure, 0.95) << toString(ground);
  }
}

TEST(PlaceNovelty, ClassifiesPointsWithoutImagesByShape) {
  const LabelModel& model = testing::trainOnYards(ClassifierKind::Boosted);
  testing::Yard yard = testing::makeYard(9);
  EXPECT_LT(labelScene(model, yard.scene, 12).share_unlike, 0.15);
  for (Eigen::Vector3f& point : yard.scene.points)  // terraces of half a metre
    point = {2.0F * point.x(), 2.0F * point.y(), 4.0F * point.z() + 0.5F * std::floor(point.x()) + point.y()};
  EXPECT_GT(labelScene(model, yard.scene, 12).share_unlike, 0.3);
}

TEST(PlaceNovelty, NothingIsNewToAModelThatCannotCompareDrives) {
  const testing::Yard strange = makeStrangeYard(9);
  LabelModel without = trainOnLawnYards();
  without.samples = {};
  without.place_novelty = PlaceNovelty(without.features, without.bins, without.samples);
  EXPECT_EQ(labelScene(without, strange.scene, 12).share_unlike, 0.0);
  LabelModel of_one_drive = trainOnLawnYards();
  std::fill(of_one_drive.samples.places.begin(), of_one_drive.samples.places.end(), std::uint16_t{0});
  of_one_drive.place_novelty = PlaceNovelty(of_one_drive.features, of_one_drive.bins, of_one_drive.samples);
  EXPECT_EQ(labelScene(of_one_drive, strange.scene, 12).share_unlike, 0.0);
}

TEST(PlaceNovelty, IsTheSameForAModelThatWasRead) {
  const LabelModel read = parseModel(printModel(trainOnLawnYards()), "m");
  const testing::Yard strange = makeStrangeYard(4);
  EXPECT_EQ(labelScene(read, strange.scene, 12).share_unlike,
            labelScene(trainOnLawnYards(), strange.scene, 12).share_unlike);
}

TEST(DoubtKinds, DividesWithinKindsOfGroundAndWithinOtherKinds) {
  const std::vector<SceneClass> classes = {SceneClass::Grass,        SceneClass::Paved,      SceneClass::DirtPath,
                                           SceneClass::TexturedWall, SceneClass::SmoothWall, SceneClass::Foliage};
  const std::vector<float> before = {0.05F, 0.5F, 0.05F, 0.2F, 0.1F, 0.1F};
  std::vector<float> known = before, in_between = before, strange = before;
  doubtKinds(0.05, classes, known.data());
  doubtKinds(0.2, classes, in_between.data());
  doubtKinds(0.9, classes, strange.data());
  EXPECT_EQ(known, before);
  for (const std::vector<float>& after : {in_between, strange}) {
    EXPECT_NEAR(after[0] + after[1] + after[2], 0.6F, 1e-6F);
    EXPECT_NEAR(after[3] + after[4] + after[5], 0.4F, 1e-6F);
    EXPECT_GT(after[1], after[0]) << "the most probable class is unchanged";
  }
  EXPECT_GT(before[1], in_between[1]);
  EXPECT_GT(in_between[1], strange[1]);
  EXPECT_NEAR(strange[1], 0.35F, 1e-6F);
}

}  // namespace
}  // namespace scene_labeler
