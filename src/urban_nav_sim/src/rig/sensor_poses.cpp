// SPDX-License-Identifier: BSD-3-Clause
#include "rig/sensor_poses.hpp"

#include <cmath>

#include "urban_nav_core/types/frames.hpp"

namespace urban_nav_sim {

namespace frames = urban_nav_core::frames;

using urban_nav_core::Matrix3d;
using urban_nav_core::Pose;
using urban_nav_core::Vector3d;

namespace {

constexpr double kHalfBaseline = 0.0600025;          // m
constexpr double kLadybugHeight = 1.4;               // m
constexpr double kLidarHeight = 1.75;                // m
constexpr double kLadybugRadius = 0.04;              // m, of the ring of lenses
constexpr double kBetweenLenses = 2.0 * M_PI / 5.0;  // rad, clockwise from above

/// Returns the axes of an optical frame with horizontal axis along `yaw` (rad, from x to y).
Matrix3d looking(double yaw) {
  Matrix3d R;
  R << std::sin(yaw), 0.0, std::cos(yaw), -std::cos(yaw), 0.0, std::sin(yaw), 0.0, -1.0, 0.0;
  return R;
}

}  // namespace

std::map<std::string, Pose> sensorPlaces() {
  std::map<std::string, Pose> places;
  places[frames::kStereoLeft] = Pose(looking(0.0), Vector3d(0.1, kHalfBaseline, 1.1));
  places[frames::kStereoRight] = Pose(looking(0.0), Vector3d(0.1, -kHalfBaseline, 1.1));
  for (int i = 0; i < 5; ++i) {
    const double yaw = -i * kBetweenLenses;
    places[frames::ladybugCamera(i)] =
        Pose(looking(yaw), Vector3d(kLadybugRadius * std::cos(yaw), kLadybugRadius * std::sin(yaw), kLadybugHeight));
  }
  // x along the middle beam, z forward: the scan planes are vertical and perpendicular to the direction of travel.
  Matrix3d left, right;
  left << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  right << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  places[frames::kLaserLeft] = Pose(left, Vector3d(-0.030, 0.270, 0.75));
  places[frames::kLaserRight] = Pose(right, Vector3d(-0.030, -0.270, 0.75));
  places[frames::kImu] = Pose(Matrix3d(Matrix3d::Identity()), Vector3d(0.0, 0.0, 0.50));
  places[frames::kGps] = Pose(Matrix3d(Matrix3d::Identity()), Vector3d(-0.15, 0.0, 1.30));
  return places;
}

Pose ladybugPlace() { return Pose(Matrix3d(Matrix3d::Identity()), Vector3d(0.0, 0.0, kLadybugHeight)); }

Pose lidarPose() { return Pose(Matrix3d(Matrix3d::Identity()), Vector3d(0.0, 0.0, kLidarHeight)); }

Pose sensorPose(const std::string& frame) { return sensorPlaces().at(frame); }

}  // namespace urban_nav_sim
