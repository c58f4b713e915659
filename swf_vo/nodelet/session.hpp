// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "nodelet_parameters.hpp"
#include "swf_vo/swf_vo.hpp"
#include "urban_nav_ros/extrinsics.hpp"
#include "urban_nav_ros/stereo_feed.hpp"

namespace swf_vo {

/// An image of one side as it came, raw or compressed.
struct ImageInput {
  urban_nav_ros::Side side;
  std::variant<sensor_msgs::ImageConstPtr, sensor_msgs::CompressedImageConstPtr> message;
  urban_nav_core::StampNs stamp;
};
using SensorInput = std::variant<ImageInput, nav_msgs::OdometryConstPtr, sensor_msgs::ImuConstPtr>;

/// Where the left camera sits on the robot, and how that is known.
struct Mounting {
  urban_nav_core::Pose T_base_optical;
  urban_nav_core::Matrix3d R_base_imu = urban_nav_core::Matrix3d::Identity();
  std::string sentence;
};

/// From the static transforms; where they do not connect the frames, base_link is at the left camera with REP-103 axes.
Mounting mountingOf(const urban_nav_ros::StaticTransforms& transforms, const std::string& base_frame,
                    const std::string& camera_frame, const std::string& imu_frame);

/// One unbroken run of the filter: a calibration, a feed, a SwfVo. Used by the worker alone.
class Session {
 public:
  /// Throws UserError where the calibration is none.
  Session(const Parameters& parameters, const NodeletParameters& nodelet,
          const std::shared_ptr<const urban_nav_ros::StereoCalibration>& calibration, const Mounting& mounting);

  void add(const SensorInput& input);
  /// The next stereo pair that is ready; process it before the next call.
  std::optional<urban_nav_ros::FedPair> take() { return feed_.take(); }
  const Frame& process(const urban_nav_core::AssembledPair& pair) { return filter_.process(pair.pair, pair.inputs); }
  /// What waits in the feed may leave; then take() until it is empty, then flush().
  void finish() { feed_.finish(); }
  std::vector<Settled> flush() { return filter_.flush(); }

  const urban_nav_ros::StereoFeed& feed() const { return feed_; }

 private:
  urban_nav_ros::StereoFeed feed_;
  SwfVo filter_;
  urban_nav_ros::WheelMotion wheels_;
  urban_nav_ros::GyroMotion gyroscope_;
};

}  // namespace swf_vo
