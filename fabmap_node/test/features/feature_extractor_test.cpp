// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/features/feature_extractor.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

#include "support/block_images.hpp"

namespace fabmap_node {
namespace {

using testing::drawBlocks;
using testing::expectInside;
using testing::squaredLength;
using testing::viewOfBlocks;

TEST(FeatureExtractor, FindsFeaturesInsideTheImageUpToTheLimit) {
  const auto pixels = drawBlocks(1);
  const PlaceObservation observation = FeatureExtractor({120, 60}).extract({viewOfBlocks(pixels)});
  EXPECT_EQ(observation.cameras, 1);
  EXPECT_GT(observation.features.size(), 60u);
  EXPECT_LE(observation.features.size(), 120u);
  for (const PlaceFeature& feature : observation.features) {
    expectInside(feature);
    EXPECT_NEAR(squaredLength(feature), 512 * 512, 6000);
  }
}

TEST(FeatureExtractor, EqualImagesGiveEqualFeatures) {
  const auto pixels = drawBlocks(2);
  const FeatureExtractor extractor;
  const PlaceObservation a = extractor.extract({viewOfBlocks(pixels)}), b = extractor.extract({viewOfBlocks(pixels)});
  ASSERT_EQ(a.features.size(), b.features.size());
  for (std::size_t i = 0; i < a.features.size(); ++i) EXPECT_EQ(a.features[i].descriptor, b.features[i].descriptor);
}

TEST(FeatureExtractor, PanoramaIsOneObservationAndContinuesWithoutOneCamera) {
  const auto first = drawBlocks(3), second = drawBlocks(4);
  const PlaceObservation observation =
      FeatureExtractor({100, 50}).extract({viewOfBlocks(first), {}, viewOfBlocks(second)});
  EXPECT_EQ(observation.cameras, 3);
  std::array<int, 3> of_camera{};
  for (const PlaceFeature& feature : observation.features) ++of_camera.at(feature.camera);
  EXPECT_GT(of_camera[0], 20);
  EXPECT_EQ(of_camera[1], 0);
  EXPECT_GT(of_camera[2], 20);
}

TEST(FeatureExtractor, BlankAndTinyImagesHaveNoFeatures) {
  const std::vector<std::uint8_t> blank(testing::kBlocksWidth * testing::kBlocksHeight, 128);
  EXPECT_TRUE(FeatureExtractor().extract({viewOfBlocks(blank)}).features.empty());
  EXPECT_TRUE(FeatureExtractor().extract({{blank.data(), 8, 8, 8}}).features.empty());
  EXPECT_TRUE(FeatureExtractor().extract({urban_nav_core::ImageView{}}).features.empty());
}

}  // namespace
}  // namespace fabmap_node
