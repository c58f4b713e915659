// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "commands/stages.hpp"
#include "map/map_command.hpp"
#include "simulate/simulate_command.hpp"
#include "urban_nav_core/io/tum.hpp"
#include "urban_nav_input/testing/folders.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::Trajectory;
using urban_nav_input::testing::readFile;

/// Session of a robot with a 3D LiDAR and no other sensor, mapped once for all tests.
class LidarSession : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<urban_nav_input::testing::TemporaryFolder>();
    ASSERT_EQ(run({"simulate", "--world", "quad", "--seed", "5", "--duration", "10", "--sensors", "lidar3d", "--lidar",
                   "16", "-o", file("drive.bag")}),
              0);
    ASSERT_EQ(run({"map", file("drive.bag"), "--stages", "lo,loops,graph", "--out", file("map")}), 0);
  }
  static void TearDownTestSuite() { folder_.reset(); }
  static std::string file(const std::string& name) { return folder_->file(name); }
  static int run(std::vector<std::string> words) {
    std::vector<const char*> argv = {"urban_nav"};
    for (const std::string& word : words) argv.push_back(word.c_str());
    return runCommandLine({mapCommand(makeStages), simulateCommand()}, addStageTables, static_cast<int>(argv.size()),
                          argv.data());
  }
  static std::size_t countLines(const std::string& name) {
    const std::string text = readFile(file(name));
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  }
  /// Largest distance between a trajectory and the truth, both relative to their poses at the time of `origin`, m.
  static double worstError(const Trajectory& trajectory, urban_nav_core::StampNs origin, const Pose& T_map_origin) {
    const Trajectory truth = urban_nav_core::readTum(file("drive.truth/trajectory.tum"));
    const auto trueAt = [&](urban_nav_core::StampNs stamp) { return truth[truth.nearest(stamp)].pose; };
    double worst = 0.0;
    for (const urban_nav_core::StampedPose& pose : trajectory)
      worst = std::max(
          worst, distanceBetween(T_map_origin.inverse() * pose.pose, trueAt(origin).inverse() * trueAt(pose.stamp)));
    return worst;
  }

  static std::unique_ptr<urban_nav_input::testing::TemporaryFolder> folder_;
};
std::unique_ptr<urban_nav_input::testing::TemporaryFolder> LidarSession::folder_;

TEST_F(LidarSession, IsMappedBySweepsAlone) {
  const Trajectory trajectory = urban_nav_core::readTum(file("map/trajectory.tum"));
  ASSERT_GE(trajectory.size(), 95U);
  EXPECT_EQ(countLines("map/sweeps.csv"), trajectory.size() + 1);
  EXPECT_LT(worstError(trajectory, trajectory[0].stamp, trajectory[0].pose), 0.05);
  const std::string summary = readFile(file("map/summary.json"));
  EXPECT_NE(summary.find("\"source\": \"laser\""), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(file("map/map.ply"))) << "not asked for";
}

TEST_F(LidarSession, IsLocalisedInAMapWithoutKeyframes) {
  const std::string before = readFile(file("map/session.db"));
  ASSERT_EQ(run({"map", file("drive.bag"), "--localise", file("map/session.db"), "--out", file("localised")}), 0);
  EXPECT_TRUE(readFile(file("map/session.db")) == before);
  const std::string rows = readFile(file("localised/localisation.csv"));
  EXPECT_NE(rows.find(",KNOWN,"), std::string::npos);
  const Trajectory map = urban_nav_core::readTum(file("map/trajectory.tum"));
  const Trajectory localised = urban_nav_core::readTum(file("localised/trajectory.tum"));
  ASSERT_EQ(localised.size(), map.size());
  EXPECT_LT(worstError(localised, map[0].stamp, map[0].pose), 0.05);
  EXPECT_NE(readFile(file("localised/summary.json")).find("the clouds of lasers alone"), std::string::npos);
}

TEST_F(LidarSession, CannotBeLocalisedInAMapWithoutSurroundings) {
  ASSERT_EQ(run({"map", file("drive.bag"), "--stages", "lo,graph", "--out", file("bare")}), 0);
  EXPECT_EQ(run({"map", file("drive.bag"), "--localise", file("bare/session.db"), "--out", file("nowhere")}), 1);
  EXPECT_FALSE(std::filesystem::exists(file("nowhere/trajectory.tum")));
}

}  // namespace
}  // namespace urban_nav
