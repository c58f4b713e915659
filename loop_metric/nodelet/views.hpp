// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/CameraInfo.h>

#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "loop_metric/keyframe.hpp"
#include "loop_metric/keyframe_choice.hpp"
#include "nodelet_parameters.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"
#include "urban_nav_ros/extrinsics.hpp"
#include "urban_nav_ros/stereo_feed.hpp"
#include "urban_nav_store/keyframe_store.hpp"

namespace loop_metric {

/// An image of one side as it came, raw or compressed.
struct ImageInput {
  urban_nav_ros::Side side;
  std::variant<sensor_msgs::ImageConstPtr, sensor_msgs::CompressedImageConstPtr> message;
  urban_nav_core::StampNs stamp;
};

/// The calibration of one side.
struct InfoInput {
  urban_nav_ros::Side side;
  sensor_msgs::CameraInfoConstPtr message;
};

/// A stereo camera and its left side's place on the robot.
struct CameraAt {
  urban_nav_core::StereoCamera camera;
  urban_nav_core::Pose T_base_left;
};

/// From images, camera_info and odometry as it is at the moment to the views that are kept: the same pairs and the same choice as offline. Used by one
/// thread.
class Views {
 public:
  struct Counts {
    std::int64_t pairs = 0, kept = 0;
    std::int64_t damaged = 0;   ///< images that do not decode or have a wrong size
    std::int64_t unplaced = 0;  ///< pairs for which odometry has no pose
  };

  /// `where`: what an error about the calibration begins with. `transforms` must outlive it.
  Views(const Parameters& parameters, const ListeningParameters& listening, bool rectified, std::string where,
        const urban_nav_ros::StaticTransforms& transforms);

  void add(urban_nav_ros::Side side, const sensor_msgs::CameraInfoConstPtr& info);
  /// True where time has gone back: what comes from now on is of another recording.
  bool add(const ImageInput& image);
  void hear(const urban_nav_core::StampedPose& odometry);
  /// Those that are ready since the last call, in order of time.
  std::vector<urban_nav_store::StoredKeyframe> take();

  /// Empty until the calibration, and the camera's place, are known.
  const std::optional<CameraAt>& camera() const { return camera_; }
  /// Why there are no views although images come; empty: nothing is wrong. And what was assumed of the camera's place.
  const std::string& fault() const { return fault_; }
  const std::string& note() const { return note_; }
  const Counts& counts() const { return counts_; }

 private:
  using Clock = std::chrono::steady_clock;
  void tryToStart();
  void begin();
  void forgetTime();

  const Parameters parameters_;
  const ListeningParameters listening_;
  const bool rectified_;
  const std::string where_;
  const urban_nav_ros::StaticTransforms& transforms_;
  sensor_msgs::CameraInfoConstPtr left_info_, right_info_;
  std::optional<Clock::time_point> first_image_;
  std::optional<urban_nav_core::StampNs> newest_image_, newest_pose_;
  std::deque<ImageInput> before_;  // the calibration was known
  std::shared_ptr<const urban_nav_ros::StereoCalibration> calibration_;
  std::optional<CameraAt> camera_;
  std::optional<KeyframeMaker> maker_;
  std::optional<urban_nav_ros::StereoFeed> feed_;
  KeyframeChoice choice_;
  std::deque<urban_nav_ros::DecodedPair> pairs_;      // for odometry
  std::deque<urban_nav_core::StampedPose> odometry_;  // for pairs
  std::string fault_, note_;
  Counts counts_;
};

}  // namespace loop_metric
