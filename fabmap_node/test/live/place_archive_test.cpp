// SPDX-License-Identifier: BSD-3-Clause
#include "live/place_archive.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "fabmap_node/model/place_model.hpp"
#include "support/synthetic_places.hpp"
#include "support/temporary_folder.hpp"

namespace fabmap_node {
namespace {

using testing::syntheticPlace;
using testing::TemporaryFolder;

constexpr std::uint32_t kPlaceCount = 4;

std::vector<MapPlace> makePlaces(const PlaceModel& model) {
  const PlaceDescriber describer(model, {}, 540);
  std::vector<MapPlace> places;
  for (std::uint32_t i = 0; i < kPlaceCount; ++i)
    places.push_back({10 + i, describer.describe(syntheticPlace(i, 0, 5)), 2.0 * i});
  return places;
}

void expectSame(const PlaceArchive& archive, const std::vector<MapPlace>& expected) {
  std::size_t i = 0;
  EXPECT_EQ(archive.forEach([&](const MapPlace& place) {
    ASSERT_LT(i, expected.size());
    EXPECT_EQ(place.stamp, expected[i].stamp);
    EXPECT_EQ(place.description.words, expected[i].description.words);
    EXPECT_EQ(place.description.look, expected[i].description.look);
    EXPECT_EQ(place.description.cameras, expected[i].description.cameras);
    ++i;
  }),
            0u);
  EXPECT_EQ(i, expected.size());
  for (const MapPlace& place : expected) EXPECT_EQ(archive.look(place.stamp), place.description.look);
  EXPECT_TRUE(archive.look(9).empty());
  EXPECT_TRUE(archive.look(100).empty());
}

TEST(PlaceArchive, RecordedPlacesAreReadBack) {
  const std::vector<MapPlace> places = makePlaces(defaultModel());
  RecordedPlaces recorded;
  for (const MapPlace& place : places) recorded.add(place);
  expectSame(recorded, places);
  std::vector<double> travelled;
  recorded.forEach([&travelled](const MapPlace& place) { travelled.push_back(place.travelled); });
  EXPECT_EQ(travelled, (std::vector<double>{0.0, 2.0, 4.0, 6.0}));
}

TEST(PlaceArchive, RecordedPlacesStayInMemoryWithoutATemporaryFolder) {
  const std::vector<MapPlace> places = makePlaces(defaultModel());
  ::setenv("TMPDIR", "/nowhere", 1);
  RecordedPlaces recorded;
  ::unsetenv("TMPDIR");
  for (const MapPlace& place : places) recorded.add(place);
  expectSame(recorded, places);
}

TEST(PlaceArchive, ASessionOfAStoreIsReadEvenOfAFileThatWasRemoved) {
  const TemporaryFolder folder;
  const PlaceModel model = defaultModel();
  const std::string bytes(defaultModelBytes()), path = folder.file("places.db");
  const std::vector<MapPlace> places = makePlaces(model);
  {
    urban_nav_store::Store store(path, urban_nav_store::Access::Write);
    writePlaces(store, {{{"s", "monday", "", "", 10, true}, places}}, bytes);
    store.commit();
  }
  const std::vector<ArchivedSession> sessions = archivedSessions(path, modelHash(bytes), model.vocabulary.size());
  std::filesystem::remove(path);
  ASSERT_EQ(sessions.size(), 1u);
  EXPECT_EQ(sessions[0].session.id, "s");
  expectSame(*sessions[0].places, places);
}

TEST(PlaceArchive, LeavesOutPlacesOfAnotherModel) {
  const TemporaryFolder folder;
  const PlaceModel model = defaultModel();
  const std::string path = folder.file("places.db");
  {
    urban_nav_store::Store store(path, urban_nav_store::Access::Write);
    writePlaces(store, {{{"s", "monday", "", "", 10, true}, makePlaces(model)}}, std::string(defaultModelBytes()));
    store.commit();
  }
  const std::vector<ArchivedSession> sessions = archivedSessions(path, "0123456789abcdef", model.vocabulary.size());
  ASSERT_EQ(sessions.size(), 1u);
  EXPECT_EQ(sessions[0].places->forEach([](const MapPlace&) { ADD_FAILURE(); }), kPlaceCount);
}

}  // namespace
}  // namespace fabmap_node
