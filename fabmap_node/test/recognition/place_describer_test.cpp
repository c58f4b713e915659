// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/recognition/place_describer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "fabmap_node/model/place_model.hpp"
#include "fabmap_node/model/word_bytes.hpp"
#include "fabmap_node/recognition/compact_look.hpp"
#include "fabmap_node/store/place_rows.hpp"
#include "support/synthetic_places.hpp"
#include "urban_nav_core/testing/fuzz.hpp"
#include "urban_nav_core/types/error.hpp"

namespace fabmap_node {
namespace {

using testing::syntheticPlace;
using urban_nav_core::ImageView;

constexpr int kSide = 200;

/// Squares of random brightness, which have corners.
std::vector<std::uint8_t> squares(unsigned seed) {
  std::mt19937 random(seed);
  std::vector<std::uint8_t> pixels(static_cast<std::size_t>(kSide * kSide));
  std::vector<std::uint8_t> level(400);
  for (std::uint8_t& value : level) value = static_cast<std::uint8_t>(random() % 256);
  for (int v = 0; v < kSide; ++v)
    for (int u = 0; u < kSide; ++u)
      pixels[static_cast<std::size_t>(v * kSide + u)] = level[static_cast<std::size_t>(v / 10 * 20 + u / 10)];
  return pixels;
}

ImageView viewOfPixels(const std::vector<std::uint8_t>& pixels) { return {pixels.data(), kSide, kSide, kSide}; }

const PlaceModel& suiteModel() {
  static const PlaceModel model = defaultModel();
  return model;
}

PlaceDescription describePixels(const std::vector<std::uint8_t>& pixels) {
  return PlaceDescriber(suiteModel(), {}, 280).describe({viewOfPixels(pixels)});
}

TEST(PlaceDescriber, StatesWhyAnImageIsNotUsed) {
  EXPECT_EQ(describePixels(squares(1)).status, ObservationStatus::Used);
  EXPECT_EQ(describePixels(std::vector<std::uint8_t>(kSide * kSide, 3)).status, ObservationStatus::Dark);
  EXPECT_EQ(describePixels(std::vector<std::uint8_t>(kSide * kSide, 200)).status, ObservationStatus::Blank);
  std::vector<std::uint8_t> ramp(static_cast<std::size_t>(kSide * kSide));
  for (std::size_t i = 0; i < ramp.size(); ++i) ramp[i] = static_cast<std::uint8_t>(i % kSide);
  EXPECT_EQ(describePixels(ramp).status, ObservationStatus::Blurred);
  EXPECT_EQ(PlaceDescriber(suiteModel(), {}, 280).describe({ImageView(), ImageView()}).status,
            ObservationStatus::NoImage);
}

TEST(PlaceDescriber, ContinuesWithoutOneOfFiveCameras) {
  const std::vector<std::uint8_t> pixels = squares(2);
  const ImageView image = viewOfPixels(pixels);
  const auto description = PlaceDescriber(suiteModel(), {}, 280).describe({image, image, ImageView(), image, image});
  EXPECT_EQ(description.status, ObservationStatus::Used);
  EXPECT_EQ(description.cameras, 5);
  EXPECT_EQ(description.missing, 1);
}

TEST(CompactLook, KeepsLevelsAndDirectionsOfPanoramas) {
  ComparedFeatures features = selectFeatures(syntheticPlace(3, 0, 5), 1000);
  const ComparedFeatures read = unpackLook(packLook(features), "look");
  // Features of one level of elevation are read by azimuth.
  for (PanoramaFeature& feature : features.panorama)
    feature.direction.y() = std::round(feature.direction.y() * 255.0F) / 255.0F;
  sortByElevation(features.panorama);
  ASSERT_EQ(read.size(), features.size());
  EXPECT_EQ(read.cameras, 5);
  for (std::size_t k = 0; k < features.size(); ++k) {
    EXPECT_EQ(features.panorama[k].middle, read.panorama[k].middle);
    EXPECT_EQ(features.panorama[k].top, read.panorama[k].top);
    const Eigen::Vector2f off = features.panorama[k].direction - read.panorama[k].direction;
    EXPECT_NEAR(off.x(), 0.0F, 5e-5F);
    EXPECT_NEAR(off.y(), 0.0F, 1e-6F);
  }
  EXPECT_EQ(packLook(read), packLook(unpackLook(packLook(read), "look"))) << "reading and writing are inverse";
  EXPECT_GT(secondLook(features, read).whole, 0.9);
}

TEST(CompactLook, KeepsTheResolutionOfSingleImages) {
  const ComparedFeatures features = selectFeatures(syntheticPlace(3, 0), 1000);
  const std::string bytes = packLook(features);
  const ComparedFeatures read = unpackLook(bytes, "look");
  ASSERT_EQ(read.size(), features.size());
  for (std::size_t k = 0; k < features.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    EXPECT_GT(features.descriptors.col(column).dot(read.descriptors.col(column)), 0.99F);
    EXPECT_NEAR((features.directions[k] - read.directions[k]).norm(), 0.0F, 2e-5F);
  }
  EXPECT_EQ(packLook(read), bytes) << "reading and writing are inverse";
}

/// Encoding of panoramas by earlier versions: elements of 4 bits of the unit vector, 40 levels per unit, and directions
/// with 16 bits per coordinate.
std::string packAsBefore(const PlaceObservation& observation) {
  std::string bytes;
  const auto put = [&bytes](unsigned value, int size) {
    for (int i = 0; i < size; ++i) bytes.push_back(static_cast<char>(value >> (8 * i) & 255u));
  };
  put(observation.cameras, 1);
  put(static_cast<unsigned>(observation.features.size()), 2);
  for (const PlaceFeature& feature : observation.features) {
    std::vector<double> elements;
    double squares = 0.0;
    for (std::size_t i = 0; i < kDescriptorBytes; i += 2) {
      elements.push_back(feature.descriptor[i] + feature.descriptor[i + 1]);
      squares += elements.back() * elements.back();
    }
    const auto level = [&](std::size_t i) {
      return static_cast<unsigned>(std::min(15L, std::lround(40.0 * elements[i] / std::sqrt(squares))));
    };
    for (std::size_t i = 0; i < elements.size(); i += 2) put(level(i) | level(i + 1) << 4, 1);
    put(feature.camera, 1);
    put(static_cast<unsigned>(std::lround(65535.0F * std::min(1.0F, feature.u))), 2);
    put(static_cast<unsigned>(std::lround(65535.0F * feature.v)), 2);
  }
  return bytes;
}

TEST(CompactLook, ReadsPanoramasOfEarlierVersions) {
  for (const std::uint8_t cameras : {std::uint8_t{1}, std::uint8_t{5}}) {
    const ComparedFeatures old = unpackLook(packAsBefore(syntheticPlace(3, 0, cameras)), "look");
    EXPECT_EQ(old.cameras, cameras);
    EXPECT_EQ(old.size(), 60u);
    EXPECT_GT(secondLook(old, selectFeatures(syntheticPlace(3, 1, cameras), 1000)).share, 0.3);
    EXPECT_LT(secondLook(old, selectFeatures(syntheticPlace(2, 1, cameras), 1000)).share, 0.15);
  }
}

TEST(CompactLook, RefusesDamagedBytes) {
  for (const std::string& bytes :
       {packLook(selectFeatures(syntheticPlace(3, 0), 10)), packLook(selectFeatures(syntheticPlace(3, 0, 5), 10)),
        packAsBefore(syntheticPlace(3, 0, 5))}) {
    for (const std::size_t size : {std::size_t{0}, std::size_t{2}, std::size_t{3}, std::size_t{4}, bytes.size() - 1})
      EXPECT_THROW(unpackLook(bytes.substr(0, size), "look"), urban_nav_core::DataError) << size;
    EXPECT_THROW(unpackLook(bytes + "x", "look"), urban_nav_core::DataError);
  }
  std::string later = packLook(selectFeatures(syntheticPlace(3, 0, 5), 10));
  later[1] = 3;
  EXPECT_THROW(unpackLook(later, "look"), urban_nav_core::DataError);
}

TEST(WordBytes, ReadBackAndRefuseDamage) {
  for (const WordSet& words : {WordSet{}, WordSet{0}, WordSet{0, 1, 127, 128, 5000}, WordSet{7, 3999}}) {
    EXPECT_EQ(unpackWords(packWords(words), 5001), words);
    if (words.empty()) continue;
    EXPECT_FALSE(unpackWords(packWords(words), words.back()));
  }
  EXPECT_FALSE(unpackWords({5, 0}, 100)) << "a word twice";
  EXPECT_FALSE(unpackWords({255}, 1000000)) << "ends too early";
}

TEST(PlaceRows, ReadBackAndRefuseDamage) {
  PlaceDescription description = describePixels(squares(4));
  description.missing = 1;
  const urban_nav_store::StoredPlace row = toStoredPlace("session", 17, description, "hash");
  EXPECT_LE(row.descriptors.size(), 20000u);
  const std::size_t words = suiteModel().vocabulary.size();
  const PlaceDescription read = toPlaceDescription(row, words);
  EXPECT_EQ(read.words, description.words);
  EXPECT_EQ(read.look, description.look);
  EXPECT_EQ(read.missing, 1);
  EXPECT_EQ(read.status, ObservationStatus::Used);
  const auto refuses = [&](const std::function<void(urban_nav_store::StoredPlace&)>& damage) {
    urban_nav_store::StoredPlace damaged = row;
    damage(damaged);
    EXPECT_THROW(toPlaceDescription(damaged, words), urban_nav_core::DataError);
  };
  refuses([](auto& place) { place.status = "seen"; });
  refuses([](auto& place) { place.cameras = 0; });
  refuses([](auto& place) { place.missing = 2; });
  refuses([](auto& place) { place.words += "\xff"; });
  refuses([](auto& place) { place.descriptors.pop_back(); });
  EXPECT_THROW(toPlaceDescription(row, 10), urban_nav_core::DataError) << "words of a larger vocabulary";
}

// Damaged input that is accepted must be compared without errors.
TEST(PlaceRows, Fuzzed) {
  const PlaceDescription description = describePixels(squares(4));
  const urban_nav_store::StoredPlace row = toStoredPlace("session", 17, description, "hash");
  const ComparedFeatures own = unpackLook(description.look, "query");
  const auto fuzz = [&](const std::string& seed, std::string urban_nav_store::StoredPlace::*column) {
    return urban_nav_core::testing::fuzzText({seed}, [&](const std::string& text) {
      urban_nav_store::StoredPlace damaged = row;
      damaged.*column = text;
      try {
        const PlaceDescription read = toPlaceDescription(damaged, suiteModel().vocabulary.size());
        ASSERT_TRUE(std::is_sorted(read.words.begin(), read.words.end()));
        const double share = secondLook(own, unpackLook(read.look, "place")).share;
        ASSERT_TRUE(share >= 0.0 && share <= 1.0) << share;
      } catch (const urban_nav_core::DataError& error) {
        throw urban_nav_core::UserError(error.parts());
      }
    });
  };
  for (const auto& result :
       {fuzz(row.words, &urban_nav_store::StoredPlace::words),
        fuzz(row.descriptors, &urban_nav_store::StoredPlace::descriptors),
        fuzz(packLook(selectFeatures(syntheticPlace(3, 0, 5), 20)), &urban_nav_store::StoredPlace::descriptors),
        fuzz(packAsBefore(syntheticPlace(3, 0, 5)), &urban_nav_store::StoredPlace::descriptors)}) {
    EXPECT_EQ(result.failure, "");
    EXPECT_GT(result.accepted, 0);
    EXPECT_GT(result.refused, 0);
  }
}

TEST(PlaceRows, ThumbnailIsSmall) {
  const std::vector<std::uint8_t> pixels = squares(5);
  const std::string jpeg = placeThumbnail(std::vector<ImageView>(5, viewOfPixels(pixels)));
  EXPECT_FALSE(jpeg.empty());
  EXPECT_LE(jpeg.size(), 6000u);
  EXPECT_TRUE(placeThumbnail({ImageView()}).empty());
}

}  // namespace
}  // namespace fabmap_node
