// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "front_end/match.hpp"
#include "front_end/robust_fit.hpp"
#include "health/row_check.hpp"
#include "swf_vo/frame.hpp"
#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace swf_vo {

/// Turn of the right camera about its x and z axes (rad; R_calibrated_turned = exp(turn)) that the rows of the images
/// show, and its standard deviations; 0: not measured.
struct RowStep {
  Eigen::Vector2d turn = Eigen::Vector2d::Zero(), sigma = Eigen::Vector2d::Zero();
};

/// Estimates the common difference between the measured disparities of landmarks and those predicted from the map of
/// earlier frames:
///   d - d(T_camera_odom) = (1 + x^2) step + (d(T_camera_odom) / z) t + error,
/// with x the tangent of the direction along the rows. The step corresponds to a rotation of the right camera about its
/// y axis by step / fx; t, estimated jointly, is the error of the camera position along its optical axis. The step is
/// zero if the rig has not changed since the landmarks were measured. `matches`: before rejection by disparity;
/// `T_camera_odom`: mainly from measurements in one image each.
/// Robust, with the standard deviation of fitRobustly(). A sigma of 0: too few matches.
///
/// Does not allocate once its buffers have grown.
class DisparityStepMeter {
 public:
  /// `known`: turns of the right camera about its x and z axes, whose displacements
  ///   d += -fx (y turn_z + x y turn_x)
  /// are removed first.
  DisparityStep measure(const urban_nav_core::StereoCamera& camera, const urban_nav_core::Pose& T_camera_odom,
                        const std::vector<Match>& matches, const Eigen::Vector2d& known = Eigen::Vector2d::Zero());
  /// Measures the rows of the right image against those of the left one, less `row_offset_px`, which is usual:
  ///   v_right - v_left = fy ((1 + y^2) turn_x - x turn_z) + error.
  RowStep measureRows(const urban_nav_core::StereoCamera& camera, const std::vector<Match>& matches,
                      double row_offset_px);
  RowStep measureRows(const urban_nav_core::StereoCamera& camera, const std::vector<RowMatch>& matches,
                      double row_offset_px);

 private:
  void addRows(const urban_nav_core::StereoCamera& camera, const RowMatch& match, double row_offset_px);
  RowStep fitRows();

  std::vector<PixelDifference> differences_;
  std::vector<double> values_;
};

}  // namespace swf_vo
