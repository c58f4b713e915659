// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <tuple>

#include "urban_nav_core/types/error.hpp"
#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_input/folder/image_file.hpp"
#include "urban_nav_input/folder/new_college_files.hpp"
#include "urban_nav_input/folder/new_college_log.hpp"
#include "urban_nav_input/folder/new_college_rig.hpp"
#include "urban_nav_input/session/open.hpp"
#include "urban_nav_ros/pose.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_input {

using urban_nav_core::DataError;
using urban_nav_core::StampNs;

namespace {

class NewCollegeFolder : public Source {
 public:
  NewCollegeFolder(const std::string& folder, const SourceOptions& options) : files_(findNewCollege(folder)) {
    if (files_.stereo.empty()) throw DataError(folder, "has no StereoImages, which visual odometry needs", "");
    info_.name = folder;
    info_.kind = "New College folder";
    info_.camera = newCollegeCamera();
    info_.T_base_camera = newCollegeLeftCamera();
    info_.frames = static_cast<std::int64_t>(files_.stereo.size());
    info_.first = files_.stereo.front().stamp;
    info_.last = files_.stereo.back().stamp;
    info_.notes.push_back(
        "images assumed rectified, with the calibration of the data set; the pose of the camera on the robot is "
        "unknown: 0.1 "
        "m ahead, 1.1 m up");
    if (!options.calibration.empty()) info_.notes.push_back("--calibration is ignored: that of the data set is used");
    if (options.motion_input == "gyroscope")
      throw DataError(folder, "has no IMU for input.motion_input = gyroscope", "");
    const urban_nav_core::MotionChoice motion = urban_nav_core::toMotionChoice(options.motion_input);
    if (motion.wheels && (motion.is_required || !files_.alog.empty())) openLog(folder, options.wheel_noise);
  }

  const SourceInfo& info() const override { return info_; }

  std::optional<SourceItem> next() override {
    if (position_ >= files_.stereo.size()) return std::nullopt;
    const NewCollegeFiles::Pair& files = files_.stereo[position_++];
    SourceItem input;
    urban_nav_core::StereoPairWithMotion& assembled = input.assembled;
    assembled.pair.stamp = files.stamp;
    std::tie(assembled.pair.left, assembled.left_owner) = sharedView(read(files.left, files.stamp, input.faults));
    std::tie(assembled.pair.right, assembled.right_owner) = sharedView(read(files.right, files.stamp, input.faults));
    for (; motion_ && motion_->to <= files.stamp; nextMotion()) assembled.inputs.push_back(*motion_);
    return input;
  }

 private:
  void openLog(const std::string& folder, double noise) {
    if (files_.alog.empty()) throw DataError(folder, "has no .alog for input.motion_input = wheels", "");
    log_.emplace(files_.alog);
    wheels_.emplace(noise);
    nextMotion();
  }

  void nextMotion() {
    motion_.reset();
    while (const std::optional<NewCollegeEvent> event = log_->next()) {
      const auto* odometry = std::get_if<NewCollegeOdometry>(&*event);
      if (odometry == nullptr) continue;
      const urban_nav_core::PoseWithCovariance pose{odometry->T_odom_base, urban_nav_core::Matrix6d::Zero()};
      motion_ = wheels_->add(urban_nav_ros::toOdometryMessage(odometry->stamp, pose, urban_nav_core::frames::kOdom,
                                                              urban_nav_core::frames::kBaseLink));
      if (motion_) return;
    }
  }

  cv::Mat read(const std::string& path, StampNs stamp, std::vector<std::string>& faults) const {
    if (path.empty()) {
      faults.push_back("one image of " + urban_nav_core::printStamp(stamp) + " s is missing");
      return {};
    }
    const urban_nav_ros::GreyImage image = readGrey(path, {});
    if (!image.fault.empty()) faults.push_back(image.fault);
    if (image.pixels.empty()) return {};
    if (image.pixels.cols != info_.camera.left.width || image.pixels.rows != info_.camera.left.height) {
      faults.push_back(path + ": " + std::to_string(image.pixels.cols) + "x" + std::to_string(image.pixels.rows) +
                       " pixels where the calibration is for 512x384");
      return {};
    }
    return image.pixels;
  }

  const NewCollegeFiles files_;
  SourceInfo info_;
  std::optional<NewCollegeLog> log_;
  std::optional<urban_nav_ros::WheelMotion> wheels_;
  std::optional<urban_nav_core::MotionInput> motion_;
  std::size_t position_ = 0;
};

}  // namespace

std::unique_ptr<Source> openNewCollegeFolder(const std::string& folder, const SourceOptions& options) {
  return std::make_unique<NewCollegeFolder>(folder, options);
}

}  // namespace urban_nav_input
