// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_sim/session.hpp"

namespace urban_nav {

/// Writes the stereo stream as a folder of KITTI odometry, for other systems on the same frames. Files appear
/// atomically, poses.txt last. Until finish() the folder has a file `simulate.unfinished`; a folder with that file,
/// left by an interrupted run, is written again from the beginning. Throws UserError if the folder exists and is not
/// empty, or cannot be written.
class StereoFolderWriter {
 public:
  StereoFolderWriter(std::string folder, const urban_nav_sim::Session& session);

  /// `T_world_left`: true pose of the left camera. The file of a missing image is omitted.
  void add(const urban_nav_sim::StereoMeasurement& pair, const urban_nav_core::Pose& T_world_left);
  void finish();

 private:
  void writeImage(const std::string& folder, const cv::Mat& image) const;

  std::string folder_, times_;
  urban_nav_core::StampNs first_ = 0;
  std::vector<urban_nav_core::Pose> poses_;
};

}  // namespace urban_nav
