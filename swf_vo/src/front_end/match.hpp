// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "front_end/tracks.hpp"

namespace swf_vo {

/// A position measured in one image, px of level 0.
struct PixelMeasurement {
  bool found = false;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();
  double correlation = 0.0, gain = 1.0, noise = 0.0;  ///< results of the alignment (patch.hpp)
};

/// Matching result of one landmark of the map in the current frame.
struct Match {
  Track* track = nullptr;
  Eigen::Vector4d p_odom = Eigen::Vector4d::Zero();  ///< homogeneous, from the map
  PixelMeasurement left, right;
  bool measured = false;                                  ///< z is valid
  Eigen::Vector3d z = Eigen::Vector3d::Zero();            ///< zero rows for coordinates that were not measured
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  ///< zero rows for missing coordinates
  double inflation = 1.0;                                 ///< NoiseScale; not included in the information
  double chi2 = 0.0;  ///< residual at the estimated pose, with the error of the map included
  bool inlier = false;
  bool contradicted = false;  ///< found at a position that contradicts the motion of the camera
};

}  // namespace swf_vo
