// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/truth/trajectory_file.hpp"

#include <cmath>
#include <filesystem>

#include "folder/text_lines.hpp"
#include "urban_nav_core/io/csv.hpp"
#include "urban_nav_core/io/kitti.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/io/tum.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_ros/extrinsics.hpp"

namespace urban_nav_input {

using urban_nav_core::Pose;
using urban_nav_core::UserError;

namespace {

/// EuRoC's ground truth as the lines of a TUM file, so that one reader judges stamps and order.
std::string eurocLinesAsTum(const std::string& path) {
  const urban_nav_core::CsvTable table = urban_nav_core::CsvTable::read(path);
  if (table.header().size() < 8)
    throw UserError(path, std::to_string(table.header().size()) + " columns",
                    "EuRoC's: stamp in ns, position, quaternion w x y z");
  std::string text;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    for (const std::size_t column : {0, 1, 2, 3, 5, 6, 7, 4}) text += table.text(row, column) + " ";
    text += "\n";
  }
  return text;
}

void note(const urban_nav_core::TumRepairs& repairs, TrajectoryFile& file) {
  if (repairs.repeated > 0)
    file.notes.push_back(file.path + ": " + std::to_string(repairs.repeated) +
                         " poses left out: an earlier line has their stamp");
  if (repairs.out_of_order > 0)
    file.notes.push_back(file.path + ": " + std::to_string(repairs.out_of_order) +
                         " lines are earlier than the one before: sorted by stamp");
  if (repairs.unit < 1.0)
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
    const std::vector<TextLine> lines = readLines(path);
    file.stamped = !lines.empty() && urban_nav_core::splitBlanks(lines.front().text).size() == 8;
  }
  if (file.stamped) {
    urban_nav_core::TumRepairs repairs;
    file.trajectory = extension == ".csv" ? urban_nav_core::parseTum(eurocLinesAsTum(path), path, &repairs)
                                          : urban_nav_core::readTum(path, &repairs);
    if (extension == ".csv") repairs.unit = 1.0;  // ns is the unit of that format
    note(repairs, file);
    for (const urban_nav_core::StampedPose& pose : file.trajectory) file.poses.push_back(pose.pose);
  } else {
    for (const Pose& camera : urban_nav_core::readKitti(path)) file.poses.push_back(opticalToBody(camera));
  }
  if (file.poses.empty()) throw urban_nav_core::DataError(path, "holds no poses", "");
  return file;
}

}  // namespace urban_nav_input
