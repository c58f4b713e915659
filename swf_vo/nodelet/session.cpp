// SPDX-License-Identifier: BSD-3-Clause
#include "session.hpp"

#include <cmath>
#include <utility>

namespace swf_vo {

using urban_nav_core::StampNs;
using urban_nav_ros::StereoFeed;

namespace {

StampNs nanoseconds(double seconds) { return static_cast<StampNs>(std::llround(seconds * 1e9)); }

StereoFeed::Options feedOptions(const Parameters& parameters, const NodeletParameters& nodelet) {
  StereoFeed::Options options;
  options.max_lateness = nanoseconds(nodelet.max_lateness);
  options.pairing_tolerance = nanoseconds(nodelet.pairing);
  options.arrival = StereoFeed::Arrival::OrderedStreams;
  options.motion = parameters.motion_input != "none";
  return options;
}

}  // namespace

Mounting mountingOf(const urban_nav_ros::StaticTransforms& transforms, const std::string& base_frame,
                    const std::string& camera_frame, const std::string& imu_frame) {
  Mounting mounting;
  if (const auto T_base_camera = transforms.lookup(base_frame, camera_frame)) {
    mounting.T_base_optical = *T_base_camera;
    mounting.sentence = "camera at tf " + base_frame + " -> " + camera_frame;
  } else {
    mounting.T_base_optical = urban_nav_ros::opticalInBody();
    mounting.sentence = "no static tf from " + base_frame + " to " + camera_frame + ": " + base_frame +
                        " is taken to be at the left camera (REP-103 axes)";
  }
  if (const auto T_base_imu = transforms.lookup(base_frame, imu_frame)) mounting.R_base_imu = T_base_imu->R();
  return mounting;
}

Session::Session(const Parameters& parameters, const NodeletParameters& nodelet,
                 const std::shared_ptr<const urban_nav_ros::StereoCalibration>& calibration, const Mounting& mounting)
    : feed_(feedOptions(parameters, nodelet), calibration),
      filter_(parameters, calibration->camera(), mounting.T_base_optical * calibration->T_optical_rectified()),
      wheels_(parameters.wheel_noise),
      gyroscope_(parameters.gyro_noise, mounting.R_base_imu) {}

void Session::add(const SensorInput& input) {
  if (const auto* image = std::get_if<ImageInput>(&input)) {
    std::visit([&](const auto& message) { feed_.add(image->side, message); }, image->message);
  } else if (const auto* odometry = std::get_if<nav_msgs::OdometryConstPtr>(&input)) {
    if (const auto motion = wheels_.add(**odometry)) feed_.add(*motion);
  } else if (const auto motion = gyroscope_.add(*std::get<sensor_msgs::ImuConstPtr>(input))) {
    feed_.add(*motion);
  }
}

}  // namespace swf_vo
