// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "inspect/fleet_coverage.hpp"
#include "inspect/fleet_report.hpp"
#include "join/release_run.hpp"
#include "joined_days.hpp"
#include "urban_nav_store/release.hpp"
#include "urban_nav_store/store.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/stored_place.hpp"

namespace urban_nav {
namespace {

using urban_nav_input::testing::readFile;
using urban_nav_store::Access;
using urban_nav_store::Store;

/// Makes a release once for all tests.
std::string makeReleaseOnce(const std::string& store, const std::string& release) {
  if (!std::filesystem::exists(release)) {
    EXPECT_EQ(runWords({"release", store, "-o", release}), 0);
  }
  return release;
}

std::size_t countPlaces(const std::string& release) {
  Store store(release, Access::Frozen);
  std::size_t places = 0;
  for (const urban_nav_store::Session& session : store.sessions().all())
    urban_nav_store::TableStore<urban_nav_store::StoredPlace>(store).forEach(
        session.id, [&](const urban_nav_store::StoredPlace&) { ++places; });
  return places;
}

TEST_F(JoinedDays, AReleaseIsASmallFileThatIsTheSameEachTime) {
  const std::string release = makeReleaseOnce(store("days"), file("days.release"));
  ASSERT_EQ(runWords({"release", store("days"), "-o", file("again.release"), "--json", file("release.json")}), 0);
  EXPECT_TRUE(readFile(file("again.release")) == readFile(release));
  EXPECT_LT(std::filesystem::file_size(release), std::filesystem::file_size(store("days")) * 7 / 10);
  for (const char* key : {"version", "digest", "parents", "sessions", "places", "keyframes", "bytes", "warnings"})
    EXPECT_NE(readFile(file("release.json")).find("\"" + std::string(key) + "\""), std::string::npos) << key;
  const StoreInfo info = readStoreInfo(release);
  ASSERT_TRUE(info.release);
  EXPECT_EQ(info.release->version, 1);
  EXPECT_EQ(info.joined.size(), 1U);
}

TEST_F(JoinedDays, AReleaseIsNoStore) {
  const std::string release = makeReleaseOnce(store("days"), file("days.release"));
  EXPECT_EQ(runWords({"join", release, store("second"), "-o", file("none.db")}), 2);
  EXPECT_EQ(runWords({"merge", release, store("second"), "-o", file("none.db")}), 2);
  EXPECT_EQ(runWords({"release", release, "-o", file("none.db")}), 2);
  EXPECT_EQ(map({file("second.bag")}, "none", {"--store", release}), 2);
  EXPECT_EQ(runWords({"join", store("second"), "--onto", store("first"), "-o", file("none.db")}), 2) << "no release";
  EXPECT_FALSE(std::filesystem::exists(file("none.db")));
}

TEST_F(JoinedDays, ADriveIsLocalisedInARelease) {
  const std::string release = makeReleaseOnce(store("first"), file("first.release"));
  const std::string before = readFile(release);
  const auto known = [&](const std::string& in, const std::string& out) {
    EXPECT_EQ(runWords({"map", file("again.bag"), "--out", file(out), "--localise", in}), 0);
    const std::string rows = readFile(file(out) + "/localisation.csv");
    std::size_t count = 0;
    for (std::size_t at = rows.find(",KNOWN,"); at != std::string::npos; at = rows.find(",KNOWN,", at + 1)) ++count;
    return count;
  };
  const std::size_t in_store = known(store("first"), "in_store");
  EXPECT_GT(in_store, 0U);
  EXPECT_GE(known(release, "in_release") * 100, in_store * 98);
  EXPECT_TRUE(readFile(release) == before);
}

TEST_F(JoinedDays, WhatAReleaseDoesNotHoldIsAdded) {
  const std::string release = makeReleaseOnce(store("again"), file("shorter.release"));  // 6 of 8 s
  ASSERT_EQ(
      runWords({"join", store("first"), "--onto", release, "-o", file("next.release"), "--json", file("onto.json")}),
      0);
  EXPECT_NE(readFile(file("onto.json")).find("\"joined\": true"), std::string::npos);
  Store next(file("next.release"), Access::Frozen);
  const urban_nav_store::ReleaseHead head = readReleaseHead(next);
  EXPECT_EQ(head.version, 2);
  Store old(release, Access::Frozen);
  EXPECT_EQ(head.parents, std::vector<std::string>{readReleaseHead(old).digest});
  EXPECT_GE(countPlaces(file("next.release")), countPlaces(release));
  const urban_nav_store::SessionId known = old.sessions().all().front().id;
  std::size_t moved = 0;
  std::map<urban_nav_core::StampNs, urban_nav_core::Pose> poses;
  old.graph().forEachRelaxed(known,
                             [&](const urban_nav_store::RelaxedPose& pose) { poses[pose.stamp] = pose.T_map_base; });
  next.graph().forEachRelaxed(known, [&](const urban_nav_store::RelaxedPose& pose) {
    moved += distanceBetween(pose.T_map_base, poses.at(pose.stamp)) > 0.0 ? 1 : 0;
  });
  EXPECT_EQ(moved, 0U) << "poses of the release stay";
  const ReleaseDifference there = compareReleases(release, file("next.release"), 500.0);
  const ReleaseDifference back = compareReleases(file("next.release"), release, 500.0);
  EXPECT_EQ(there.places_new, back.places_lost);
  EXPECT_EQ(there.places_lost, 0U);
  EXPECT_EQ(there.surfaces_new_m2, back.surfaces_gone_m2);
}

TEST_F(JoinedDays, WhatAddsNothingIsNotKept) {
  const std::string release = makeReleaseOnce(store("first"), file("first.release"));
  ASSERT_EQ(runWords({"join", store("again"), store("second"), store("first"), "--onto", release, "-o",
                      file("idle.release"), "--json", file("idle.json")}),
            0);
  const std::string json = readFile(file("idle.json"));
  EXPECT_EQ(json.find("\"kept\": true"), std::string::npos) << json;
  EXPECT_NE(json.find("no closure joins it to the release"), std::string::npos);
  EXPECT_NE(json.find("the release holds this session"), std::string::npos);
  EXPECT_EQ(countPlaces(file("idle.release")), countPlaces(release));
  const ReleaseDifference none = compareReleases(release, file("idle.release"), 500.0);
  EXPECT_EQ(none.places_lost + none.places_new + none.places_moved, 0U);
  EXPECT_EQ(none.surfaces_gone_m2 + none.surfaces_new_m2, 0.0);
}

TEST_F(JoinedDays, ReleasesOfOtherMapsAreNotCompared) {
  const std::string one = makeReleaseOnce(store("first"), file("first.release"));
  const std::string other = makeReleaseOnce(store("second"), file("second.release"));
  EXPECT_EQ(runWords({"release", "--diff", one, other}), 1);
  EXPECT_EQ(runWords({"release", "--diff", one}), 2);
}

TEST_F(JoinedDays, AFolderOfStoresIsReportedOnOnePage) {
  const std::string fleet = file("fleet");
  std::filesystem::create_directories(fleet + "/robot");
  std::filesystem::copy_file(store("days"), fleet + "/robot/days.db");
  std::filesystem::copy_file(store("second"), fleet + "/second.db");
  urban_nav_input::testing::writeFile(fleet + "/damaged.db", readFile(store("first")).substr(0, 100'000));
  makeReleaseOnce(store("first"), fleet + "/first.release");
  for (const char* name : {"/sessions/broken", "/sessions/sound"}) std::filesystem::create_directories(fleet + name);
  std::filesystem::copy_file(store("first"), fleet + "/sessions/broken/session.db");
  urban_nav_input::testing::writeFile(fleet + "/sessions/broken/summary.json",
                                      R"({"failed": "broken.bag: no message can be read", "exit_status": 1})");
  urban_nav_input::testing::writeFile(fleet + "/sessions/sound/summary.json", R"({"wall_s": 3.5})");
  ASSERT_EQ(runWords({"info", fleet, "--report", file("fleet.html"), "--json", file("fleet.json")}), 0);
  const Fleet read = readFleet(fleet);
  ASSERT_EQ(read.sessions.size(), 3U);
  std::size_t joined = 0;
  for (const FleetSession& session : read.sessions) joined += session.in_map == 2 && session.accepted > 0 ? 1 : 0;
  EXPECT_EQ(joined, 2U);
  EXPECT_EQ(read.releases.size(), 1U);
  ASSERT_EQ(read.unreadable.size(), 1U);
  EXPECT_EQ(read.unreadable.front().first, "damaged.db");
  ASSERT_EQ(read.failed.size(), 1U) << "the summary of a map is no failure";
  EXPECT_EQ(read.failed.front().first, "sessions/broken");
  for (const char* output : {"fleet.html", "fleet.json"})
    EXPECT_NE(readFile(file(output)).find("broken.bag: no message can be read"), std::string::npos) << output;
  for (const char* word : {"\"joined\"", "\"apart\"", "robot/days.db", "damaged.db"})
    EXPECT_NE(readFile(file("fleet.json")).find(word), std::string::npos) << word;
  const std::vector<MapCoverage> coverage = computeCoverage(read);
  const auto joint =
      std::find_if(coverage.begin(), coverage.end(), [](const MapCoverage& each) { return each.sessions == 2; });
  ASSERT_TRUE(joint != coverage.end());
  EXPECT_EQ(coverage.size(), 2U) << "the third session is apart";
  EXPECT_GE(joint->days, 1U);
  EXPECT_GT(joint->area_m2, 100.0);
  EXPECT_LE(std::max(joint->repeated_m2, joint->newest_m2), joint->area_m2);
  for (const char* word : {"\"maps\"", "\"area_m2\"", "\"repeated_m2\""})
    EXPECT_NE(readFile(file("fleet.json")).find(word), std::string::npos) << word;
  EXPECT_NE(readFile(file("fleet.html")).find("new on the last day"), std::string::npos);
  EXPECT_NE(readFile(file("fleet.html")).find("Robots and days"), std::string::npos);
  EXPECT_EQ(runWords({"info", file("fleet.json"), "--report", file("none.html")}), 2) << "no folder";
}

TEST_F(JoinedDays, LayersOfAGeoPackageAreTheSameEachTime) {
  ASSERT_EQ(runWords({"export", store("days"), "--gpkg", file("days.gpkg")}), 0);
  ASSERT_EQ(runWords({"export", store("days"), "--gpkg", file("again.gpkg")}), 0);
  EXPECT_TRUE(readFile(file("days.gpkg")) == readFile(file("again.gpkg")));
  EXPECT_EQ(runWords({"export", store("days"), "--gpkg", file("none.gpkg"), "--crs", "auto"}), 1) << "no GPS";
  EXPECT_FALSE(std::filesystem::exists(file("none.gpkg")));
}

}  // namespace
}  // namespace urban_nav
