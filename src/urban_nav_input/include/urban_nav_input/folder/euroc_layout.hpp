// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/Imu.h>

#include <optional>
#include <string>
#include <vector>

#include "urban_nav_core/camera/raw_camera.hpp"
#include "urban_nav_core/camera/rectify.hpp"
#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"
#include "urban_nav_input/sensors/pairing_examination.hpp"
#include "urban_nav_ros/image.hpp"

namespace urban_nav_input {

/// A pair of file names; one may be empty.
struct EurocPair {
  urban_nav_core::StampNs stamp = 0;
  std::string left, right;
  urban_nav_core::StampNs right_stamp = 0;  ///< of the right image, as recorded; 0 without one
};
/// A row of imu0/data.csv of a EuRoC folder.
struct EurocImu {
  urban_nav_core::StampNs stamp = 0;
  urban_nav_core::Vector3d rate = urban_nav_core::Vector3d::Zero();          ///< rad/s, in the body frame
  urban_nav_core::Vector3d acceleration = urban_nav_core::Vector3d::Zero();  ///< m/s^2
  double rate_sigma = 0.0;  ///< rad/s, of one rate by sensor.yaml; 0: not stated
};

/// The two cameras of a EuRoC folder, and the rectified pair. base_link is at the rectified left camera, with REP-103
/// axes.
struct EurocRig {
  urban_nav_core::RawCamera left, right;
  urban_nav_core::StereoRectification rectification;
  urban_nav_core::RectifyMap left_map, right_map;
  urban_nav_core::Pose T_base_camera;  ///< rectified left optical frame
  urban_nav_core::Pose T_base_body;    ///< EuRoC's body: the IMU
};

/// Returns the folder with cam0 and cam1: `path` or its mav0.
std::string eurocFolder(const std::string& path);

/// All read data.csv and sensor.yaml, and throw UserError with file and line for damaged ones. `notes`: corrections of
/// the lists of images, for the user.
std::vector<EurocPair> readEurocPairs(const std::string& mav0, std::vector<std::string>* notes = nullptr,
                                      const PairingConvention& pairing = {});
/// Returns the depth of 16-bit images, 8...16, from the first ones of both cameras; 8 for 8-bit images.
urban_nav_ros::GreyScale eurocScale(const std::vector<EurocPair>& pairs);
EurocRig readEurocRig(const std::string& mav0);
/// Returns the IMU readings; empty without imu0. Their noise is that of imu0/sensor.yaml, if it can be read.
std::vector<EurocImu> readEurocImu(const std::string& mav0);
/// Returns the reading as a message in the frame imu_link.
sensor_msgs::Imu toImuMessage(const EurocImu& row);
/// Returns base_link in the frame of the truth, from state_groundtruth_estimate0; nullopt without it.
std::optional<urban_nav_core::Trajectory> readEurocTruth(const std::string& mav0,
                                                         const urban_nav_core::Pose& T_base_body);

/// Reads and rectifies a raw image; else returns a fault that names it.
urban_nav_ros::GreyImage readRectified(const std::string& path, const urban_nav_core::RectifyMap& map,
                                       const urban_nav_ros::GreyScale& scale);

}  // namespace urban_nav_input
