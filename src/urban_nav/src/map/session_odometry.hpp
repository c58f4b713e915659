// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "map/odometry_source.hpp"
#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/fusion/fuse_odometry.hpp"
#include "urban_nav_core/trajectory/odometry_chain.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"
#include "urban_nav_core/types/frame_measurements.hpp"
#include "urban_nav_core/types/pose_with_covariance.hpp"
#include "urban_nav_core/types/specific_force.hpp"
#include "urban_nav_core/types/status.hpp"

namespace urban_nav {

/// Odometry of one frame at its processing time.
struct OdometryFrame {
  std::int64_t frame = 0;  ///< counts frames from 0, dropped ones included
  urban_nav_core::StampNs stamp = 0;
  bool accepted = true;  ///< false: dropped because of its stamp
  urban_nav_core::Status status;
  urban_nav_core::Pose T_odom_base;            ///< filtered, as live odometry publishes it
  urban_nav_core::FrameMeasurements compared;  ///< comparison with other measurements, by visual odometry
};

/// Odometry of one frame as files and later stages use it.
struct SmoothedFrame {
  std::int64_t frame = 0;
  urban_nav_core::StampNs stamp = 0;
  urban_nav_core::PoseWithCovariance T_odom_base;  ///< covariance: of T_first_base in the axes of the first pose
  urban_nav_core::RelativePose from_previous;      ///< from == to for the first frame
  urban_nav_core::Status status;                   ///< at the processing time of the frame
};

/// Result of comparing visual with laser odometry (FusedOdometry).
struct OdometryFusion {
  std::vector<urban_nav_core::StepSource> sources;  ///< of the step to each settled frame but the first
  std::vector<urban_nav_core::SharedConstant> shared;
  std::vector<urban_nav_core::OdometryConflict> conflicts;
  double spread = 1.0;
};

/// Odometry of one session, from any sensor.
struct SessionOdometry {
  std::string input;
  OdometrySource source = OdometrySource::Stereo;
  urban_nav_core::StereoCamera camera;
  urban_nav_core::Pose T_base_camera;
  std::optional<urban_nav_core::Pose> T_base_lidar;  ///< mounting of the LiDAR, if it is used
  std::optional<OdometryFusion> fusion;              ///< result of the comparison, if both sources are used
  std::vector<OdometryFrame> frames;                 ///< one per stereo frame, or per sweep by laser
  std::vector<SmoothedFrame> settled;  ///< smoothed poses, one per accepted frame that has left the window
  std::string cameras;                 ///< describeCameras() of a stored session; empty: of `camera`
  std::vector<urban_nav_core::SpecificForce>
      forces;                       ///< specific forces around smoothed frames; empty without an accelerometer
  std::vector<std::string> faults;  ///< of the data, each with its file or topic; at most kMaxFaults
  std::int64_t faults_total = 0;
};
constexpr std::size_t kMaxFaults = 100;

/// Returns a fingerprint of the cameras of a session and their mounting (calibrationFingerprint).
std::string describeCameras(const SessionOdometry& odometry);
/// Returns the smoothed poses of base_link in `odom`.
urban_nav_core::Trajectory smoothedTrajectory(const SessionOdometry& odometry);
/// Returns the smoothed steps between the poses of smoothedTrajectory().
urban_nav_core::OdometryChain odometryChain(const SessionOdometry& odometry);

/// Rotates all poses in `odom`. Steps and covariances, which are in the axes of the poses, do not change.
void turnOdometry(const Eigen::Quaterniond& q_level_odom, SessionOdometry& odometry);

}  // namespace urban_nav
