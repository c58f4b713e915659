// SPDX-License-Identifier: BSD-3-Clause
#include "simulate/stereo_folder_writer.hpp"

#include <algorithm>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/kitti.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav {

namespace fs = std::filesystem;
using urban_nav_core::UserError;

namespace {

std::string projection(const char* name, const urban_nav_core::CameraInfo& info) {
  std::string line = name;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column) line += " " + urban_nav_core::printNumber(info.P(row, column));
  return line + "\n";
}

/// Returns the file that marks a folder of an interrupted run, which may be overwritten.
std::string toMark(const std::string& folder) { return folder + "/simulate.unfinished"; }

}  // namespace

StereoFolderWriter::StereoFolderWriter(std::string folder, const urban_nav_sim::Session& session)
    : folder_(std::move(folder)) {
  std::error_code error;
  if (fs::exists(folder_, error) && !fs::is_empty(folder_, error) && !fs::exists(toMark(folder_), error))
    throw UserError(folder_, "is not empty", "a new or empty folder");
  fs::create_directories(folder_, error);
  if (error) throw UserError(folder_, "cannot be made: " + error.message(), "");
  urban_nav_core::writeAtomically(toMark(folder_), "");
  for (const char* side : {"image_0", "image_1"}) {
    fs::remove_all(fs::path(folder_) / side, error);
    if (fs::create_directory(fs::path(folder_) / side, error); error)
      throw UserError(folder_, "cannot be made: " + error.message(), "");
  }
  urban_nav_core::writeAtomically(folder_ + "/calib.txt",
                                  projection("P0:", session.stereoInfo(urban_nav_sim::Side::Left)) +
                                      projection("P1:", session.stereoInfo(urban_nav_sim::Side::Right)));
}

void StereoFolderWriter::writeImage(const std::string& folder, const cv::Mat& image) const {
  if (image.empty()) return;
  std::string name = std::to_string(poses_.size());
  name.insert(0, 6 - std::min<std::size_t>(6, name.size()), '0');
  urban_nav_core::PartialFile file(folder_ + "/" + folder + "/" + name + ".png");
  if (!cv::imwrite(file.path(), image, {cv::IMWRITE_PNG_COMPRESSION, 1}))
    throw UserError(file.path(), "cannot be written", "");
  file.commit();
}

void StereoFolderWriter::add(const urban_nav_sim::StereoMeasurement& pair, const urban_nav_core::Pose& T_world_left) {
  if (poses_.empty()) first_ = pair.stamp;
  writeImage("image_0", pair.left);
  writeImage("image_1", pair.right);
  times_ += urban_nav_core::printStamp(pair.stamp - first_) + "\n";
  poses_.push_back(T_world_left);
}

void StereoFolderWriter::finish() {
  urban_nav_core::writeAtomically(folder_ + "/times.txt", times_);
  std::vector<urban_nav_core::Pose> relative;
  for (const urban_nav_core::Pose& pose : poses_) relative.push_back(poses_.front().inverse() * pose);
  urban_nav_core::writeKitti(folder_ + "/poses.txt", relative);
  fs::remove(toMark(folder_));
}

}  // namespace urban_nav
