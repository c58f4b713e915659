// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav {

/// Dense stereo at a keyframe, in figures.
struct StereoKeyframe {
  urban_nav_core::StampNs stamp = 0;
  double ms = 0.0;
  std::string reason;       ///< "none", or the defect of the pair
  std::string sentence;     ///< for the user; empty without a defect
  double answered = 0.0;    ///< share of matched pixels
  double near_share = 0.0;  ///< of these, share within the range limit
  std::string ground;       ///< "found", or the reason why there is no plane
  double tilt = 0.0;        ///< rad, between the ground's normal and base_link's z axis
  double height = 0.0;      ///< m, of the camera above the ground
  std::int64_t points = 0, obstacles = 0;

  bool hasGround() const { return ground == "found"; }
  void archive(urban_nav_core::Archive& archive) {
    archive(stamp, ms, reason, sentence, answered, near_share, ground, tilt, height, points, obstacles);
  }
};

/// A keyframe in pictures, small enough for the report.
struct StereoPicture {
  std::int64_t keyframe = 0;  ///< number
  std::string caption;
  std::vector<unsigned char> jpeg;
  int width = 0, height = 0;

  void archive(urban_nav_core::Archive& archive) { archive(keyframe, caption, jpeg, width, height); }
};

/// Dense stereo of a session.
struct StereoRun {
  std::vector<StereoKeyframe> keyframes;
  std::vector<StereoPicture> pictures;                   ///< evenly spread over the session
  std::int64_t picture_step = 1;                         ///< keyframes between pictures
  std::optional<urban_nav_core::Pose> last_T_odom_base;  ///< of the last keyframe

  void archive(urban_nav_core::Archive& archive) {
    archive(keyframes, pictures, picture_step, last_T_odom_base);
    archive.require(picture_step > 0, "no step between pictures");
  }
};

}  // namespace urban_nav
