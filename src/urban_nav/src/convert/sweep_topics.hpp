// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "convert/bag_writer.hpp"
#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_input/folder/kitti_sweeps.hpp"

namespace urban_nav {

/// Sweeps of a KITTI folder as sensor_msgs/PointCloud2 on `points`: x, y, z (m), intensity, ring if the order of the
/// points shows it, and for raw sweeps their times (KittiCloud). Empty for other folders, and if the mounting of the
/// LiDAR is unknown.
class KittiSweepTopic {
 public:
  /// `rate`: Hz, without times of the folder; 0: that of KITTI. Throws UserError for invalid stamps or calibration.
  KittiSweepTopic(const std::string& folder, double rate);

  /// Writes the sweeps up to a stamp of the folder, each with this stamp plus `shift`, ns. Throws DataError naming a
  /// file that cannot be read.
  void writeUntil(urban_nav_core::StampNs stamp, urban_nav_core::StampNs shift, BagWriter& bag);

  /// Returns the mounting relative to the rectified left camera; nullopt without sweeps.
  const std::optional<urban_nav_core::Pose>& T_camera_lidar() const { return T_camera_lidar_; }
  static const char* frame() { return "velodyne"; }
  /// Returns what a reader of the bag must know.
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  bool is_deskewed_ = false;
  std::optional<urban_nav_core::Pose> T_camera_lidar_;
  std::vector<std::pair<urban_nav_core::StampNs, std::string>> files_;
  std::size_t next_ = 0;
  std::vector<std::string> notes_;
};

}  // namespace urban_nav
