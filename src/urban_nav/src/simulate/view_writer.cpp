// SPDX-License-Identifier: BSD-3-Clause
#include "simulate/view_writer.hpp"

#include <cmath>
#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <utility>

#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/io/text.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

namespace fs = std::filesystem;
using urban_nav_core::UserError;
using urban_nav_sim::ViewTruth;

namespace {

void writePicture(const std::string& path, const cv::Mat& picture) {
  urban_nav_core::PartialFile file(path);
  if (!cv::imwrite(file.path(), picture)) throw UserError(path, "cannot be written", "");
  file.commit();
}

}  // namespace

ViewWriter::ViewWriter(std::string folder) : folder_(std::move(folder)) {
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_)) {
    const std::string name = entry.path().filename().string();
    const bool is_ours = entry.is_directory() ? urban_nav_core::endsWith(name, "_optical_frame") || name == "lidar3d"
                                              : name.rfind("laser_", 0) == 0;
    if (is_ours) fs::remove_all(entry.path());
  }
}

void ViewWriter::add(const ViewTruth& view) {
  if (view.depth.rows == 1) addBeams(view);
  else addPicture(view);
}

void ViewWriter::addPicture(const ViewTruth& view) {
  const std::string folder = folder_ + "/" + view.frame, name = folder + "/" + std::to_string(view.stamp);
  std::error_code error;
  fs::create_directory(folder, error);
  if (error) throw UserError(folder, "cannot be made: " + error.message(), "");
  writePicture(name + ".pfm", view.depth);
  writePicture(name + ".png", view.surface_class);
}

void ViewWriter::addBeams(const ViewTruth& view) {
  std::unique_ptr<urban_nav_core::AtomicFile>& file = beams_[view.frame];
  if (!file) {
    file = std::make_unique<urban_nav_core::AtomicFile>(folder_ + "/" + view.frame + ".csv");
    file->write("stamp_ns,beam,range_m,class\n");
  }
  const std::string stamp = std::to_string(view.stamp);
  for (int i = 0; i < view.depth.cols; ++i) {
    const auto range = static_cast<double>(view.depth.at<float>(i));
    file->write(stamp + "," + std::to_string(i) + "," +
                (std::isfinite(range) ? urban_nav_core::printNumber(range) : std::string()) + "," +
                std::to_string(view.surface_class.at<std::uint8_t>(i)) + "\n");
  }
}

void ViewWriter::finish() {
  for (auto& [frame, file] : beams_) file->commit();
  beams_.clear();
}

}  // namespace urban_nav
