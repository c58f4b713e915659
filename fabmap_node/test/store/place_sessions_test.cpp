// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/store/place_sessions.hpp"

#include <gtest/gtest.h>

#include "fabmap_node/model/place_model.hpp"
#include "fabmap_node/store/model_rows.hpp"
#include "support/synthetic_places.hpp"
#include "support/temporary_folder.hpp"
#include "urban_nav_core/types/error.hpp"

namespace fabmap_node {
namespace {

using testing::syntheticPlace;
using testing::TemporaryFolder;
using urban_nav_store::Access;
using urban_nav_store::Store;

constexpr urban_nav_core::StampNs kSecond = 1'000'000'000;

PlaceSession makeSession(const PlaceModel& model, const std::string& recording, urban_nav_core::StampNs start) {
  PlaceSession made;
  made.session = {
      urban_nav_store::makeSessionId({"lisa", recording, start, ""}), recording, "lisa", recording, start, false};
  const PlaceDescriber describer(model, {}, 540);
  for (std::uint32_t i = 0; i < 5; ++i)
    made.places.push_back({start + i * kSecond, describer.describe(syntheticPlace(i, 0, 5)), 2.0 * i});
  return made;
}

TEST(PlaceSessions, AreReadAsTheyWereWritten) {
  const TemporaryFolder folder;
  const PlaceModel model = defaultModel();
  const std::string bytes(defaultModelBytes());
  const std::vector<PlaceSession> written = {makeSession(model, "monday", kSecond), makeSession(model, "tuesday", 99)};
  {
    Store store(folder.file("places.db"), Access::Write);
    writePlaces(store, written, bytes);
    store.commit();
  }
  Store store(folder.file("places.db"), Access::Read);
  const StoredPlaces read = readPlaces(store, modelHash(bytes), model.vocabulary.size());
  EXPECT_EQ(read.other_model, 0u);
  ASSERT_EQ(read.sessions.size(), 2u);
  for (const PlaceSession& expected : written) {
    const PlaceSession& session = read.sessions[expected.session.start == kSecond ? 1 : 0];
    EXPECT_EQ(session.session, expected.session);
    ASSERT_EQ(session.places.size(), expected.places.size());
    for (std::size_t i = 0; i < session.places.size(); ++i) {
      EXPECT_EQ(session.places[i].stamp, expected.places[i].stamp);
      EXPECT_EQ(session.places[i].description.words, expected.places[i].description.words);
      EXPECT_EQ(session.places[i].description.look, expected.places[i].description.look);
      if (i == 0) continue;
      EXPECT_GT(session.places[i].travelled, session.places[i - 1].travelled) << "no trajectory is stored";
    }
  }
}

TEST(PlaceSessions, LeavesOutPlacesOfAnotherModel) {
  const TemporaryFolder folder;
  const PlaceModel model = defaultModel();
  {
    Store store(folder.file("places.db"), Access::Write);
    writePlaces(store, {makeSession(model, "monday", kSecond)}, std::string(defaultModelBytes()));
    store.commit();
  }
  Store store(folder.file("places.db"), Access::Read);
  const StoredPlaces read = readPlaces(store, "0123456789abcdef", model.vocabulary.size());
  EXPECT_TRUE(read.sessions.empty());
  EXPECT_EQ(read.other_model, 5u);
}

TEST(PlaceSessions, AModelOfTheProgramIsStoredByItsHash) {
  const std::string supplied(defaultModelBytes()), own = "the bytes of another model";
  const auto by_hash = toStoredModel("session", modelHash(supplied), supplied);
  EXPECT_TRUE(by_hash.bytes.empty());
  EXPECT_EQ(modelBytes(by_hash, "s.db"), supplied);
  const auto whole = toStoredModel("session", modelHash(own), own);
  EXPECT_EQ(modelBytes(whole, "s.db"), own);
  EXPECT_THROW(modelBytes({"session", "0123456789abcdef", "fabmap_node", ""}, "s.db"), urban_nav_core::DataError);
}

// Stores refer to it by its hash: if another model becomes the built-in one, this one has to stay in the program.
TEST(PlaceSessions, EachModelThatWasBuiltInIsSupplied) { EXPECT_TRUE(suppliedModel("b05cf4b60e3bd296")); }

}  // namespace
}  // namespace fabmap_node
