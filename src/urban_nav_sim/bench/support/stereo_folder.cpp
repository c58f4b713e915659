// SPDX-License-Identifier: BSD-3-Clause
#include "stereo_folder.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <utility>

#include "urban_nav_core/io/calibration.hpp"
#include "urban_nav_core/io/kitti.hpp"
#include "urban_nav_core/types/frames.hpp"

namespace urban_nav_sim::bench {

namespace frames = urban_nav_core::frames;

namespace {

/// Returns six digits, so that alphabetical order is the order of time.
std::string toName(std::size_t number) {
  std::string name = std::to_string(number);
  return name.insert(0, 6 - std::min<std::size_t>(6, name.size()), '0');
}

void write(const std::string& path, const cv::Mat& image) {
  if (!cv::imwrite(path, image)) throw std::runtime_error(path + ": not written");
}

}  // namespace

StereoFolder::StereoFolder(std::string path) : path_(std::move(path)) {
  for (const char* side : {"/image_0", "/image_1"}) std::filesystem::create_directories(path_ + side);
}

void StereoFolder::add(const std::array<cv::Mat, 2>& images, const urban_nav_core::Pose& T_world_left) {
  for (std::size_t side = 0; side < 2; ++side)
    write(path_ + "/image_" + std::to_string(side) + "/" + toName(poses_.size()) + ".png", images[side]);
  poses_.push_back(T_world_left);
}

void StereoFolder::addTruth(const std::array<Picture, 2>& pictures, const std::string& folder) const {
  const char* const cameras[] = {frames::kStereoLeft, frames::kStereoRight};
  for (std::size_t side = 0; side < 2; ++side) {
    const Picture& picture = pictures[side];
    cv::Mat depth(picture.height, picture.width, CV_32F), classes(picture.height, picture.width, CV_8U);
    std::copy(picture.depth.begin(), picture.depth.end(), depth.begin<float>());
    std::copy(picture.surface_class.begin(), picture.surface_class.end(), classes.begin<std::uint8_t>());
    const std::string into = folder + "/" + cameras[side];
    std::filesystem::create_directories(into);
    write(into + "/" + toName(poses_.size() - 1) + ".pfm", depth);
    write(into + "/" + toName(poses_.size() - 1) + ".png", classes);
  }
}

void StereoFolder::finish(const std::array<Camera, 2>& cameras) const {
  std::ofstream times(path_ + "/times.txt");
  for (std::size_t i = 0; i < poses_.size(); ++i) times << i << "\n";
  std::ofstream(path_ + "/calib.txt") << urban_nav_core::printKittiCalibration(
      urban_nav_core::stereoCamera(cameras[0].info, cameras[1].info, path_));
  urban_nav_core::writeKitti(path_ + "/poses.txt", poses_);
}

}  // namespace urban_nav_sim::bench
