// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "dense_stereo/disparity_image.hpp"
#include "urban_nav_core/camera/stereo_camera.hpp"

namespace dense_stereo {

/// Pixel with a disparity, as a point in the left optical frame.
struct DensePoint {
  int u = 0, v = 0;                                 ///< px
  float disparity = 0.0F;                           ///< px, without the camera's disparity offset
  float variance = 0.0F;                            ///< px^2, of the disparity
  Eigen::Vector3f p_cam = Eigen::Vector3f::Zero();  ///< m
};

/// Returns every `step`-th pixel of every `step`-th row that has a disparity and lies within `max_range` metres of the
/// camera (Newman et al. 2009, section 6.2: 5 m). Pixels without a positive depth are omitted.
std::vector<DensePoint> makePoints(const DisparityImage& image, const urban_nav_core::StereoCamera& camera,
                                   double max_range, int step = 1);

/// Returns the covariance of a point, m^2, to first order: the disparity error acts along the line of sight, and the
/// direction has an error of a third of a pixel. Optimistic where the standard deviation of the disparity is not small
/// compared with the disparity.
Eigen::Matrix3d pointCovariance(const DensePoint& point, const urban_nav_core::StereoCamera& camera);

}  // namespace dense_stereo
