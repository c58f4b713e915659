// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <tuple>

#include "input/image_file.hpp"
#include "input/kitti_layout.hpp"
#include "input/open.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_ros/extrinsics.hpp"

namespace urban_nav {

using urban_nav_core::AssembledPair;
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
    look();
  }

  const SourceInfo& info() const override { return info_; }

  std::optional<StereoInput> next() override {
    if (position_ >= frames_.numbers.size()) return std::nullopt;
    const std::int64_t number = frames_.numbers[position_];
    StereoInput input;
    AssembledPair& assembled = input.assembled;
    assembled.pair.stamp = frames_.stamps[position_];
    std::tie(assembled.pair.left, assembled.left_owner) = keep(read(frames_.left, layout_.left, number, input.faults));
    std::tie(assembled.pair.right, assembled.right_owner) =
        keep(read(frames_.right, layout_.right, number, input.faults));
    ++position_;
    return input;
  }

 private:
  /// Size and depth of the images, from the first that can be read, and with the size the camera.
  void look() {
    std::string fault;
    for (const std::map<std::int64_t, std::string>* side : {&frames_.left, &frames_.right}) {
      for (const auto& [number, path] : *side) {
        const GreyImage image = urban_nav::readPixels(path);
        if (image.pixels.empty()) {
          if (fault.empty()) fault = image.fault;
          continue;
        }
        info_.camera = readKittiCamera(layout_, image.pixels.cols, image.pixels.rows);
        bits_ = urban_nav_ros::significantBits(image.pixels);
        return;
      }
    }
    throw urban_nav_core::DataError(info_.name, "no image can be read, the first: " + fault, "");
  }

  cv::Mat read(const std::map<std::int64_t, std::string>& files, const std::string& folder, std::int64_t number,
               std::vector<std::string>& faults) const {
    const auto file = files.find(number);
    if (file == files.end()) {
      faults.push_back(folder + ": image " + std::to_string(number) + " is missing");
      return {};
    }
    const GreyImage image = readGrey(file->second, bits_);
    if (!image.fault.empty()) faults.push_back(image.fault);
    if (image.pixels.empty()) return {};
    if (image.pixels.cols != info_.camera.left.width || image.pixels.rows != info_.camera.left.height) {
      faults.push_back(file->second + ": " + std::to_string(image.pixels.cols) + "x" +
                       std::to_string(image.pixels.rows) + " pixels where the others have " +
                       std::to_string(info_.camera.left.width) + "x" + std::to_string(info_.camera.left.height));
      return {};
    }
    return image.pixels;
  }

  KittiLayout layout_;
  KittiFrames frames_;
  SourceInfo info_;
  int bits_ = 16;
  std::size_t position_ = 0;
};

}  // namespace

std::unique_ptr<Source> openKittiFolder(const std::string& folder, const SourceOptions& options) {
  return std::make_unique<KittiFolder>(folder, options);
}

}  // namespace urban_nav
