// SPDX-License-Identifier: BSD-3-Clause
// Laser odometry with wheels and gyroscope, from a recording to the results of `map`.
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>

#include "commands/stages.hpp"
#include "convert/convert_command.hpp"
#include "map/map_command.hpp"
#include "simulate/simulate_command.hpp"
#include "urban_nav_core/io/tum.hpp"
#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::Trajectory;
using urban_nav_input::testing::readFile;

/// A drive of 8 s in a smooth tunnel, which leaves the motion along it free.
class TunnelDrive : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<urban_nav_input::testing::TemporaryFolder>();
    ASSERT_EQ(run({"simulate", "--world", "tunnel", "--seed", "3", "--route", "straight300", "--duration", "8",
                   "--sensors", "lidar3d,imu,wheels", "--lidar", "16", "-o", file("drive.bag")}),
              0);
    ASSERT_EQ(run({"map", file("drive.bag"), "--stages", "lo", "--out", file("map")}), 0);
  }
  static void TearDownTestSuite() { folder_.reset(); }
  static std::string file(const std::string& name) { return folder_->file(name); }
  static int run(std::vector<std::string> words) {
    std::vector<const char*> argv = {"urban_nav"};
    for (const std::string& word : words) argv.push_back(word.c_str());
    return runCommandLine({mapCommand(makeStages), simulateCommand(), convertCommand()}, addStageTables,
                          static_cast<int>(argv.size()), argv.data());
  }
  /// Error of the distance between the first and the last pose, and the true distance, m.
  static std::pair<double, double> endError(const std::string& map) {
    const Trajectory path = urban_nav_core::readTum(file(map + "/trajectory.tum"));
    const Trajectory truth = urban_nav_core::readTum(file("drive.truth/trajectory.tum"));
    const auto trueAt = [&](urban_nav_core::StampNs stamp) { return truth[truth.nearest(stamp)].pose; };
    const std::size_t last = path.size() - 1;
    const Pose expected = trueAt(path[0].stamp).inverse() * trueAt(path[last].stamp);
    return {distanceBetween(path[0].pose.inverse() * path[last].pose, expected), expected.t().norm()};
  }

  static std::unique_ptr<urban_nav_input::testing::TemporaryFolder> folder_;
};
std::unique_ptr<urban_nav_input::testing::TemporaryFolder> TunnelDrive::folder_;

TEST_F(TunnelDrive, IsCarriedByTheWheels) {
  const auto [error, distance] = endError("map");
  EXPECT_GT(distance, 4.0);
  EXPECT_LT(error, 0.05 * distance);  // wheels without calibration: nothing in the tunnel measures their scale
  const std::string summary = readFile(file("map/summary.json"));
  EXPECT_NE(summary.find("\"wheels\""), std::string::npos);
  EXPECT_NE(summary.find("\"wheel_scale\""), std::string::npos);
  EXPECT_NE(summary.find("\"gyroscope_bias_radps\""), std::string::npos);
}

TEST_F(TunnelDrive, WithoutMotionInputHasTheBytesOfARecordingWithoutTheSensors) {
  ASSERT_EQ(run({"convert", file("drive.bag"), "--topics", "/points,/tf_static", "-o", file("bare.bag")}), 0);
  ASSERT_EQ(run({"map", file("bare.bag"), "--stages", "lo", "--out", file("bare")}), 0);
  ASSERT_EQ(
      run({"map", file("drive.bag"), "--stages", "lo", "--set", "swf_vo.motion_input=none", "--out", file("none")}), 0);
  for (const char* name : {"trajectory.tum", "sweeps.csv", "covariance.csv", "graph.g2o"}) {
    if (!std::filesystem::exists(file(std::string("bare/") + name))) continue;
    EXPECT_TRUE(readFile(file(std::string("none/") + name)) == readFile(file(std::string("bare/") + name))) << name;
  }
  EXPECT_GT(endError("none").first, 2.0 * endError("map").first);
}

}  // namespace
}  // namespace urban_nav
