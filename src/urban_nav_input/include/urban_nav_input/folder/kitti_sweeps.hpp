// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/laser/cloud/cloud_convention.hpp"
#include "urban_nav_core/laser/cloud/sweep_reader.hpp"
#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_input {

/// Sweeps of the LiDAR in a KITTI folder: `velodyne/` of the odometry benchmark, which is deskewed, or
/// `velodyne_points/` of the raw recordings, with or without `data/` inside, which is not.
struct KittiSweepLayout {
  std::string folder;
  std::string name;   ///< "velodyne" or "velodyne_points"
  std::string files;  ///< folder of the files
  bool is_deskewed = false;
};
/// Returns nullopt without any sweep.
std::optional<KittiSweepLayout> findKittiSweeps(const std::string& folder);

/// Returns the files of sweeps, NUMBER.bin, by their number.
std::map<std::int64_t, std::string> listKittiSweeps(const KittiSweepLayout& layout);
/// Returns their stamps, as those of images (stampKittiFrames()), and files, in order of time. Throws UserError for
/// invalid stamps.
std::vector<std::pair<urban_nav_core::StampNs, std::string>> stampKittiSweeps(const KittiSweepLayout& layout,
                                                                              double rate,
                                                                              std::vector<std::string>& notes);

/// Returns T_camera_lidar of the rectified left camera of the pair that is used: the row `Tr` of calib.txt, else
/// calib_velo_to_cam.txt with the rectification of calib_cam_to_cam.txt, in the folder or above it, which are of camera
/// 0, and the offset of a colour pair; nullopt without either. Throws UserError for invalid rows.
std::optional<urban_nav_core::Pose> readKittiLidar(const std::string& folder);

/// The points of a file: little-endian float32 x, y, z (m; at the LiDAR, x forward, y left, z up) and reflectance,
/// ring by ring from the top, within a ring by rising azimuth. Read as a cloud with ring numbers from the lowest, if
/// the order shows them, and with times in the field `azimuth`, s from the middle of the sweep: the sensor turns
/// clockwise from the back, once in 0.1 s.
class KittiCloud {
 public:
  /// Does not throw: fault() states what cannot be read.
  KittiCloud(const std::string& path, urban_nav_core::StampNs stamp);

  /// Returns the view of this object, which outlives it. `is_deskewed`: without times, which have no meaning then.
  urban_nav_core::CloudView view(bool is_deskewed = false) const;
  /// Returns the defect of the file; empty without one.
  const std::string& fault() const { return fault_; }

 private:
  void addTimesAndRings(std::size_t points);

  urban_nav_core::StampNs stamp_;
  bool has_rings_ = false;
  std::string fault_;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace urban_nav_input
