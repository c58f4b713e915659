// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "free_camera.hpp"

namespace urban_nav_sim::bench {

/// A laser's return.
struct Return {
  Eigen::Vector3f place;     ///< m, in `world`
  float reflectance = 0.0F;  ///< 0 ... 255
};

/// Renders a cloud for a free camera, 8 bit BGR on a dark background: coloured by height (0 ... `top` m above z = 0),
/// with brightness by reflectance, darker next to the edges of nearer surfaces (Boucheny 2009).
cv::Mat drawCloud(const std::vector<Return>& cloud, const FreeCamera& camera, float top);

}  // namespace urban_nav_sim::bench
