// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "map/session_odometry.hpp"
#include "swf_vo/swf_vo.hpp"

namespace urban_nav {

/// Figures of one stereo frame, for stats.csv and the report.
struct VoFigures {
  swf_vo::Statistics statistics;
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
  std::uint8_t grey = 0;  ///< of its pixel in the last observation
  int seen = 0;           ///< frames
};

/// Visual odometry of one session.
struct VoRun : SessionOdometry {
  std::vector<VoFigures> figures;  ///< one per element of `frames`
  std::map<swf_vo::LandmarkId, VoLandmark> landmarks;
  swf_vo::RigConstants rig;         ///< as known at the end
  swf_vo::MotionEstimates motion;   ///< as known at the end
  std::vector<VoPicture> pictures;  ///< evenly spread over the session
};

}  // namespace urban_nav
