// SPDX-License-Identifier: BSD-3-Clause
#include "topics/places/place_pair.hpp"

#include <gtest/gtest.h>

#include "fabmap_node/model/place_model.hpp"
#include "fabmap_node/store/place_rows.hpp"
#include "support/place_images.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/testing/folders.hpp"
#include "urban_nav_ros/image.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/stored_model.hpp"

namespace urban_nav {
namespace {

using urban_nav_core::StampNs;
using urban_nav_store::StoredModel;
using urban_nav_store::StoredPlace;
using urban_nav_store::TableStore;

constexpr StampNs kPairSecond = 1'000'000'000;

/// A store with images of one camera: scenes 1, 2 and 3 on monday, 10 s apart, and scene 2 on tuesday.
class PlacePairTest : public ::testing::Test {
 protected:
  PlacePairTest() {
    add("monday", 1, 100);
    add("monday", 2, 110);
    add("monday", 3, 120);
    add("tuesday", 2, 5000);
    addDark("tuesday", 5010);
  }

  PlacePair pairAt(const std::string& one, const std::string& other) {
    return explainPlaces(store_, parseTimeQuery(one, "T1"), parseTimeQuery(other, "T2"), fabmap_node::Parameters());
  }

  urban_nav_store::Store& store() { return store_; }

 private:
  void add(const std::string& session, unsigned scene, StampNs seconds) {
    put(session, testing::sceneImage(scene, session == "monday" ? 0 : 2), seconds);
  }
  void addDark(const std::string& session, StampNs seconds) {
    put(session, cv::Mat(384, 512, CV_8UC1, cv::Scalar(2)), seconds);
  }
  void put(const std::string& session, const cv::Mat& image, StampNs seconds) {
    store_.sessions().put({session, session, "", "", (session == "monday" ? 100 : 5000) * kPairSecond, true});
    const std::string bytes(fabmap_node::defaultModelBytes());
    const std::string hash = fabmap_node::modelHash(bytes);
    TableStore<StoredModel>(store_).put({session, hash, "fabmap_node", bytes});
    const auto description = fabmap_node::PlaceDescriber(model_, {}, 540).describe({urban_nav_ros::toView(image)});
    StoredPlace row = fabmap_node::toStoredPlace(session, seconds * kPairSecond, description, hash);
    row.thumbnail = fabmap_node::placeThumbnail({urban_nav_ros::toView(image)});
    TableStore<StoredPlace>(store_).put(row);
  }

  const urban_nav_input::testing::TemporaryFolder folder_;
  urban_nav_store::Store store_{folder_.file("s.db"), urban_nav_store::Access::Write};
  const fabmap_node::PlaceModel model_ = fabmap_node::defaultModel();
};

TEST_F(PlacePairTest, TheSameSceneOfAnotherDayAgrees) {
  const PlacePair same = pairAt("5000", "110"), other = pairAt("100", "5000");
  EXPECT_EQ(same.earlier.name, "monday") << "the order of times does not matter";
  EXPECT_EQ(same.query.name, "tuesday");
  ASSERT_TRUE(same.comparison);
  ASSERT_TRUE(other.comparison);
  EXPECT_TRUE(same.comparison->is_first);
  EXPECT_EQ(same.comparison->rank_by_words, 1u);
  EXPECT_EQ(same.comparison->candidates, 3u);
  EXPECT_GT(same.shared_words, other.shared_words);
  EXPECT_LE(same.shared_words, std::min(same.earlier.words, same.query.words));
  EXPECT_GT(same.comparison->look.agreeing, 2 * other.comparison->look.agreeing);
  EXPECT_GT(same.probability, other.probability);
  EXPECT_NE(other.reason.find("another place is more similar"), std::string::npos) << other.reason;
}

TEST_F(PlacePairTest, NamesWhatRulesAPairOut) {
  EXPECT_NE(pairAt("monday+0", "monday+10").reason.find("too close in time"), std::string::npos);
  const PlacePair dark = pairAt("monday+0", "tuesday+10");
  EXPECT_NE(dark.reason.find("dark"), std::string::npos) << dark.reason;
  EXPECT_FALSE(dark.comparison);
}

TEST_F(PlacePairTest, TextPageAndJsonStateTheEvidence) {
  const PlacePair pair = pairAt("monday+0", "tuesday+0");
  const std::string text = explain(pair);
  for (const char* part : {"shared", "log likelihood at a new place", "descriptors", "proposed above 0.05"})
    EXPECT_NE(text.find(part), std::string::npos) << part;
  EXPECT_EQ(explainOnPage(pair, "s.db").sections.at(0).pictures.size(), 1u);
  EXPECT_NE(explainAsJson(pair).print().find("\"words_shared\": " + std::to_string(pair.shared_words)),
            std::string::npos);
}

TEST_F(PlacePairTest, TimesWithoutAPlaceAreRefused) {
  EXPECT_THROW(pairAt("monday+0", "tuesday+90"), urban_nav_core::DataError);
  EXPECT_THROW(pairAt("monday+0", "monday+0.4"), urban_nav_core::DataError);
  const urban_nav_input::testing::TemporaryFolder folder;
  urban_nav_store::Store empty(folder.file("empty.db"), urban_nav_store::Access::Write);
  EXPECT_THROW(explainPlaces(empty, parseTimeQuery("1", "T1"), parseTimeQuery("2", "T2"), fabmap_node::Parameters()),
               urban_nav_core::DataError);
}

}  // namespace
}  // namespace urban_nav
