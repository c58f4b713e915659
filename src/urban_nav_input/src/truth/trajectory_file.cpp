// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/truth/trajectory_file.hpp"

#include <cmath>
#include <filesystem>

#include "urban_nav_core/io/kitti.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/io/text_table.hpp"
#include "urban_nav_core/io/tum.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_ros/extrinsics.hpp"

namespace urban_nav_input {

using urban_nav_core::Pose;
using urban_nav_core::UserError;

namespace {

constexpr std::size_t kKittiColumns = 12;

/// Adds notes on repairs. `is_stated`: the unit of the stamps is given by the format or its header.
void note(const urban_nav_core::TumRepairs& repairs, bool is_stated, TrajectoryFile& file) {
  if (repairs.repeated > 0)
    file.notes.push_back(file.path + ": " + std::to_string(repairs.repeated) +
                         " poses left out: an earlier line has their stamp");
  if (repairs.not_finite > 0)
    file.notes.push_back(file.path + ": " + std::to_string(repairs.not_finite) +
                         " lines left out: a number is missing or not finite (NaN), or the quaternion is zero");
  if (repairs.out_of_order > 0)
    file.notes.push_back(file.path + ": " + std::to_string(repairs.out_of_order) +
                         " lines are out of order: sorted by stamp");
  if (repairs.unit < 1.0 && !is_stated)
    file.notes.push_back(file.path + ": its stamps are taken as " +
                         (repairs.unit < 2e-9   ? "ns"
                          : repairs.unit < 2e-6 ? "us"
                                                : "ms") +
                         ", not seconds");
}

}  // namespace

Pose opticalToBody(const Pose& T_first_camera) {
  const Pose T_base_camera = urban_nav_ros::opticalInBody();
  return T_base_camera * T_first_camera * T_base_camera.inverse();
}

TrajectoryFile readTrajectory(const std::string& path) {
  TrajectoryFile file;
  file.path = path;
  const std::string extension = std::filesystem::path(path).extension().string();
  const char* const allowed = ".tum, .kitti, .txt with 8 or 12 columns, .csv (EuRoC's ground truth)";
  if (extension != ".tum" && extension != ".kitti" && extension != ".txt" && extension != ".csv")
    throw UserError(path, "extension \"" + extension + "\"", allowed);
  file.stamped = extension == ".tum" || extension == ".csv";
  if (extension == ".txt") {
    const std::string text = urban_nav_core::readTextFile(path);
    file.stamped = urban_nav_core::TextTable(text, path).width() != kKittiColumns;
  }
  if (file.stamped) {
    urban_nav_core::TumRepairs repairs;
    const bool is_euroc = extension == ".csv";
    file.trajectory = urban_nav_core::readTum(
        path, &repairs, is_euroc ? urban_nav_core::PoseOrder::Euroc : urban_nav_core::PoseOrder::Tum);
    note(repairs, is_euroc && repairs.unit == 1e-9, file);
    for (const urban_nav_core::StampedPose& pose : file.trajectory) file.poses.push_back(pose.pose);
  } else {
    for (const Pose& camera : urban_nav_core::readKitti(path)) file.poses.push_back(opticalToBody(camera));
  }
  if (file.poses.empty()) throw urban_nav_core::DataError(path, "holds no poses", "");
  return file;
}

}  // namespace urban_nav_input
