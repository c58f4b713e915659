// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "urban_nav_live/stage_report.hpp"
#include "urban_nav_live/time_jump.hpp"
#include "urban_nav_ros/grey_range.hpp"
#include "urban_nav_ros/rectification_judge.hpp"
#include "urban_nav_ros/stereo_input.hpp"

namespace urban_nav_ros {

/// Decodes and rectifies the images of a stereo camera, with the same result as StereoFeed. Rectified images are passed
/// through, without a copy if they are mono8 and keep their stamp. Used by one thread.
///
/// Images that arrive before the calibration are queued. An image that cannot be decoded or has a wrong size becomes a
/// message without pixels, so that it is reported missing at once instead of after a timeout.
class StereoRectifier {
 public:
  struct Options {
    bool rectified = false;      ///< the images are rectified already
    bool judges_images = false;  ///< `rectified` is uncertain: the first pairs decide, if possible
    /// Delay of the stamps of right images relative to those of left images with the same exposure, ns.
    urban_nav_core::StampNs right_delay = 0;
    int queue = 200;               ///< capacity, images that wait for the calibration
    std::string where = "stereo";  ///< prefix of errors of the calibration
  };
  struct Listener {
    std::function<void(Side side, const sensor_msgs::ImageConstPtr& image)> image;
    std::function<void(const std::string& fault)> fault;  ///< reports an image or the calibration
  };
  struct Counts {
    std::int64_t rectified = 0, passed = 0, damaged = 0, dropped = 0;  ///< images
  };

  StereoRectifier(Options options, Listener listener)
      : options_(std::move(options)),
        listener_(std::move(listener)),
        judge_(options_.rectified, options_.judges_images) {}

  void handle(const InfoInput& info);
  void handle(ImageInput image);
  /// Drops the waiting images.
  void reset();

  const Counts& counts() const { return counts_; }
  /// Returns the state for the operator: a warning until the calibration is known, and for an implausible one.
  urban_nav_live::StageReport report() const;

 private:
  void calibrate();
  void forgetStream();
  void process(const ImageInput& image);
  sensor_msgs::ImageConstPtr convert(const ImageInput& image, std::string& fault);

  const Options options_;
  const Listener listener_;
  sensor_msgs::CameraInfoConstPtr left_info_, right_info_;
  RectificationJudge judge_;
  std::optional<StereoCalibration> calibration_;
  std::deque<ImageInput> waiting_;  // images before the calibration
  urban_nav_live::TimeJumpDetector images_;
  GreyRange range_;    // 16-bit pixels of both cameras
  std::string fault_;  // fault of the calibration
  Counts counts_;
};

}  // namespace urban_nav_ros
