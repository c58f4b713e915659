// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "folder/unused_files.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/folder/image_file.hpp"
#include "urban_nav_input/folder/kitti_layout.hpp"
#include "urban_nav_input/session/calibration_file.hpp"
#include "urban_nav_input/session/open.hpp"
#include "urban_nav_ros/extrinsics.hpp"
#include "urban_nav_ros/stereo_calibration.hpp"

namespace urban_nav_input {

using urban_nav_core::StereoPairWithMotion;
using urban_nav_ros::GreyImage;

namespace {

class KittiFolder : public Source {
 public:
  KittiFolder(const std::string& folder, const SourceOptions& options) : layout_(*findKittiLayout(folder)) {
    frames_ = listKittiFrames(layout_, options.rate);
    info_.name = folder;
    info_.kind = "KITTI folder";
    info_.T_base_camera = urban_nav_ros::opticalInBody();
    info_.frames = static_cast<std::int64_t>(frames_.numbers.size());
    info_.first = *std::min_element(frames_.stamps.begin(), frames_.stamps.end());
    info_.last = *std::max_element(frames_.stamps.begin(), frames_.stamps.end());
    info_.notes = frames_.notes;
    if (options.motion_input != "none")
      throw urban_nav_core::DataError(
          folder, "holds images alone, nothing for input.motion_input = " + options.motion_input, "");
    look(options.calibration);
    noteUnused(folder);
  }

  const SourceInfo& info() const override { return info_; }

  std::optional<SourceItem> next() override {
    if (position_ >= frames_.numbers.size()) return std::nullopt;
    const std::int64_t number = frames_.numbers[position_];
    SourceItem input;
    StereoPairWithMotion& assembled = input.assembled;
    assembled.pair.stamp = frames_.stamps[position_];
    std::tie(assembled.pair.left, assembled.left_owner) =
        sharedView(read(urban_nav_ros::Side::Left, number, input.faults));
    std::tie(assembled.pair.right, assembled.right_owner) =
        sharedView(read(urban_nav_ros::Side::Right, number, input.faults));
    ++position_;
    return input;
  }

 private:
  void noteUnused(const std::string& folder) {
    std::set<std::string> used = {"calib.txt", "calib_cam_to_cam.txt", "perspective.txt",
                                  "times.txt", "timestamps.txt",       "poses.txt"};
    for (const std::string& images : {layout_.left, layout_.right}) used.insert(firstPartWithin(folder, images));
    if (std::string sentence = describeUnusedFiles(folder, used); !sentence.empty())
      info_.notes.push_back(std::move(sentence));
  }

  /// Size and depth of the images, from the first that can be read, and with the size the camera.
  void look(const std::string& calibration) {
    std::string fault;
    for (const std::map<std::int64_t, std::string>* side : {&frames_.left, &frames_.right}) {
      for (const auto& [number, path] : *side) {
        const GreyImage image = urban_nav_input::readPixels(path);
        if (image.pixels.empty()) {
          if (fault.empty()) fault = image.fault;
          continue;
        }
        size_ = image.pixels.size();
        calibrate(calibration);
        lookAtDepth();
        return;
      }
    }
    throw urban_nav_core::DataError(info_.name, "no image can be read, the first: " + fault, "");
  }

  /// One range of grey values for both cameras, from the first images of each.
  void lookAtDepth() {
    constexpr std::size_t kSampledImages = 20;
    std::vector<std::string> paths;
    for (const std::map<std::int64_t, std::string>* side : {&frames_.left, &frames_.right}) {
      std::size_t seen = 0;
      for (auto image = side->begin(); image != side->end() && seen < kSampledImages; ++image, ++seen)
        paths.push_back(image->second);
    }
    scale_ = sampleGreyScale(paths);
  }

  /// By the user's files where there are any, else by the folder's.
  void calibrate(const std::string& files) {
    if (files.empty()) {
      info_.camera = readKittiCamera(layout_, size_.width, size_.height);
      return;
    }
    const auto [left, right] = readCalibration(files, size_.width, size_.height, layout_.pair);
    if (left.width != size_.width || left.height != size_.height)
      throw urban_nav_core::UserError(
          files, "images of " + sizeText(left.width, left.height),
          sizeText(size_.width, size_.height) + ", the size of the images of " + info_.name);
    calibration_.emplace(left, right, false, files);
    info_.camera = calibration_->camera();
    info_.notes.push_back("calibration: " + files);
    if (calibration_->rectifies()) info_.notes.push_back("raw images with distortion, rectified on the way");
  }

  static std::string sizeText(int width, int height) { return std::to_string(width) + "x" + std::to_string(height); }

  cv::Mat read(urban_nav_ros::Side side, std::int64_t number, std::vector<std::string>& faults) const {
    const std::map<std::int64_t, std::string>& files = side == urban_nav_ros::Side::Left ? frames_.left : frames_.right;
    const auto file = files.find(number);
    if (file == files.end()) {
      faults.push_back((side == urban_nav_ros::Side::Left ? layout_.left : layout_.right) + ": image " +
                       std::to_string(number) + " is missing");
      return {};
    }
    const GreyImage image = readGrey(file->second, scale_);
    if (!image.fault.empty()) faults.push_back(image.fault);
    if (image.pixels.empty()) return {};
    if (image.pixels.size() != size_) {
      faults.push_back(file->second + ": " + sizeText(image.pixels.cols, image.pixels.rows) +
                       " pixels where the others have " + sizeText(size_.width, size_.height));
      return {};
    }
    if (!calibration_ || !calibration_->rectifies()) return image.pixels;
    std::vector<std::uint8_t> bytes;
    const urban_nav_core::ImageView view = calibration_->rectify(side, urban_nav_ros::toView(image.pixels), bytes);
    return cv::Mat(view.height, view.width, CV_8UC1, bytes.data(), static_cast<std::size_t>(view.stride)).clone();
  }

  KittiLayout layout_;
  KittiFrames frames_;
  SourceInfo info_;
  std::optional<urban_nav_ros::StereoCalibration> calibration_;  // where the user gave one
  cv::Size size_;                                                // of the images in the folder
  urban_nav_ros::GreyScale scale_;
  std::size_t position_ = 0;
};

}  // namespace

std::unique_ptr<Source> openKittiFolder(const std::string& folder, const SourceOptions& options) {
  return std::make_unique<KittiFolder>(folder, options);
}

}  // namespace urban_nav_input
