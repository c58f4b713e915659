// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_sim/session.hpp"

namespace urban_nav {

/// The stereo stream as a folder of KITTI odometry, so that other systems run on the very same frames. Each file
/// appears whole or not at all, poses.txt last. Until finish() it holds a file `simulate.unfinished`; where that is
/// found, as a run that was cut off leaves it, the folder is begun anew. Throws UserError if the folder is there and
/// not empty, or cannot be written.
class StereoFolderWriter {
 public:
  StereoFolderWriter(std::string folder, const urban_nav_sim::Session& session);

  /// `T_world_left`: where the left camera truly was. A pair of which one image is missing leaves that file out.
  void add(const urban_nav_sim::StereoMeasurement& pair, const urban_nav_core::Pose& T_world_left);
  void finish();

 private:
  void writeImage(const std::string& folder, const cv::Mat& image) const;

  std::string folder_, times_;
  urban_nav_core::StampNs first_ = 0;
  std::vector<urban_nav_core::Pose> poses_;
};

}  // namespace urban_nav
