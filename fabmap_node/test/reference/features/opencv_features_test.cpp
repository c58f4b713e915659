// SPDX-License-Identifier: BSD-3-Clause
#include "reference/features/opencv_features.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>

#include "fabmap_node/features/feature_extractor.hpp"
#include "fabmap_node/vocabulary/k_means.hpp"
#include "fabmap_node/vocabulary/vocabulary.hpp"
#include "support/block_images.hpp"

namespace fabmap_node {
namespace {

using testing::drawBlocks;
using testing::viewOfBlocks;

constexpr int kWanted = 120;

PlaceObservation observeBlocks(OpenCvFeature feature, unsigned seed, int shift = 0) {
  return openCvObservation(feature, viewOfBlocks(drawBlocks(seed, shift)), kWanted);
}

class OpenCvFeatures : public ::testing::TestWithParam<OpenCvFeature> {};

TEST_P(OpenCvFeatures, AreItsOwnAndAtMostTheNumberWanted) {
  const PlaceObservation observation = observeBlocks(GetParam(), 5), again = observeBlocks(GetParam(), 5);
  const ByteDescriptor upright =
      FeatureExtractor({kWanted, kWanted}).extract({viewOfBlocks(drawBlocks(5))}).features.front().descriptor;
  EXPECT_EQ(observation.cameras, 1);
  EXPECT_GT(observation.features.size(), 40u);
  EXPECT_LE(observation.features.size(), 120u);
  ASSERT_EQ(observation.features.size(), again.features.size());
  for (std::size_t i = 0; i < observation.features.size(); ++i) {
    const PlaceFeature& feature = observation.features[i];
    EXPECT_NE(feature.descriptor, upright);
    EXPECT_EQ(feature.descriptor, again.features[i].descriptor);
    testing::expectInside(feature);
    EXPECT_GT(testing::squaredLength(feature), 200 * 200);
  }
}

TEST_P(OpenCvFeatures, BlankAndAbsentImagesHaveNone) {
  const std::vector<std::uint8_t> blank(testing::kBlocksWidth * testing::kBlocksHeight, 128);
  EXPECT_TRUE(openCvObservation(GetParam(), viewOfBlocks(blank), kWanted).features.empty());
  EXPECT_TRUE(openCvObservation(GetParam(), urban_nav_core::ImageView{}, kWanted).features.empty());
}

TEST_P(OpenCvFeatures, WordsOfTheSameSceneAreSharedMost) {
  constexpr unsigned kScenes = 6;
  std::vector<ByteDescriptor> descriptors;
  for (unsigned scene = 0; scene < 4 * kScenes; ++scene)
    for (const PlaceFeature& feature : observeBlocks(GetParam(), scene).features)
      descriptors.push_back(feature.descriptor);
  KMeansOptions options;
  options.words = 400;
  const Vocabulary vocabulary = trainVocabulary(std::move(descriptors), options);
  for (unsigned scene = 0; scene < kScenes; ++scene) {
    const WordSet revisit = vocabulary.words(observeBlocks(GetParam(), scene, 2));
    std::vector<std::size_t> shared;
    for (unsigned other = 0; other < kScenes; ++other) {
      const WordSet words = vocabulary.words(observeBlocks(GetParam(), other));
      WordSet both;
      std::set_intersection(revisit.begin(), revisit.end(), words.begin(), words.end(), std::back_inserter(both));
      shared.push_back(both.size());
    }
    EXPECT_EQ(std::max_element(shared.begin(), shared.end()) - shared.begin(), scene);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, OpenCvFeatures, ::testing::Values(OpenCvFeature::Sift, OpenCvFeature::Orb),
                         [](const auto& kind) {
                           return std::string(kOpenCvFeatureNames[static_cast<std::size_t>(kind.param)]);
                         });

}  // namespace
}  // namespace fabmap_node
