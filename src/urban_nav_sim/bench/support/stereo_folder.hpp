// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "camera/render.hpp"
#include "camera/rig.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace urban_nav_sim::bench {

/// Writes stereo pairs as a folder of KITTI odometry, with stamps a second apart.
class StereoFolder {
 public:
  explicit StereoFolder(std::string path);

  /// Adds a pair. Throws std::runtime_error if a file cannot be written.
  void add(const std::array<cv::Mat, 2>& images, const urban_nav_core::Pose& T_world_left);
  /// Writes the true depth and class of the newest pair into `folder`, as `urban_nav simulate --views stereo`.
  void addTruth(const std::array<Picture, 2>& pictures, const std::string& folder) const;
  /// Writes times, calibration and poses.
  void finish(const std::array<Camera, 2>& cameras) const;

 private:
  std::string path_;
  std::vector<urban_nav_core::Pose> poses_;
};

}  // namespace urban_nav_sim::bench
