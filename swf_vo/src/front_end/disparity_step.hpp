// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "front_end/match.hpp"
#include "swf_vo/frame.hpp"
#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace swf_vo {

/// Estimates the common difference between the measured disparities of landmarks and those predicted from the map of
/// earlier frames:
///   d - d(T_camera_odom) = (1 + x^2) step + (d(T_camera_odom) / z) t + error,
/// with x the tangent of the direction along the rows. The step corresponds to a rotation of the right camera about its
/// y axis by step / fx; t, estimated jointly, is the error of the camera position along its optical axis. The step is
/// zero if the rig has not changed since the landmarks were measured. `matches`: before rejection by disparity;
/// `T_camera_odom`: mainly from measurements in one image each.
///
/// Huber weights; matches further than kStepOutlier from the median are outliers. The standard deviation is that of a
/// sandwich estimator clustered by image cell, since matches of a cell share errors (Liang and Zeger 1986). A sigma of
/// 0: too few matches.
///
/// Does not allocate once its buffers have grown.
class DisparityStepMeter {
 public:
  DisparityStep measure(const urban_nav_core::StereoCamera& camera, const urban_nav_core::Pose& T_camera_odom,
                        const std::vector<Match>& matches);

  struct Difference {
    double px = 0.0;                                  ///< measured less predicted disparity
    Eigen::Vector2d slope = Eigen::Vector2d::Zero();  ///< derivative by the step and by the position along the optical
                                                      ///< axis (1/m)
    std::size_t cell = 0;                             ///< image cell
  };

 private:
  std::vector<Difference> differences_;
  std::vector<double> values_;
};

}  // namespace swf_vo
