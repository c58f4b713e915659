// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace urban_nav_core::testing {

/// Motion of the simulated camera, 10 frames a second, nearly level with a little pitch and roll.
enum class TrackMotion {
  Standing,  ///< does not move
  Straight,  ///< forward at constant speed
  Turning,   ///< forward in alternating turns
  Mixed,     ///< drives, turns through 360 deg, stops, drives on
};

/// Stereo camera among points: measurements of an ideal front end, with noise.
struct TrackOptions {
  std::uint64_t seed = 1;
  int frames = 200;
  TrackMotion motion = TrackMotion::Turning;
  double speed = 0.1;          ///< m a frame
  int features = 60;           ///< seen in a frame
  double sigma_px = 0.3;       ///< of u_left, v and u_right, independent
  double track_length = 13.0;  ///< mean lifetime of a landmark that stays in the image, frames; geometrically
                               ///< distributed
  double missed = 0.05;        ///< share of measurements omitted while the landmark is alive
  double outliers = 0.0;       ///< share of measurements with errors of up to 20 px
  double nearest = 2.0, farthest = 40.0;  ///< depth of new points, m, uniform in the logarithm
};
/// A landmark measured in a stereo frame.
struct TrackSighting {
  std::int64_t landmark = 0;
  Eigen::Vector3d z = Eigen::Vector3d::Zero();  ///< u_left, v, u_right, px
  bool outlier = false;
};
/// A stereo frame of simulated tracks.
struct TrackFrame {
  Pose T_world_camera;                   ///< truth; the first is the identity
  std::vector<TrackSighting> sightings;  ///< in order of landmark
  std::vector<std::int64_t> ended;       ///< landmarks without measurements after this frame
};
/// Simulated tracks of a stereo camera with their truth.
struct Tracks {
  StereoCamera camera;
  double sigma_px = 0.0;
  std::vector<TrackFrame> frames;
  std::vector<Eigen::Vector3d> points;  ///< truth by landmark, in `world`, m
};

/// Simulates tracks; equal options give identical bits. Uses its own projection, so that the tested code is not tested
/// against itself.
Tracks simulateTracks(const TrackOptions& options);

}  // namespace urban_nav_core::testing
