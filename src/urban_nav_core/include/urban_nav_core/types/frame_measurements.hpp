// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>

#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_core {

/// Comparisons of a stereo frame with other measurements, made by odometry. A sigma of 0: not compared. Errors are
/// residuals after the corrections estimated by odometry (bias, delays); sigmas are their standard deviations.
struct FrameMeasurements {
  StampNs stamp = 0;
  /// Excess of disparities over those predicted from earlier frames, px.
  double disparity_step_px = 0.0, disparity_step_sigma_px = 0.0;
  /// Root mean square reprojection error in the left image after the update, px; 0: not measured. Not archived.
  double reprojection_px = 0.0;
  /// Rotation vector of the right stereo camera relative to its calibrated orientation, in its optical frame, rad, by
  /// which odometry corrects the images of this frame. Not archived.
  Eigen::Vector3d right_turn = Eigen::Vector3d::Zero();
  /// Rotation vector from images over one step, rad, about the axes of base_link; its excess over that of the
  /// gyroscope; sigma of each axis.
  Eigen::Vector3d turn = Eigen::Vector3d::Zero(), turn_error = Eigen::Vector3d::Zero();
  double turn_sigma = 0.0;
  /// Motion from images along x and y of base_link over one step, m; its excess along x over that of the wheels as
  /// they state it, without the estimated scale; and the standard deviation of either coordinate.
  double forward = 0.0, sideways = 0.0, forward_error = 0.0, forward_sigma = 0.0;
  /// Current estimates of the delays of the stamps of IMU and wheels relative to the clock of the cameras, s.
  double imu_delay = 0.0, imu_delay_sigma = 0.0, wheel_delay = 0.0, wheel_delay_sigma = 0.0;
  /// Why odometry does not use gyroscope or wheels: how they contradict the images, and the remedy. Empty: used, or
  /// absent.
  std::string gyroscope_fault, wheels_fault;
};

/// Reads or writes the members.
void archive(Archive& archive, FrameMeasurements& frame);

}  // namespace urban_nav_core
