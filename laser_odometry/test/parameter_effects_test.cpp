// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/testing/parameter_effects.hpp"

#include <sstream>

#include "laser_odometry/laser_odometry.hpp"
#include "support/floor_plans.hpp"

namespace laser_odometry {
namespace {

/// Health, poses, covariances and size of the map along a few sweeps.
std::string play(const BoxWorld& world, double speed, const Parameters& parameters) {
  const SpinningLidar lidar;
  LaserOdometry odometry(parameters, lidar.T_base_lidar);
  std::ostringstream text;
  text.precision(17);
  for (int i = 0; i < 5; ++i) {
    const LaserPose pose = odometry.process(lidar.scan(world, makeDrive(speed, 0.3), 0.1 * i, 1));
    text << toString(pose.status.health) << "\n"
         << pose.T_odom_base.matrix() << "\n"
         << pose.step.covariance << "\n"
         << pose.statistics.map_cells << "\n";
  }
  return text.str();
}

TEST(ParameterEffects, EachParameterChangesTheEstimate) {
  using Experiment = urban_nav_core::testing::ParameterExperiment<Parameters>;
  const BoxWorld world = makeStreet(11);
  const Experiment street("street", [&](const Parameters& p) { return play(world, 16.0, p); },
                          {{"cell", 1.0},
                           {"levels", 2},
                           {"min_range", 6.0},
                           {"max_range", 20.0},
                           {"map_range", 10.0},
                           {"deskew", false},
                           {"iterations", 1},
                           {"rounds", 1},
                           {"surface_sigma", 0.1},
                           {"lost_patches", 100000},
                           {"degraded_patches", 100000}});
  const auto blink = [&](const Parameters& parameters) {  // two sweeps without returns: prediction only
    const SpinningLidar lidar;
    LaserOdometry odometry(parameters, lidar.T_base_lidar);
    std::ostringstream text;
    for (int i = 0; i < 5; ++i) {
      Sweep sweep = lidar.scan(world, makeDrive(3.0, 0.0), 0.1 * i, 1);
      if (i > 2) sweep.beams.clear();
      text << odometry.process(sweep).step.covariance << "\n";
    }
    return text.str();
  };
  const Experiment lost("sweeps without returns", blink, {{"acceleration", 3.0}, {"angular_acceleration", 0.2}});
  const Experiment office(
      "office with a planar laser",
      [](const Parameters& parameters) {
        const SpinningLidar laser = makePlanarLaser();
        LaserOdometry odometry(parameters, laser.T_base_lidar, Scanner::Planar);
        std::ostringstream text;
        text.precision(17);
        for (int i = 0; i < 5; ++i) {
          const LaserPose pose = odometry.process(laser.scan(makeOffice(1), makeDrive(1.0, 0.3), 0.1 * i, 1));
          text << pose.T_odom_base.matrix() << "\n" << pose.step.covariance << "\n" << pose.covariance << "\n";
        }
        return text.str();
      },
      {{"planar_cell", 0.4}, {"planar_min_range", 4.5}, {"floor_height", 0.1}, {"floor_tilt", 2.0}});
  EXPECT_EQ(urban_nav_core::testing::findParametersWithoutEffect(table(), {street, lost, office}), "");
}

}  // namespace
}  // namespace laser_odometry
