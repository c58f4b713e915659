// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/session/open.hpp"

#include <filesystem>

#include "session/foreign_input.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/folder/kitti_layout.hpp"
#include "urban_nav_input/folder/kitti_sweeps.hpp"
#include "urban_nav_input/recording/recording.hpp"

namespace urban_nav_input {

namespace fs = std::filesystem;
using urban_nav_core::UserError;

namespace {

constexpr const char* kKnownInputs =
    "a recording (ROS 1 bag, MCAP, .db3, folder of rosbag2), a KITTI folder"
    " (image_0/, image_1/, calib.txt; image_00/data/ too; velodyne/ or velodyne_points/), a EuRoC folder (mav0/), or a "
    "New "
    "College folder (*.alog, StereoImages/)";

bool hasAlog(const std::string& folder) {
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".alog") return true;
  }
  return false;
}

}  // namespace

InputKind inputKind(const std::string& path) {
  if (!fs::exists(path)) throw UserError(path, "does not exist", kKnownInputs);
  if (!fs::is_directory(path)) {
    if (!fs::is_regular_file(path)) throw UserError(path, "is neither a file nor a folder", kKnownInputs);
    if (isRecording(path)) return InputKind::Bag;
    if (const auto foreign = recogniseForeignInput(path)) throw UserError(path, foreign->found, foreign->remedy);
    throw UserError(path, "is not a recording (ROS 1 bag, MCAP or .db3 of rosbag2)", kKnownInputs);
  }
  if (findKittiLayout(path) || findKittiSweeps(path)) return InputKind::KittiFolder;
  if (fs::is_directory(fs::path(path) / "mav0") || fs::is_directory(fs::path(path) / "cam0"))
    return InputKind::EurocFolder;
  if (fs::is_directory(fs::path(path) / "StereoImages") || hasAlog(path)) return InputKind::NewCollegeFolder;
  if (isRecording(path)) return InputKind::Bag;
  if (const auto foreign = recogniseForeignInput(path)) throw UserError(path, foreign->found, foreign->remedy);
  throw UserError(path, "contains no known kind of input", kKnownInputs);
}

std::unique_ptr<Source> openSource(const std::vector<std::string>& paths, const SourceOptions& options,
                                   const BagEnd* after, const ReceiptRange& part) {
  const InputKind kind = inputKind(paths.front());
  if (kind != InputKind::Bag && !options.topics.empty())
    throw UserError("--topic or --preset: " + options.topics.front(),
                    "names topics, but " + paths.front() + " is a folder", "for bags only");
  switch (kind) {
    case InputKind::KittiFolder: return openKittiFolder(paths.front(), options);
    case InputKind::NewCollegeFolder: return openNewCollegeFolder(paths.front(), options);
    case InputKind::EurocFolder: return openEurocFolder(paths.front(), options);
    case InputKind::Bag: return openBags(paths, options, after, part);
  }
  throw UserError(paths.front(), "contains no known kind of input", kKnownInputs);
}

}  // namespace urban_nav_input
