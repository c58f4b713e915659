// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <tuple>

#include "folder/unused_files.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/folder/euroc_layout.hpp"
#include "urban_nav_input/folder/image_file.hpp"
#include "urban_nav_input/sensors/accelerometer_finding.hpp"
#include "urban_nav_input/sensors/pairing_examination.hpp"
#include "urban_nav_input/session/calibration_file.hpp"
#include "urban_nav_input/session/open.hpp"
#include "urban_nav_ros/accelerometer.hpp"

namespace urban_nav_input {

using urban_nav_core::UserError;
using urban_nav_ros::GreyImage;

namespace {

class EurocFolder : public Source {
 public:
  EurocFolder(const std::string& folder, const SourceOptions& options)
      : mav0_(eurocFolder(folder)),
        rig_(readEurocRig(mav0_)),
        pairs_(readEurocPairs(mav0_, &info_.notes, options.pairing)) {
    scale_ = eurocScale(pairs_);
    if (pairs_.empty()) throw UserError(mav0_, "lists no images", "cam0/data.csv and cam1/data.csv");
    info_.name = folder;
    info_.kind = "EuRoC folder";
    info_.camera = rig_.rectification.camera;
    scaleBaseline(options.baseline_scale, folder, info_.camera);
    info_.right_delay = options.pairing.right_delay;
    examinePairing(options.pairing);
    info_.T_base_camera = rig_.T_base_camera;
    info_.frames = static_cast<std::int64_t>(pairs_.size());
    info_.first = pairs_.front().stamp;
    info_.last = pairs_.back().stamp;
    if (options.motion_input == "wheels")
      throw urban_nav_core::DataError(mav0_, "has no wheel odometry for input.motion_input = wheels", "");
    readMotion(options);
    readForces(options.sensors.accelerometer);
    info_.notes.push_back("raw images, rectified on the way; base_link is at the left camera");
    if (!options.calibration.empty()) info_.notes.push_back("--calibration is ignored: sensor.yaml is used");
    if (std::string sentence = describeUnusedFiles(mav0_, {"cam0", "cam1", "imu0", "state_groundtruth_estimate0"});
        !sentence.empty())
      info_.notes.push_back(std::move(sentence));
  }

  const SourceInfo& info() const override { return info_; }
  std::vector<urban_nav_core::SpecificForce> forces() const override { return forces_; }
  std::vector<Finding> sensorFindings() const override {
    std::vector<Finding> findings = pairing_findings_;
    findings.insert(findings.end(), findings_.begin(), findings_.end());
    return findings;
  }

  std::optional<SourceItem> next() override {
    if (position_ >= pairs_.size()) return std::nullopt;
    const EurocPair& pair = pairs_[position_++];
    SourceItem input;
    input.assembled.pair.stamp = pair.stamp;
    std::tie(input.assembled.pair.left, input.assembled.left_owner) =
        sharedView(read(pair.left, "left", pair.stamp, rig_.left_map, scale_, input.faults));
    std::tie(input.assembled.pair.right, input.assembled.right_owner) =
        sharedView(read(pair.right, "right", pair.stamp, rig_.right_map, scale_, input.faults));
    for (; next_motion_ < motion_.size() && motion_[next_motion_].to <= pair.stamp; ++next_motion_)
      input.assembled.inputs.push_back(motion_[next_motion_]);
    return input;
  }

 private:
  void examinePairing(const PairingConvention& present) {
    PairingExamination pairing;
    std::array<std::int64_t, 2> missing = {{0, 0}};
    for (const EurocPair& pair : pairs_) {
      if (pair.left.empty()) ++missing[0];
      else pairing.add(0, pair.stamp);
      if (pair.right.empty()) ++missing[1];
      else pairing.add(1, pair.right_stamp);
    }
    pairing_findings_ = pairing.findings({{"cam0", "cam1"}}, missing, present);
  }

  void readMotion(const SourceOptions& options) {
    const urban_nav_core::MotionChoice choice = urban_nav_core::toMotionChoice(options.motion_input);
    if (!choice.gyroscope) return;
    urban_nav_ros::GyroMotion gyroscope(options.gyro_noise, rig_.T_base_body.R());
    try {
      for (const EurocImu& row : readEurocImu(mav0_))
        if (const auto motion = gyroscope.add(toImuMessage(row))) motion_.push_back(*motion);
    } catch (const urban_nav_core::Error&) {
      if (choice.is_required) throw;
      motion_.clear();  // readForces() notes why
    }
    if (choice.is_required && motion_.empty())
      throw urban_nav_core::DataError(mav0_, "has no imu0 for input.motion_input = gyroscope", "");
  }

  /// Reads the specific forces, used only to align the map with gravity.
  void readForces(const urban_nav_core::AccelerometerConvention& convention) {
    try {
      urban_nav_ros::Accelerometer accelerometer(rig_.T_base_body.R(), convention);
      for (const EurocImu& row : readEurocImu(mav0_))
        for (const urban_nav_core::SpecificForce& sample : accelerometer.add(toImuMessage(row)))
          forces_.push_back(sample);
      findings_ = accelerometerFindings("imu0", accelerometer.verdict(), convention);
      if (!accelerometer.verdict().sound()) forces_.clear();
    } catch (const urban_nav_core::Error& error) {
      forces_.clear();
      info_.notes.push_back(std::string("the accelerometer is ignored: ") + error.what());
    }
  }

  static cv::Mat read(const std::string& path, const char* side, urban_nav_core::StampNs stamp,
                      const urban_nav_core::RectifyMap& map, const urban_nav_ros::GreyScale& scale,
                      std::vector<std::string>& faults) {
    if (path.empty()) {
      faults.push_back(std::string(side) + " image of " + std::to_string(stamp) + " ns is missing");
      return {};
    }
    const GreyImage image = readRectified(path, map, scale);
    if (!image.fault.empty()) faults.push_back(image.fault);
    return image.pixels;
  }

  std::string mav0_;
  EurocRig rig_;
  SourceInfo info_;
  std::vector<EurocPair> pairs_;
  urban_nav_ros::GreyScale scale_;
  std::vector<urban_nav_core::MotionInput> motion_;
  std::vector<urban_nav_core::SpecificForce> forces_;
  std::vector<Finding> pairing_findings_, findings_;
  std::size_t position_ = 0, next_motion_ = 0;
};

}  // namespace

std::unique_ptr<Source> openEurocFolder(const std::string& folder, const SourceOptions& options) {
  return std::make_unique<EurocFolder>(folder, options);
}

}  // namespace urban_nav_input
