// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "floor_plans.hpp"
#include "laser_odometry/laser_odometry.hpp"
#include "urban_nav_core/geometry/small_matrices.hpp"
#include "urban_nav_core/trajectory/odometry_chain.hpp"

namespace laser_odometry {

/// A drive through a place that leaves directions free for some of the time, and ends where nothing is free.
struct FreePlace {
  const char* name;
  std::function<BoxWorld(std::uint64_t seed)> world;
  SpinningLidar laser;
  Scanner scanner;
  double speed, swing, period;  ///< m/s and s: the speed swings sinusoidally, with a phase from the seed
  double max_range;             ///< m
  int sweeps;
};

/// A drive with its true poses.
struct FreeRun {
  std::vector<LaserPose> poses;
  std::vector<Pose> truth;
  urban_nav_core::OdometryChain chain;
  bool is_planar = false;

  int free() const {
    int count = 0;
    for (const LaserPose& pose : poses) count += pose.free_directions.empty() ? 0 : 1;
    return count;
  }
  double length() const { return (truth.back().t() - truth.front().t()).norm(); }
  /// Error of the position at a sweep, m.
  double error(std::size_t i) const {
    return (poses[i].T_odom_base.t() - (truth.front().inverse() * truth[i]).t()).norm();
  }
  /// Stated standard deviation of the last position along x, m.
  double stated() const { return std::sqrt(poses.back().covariance(0, 0)); }
  /// Normalised squared error of the motion from sweep `i` over a number of sweeps: of 6 or, planar, 3 coordinates.
  double nees(std::size_t i, std::size_t sweeps) const {
    const auto path = chain.between(poses[i].stamp, poses[i + sweeps].stamp);
    const Vector6d d = urban_nav_core::boxMinus(truth[i].inverse() * truth[i + sweeps], path->pose);
    if (!is_planar) return d.dot(urban_nav_core::SmallCholesky<6>(path->covariance).solve(d));
    constexpr std::array<int, 3> kRows = {0, 1, 5};
    Eigen::Matrix3d C;
    Vector3d e;
    for (int r = 0; r < 3; ++r) {
      e[r] = d[kRows[static_cast<std::size_t>(r)]];
      for (int c = 0; c < 3; ++c)
        C(r, c) = path->covariance(kRows[static_cast<std::size_t>(r)], kRows[static_cast<std::size_t>(c)]);
    }
    return e.dot(urban_nav_core::SmallCholesky<3>(C).solve(e));
  }
  /// Mean over all spans of a number of sweeps.
  double nees(std::size_t sweeps) const {
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i + sweeps < poses.size(); ++i, count += 1.0) sum += nees(i, sweeps);
    return sum / count;
  }
};

/// A corridor along x with doors in niches at irregular intervals, whose jambs are 12 cm deep, and cabinets; its ends
/// are out of range for most of a drive.
inline BoxWorld makeCorridorWithDoors(std::uint64_t seed) {
  urban_nav_core::testing::Dice dice(seed);
  BoxWorld world;
  addWall(-8.2, -3.0, -8.0, 3.0, world);
  addWall(60.0, -3.0, 60.2, 3.0, world);
  for (const double side : {-1.0, 1.0}) {
    addWall(-8.0, side * 2.4, 60.0, side * 2.6, world);
    double x = -8.0;
    for (double next = x + dice.uniform(0.4, 1.6); next < 58.0; next += dice.uniform(2.4, 5.2)) {
      addWall(x, side * 1.4, next, side * 1.6, world);
      x = next + 0.95;
      if (dice.chance(0.25)) continue;  // a niche, the others are closed
      addWall(next, side * 1.52, x, side * 1.6, world);
    }
    addWall(x, side * 1.4, 60.0, side * 1.6, world);
  }
  for (double x = dice.uniform(0.0, 4.0); x < 58.0; x += dice.uniform(6.0, 12.0))
    addWall(x, -1.4, x + dice.uniform(0.8, 1.2), -1.06, world);
  return world;
}

/// A room, a corridor of 22 m without any feature, and another room.
inline BoxWorld makeRoomsAndCorridor(std::uint64_t) {
  BoxWorld world;
  addWall(-3.2, -3.0, -3.0, 3.0, world);
  addWall(-3.0, 3.0, 3.0, 3.2, world);
  addWall(-3.0, -3.2, 3.0, -3.0, world);
  addWall(3.0, 0.8, 25.0, 3.0, world);
  addWall(3.0, -3.0, 25.0, -0.8, world);
  addWall(25.0, 3.0, 33.0, 3.2, world);
  addWall(25.0, -3.2, 33.0, -3.0, world);
  addWall(33.0, -3.2, 33.2, 3.2, world);
  addWall(29.0, 1.2, 30.0, 2.0, world);
  return world;
}

