// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/retrieval/keyframe_places.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <optional>

#include "fabmap_node/model/place_model.hpp"
#include "fabmap_node/recognition/place_describer.hpp"
#include "fabmap_node/store/place_rows.hpp"
#include "urban_nav_core/testing/motion.hpp"
#include "urban_nav_core/testing/textured_street.hpp"
#include "urban_nav_registration/io/jpeg.hpp"
#include "urban_nav_registration/session/stored_keyframe.hpp"
#include "urban_nav_registration/testing/photographer.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/stored_keyframe_place.hpp"
#include "urban_nav_store/tables/stored_model.hpp"

namespace fabmap_node {
namespace {

using urban_nav_core::testing::lookingAlong;
using urban_nav_registration::Keyframe;
using urban_nav_registration::SearchedKeyframe;
using urban_nav_store::Access;
using urban_nav_store::Store;
using urban_nav_store::StoredKeyframePlace;
using urban_nav_store::StoredPlace;
using urban_nav_store::TableStore;

constexpr int kKeyframeCount = 12;
constexpr double kSpacing = 4.0;  // m

urban_nav_core::Pose placeOf(int i, double beside) { return lookingAlong({4.0 + kSpacing * i, beside, 1.2}, 0.0); }

urban_nav_registration::testing::Photographer& street() {
  static urban_nav_registration::testing::Photographer photographer(urban_nav_core::testing::texturedStreet());
  return photographer;
}

/// Keyframes along the street, rendered once.
const std::vector<Keyframe>& streetKeyframes() {
  static const std::vector<Keyframe> made = [] {
    std::vector<Keyframe> keyframes;
    for (int i = 0; i < kKeyframeCount; ++i) keyframes.push_back(street().keyframe(placeOf(i, 0.0)));
    return keyframes;
  }();
  return made;
}

/// The other day: slightly offset, with different illumination.
Keyframe visit(std::size_t i) {
  return street().keyframe(lookingAlong({3.3 + kSpacing * static_cast<double>(i), 0.4, 1.2}, 0.1), 0.8);
}

/// A street with keyframes, one of which has no image.
class KeyframePlacesTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = (std::filesystem::temp_directory_path() / "keyframe_places_XXXXXX").string();
    ASSERT_NE(mkdtemp(folder_.data()), nullptr);
    store_.emplace(folder_ + "/map.db", Access::Write);
    store_->sessions().put(urban_nav_store::Session{id_, "day", "", "", 0, true});
    for (int i = 0; i < kKeyframeCount; ++i) {
      Keyframe keyframe = streetKeyframes()[static_cast<std::size_t>(i)];
      if (i == kWithoutImage) keyframe.image.clear();
      keyframe.at = {id_, i + 1};
      keyframes_.push_back(keyframe);
      searched_.push_back({keyframe.at, nullptr});
      store_->keyframes().put(id_, urban_nav_registration::kKeyframeCamera,
                              urban_nav_registration::toStoredKeyframe(keyframe));
    }
    store_->commit();
  }
  void TearDown() override {
    store_.reset();
    std::filesystem::remove_all(folder_);
  }

  /// Stores the words of all keyframes, by the built-in model.
  template <typename Row>
  void storeWords(const std::string& model_hash) {
    const PlaceModel model = defaultModel();
    const PlaceDescriber describer(model, {}, kKeyframeLookFeatures);
    for (const Keyframe& keyframe : keyframes_) {
      const cv::Mat pixels = urban_nav_registration::decodeJpeg(keyframe.image, {keyframe.width, keyframe.height});
      const urban_nav_core::ImageView view{pixels.data, pixels.cols, pixels.rows,
                                           static_cast<std::ptrdiff_t>(pixels.step)};
      Row row;
      static_cast<StoredPlace&>(row) = toStoredPlace(id_, keyframe.at.stamp, describer.describe({view}), model_hash);
      TableStore<Row>(*store_).put(row);
    }
    TableStore<urban_nav_store::StoredModel>(*store_).put(
        {id_, modelHash(defaultModelBytes()), "fabmap_node", std::string(defaultModelBytes())});
    store_->commit();
  }
  void open(KeyframePlaces& places) {
    places.open(*store_, searched_);
    EXPECT_EQ(places.read(), 0u);
    while (places.readNext()) {
    }
    EXPECT_EQ(places.read(), searched_.size());
  }
  void expectFound(const KeyframePlaces& places) {
    for (const std::size_t wanted : {1u, 4u, 9u}) {
      const auto found = places.find(visit(wanted), 3);
      ASSERT_EQ(found.size(), 3u);
      EXPECT_EQ(found.front(), wanted);
    }
  }

  static constexpr int kWithoutImage = 6;
  const std::string id_ = "0123456789abcdef0123";
  std::string folder_;
  std::optional<Store> store_;
  std::vector<Keyframe> keyframes_;
  std::vector<SearchedKeyframe> searched_;
};

TEST_F(KeyframePlacesTest, FindsTheKeyframeThatWasTakenNearbyByItsImage) {
  KeyframePlaces places;
  open(places);
  EXPECT_EQ(places.described(), static_cast<std::size_t>(kKeyframeCount));
  expectFound(places);
}

TEST_F(KeyframePlacesTest, FindsTheSameByStoredWords) {
  KeyframePlaces by_images;
  open(by_images);
  storeWords<StoredKeyframePlace>(modelHash(defaultModelBytes()));
  KeyframePlaces by_words;
  open(by_words);
  EXPECT_EQ(by_words.described(), 0u);
  for (const std::size_t i : {0u, 3u, 7u, 11u}) {
    const Keyframe query = visit(i);
    EXPECT_EQ(by_words.find(query, 5), by_images.find(query, 5)) << i;
  }
}

TEST_F(KeyframePlacesTest, TakesPlacesOfASingleCamera) {
  storeWords<StoredPlace>(modelHash(defaultModelBytes()));
  KeyframePlaces places;
  open(places);
  EXPECT_EQ(places.described(), 0u);
  expectFound(places);
}

TEST_F(KeyframePlacesTest, DescribesKeyframesOfAnotherModelOrCamera) {
  storeWords<StoredKeyframePlace>("another model");
  KeyframePlaces of_another_model;
  open(of_another_model);
  EXPECT_EQ(of_another_model.described(), static_cast<std::size_t>(kKeyframeCount));
  expectFound(of_another_model);

  storeWords<StoredKeyframePlace>(modelHash(defaultModelBytes()));
  const urban_nav_registration::MountedCamera camera{street().camera(), {}};
  searched_[4].conversion = std::make_shared<urban_nav_registration::KeyframeConversion>(camera, camera);
  KeyframePlaces of_another_camera;
  open(of_another_camera);
  EXPECT_EQ(of_another_camera.described(), 1u);
  expectFound(of_another_camera);
}

TEST_F(KeyframePlacesTest, ReturnsNothingForAnInvalidImage) {
  EXPECT_TRUE(KeyframePlaces().find(visit(1), 3).empty()) << "not open";
  KeyframePlaces places;
  places.open(*store_, searched_);
  EXPECT_TRUE(places.find(visit(1), 3).empty()) << "nothing read yet";
  while (places.readNext()) {
  }
  EXPECT_TRUE(places.find(Keyframe(), 3).empty());
  const auto all = places.find(visit(kWithoutImage), 100);
  EXPECT_EQ(std::count(all.begin(), all.end(), static_cast<std::size_t>(kWithoutImage)), 0) << "it cannot be found";
}

}  // namespace
}  // namespace fabmap_node
