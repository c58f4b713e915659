// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "front_end/match.hpp"
#include "swf_vo/frame.hpp"
#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace swf_vo {

/// Measures by how much the disparities of the landmarks in both images exceed those that the map of earlier frames
/// predicts:
///   d - d(T_camera_odom) = (1 + x^2) step + (d(T_camera_odom) / z) t + error,
/// with x the tangent of the direction along the rows: a turn of the right camera about its y axis by step / fx. t is
/// an error of the camera's place along its axis, estimated too. Where the rig has not changed since
/// the landmarks were measured, the step is zero. `matches`: before any was rejected for its disparity;
/// `T_camera_odom`: mostly by measurements in one image each.
///
/// Huber's weights; matches further apart than kStepOutlier from the median are taken as wrong. The standard deviation
/// is that of a sandwich over cells of the image, whose matches share errors (Liang and Zeger 1986). A sigma of 0: too
/// few.
///
/// Allocates nothing once it has seen as many matches as come.
class DisparityStepMeter {
 public:
  DisparityStep measure(const urban_nav_core::StereoCamera& camera, const urban_nav_core::Pose& T_camera_odom,
                        const std::vector<Match>& matches);

  struct Difference {
    double px = 0.0;                                  ///< measured less predicted disparity
    Eigen::Vector2d slope = Eigen::Vector2d::Zero();  ///< derivative by the step, and by the place along the axis (1/m)
    std::size_t cell = 0;                             ///< of the image
  };

 private:
  std::vector<Difference> differences_;
  std::vector<double> values_;
};

}  // namespace swf_vo
