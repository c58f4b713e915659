// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/features/feature_extractor.hpp"

#include <gtest/gtest.h>

#include <random>

namespace fabmap_node {
namespace {

constexpr int blocks_width = 240, blocks_height = 180;

std::vector<std::uint8_t> drawBlocks(unsigned seed) {
  std::mt19937 random(seed);
  std::vector<std::uint8_t> pixels(blocks_width * blocks_height, 90);
  for (int k = 0; k < 120; ++k) {
    const int u = static_cast<int>(random() % (blocks_width - 20)),
              v = static_cast<int>(random() % (blocks_height - 20));
    const int w = 4 + static_cast<int>(random() % 14), h = 4 + static_cast<int>(random() % 14);
    const auto grey = static_cast<std::uint8_t>(random() % 256);
    for (int j = v; j < v + h; ++j)
      for (int i = u; i < u + w; ++i) pixels[static_cast<std::size_t>(j * blocks_width + i)] = grey;
  }
  return pixels;
}

urban_nav_core::ImageView viewOfBlocks(const std::vector<std::uint8_t>& pixels) {
  return {pixels.data(), blocks_width, blocks_height, blocks_width};
}

void expectInside(const PlaceFeature& feature) {
  EXPECT_GE(feature.u, 0.0F);
  EXPECT_LE(feature.u, 1.0F);
  EXPECT_GE(feature.v, 0.0F);
  EXPECT_LE(feature.v, 1.0F);
}

int squaredLength(const PlaceFeature& feature) {
  int squares = 0;
  for (const std::uint8_t x : feature.descriptor) squares += x * x;
  return squares;
}

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

TEST(FeatureExtractor, OpenCvFindsItsOwnFeaturesUpToTheLimit) {
  const auto pixels = drawBlocks(5);
  const ByteDescriptor upright =
      FeatureExtractor({120, 60}).extract({viewOfBlocks(pixels)}).features.front().descriptor;
  for (const FeatureKind kind : {FeatureKind::Sift, FeatureKind::Orb}) {
    const FeatureExtractor extractor({120, 60, kind});
    const PlaceObservation observation = extractor.extract({viewOfBlocks(pixels)});
    EXPECT_GT(observation.features.size(), 40u);
    EXPECT_LE(observation.features.size(), 120u);
    const PlaceObservation again = extractor.extract({viewOfBlocks(pixels)});
    ASSERT_EQ(observation.features.size(), again.features.size());
    for (std::size_t i = 0; i < observation.features.size(); ++i) {
      const PlaceFeature& feature = observation.features[i];
      EXPECT_NE(feature.descriptor, upright);
      EXPECT_EQ(feature.descriptor, again.features[i].descriptor);
      expectInside(feature);
      EXPECT_GT(squaredLength(feature), 200 * 200);
    }
    const std::vector<std::uint8_t> blank(blocks_width * blocks_height, 128);
    EXPECT_TRUE(extractor.extract({viewOfBlocks(blank)}).features.empty());
    EXPECT_TRUE(extractor.extract({urban_nav_core::ImageView{}}).features.empty());
  }
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
  const std::vector<std::uint8_t> blank(blocks_width * blocks_height, 128);
  EXPECT_TRUE(FeatureExtractor().extract({viewOfBlocks(blank)}).features.empty());
  EXPECT_TRUE(FeatureExtractor().extract({{blank.data(), 8, 8, 8}}).features.empty());
  EXPECT_TRUE(FeatureExtractor().extract({urban_nav_core::ImageView{}}).features.empty());
}

}  // namespace
}  // namespace fabmap_node
