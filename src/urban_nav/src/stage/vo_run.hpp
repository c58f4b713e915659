// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "input/source.hpp"
#include "swf_vo/swf_vo.hpp"
#include "urban_nav_core/trajectory/odometry_chain.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"

namespace urban_nav {

/// One stereo frame: the row of stats.csv.
struct VoRow {
  std::int64_t frame = 0;  ///< counts stereo frames from 0, dropped ones included
  urban_nav_core::StampNs stamp = 0;
  bool accepted = true;  ///< false: dropped because of its stamp
  urban_nav_core::Status status;
  swf_vo::Statistics statistics;
  urban_nav_core::Pose T_odom_base;  ///< filtered, as live odometry publishes it
  double process_ms = 0.0;
};

/// A frame with its feature tracks, small enough for the report.
struct VoPicture {
  std::int64_t frame = 0;
  urban_nav_core::StampNs stamp = 0;
  std::string caption;
  std::vector<unsigned char> jpeg;
  int width = 0, height = 0;
};

struct VoLandmark {
  swf_vo::Landmark landmark;
  std::uint8_t grey = 0;  ///< of the pixel of its last observation
  int seen = 0;           ///< frames
};

/// Visual odometry of one session.
struct VoRun {
  std::string input;
  urban_nav_core::StereoCamera camera;
  urban_nav_core::Pose T_base_camera;
  std::vector<VoRow> rows;               ///< one per stereo frame
  std::vector<swf_vo::Settled> settled;  ///< smoothed poses, one per accepted frame that has left the window
  std::map<swf_vo::LandmarkId, VoLandmark> landmarks;
  swf_vo::RigConstants rig;         ///< as known at the end
  std::vector<VoPicture> pictures;  ///< evenly spread over the session
  std::vector<urban_nav_core::SpecificForce>
      forces;                       ///< specific forces around smoothed frames; empty without an accelerometer
  std::vector<std::string> faults;  ///< of the data, each with its file or topic; at most kMaxFaults
  std::int64_t faults_total = 0;
};
constexpr std::size_t kMaxFaults = 100;

/// Returns the smoothed poses of base_link in `odom`.
urban_nav_core::Trajectory smoothedTrajectory(const VoRun& run);
/// Returns the smoothed steps between them.
urban_nav_core::OdometryChain odometryChain(const VoRun& run);

}  // namespace urban_nav
