// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/training/teaching.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "scene_labeler/labelling/labeler.hpp"
#include "scene_labeler/labelling/superpixels.hpp"
#include "support/yard.hpp"
#include "urban_nav_core/parallel/for_each.hpp"

namespace scene_labeler {
namespace {

/// Yard with level vehicle roofs, which no training yard has.
testing::Yard makeYardWithRoofs(unsigned seed) {
  testing::Yard yard = testing::makeYard(seed);
  std::mt19937 random(seed);
  const auto draw = [&random](float size) { return size * static_cast<float>(random() % 10000U) / 1e4F; };
  for (const float x : {-6.0F, -12.0F}) {
    for (int i = 0; i < 2000; ++i) yard.add({x + draw(4), draw(2), draw(0.04F)}, SceneClass::Paved);
    for (int i = 0; i < 1000; ++i) yard.add({x + draw(4), draw(2), 1.4F + draw(0.04F)}, SceneClass::Vehicle);
  }
  return yard;
}

double f1(const LabelModel& model, const testing::Yard& yard, SceneClass wanted) {
  const SceneLabels labels = labelScene(model, yard.scene, 12);
  double hits = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < yard.labels.size(); ++i) {
    sum += (labels.labels[i] == wanted ? 1.0 : 0.0) + (yard.labels[i] == wanted ? 1.0 : 0.0);
    hits += labels.labels[i] == wanted && yard.labels[i] == wanted ? 1.0 : 0.0;
  }
  return sum > 0.0 ? 2.0 * hits / sum : 1.0;
}

/// Corrects the wrong answers of the model in a yard, and trains again.
LabelModel teach(const LabelModel& model, const testing::Yard& yard) {
  std::vector<TrainingFold> folds = restoreFolds(model);
  addCorrections(model, yard.scene, yard.labels, 12, "corrections", folds);
  TrainingOptions options;
  options.kind = model.kind;
  options.features = model.features;
  options.samples_per_class = 300;
  options.base = &model;
  options.adds_trees = true;
  return trainModel(std::move(folds), options, [](double) {}).model;
}

TEST(Teaching, ImprovesTheCorrectedClassElsewhereAndKeepsTheOthers) {
  const LabelModel& model = testing::trainOnYards(ClassifierKind::Boosted);
  const testing::Yard held_out = makeYardWithRoofs(12), plain = testing::makeYard(5);
  ASSERT_EQ(f1(model, held_out, SceneClass::Vehicle), 0.0);
  const LabelModel taught = teach(model, makeYardWithRoofs(11));
  EXPECT_GT(f1(taught, held_out, SceneClass::Vehicle), 0.8);
  for (const SceneClass other : {SceneClass::Paved, SceneClass::Wall, SceneClass::Foliage})
    for (const testing::Yard* yard : {&held_out, &plain})
      EXPECT_GT(f1(taught, *yard, other), f1(model, *yard, other) - 0.03) << toString(other);
}

TEST(Teaching, GivesTheSameBytesForAnyNumberOfThreads) {
  const LabelModel& model = testing::trainOnYards(ClassifierKind::Boosted);
  const testing::Yard yard = makeYardWithRoofs(11);
  const auto bytes = [&](int threads) {
    const urban_nav_core::ThreadLimit limit(threads);
    return printModel(teach(model, yard));
  };
  EXPECT_EQ(bytes(1), bytes(2));
}

TEST(Teaching, IgnoresLabelsThatEqualTheResult) {
  const LabelModel& model = testing::trainOnYards(ClassifierKind::Boosted);
  const testing::Yard yard = testing::makeYard(5);
  std::vector<TrainingFold> folds;
  const CorrectionCount count =
      addCorrections(model, yard.scene, labelScene(model, yard.scene, 12).labels, 12, "corrections", folds);
  EXPECT_EQ(count.labelled, yard.labels.size());
  EXPECT_EQ(count.corrected, 0U);
  EXPECT_TRUE(folds.empty());
}

TEST(Teaching, GivesCorrectionsTenfoldWeight) {
  const LabelModel& model = testing::trainOnYards(ClassifierKind::Boosted);
  const testing::Yard yard = makeYardWithRoofs(11);
  std::vector<TrainingFold> folds;
  EXPECT_GE(addCorrections(model, yard.scene, yard.labels, 12, "corrections", folds).corrected, 2000U);
  ASSERT_EQ(folds.size(), 1U);
  EXPECT_TRUE(folds[0].held_out.labels.empty());
  for (const float weight : folds[0].samples.weights) EXPECT_EQ(weight, 10.0F);
  const LabelModel taught = teach(model, yard);
  EXPECT_GT(std::count(taught.samples.weights.begin(), taught.samples.weights.end(), 10), 0);
}

TEST(Teaching, UsesTheSuperpixelsAtCorrectedReturns) {
  const LabelModel& model = testing::trainOnYards(ClassifierKind::Boosted);
  const testing::Yard yard = makeYardWithRoofs(11), held_out = makeYardWithRoofs(12);
  const std::vector<std::uint32_t> patches = makePatches(yard.scene, {});
  std::vector<PatchCorrection> corrections;
  for (std::size_t i = 0; i < yard.labels.size() && corrections.size() < 20; i += 7)
    if (yard.labels[i] == SceneClass::Vehicle) corrections.push_back({i, SceneClass::Vehicle});
  TrainingFold fold;
  fold.name = "corrections";
  const std::size_t added = addPatchCorrections(model, yard.scene, corrections, 12, fold);
  std::size_t members = 0;
  for (const PatchCorrection& one : corrections)
    members += static_cast<std::size_t>(std::count(patches.begin(), patches.end(), patches[one.point]));
  EXPECT_EQ(added, members);
  EXPECT_GT(added, corrections.size());
  std::vector<TrainingFold> folds = restoreFolds(model);
  folds.push_back(fold);
  TrainingOptions options;
  options.samples_per_class = 300;
  options.base = &model;
  options.adds_trees = true;
  const LabelModel taught = trainModel(std::move(folds), options, [](double) {}).model;
  EXPECT_GT(f1(taught, held_out, SceneClass::Vehicle), 0.8);
}

TEST(Teaching, KeepsUncorrectedLabelsUnlessThePlaceIsNew) {
  const LabelModel& model = testing::trainOnYards(ClassifierKind::Boosted);
  const auto anchorsOf = [&](const testing::Yard& yard) {
    std::size_t lawn = 0;  // paved ground, far from the wall
    while (yard.scene.points[lawn].x() > 4.0F) ++lawn;
    TrainingFold fold;
    addPatchCorrections(model, yard.scene, {{lawn, SceneClass::Grass}}, 12, fold);
    std::vector<SceneClass> labels;
    for (std::size_t i = 0; i < fold.samples.labels.size(); ++i)
      if (fold.samples.weights[i] == kAnchorWeight) labels.push_back(fold.samples.labels[i]);
    return labels;
  };
  testing::Yard yard = testing::makeYard(14);
  const std::vector<SceneClass> anchors = anchorsOf(yard);
  EXPECT_LE(anchors.size(), 300U);
  EXPECT_GT(std::count(anchors.begin(), anchors.end(), SceneClass::Wall), 10);
  EXPECT_EQ(std::count(anchors.begin(), anchors.end(), SceneClass::Grass), 0);
  EXPECT_EQ(std::count(anchors.begin(), anchors.end(), SceneClass::Paved), 0) << "other ground may also be wrong";
  for (Eigen::Vector3f& point : yard.scene.points)  // terraces on a slope
    point = {2.0F * point.x(), 2.0F * point.y(), 4.0F * point.z() + 0.5F * std::floor(point.x()) + point.y()};
  EXPECT_TRUE(anchorsOf(yard).empty());
}

TEST(ModelSamples, AreBoundedAndRestoreTheFoldsOfTheTraining) {
  for (const ClassifierKind kind : {ClassifierKind::Forest, ClassifierKind::Boosted}) {
    const LabelModel& model = testing::trainOnYards(kind);
    EXPECT_LE(printModel(model).size(), 1'000'000U);
    const std::vector<TrainingFold> before = testing::yardFolds(FeatureSet::All), after = restoreFolds(model);
    ASSERT_EQ(after.size(), before.size());
    std::size_t held_out = 0;
    float frequency = 0.0F;
    for (std::size_t f = 0; f < after.size(); ++f) {
      EXPECT_EQ(after[f].name, before[f].name);
      EXPECT_EQ(after[f].samples.values.size(), after[f].samples.labels.size() * model.bins.columns());
      EXPECT_FALSE(after[f].samples.labels.empty());
      held_out += before[f].held_out.labels.size();
      for (const float weight : after[f].held_out.weights) frequency += weight;
    }
    EXPECT_NEAR(frequency, static_cast<float>(held_out), 0.01F * static_cast<float>(held_out));
  }
}

TEST(ModelSamples, AreMissingInModelsOfTheVersionBefore) {
  LabelModel model = testing::trainOnYards(ClassifierKind::Boosted);
  urban_nav_core::Archive archive;
  model.archive(archive);
  const LabelModel read = parseModel(urban_nav_core::seal("model of scene_labeler", 2, archive.take()), "m");
  EXPECT_TRUE(restoreFolds(read).empty());
  EXPECT_EQ(read.classes, model.classes);
}

}  // namespace
}  // namespace scene_labeler
