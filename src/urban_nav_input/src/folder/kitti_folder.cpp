// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "folder/kitti_colour.hpp"
#include "folder/kitti_sweep_stream.hpp"
#include "folder/unused_files.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/folder/image_file.hpp"
#include "urban_nav_input/folder/kitti_layout.hpp"
#include "urban_nav_input/recording/bag_topics.hpp"
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
  KittiFolder(const std::string& folder, const SourceOptions& options) : baseline_scale_(options.baseline_scale) {
    info_.name = folder;
    info_.kind = "KITTI folder";
    info_.T_base_camera = urban_nav_ros::opticalInBody();
    const std::optional<KittiLayout> layout = findKittiLayout(folder);
    info_.has_images = layout.has_value();
    if (layout) listImages(*layout, options);
    if (options.with_sweeps) findSweeps(options);
    if (!layout && !options.with_sweeps)
      throw urban_nav_core::DataError(folder, "has no images, and the sweeps of its LiDAR are not used here", "");
    if (!layout && !sweeps_)
      throw urban_nav_core::DataError(
          folder,
          "has no images, and no sweep that can be used" + (info_.notes.empty() ? "" : ": " + info_.notes.back()), "");
    if (urban_nav_core::toMotionChoice(options.motion_input).is_required)
      throw urban_nav_core::DataError(folder,
                                      "has only images, no data for input.motion_input = " + options.motion_input, "");
    if (layout) look(options.calibration);
    if (layout && options.with_colour) findColour();
    describeInputs();
    noteUnused(folder);
  }

  const SourceInfo& info() const override { return info_; }

  std::optional<SourceItem> next() override {
    SourceItem input;
    const bool has_pair = position_ < frames_.numbers.size();
    const std::size_t most = has_pair ? kMostSweeps : 1;
    while (sweeps_ && sweeps_->nextStamp() && input.sweeps.size() < most &&
           (!has_pair || *sweeps_->nextStamp() <= frames_.stamps[position_]))
      if (std::optional<SweepInput> sweep = sweeps_->next()) input.sweeps.push_back(std::move(*sweep));
    if (!has_pair && input.sweeps.empty()) return std::nullopt;
    input.has_pair = has_pair && input.sweeps.size() < most;
    if (!input.has_pair) return input;
    const std::int64_t number = frames_.numbers[position_];
    StereoPairWithMotion& assembled = input.assembled;
    assembled.pair.stamp = frames_.stamps[position_];
    std::tie(assembled.pair.left, assembled.left_owner) =
        sharedView(read(urban_nav_ros::Side::Left, number, input.faults));
    std::tie(assembled.pair.right, assembled.right_owner) =
        sharedView(read(urban_nav_ros::Side::Right, number, input.faults));
    if (colour_)
      if (auto image = colour_->read(number, frames_.stamps[position_])) input.colours.push_back(std::move(*image));
    ++position_;
    return input;
  }

  std::vector<Finding> sensorFindings() const override {
    return sweeps_ ? sweeps_->findings() : std::vector<Finding>();
  }

 private:
  static constexpr std::size_t kMostSweeps = 4;  // per item

  void listImages(const KittiLayout& layout, const SourceOptions& options) {
    layout_ = layout;
    frames_ = listKittiFrames(layout_, options.rate);
    info_.frames = static_cast<std::int64_t>(frames_.numbers.size());
    info_.first = *std::min_element(frames_.stamps.begin(), frames_.stamps.end());
    info_.last = *std::max_element(frames_.stamps.begin(), frames_.stamps.end());
    info_.notes = frames_.notes;
  }

  void findSweeps(const SourceOptions& options) {
    const std::optional<KittiSweepLayout> layout = findKittiSweeps(info_.name);
    if (!layout) return;
    sweeps_.emplace(*layout, info_.T_base_camera, options);
    sweep_files_ = layout->files;
    info_.notes.insert(info_.notes.end(), sweeps_->notes().begin(), sweeps_->notes().end());
    if (!sweeps_->isPlaced()) {
      sweeps_.reset();
      return;
    }
    if (info_.has_images) return;
    info_.frames = static_cast<std::int64_t>(sweeps_->size());
    info_.first = sweeps_->first();
    info_.last = sweeps_->last();
  }

  void findColour() {
    if (layout_.pair == urban_nav_core::KittiPair::Grey) {
      colour_ = KittiColour::ofCamera2(layout_, info_.T_base_camera, info_.notes);
    } else {
      const urban_nav_core::RawCamera camera = raw_left_.value_or(urban_nav_core::RawCamera{info_.camera.left, {}});
      const urban_nav_core::Pose T_base_left =
          calibration_ ? info_.T_base_camera * calibration_->T_optical_rectified().inverse() : info_.T_base_camera;
      colour_ = KittiColour::ofPair(layout_, frames_.left, camera, T_base_left);
    }
    if (colour_) info_.colour_cameras = {colour_->camera()};
  }

  void describeInputs() {
    const auto add = [this](Role role, const std::string& folder, std::size_t files) {
      if (files == 0) return;
      InputStream stream;
      stream.role = toString(role);
      stream.topic = std::filesystem::path(folder).lexically_relative(info_.name).string();
      stream.messages = static_cast<std::int64_t>(files);
      info_.inputs.push_back(std::move(stream));
    };
    add(Role::Left, layout_.left, frames_.left.size());
    add(Role::Right, layout_.right, frames_.right.size());
    if (colour_ && layout_.pair == urban_nav_core::KittiPair::Grey)
      add(Role::Colour0, colour_->folder(), colour_->files());
    if (sweeps_) info_.inputs.push_back(sweeps_->describe());
  }

  void noteUnused(const std::string& folder) {
    std::set<std::string> used = {"calib.txt", "calib_cam_to_cam.txt", "perspective.txt",
                                  "times.txt", "timestamps.txt",       "poses.txt"};
    for (const std::string& images : {layout_.left, layout_.right}) used.insert(firstPartWithin(folder, images));
    if (colour_) used.insert(firstPartWithin(folder, colour_->folder()));
    if (sweeps_) {
      used.insert("calib_velo_to_cam.txt");
      used.insert(firstPartWithin(folder, sweep_files_));
    }
    if (std::string sentence = describeUnusedFiles(folder, used); !sentence.empty())
      info_.notes.push_back(std::move(sentence));
  }

  /// Determines size and depth of the images from the first readable one, and reads the camera for this size.
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
        findDepth();
        return;
      }
    }
    throw urban_nav_core::DataError(info_.name, "no image can be read, the first: " + fault, "");
  }

  /// Determines the common grey range of both cameras from the first images of each.
  void findDepth() {
    constexpr std::size_t kSampledImages = 20;
    std::vector<std::string> paths;
    for (const std::map<std::int64_t, std::string>* side : {&frames_.left, &frames_.right}) {
      std::size_t seen = 0;
      for (auto image = side->begin(); image != side->end() && seen < kSampledImages; ++image, ++seen)
        paths.push_back(image->second);
    }
    scale_ = sampleGreyScale(paths);
  }

  /// Reads the calibration from the files of the user, else from the folder.
  void calibrate(const std::string& files) {
    if (files.empty()) {
      info_.camera = readKittiCamera(layout_, size_.width, size_.height);
      scaleBaseline(baseline_scale_, info_.name, info_.camera);
      return;
    }
    auto [left, right] = readCalibration(files, size_.width, size_.height, layout_.pair);
    if (left.width != size_.width || left.height != size_.height)
      throw urban_nav_core::UserError(
          files, "images of " + sizeText(left.width, left.height),
          sizeText(size_.width, size_.height) + ", the size of the images of " + info_.name);
    scaleBaseline(baseline_scale_, left, right);
    calibration_.emplace(left, right, false, files);
    raw_left_ = rawCamera(withRawCamera(left), files);
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
  const double baseline_scale_;
  KittiFrames frames_;
  SourceInfo info_;
  std::optional<urban_nav_ros::StereoCalibration> calibration_;  // if given by the user
  std::optional<urban_nav_core::RawCamera> raw_left_;            // if given by the user
  std::optional<KittiColour> colour_;
  cv::Size size_;  // of the images in the folder
  urban_nav_ros::GreyScale scale_;
  std::size_t position_ = 0;
  std::optional<KittiSweepStream> sweeps_;
  std::string sweep_files_;  // folder
};

}  // namespace

std::unique_ptr<Source> openKittiFolder(const std::string& folder, const SourceOptions& options) {
  return std::make_unique<KittiFolder>(folder, options);
}

}  // namespace urban_nav_input
