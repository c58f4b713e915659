// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace urban_nav_core::testing {

/// How the simulated camera moves, 10 frames a second, nearly level with a little pitch and roll.
enum class TrackMotion {
  Standing,  ///< does not move
  Straight,  ///< forward at a steady pace
  Turning,   ///< forward while it turns to and fro
  Mixed,     ///< drives, turns through 360 deg, stops, drives on
};

/// A stereo camera among points: what a perfect front end would measure, with noise.
struct TrackOptions {
  std::uint64_t seed = 1;
  int frames = 200;
  TrackMotion motion = TrackMotion::Turning;
  double speed = 0.1;          ///< m a frame
  int features = 60;           ///< seen in a frame
  double sigma_px = 0.3;       ///< of each of u_left, v, u_right, independent
  double track_length = 13.0;  ///< mean life of a landmark, frames, where it does not leave the image before; geometric
  double missed = 0.05;        ///< share of sightings that are left out while the landmark lives on
  double outliers = 0.0;       ///< share of sightings that are off by up to 20 px
  double nearest = 2.0, farthest = 40.0;  ///< depth of new points, m, uniform in the logarithm
};

struct TrackSighting {
  std::int64_t landmark = 0;
  Eigen::Vector3d z = Eigen::Vector3d::Zero();  ///< u_left, v, u_right, px
  bool outlier = false;
};

struct TrackFrame {
  Pose T_world_camera;                   ///< truth; the first is the identity
  std::vector<TrackSighting> sightings;  ///< in order of landmark
  std::vector<std::int64_t> ended;       ///< landmarks that will not be seen again, after this frame
};

struct Tracks {
  StereoCamera camera;
  double sigma_px = 0.0;
  std::vector<TrackFrame> frames;
  std::vector<Eigen::Vector3d> points;  ///< truth by landmark, in `world`, m
};

/// The same options give the same bits. Own projection code: what is tested with it does not test itself.
Tracks simulateTracks(const TrackOptions& options);

}  // namespace urban_nav_core::testing
