// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cstdlib>

#include "laser_odometry/laser_odometry.hpp"
#include "support/velodyne_folder.hpp"
#include "urban_nav_core/trajectory/errors.hpp"

namespace laser_odometry {
namespace {

using urban_nav_core::Span;

TEST(RealDrive, RawSweepsOfKittiAreFollowedWithinAQuarterOfAPercent) {
  const char* data = std::getenv("URBAN_NAV_DATA");
  if (data == nullptr) GTEST_SKIP() << "URBAN_NAV_DATA is not set";
  const std::string folder = std::string(data) + "/lidar", unpacked = ::testing::TempDir() + "/velodyne";
  if (!std::filesystem::exists(folder + "/velodyne_points.tar.xz")) GTEST_SKIP() << folder << " has no sweeps";
  std::filesystem::create_directories(unpacked);
  ASSERT_EQ(std::system(("tar -xJf '" + folder + "/velodyne_points.tar.xz' -C '" + unpacked + "'").c_str()), 0);
  const VelodyneFolder drive(folder, unpacked + "/velodyne_points/data");
  ASSERT_EQ(drive.files.size(), drive.times.size());

  LaserOdometry odometry({}, drive.T_base_lidar);
  std::vector<urban_nav_core::Pose> poses;
  int degenerate = 0;
  for (std::size_t i = 0; i < drive.files.size(); ++i) {
    const LaserPose pose = odometry.process(drive.read(i));
    degenerate += pose.free_directions.empty() ? 0 : 1;
    poses.push_back(pose.T_odom_base);
  }
  std::filesystem::remove_all(unpacked);
  EXPECT_LE(relativeError(drive.truth, poses, {Span::Unit::Frames, 10})->percent, 0.25);
  EXPECT_LE(relativeError(drive.truth, poses, {Span::Unit::Frames, 50})->percent, 0.25);
  EXPECT_NEAR(urban_nav_core::pathLength(poses) / urban_nav_core::pathLength(drive.truth), 1.0, 0.003);
  EXPECT_EQ(degenerate, 0);
}

}  // namespace
}  // namespace laser_odometry
