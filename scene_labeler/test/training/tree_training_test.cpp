// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/training/tree_training.hpp"

#include <gtest/gtest.h>

#include <random>

#include "urban_nav_core/parallel/for_each.hpp"

namespace scene_labeler {
namespace {

/// Class 1 where exactly one of two codes is above 32 (exclusive or); class 2 where the third code is missing.
CodedSamples makeExclusiveOr(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  CodedSamples samples;
  samples.features = 4;
  samples.classes = 3;
  for (std::size_t i = 0; i < count; ++i) {
    const auto code = [&random] { return static_cast<std::uint8_t>(1 + random() % 64U); };
    const std::uint8_t a = code(), b = code(), c = random() % 4U == 0 ? std::uint8_t{0} : code(), d = code();
    for (const std::uint8_t value : {a, b, c, d}) samples.codes.push_back(value);
    samples.labels.push_back(c == 0 ? 2 : (a > 32) != (b > 32) ? 1 : 0);
    samples.weights.push_back(1.0F);
  }
  return samples;
}

double shareRight(const TreeEnsemble& ensemble, const CodedSamples& samples) {
  double right = 0.0;
  std::vector<float> scores(samples.classes);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    ensemble.evaluate(samples.codes.data() + i * samples.features, scores.data());
    right += std::max_element(scores.begin(), scores.end()) - scores.begin() == samples.labels[i] ? 1.0 : 0.0;
  }
  return right / static_cast<double>(samples.size());
}

TreeSettings forestSettings() {
  TreeSettings settings;
  settings.leaves = 64;
  settings.regularisation = 1e-3;
  settings.least_weight = 3.0;
  settings.sample_share = 1.0;
  return settings;
}

TEST(TreeTraining, FitsExclusiveOrAndMissingValues) {
  const CodedSamples samples = makeExclusiveOr(4000, 1), others = makeExclusiveOr(4000, 2);
  EXPECT_GT(shareRight(trainBoosted(samples, {}, 1), others), 0.98);
  EXPECT_GT(shareRight(trainForest(samples, forestSettings(), 1), others), 0.98);
}

TEST(TreeTraining, VotesOfAForestAreSharesOfTheClasses) {
  const CodedSamples samples = makeExclusiveOr(2000, 3);
  const TreeEnsemble forest = trainForest(samples, forestSettings(), 1);
  std::vector<float> scores(3);
  for (std::size_t i = 0; i < 200; ++i) {
    forest.evaluate(samples.codes.data() + i * 4, scores.data());
    EXPECT_NEAR(scores[0] + scores[1] + scores[2], 1.0F, 1e-3F);
    for (const float score : scores) EXPECT_GT(score, -1e-3F);
  }
}

TEST(TreeTraining, DoesNotDependOnTheNumberOfThreads) {
  const CodedSamples samples = makeExclusiveOr(3000, 4);
  const auto bytes = [&samples](int threads) {
    const urban_nav_core::ThreadLimit limit(threads);
    urban_nav_core::Archive archive;
    TreeEnsemble boosted = trainBoosted(samples, {}, 7), forest = trainForest(samples, forestSettings(), 7);
    boosted.archive(archive, 4);
    forest.archive(archive, 4);
    return archive.take();
  };
  EXPECT_EQ(bytes(1), bytes(3));
}

TEST(TreeTraining, TreesRespectTheLimitOfLeaves) {
  TreeSettings settings;
  settings.leaves = 5;
  settings.trees = 10;
  for (const LabelTree& tree : trainBoosted(makeExclusiveOr(1000, 5), settings, 1).trees) {
    EXPECT_LE(tree.leaves.size(), 5u * 3u);
    EXPECT_EQ(tree.leaves.size(), (tree.nodes.size() + 1) * 3u);
  }
}

}  // namespace
}  // namespace scene_labeler
