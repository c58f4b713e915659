// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "base/command.hpp"
#include "commands/stages.hpp"
#include "map/map_command.hpp"
#include "support/shared_drive.hpp"
#include "topics/lasers/map_export.hpp"
#include "urban_nav_input/testing/folders.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/tile_colours.hpp"

namespace urban_nav {
namespace {

int runCommand(const std::vector<std::string>& words) {
  std::vector<const char*> argv = {"urban_nav"};
  for (const std::string& word : words) argv.push_back(word.c_str());
  return runCommandLine({mapCommand(makeStages)}, addStageTables, static_cast<int>(argv.size()), argv.data());
}

/// Returns the calibration in summary.json of `map`.
nlohmann::json readCalibration(const std::string& folder) {
  const auto summary = nlohmann::json::parse(urban_nav_input::testing::readFile(folder + "/summary.json"));
  return summary.at("laser_mapper").at("calibration").at(0);
}

/// An export reads the colours that `map` stored, and computes the same ones if they are missing.
void expectStoredColours(const std::string& folder) {
  using urban_nav_store::TileColours;
  const std::string file = folder + "/export.ply", map = urban_nav_input::testing::readFile(folder + "/map.ply");
  urban_nav_store::Store store(folder + "/session.db", urban_nav_store::Access::Write);
  const auto sessions = urban_nav_store::readMaps(store, urban_nav_store::selectSessions(store, {})).front();
  urban_nav_store::TableStore<TileColours> rows(store);
  std::vector<TileColours> stored;
  rows.forEach(sessions.front().session.id, [&](const TileColours& row) { stored.push_back(row); });
  ASSERT_GT(stored.size(), 1U);
  exportMap(store, sessions, {file, "", "", "", ""}, 100.0);
  EXPECT_TRUE(urban_nav_input::testing::readFile(file) == map) << "with stored colours";
  for (TileColours& row : stored) rows.remove(row);
  exportMap(store, sessions, {file, "", "", "", ""}, 100.0);
  EXPECT_TRUE(urban_nav_input::testing::readFile(file) == map) << "with computed colours";
  for (TileColours& row : stored) {
    row.digest = "of another map";
    rows.put(row);
  }
  exportMap(store, sessions, {file, "", "", "", ""}, 100.0);
  EXPECT_TRUE(urban_nav_input::testing::readFile(file) == map) << "with colours of another map in the store";
}

/// Ten seconds of a drive: the head of the panoramic cameras is turned to the left by 2 deg from where it is stated to
/// be, so /tf_static is wrong by -2 deg about z.
TEST(MapCalibrate, FindsATurnedHeadReportsItAndColoursTheMapWithIt) {
  const urban_nav_input::testing::TemporaryFolder folder;
  const std::string bag = folder.file("drive.bag"), plain = folder.file("plain"),
                    calibrated = folder.file("calibrated");
  testing::cutSharedDrive(bag, {0.0, 10.0, {"/stereo/", "/ladybug/", "/laser_"}, "ladybug:0,0,-2"});
  ASSERT_EQ(runCommand({"map", bag, "--out", plain, "--stages", "vo,lasers"}), 0);
  ASSERT_EQ(runCommand({"map", bag, "--out", calibrated, "--stages", "vo,lasers", "--calibrate"}), 0);
  const nlohmann::json calibration = readCalibration(calibrated);
  EXPECT_TRUE(calibration.at("panorama_adopted").get<bool>());
  const nlohmann::json& head = calibration.at("devices").at("panorama");
  for (const auto& [term, truth] : {std::pair("turn_x_deg", 0.0), {"turn_y_deg", 0.0}, {"turn_z_deg", 2.0}}) {
    EXPECT_TRUE(head.at(term).at("observable").get<bool>()) << term;
    const double sigma = head.at(term).at("sigma").get<double>();
    EXPECT_NEAR(head.at(term).at("adopted").get<double>(), truth, 4.0 * sigma) << term;
    EXPECT_LT(sigma, 0.3) << term << ": odometry does say something";
    EXPECT_EQ(head.at(term).at("adopted"), head.at(term).at("found")) << term;
  }
  EXPECT_EQ(calibration.at("devices").at("laser_left").at("delay_ms").at("adopted"), 0.0);
  EXPECT_FALSE(calibration.at("not_observable").empty()) << "ten seconds do not tell everything";
  EXPECT_NE(urban_nav_input::testing::readFile(calibrated + "/report.html").find("Calibration of lasers and panoramas"),
            std::string::npos);
  EXPECT_NE(urban_nav_input::testing::readFile(plain + "/map.ply"),
            urban_nav_input::testing::readFile(calibrated + "/map.ply"))
      << "its colours";
  expectStoredColours(calibrated);
  EXPECT_EQ(urban_nav_input::testing::readFile(plain + "/trajectory.tum"),
            urban_nav_input::testing::readFile(calibrated + "/trajectory.tum"));
}

}  // namespace
}  // namespace urban_nav