/// Frames of a portal, a smooth tunnel of 63 m, and frames again; 6 m wide and 5 m high.
inline BoxWorld makeTunnelBetweenPortals(std::uint64_t seed) {
  urban_nav_core::testing::Dice dice(seed);
  BoxWorld world = makeTunnel();
  const auto addFrames = [&](double begin, double end) {
    for (double x = begin; x < end; x += dice.uniform(2.0, 5.0)) {
      world.boxes.push_back({{x, 2.2, 0}, {x + 0.6, 3.0, 5}});
      world.boxes.push_back({{x, -3.0, 0}, {x + 0.6, -2.2, 5}});
      world.boxes.push_back({{x, -3.0, 4.4}, {x + 0.6, 3.0, 5}});
    }
  };
  addFrames(-30.0, 12.0);
  addFrames(75.0, 200.0);
  return world;
}

/// Level ground between two groups of huts.
inline BoxWorld makeFieldBetweenHuts(std::uint64_t seed) {
  urban_nav_core::testing::Dice dice(seed);
  BoxWorld world = makeField();
  const auto addHuts = [&](double begin, double end) {
    for (double x = begin; x < end; x += dice.uniform(3.0, 7.0)) {
      const double y = (dice.chance(0.5) ? 1.0 : -1.0) * dice.uniform(6.0, 12.0);
      world.boxes.push_back({{x, y - 1.5, 0}, {x + dice.uniform(1.0, 3.0), y + 1.5, dice.uniform(2.0, 4.0)}});
    }
  };
  addHuts(-30.0, 20.0);
  addHuts(90.0, 220.0);
  return world;
}

inline std::vector<FreePlace> makeFreePlaces() {
  SpinningLidar car;
  car.rings = 16;
  car.columns = 600;
  car.sigma_m = 0.02;
  return {{"corridor with doors", makeCorridorWithDoors, makePlanarLaser(720, 0.01), Scanner::Planar, 1.0, 0.3, 9.0,
           12.0, 300},
          {"rooms and corridor", makeRoomsAndCorridor, makePlanarLaser(360, 0.02), Scanner::Planar, 1.0, 0.3, 9.0, 8.0,
           290},
          {"tunnel", makeTunnelBetweenPortals, car, Scanner::Spatial, 6.0, 2.0, 13.0, 30.0, 230},
          {"field", makeFieldBetweenHuts, car, Scanner::Spatial, 6.0, 2.0, 13.0, 30.0, 230}};
}

/// Returns the motion of a drive: T_world_base(t).
inline std::function<Pose(double)> makeMotion(const FreePlace& place, std::uint64_t seed) {
  const double w = 2.0 * M_PI / place.period, phase = 1.9 * static_cast<double>(seed);
  const double height = place.scanner == Scanner::Planar ? 0.0 : 1.7;
  return [=](double t) {
    const double x = place.speed * t - place.swing / w * (std::cos(w * t + phase) - std::cos(phase));
    return Pose(Eigen::Quaterniond::Identity(), {x, 0.1 * std::sin(0.35 * x), height}) *
           Pose(urban_nav_core::expSo3({0.0, 0.0, std::atan(0.035 * std::cos(0.35 * x))}), Vector3d::Zero());
  };
}

/// Motion prior of a sweep with a reference time and the previous one; empty: constant speed.
using MakePrior = std::function<std::optional<MotionPrior>(double from_s, double to_s)>;

inline FreeRun driveFreePlace(const FreePlace& place, Parameters parameters, std::uint64_t seed,
                              const MakePrior& prior = {}) {
  parameters.max_range = place.max_range;
  LaserOdometry odometry(parameters, place.laser.T_base_lidar, place.scanner);
  const BoxWorld world = place.world(seed);
  const std::function<Pose(double)> motion = makeMotion(place, seed);
  FreeRun run;
  run.is_planar = place.scanner == Scanner::Planar;
  for (int i = 0; i < place.sweeps; ++i) {
    const double t = place.laser.sweep_s * i;
    const Sweep sweep = place.laser.scan(world, motion, t, seed);
    const std::optional<MotionPrior> by_sensors =
        prior && i > 0 ? prior(t - place.laser.sweep_s, t) : std::optional<MotionPrior>();
    run.poses.push_back(odometry.process(sweep, by_sensors));
    run.truth.push_back(motion(t));
    if (i > 0) run.chain.append(run.poses.back().step);
  }
  return run;
}

}  // namespace laser_odometry
