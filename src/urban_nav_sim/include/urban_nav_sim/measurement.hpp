// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <string>
#include <variant>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/laser/scan.hpp"
#include "urban_nav_core/laser/sweep.hpp"
#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_sim {
/// Camera of the stereo pair, or side laser.
enum class Side : std::uint8_t { Left, Right };

/// A stereo pair, grey, 8 bit. A missing image is empty.
struct StereoMeasurement {
  urban_nav_core::StampNs stamp = 0;
  cv::Mat left, right;
};

/// Image of one camera of the Ladybug, BGR, 8 bit.
struct LadybugMeasurement {
  urban_nav_core::StampNs stamp = 0;
  int camera = 0;  ///< 0 forward, then clockwise seen from above
  cv::Mat image;
};
/// A scan of a side laser.
struct LaserMeasurement {
  Side side = Side::Left;
  urban_nav_core::PlanarScan scan;
};

/// A sweep of the 3D LiDAR, without beams that have no return.
struct LidarMeasurement {
  urban_nav_core::StampNs stamp = 0;  ///< end of the sweep
  urban_nav_core::Sweep sweep;
};
/// A measurement of the IMU.
struct ImuMeasurement {
  urban_nav_core::StampNs stamp = 0;
  Eigen::Vector3d rate = Eigen::Vector3d::Zero();            ///< rad/s, axes of imu_link
  Eigen::Vector3d specific_force = Eigen::Vector3d::Zero();  ///< m/s^2, +9.81 along z at rest
  Eigen::Vector3d field = Eigen::Vector3d::Zero();           ///< T
};
/// A measurement of the wheel odometry.
struct WheelMeasurement {
  urban_nav_core::StampNs stamp = 0;
  urban_nav_core::Pose T_odom_base;
  double speed = 0.0, yaw_rate = 0.0;  ///< m/s, rad/s
};
/// A measurement of the GPS receiver.
struct GpsMeasurement {
  urban_nav_core::StampNs stamp = 0;
  bool has_fix = true;
  double latitude = 0.0, longitude = 0.0, altitude = 0.0;  ///< deg, deg, m over the ellipsoid
  Eigen::Vector3d sigma = Eigen::Vector3d::Ones();         ///< as stated by the receiver: east, north, up, m
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();      ///< east, north, up, m/s
};
/// The true pose at a stamp.
struct TruthMeasurement {
  urban_nav_core::StampNs stamp = 0;
  urban_nav_core::Pose T_world_base;
};

/// True depth and class of the pixels of a camera or the beams of a laser, for the measurement of the same stamp. Not
/// affected by faults.
struct ViewTruth {
  urban_nav_core::StampNs stamp = 0;
  std::string frame;  ///< "laser_left", "stereo_right_optical_frame", ...
  cv::Mat depth;  ///< CV_32F, m along the camera axis; of a laser a row of beams, m along each; of a 3D LiDAR a row per
                  ///< ring, from ring 0 on, and a column per firing; infinite for the sky
  cv::Mat surface_class;  ///< CV_8U, as in cloud.ply
};

using Measurement = std::variant<StereoMeasurement, LadybugMeasurement, LaserMeasurement, ImuMeasurement,
                                 WheelMeasurement, GpsMeasurement, LidarMeasurement, TruthMeasurement, ViewTruth>;

urban_nav_core::StampNs toStamp(const Measurement& measurement);

}  // namespace urban_nav_sim
