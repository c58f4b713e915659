// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "front_end/tracks.hpp"

namespace swf_vo {

/// A place in one image, px of level 0.
struct PixelMeasurement {
  bool found = false;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();
  double correlation = 0.0, gain = 1.0, noise = 0.0;  ///< of the alignment (patch.hpp)
};

/// What became of one landmark of the map in the frame at hand.
struct Match {
  Track* track = nullptr;
  Eigen::Vector4d p_odom = Eigen::Vector4d::Zero();  ///< homogeneous, as the map has it
  PixelMeasurement left, right;
  bool measured = false;                                  ///< z is valid
  Eigen::Vector3d z = Eigen::Vector3d::Zero();            ///< u_left, v, u_right (px)
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  ///< zero rows for what was not measured
  double inflation = 1.0;                                 ///< NoiseScale; not in the information
  double chi2 = 0.0;  ///< of the residual at the localised pose, the map's own error allowed for
  bool inlier = false;
  bool contradicted = false;  ///< was found, but where the motion of the camera does not take it
};

}  // namespace swf_vo
