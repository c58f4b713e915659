// SPDX-License-Identifier: BSD-3-Clause
#include "folder/kitti_colour.hpp"

#include <boost/make_shared.hpp>
#include <filesystem>
#include <utility>

#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_input {

namespace fs = std::filesystem;
using urban_nav_core::KittiPair;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_ros::RecordedImage;

namespace {

RecordedImage readRecorded(const std::string& path, StampNs stamp) {
  auto message = boost::make_shared<sensor_msgs::CompressedImage>();
  message->header.stamp = urban_nav_ros::toRosTime(stamp);
  message->format = fs::path(path).extension().string();
  try {
    const std::string bytes = urban_nav_core::readBytes(path);
    message->data.assign(bytes.begin(), bytes.end());
  } catch (const urban_nav_core::UserError&) {  // as an image that cannot be decoded
  }
  return RecordedImage(sensor_msgs::CompressedImageConstPtr(message));
}

}  // namespace

std::optional<KittiColour> KittiColour::ofCamera2(const KittiLayout& layout, const Pose& T_base_camera,
                                                  std::vector<std::string>& notes) {
  if (layout.pair != KittiPair::Grey) return std::nullopt;
  for (const char* name : {"image_2", "image_02"}) {
    fs::path images = fs::path(layout.folder) / name;
    for (const char* inside : {"data", "data_rect"})
      if (fs::is_directory(images / inside)) images /= inside;
    KittiColour found;
    found.folder_ = images.string();
    found.files_ = listFrames(found.folder_);
    if (found.files_.empty()) continue;
    const auto leave = [&](const std::string& reason) {
      notes.push_back(std::string(name) + " does not colour the map: " + reason);
      return std::nullopt;
    };
    const RecordedImage first = readRecorded(found.files_.begin()->second, 0);
    const urban_nav_ros::ColourImage image = first.colour();
    if (image.pixels.empty()) return leave(image.fault);
    if (!first.hasColour()) return leave("its images are grey");
    try {
      const urban_nav_core::StereoCamera pair =
          readKittiCamera({layout.folder, "", "", KittiPair::Colour}, image.pixels.cols, image.pixels.rows);
      urban_nav_core::RawCamera camera;
      camera.pinhole = pair.left;
      const urban_nav_core::Vector3d offset =
          readKittiOffset(layout.folder, KittiPair::Grey) - readKittiOffset(layout.folder, KittiPair::Colour);
      const Pose T_camera_colour(urban_nav_core::Quaterniond::Identity(), offset);
      found.camera_ = {"colour0", name, "camera_2", T_base_camera * T_camera_colour, camera};
    } catch (const urban_nav_core::UserError& error) {
      return leave(error.what());
    }
    return found;
  }
  return std::nullopt;
}

std::optional<KittiColour> KittiColour::ofPair(const KittiLayout& layout,
                                               const std::map<std::int64_t, std::string>& files,
                                               const urban_nav_core::RawCamera& camera, const Pose& T_base_camera) {
  if (files.empty() || !readRecorded(files.begin()->second, 0).hasColour()) return std::nullopt;
  KittiColour found;
  found.folder_ = layout.left;
  found.files_ = files;
  found.camera_ = {"left", fs::path(layout.left).lexically_relative(layout.folder).string(), "left", T_base_camera,
                  camera};
  return found;
}

std::optional<ColourInput> KittiColour::read(std::int64_t number, StampNs stamp) const {
  const auto file = files_.find(number);
  if (file == files_.end()) return std::nullopt;
  return ColourInput{0, stamp, readRecorded(file->second, stamp)};
}

}  // namespace urban_nav_input
