// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/model/label_model.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "scene_labeler/labelling/labeler.hpp"
#include "support/yard.hpp"
#include "urban_nav_core/io/archive_types.hpp"
#include "urban_nav_core/testing/fuzz.hpp"
#include "urban_nav_core/types/error.hpp"

namespace scene_labeler {
namespace {

using urban_nav_core::UserError;

class LabelModels : public ::testing::TestWithParam<ClassifierKind> {};

TEST_P(LabelModels, AreTheSameAfterReading) {
  const LabelModel model = testing::trainOnYards(GetParam());
  const std::string bytes = printModel(model);
  const LabelModel read = parseModel(bytes, "m");
  EXPECT_EQ(printModel(read), bytes);
  const FeatureTable table = measureFeatures(testing::makeYard(5).scene, model.features);
  std::vector<float> before(model.classes.size()), after(model.classes.size());
  for (std::size_t i = 0; i < table.rows(); i += 50) {
    model.logProbabilities(table.row(i), before.data());
    read.logProbabilities(table.row(i), after.data());
    EXPECT_EQ(before, after);
  }
}

TEST_P(LabelModels, ThatAreDamagedAreRefusedOrCanBeUsed) {
  LabelModel model = testing::trainOnYards(GetParam());
  model.samples.codes.resize(3 * model.bins.columns());
  model.samples.labels.resize(3);
  model.samples.weights.resize(3);
  model.samples.places.resize(3);
  model.trees.trees.resize(std::min<std::size_t>(model.trees.trees.size(), 3));
  for (KernelMachine& machine : model.svm.machines) {
    machine.weights.resize(std::min<std::size_t>(machine.weights.size(), 4));
    machine.vectors.resize(machine.weights.size() * model.bins.columns());
  }
  const std::string sealed = printModel(model);
  const std::string content(urban_nav_core::unseal("model of scene_labeler", 4, sealed));
  const std::vector<float> row(model.bins.columns(), 0.3F);
  const auto result = urban_nav_core::testing::fuzzText({content}, [&row](const std::string& text) {
    const LabelModel read = parseModel(urban_nav_core::seal("model of scene_labeler", 4, text), "m");
    if (read.bins.columns() != row.size()) return;
    std::vector<float> logs(read.classes.size());
    read.logProbabilities(row.data(), logs.data());
  });
  EXPECT_EQ(result.failure, "");
  EXPECT_GT(result.accepted, 0);
  EXPECT_GT(result.refused, 0);
}

INSTANTIATE_TEST_SUITE_P(Kinds, LabelModels,
                         ::testing::Values(ClassifierKind::Svm, ClassifierKind::Forest, ClassifierKind::Boosted));

TEST(LabelModelReader, RefusesOtherFilesByName) {
  const std::string bytes = printModel(testing::trainOnYards(ClassifierKind::Boosted));
  for (const std::string& text : {std::string(), std::string("ply\n"), bytes.substr(0, 200), bytes + "x"}) try {
      parseModel(text, "street.labels");
      FAIL() << text.size();
    } catch (const UserError& error) {
      EXPECT_EQ(error.parts().where, "street.labels");
    }
}

TEST(LabelModel, OfVersion3HasNoThresholdsAndKeepsTheFixedOnes) {
  const LabelModel model = testing::trainOnYards(ClassifierKind::Boosted);
  ASSERT_FALSE(model.sure.empty());
  urban_nav_core::Archive archive;
  LabelModel copy = model;
  copy.archive(archive);
  copy.samples.archive(archive, copy.bins.columns(), copy.classes.size());
  const LabelModel read = parseModel(urban_nav_core::seal("model of scene_labeler", 3, archive.take()), "m");
  EXPECT_TRUE(read.sure.empty());
  LabelModel strict = read;
  strict.precision = 0.999;
  const Scene scene = testing::makeYard(5).scene;
  const SceneLabels labels = labelScene(read, scene, 12);
  EXPECT_EQ(labels.probabilities, labelScene(model, scene, 12).probabilities);
  EXPECT_EQ(labels.unsure, labelScene(strict, scene, 12).unsure) << "no effect of the precision";
  for (std::size_t i = 0; i < labels.unsure.size(); ++i)
    ASSERT_TRUE(labels.unsure[i] != 0 || labels.probability(i) >= 0.5F);
}

TEST(LabelModel, OfANewerVersionIsRefusedByName) {
  const std::string sealed = printModel(testing::trainOnYards(ClassifierKind::Boosted));
  const std::string content(urban_nav_core::unseal("model of scene_labeler", 4, sealed));
  try {
    parseModel(urban_nav_core::seal("model of scene_labeler", 5, content), "tomorrow.labels");
    FAIL() << "a model of a newer version";
  } catch (const urban_nav_core::UserError& error) {
    EXPECT_NE(std::string(error.what()).find("tomorrow.labels"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace scene_labeler
