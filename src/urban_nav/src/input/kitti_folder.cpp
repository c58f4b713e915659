// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "input/image_file.hpp"
#include "input/kitti_layout.hpp"
#include "input/open.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_ros/extrinsics.hpp"

namespace urban_nav {

using urban_nav_core::AssembledPair;
using urban_nav_core::StampNs;
using urban_nav_core::UserError;
using urban_nav_ros::GreyImage;

namespace {

constexpr double kUsualRate = 10.0;  // Hz, of KITTI's cameras

class KittiFolder : public Source {
 public:
  KittiFolder(const std::string& folder, const SourceOptions& options) : layout_(*findKittiLayout(folder)) {
    left_ = listFrames(layout_.left);
    right_ = listFrames(layout_.right);
    if (left_.empty() && right_.empty()) throw UserError(layout_.left, "holds no images named by numbers", "000000.png, 000001.png, ...");
    info_.name = folder;
    info_.kind = "KITTI folder";
    info_.T_base_camera = urban_nav_ros::opticalInBody();
    info_.camera = readKittiCamera(layout_);
    listStamps(options);
    look();
  }

  const SourceInfo& info() const override { return info_; }

  std::optional<StereoInput> next() override {
    if (position_ >= frames_.size()) return std::nullopt;
    const std::int64_t number = frames_[position_];
    StereoInput input;
    AssembledPair& assembled = input.assembled;
    assembled.pair.stamp = stamps_[position_];
    std::tie(assembled.pair.left, assembled.left_owner) = keep(read(left_, layout_.left, number, input.faults));
    std::tie(assembled.pair.right, assembled.right_owner) = keep(read(right_, layout_.right, number, input.faults));
    ++position_;
    return input;
  }

 private:
  /// Frames are all numbers that either camera has; a stamp belongs to each, by its place where the counts agree, by its number elsewhere.
  void listStamps(const SourceOptions& options) {
    std::set<std::int64_t> numbers;
    for (const auto& [number, path] : left_) numbers.insert(number);
    for (const auto& [number, path] : right_) numbers.insert(number);
    const std::int64_t first = *numbers.begin(), last = *numbers.rbegin();
    const KittiTimes times = readKittiTimes(layout_);
    if (times.path.empty()) {
      const double rate = options.rate > 0.0 ? options.rate : kUsualRate;
      for (std::int64_t number = first; number <= last; ++number) {
        frames_.push_back(number);
        stamps_.push_back(static_cast<StampNs>(std::llround(static_cast<double>(number - first) * 1e9 / rate)));
      }
      if (options.rate <= 0.0) info_.notes.push_back("no times.txt: taken as 10 Hz (--rate says otherwise)");
      finishStamps();
      return;
    }
    const auto rows = static_cast<std::int64_t>(times.stamps.size());
    if (last < rows) {
      for (std::int64_t number = first; number <= last; ++number) {
        frames_.push_back(number);
        stamps_.push_back(times.stamps[static_cast<std::size_t>(number)]);
      }
      if (last + 1 < rows) info_.notes.push_back(times.path + " has " + std::to_string(rows) + " stamps, the images end at number " + std::to_string(last));
    } else if (last - first + 1 == rows) {
      for (std::int64_t i = 0; i < rows; ++i) {
        frames_.push_back(first + i);
        stamps_.push_back(times.stamps[static_cast<std::size_t>(i)]);
      }
    } else {
      throw UserError(times.path, std::to_string(rows) + " stamps for images " + std::to_string(first) + " to " + std::to_string(last), "one line for each image");
    }
    finishStamps();
  }

  void finishStamps() {
    info_.frames = static_cast<std::int64_t>(frames_.size());
    info_.first = *std::min_element(stamps_.begin(), stamps_.end());
    info_.last = *std::max_element(stamps_.begin(), stamps_.end());
  }

  /// Size and depth of the images, from the first that can be read.
  void look() {
    std::string fault;
    for (const std::map<std::int64_t, std::string>* side : {&left_, &right_}) {
      for (const auto& [number, path] : *side) {
        const GreyImage image = urban_nav::readPixels(path);
        if (image.pixels.empty()) {
          if (fault.empty()) fault = image.fault;
          continue;
        }
        info_.camera.left.width = image.pixels.cols;
        info_.camera.left.height = image.pixels.rows;
        bits_ = urban_nav_ros::significantBits(image.pixels);
        return;
      }
    }
    throw urban_nav_core::DataError(info_.name, "no image can be read, the first: " + fault, "");
  }

  cv::Mat read(const std::map<std::int64_t, std::string>& files, const std::string& folder, std::int64_t number, std::vector<std::string>& faults) const {
    const auto file = files.find(number);
    if (file == files.end()) {
      faults.push_back(folder + ": image " + std::to_string(number) + " is missing");
      return {};
    }
    const GreyImage image = readGrey(file->second, bits_);
    if (!image.fault.empty()) faults.push_back(image.fault);
    if (image.pixels.empty()) return {};
    if (image.pixels.cols != info_.camera.left.width || image.pixels.rows != info_.camera.left.height) {
      faults.push_back(file->second + ": " + std::to_string(image.pixels.cols) + "x" + std::to_string(image.pixels.rows) + " pixels where the others have " +
                       std::to_string(info_.camera.left.width) + "x" + std::to_string(info_.camera.left.height));
      return {};
    }
    return image.pixels;
  }

  KittiLayout layout_;
  std::map<std::int64_t, std::string> left_, right_;  // frame number to file
  std::vector<std::int64_t> frames_;
  std::vector<StampNs> stamps_;
  SourceInfo info_;
  int bits_ = 16;
  std::size_t position_ = 0;
};

}  // namespace

std::unique_ptr<Source> openKittiFolder(const std::string& folder, const SourceOptions& options) {
  return std::make_unique<KittiFolder>(folder, options);
}

}  // namespace urban_nav
