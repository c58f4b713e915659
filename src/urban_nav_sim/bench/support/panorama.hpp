// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <opencv2/core/mat.hpp>

#include "camera/rig.hpp"

namespace urban_nav_sim::bench {

/// Projects the five images of a Ladybug on a cylinder of 1.6 radii height, with forward in the centre and blended
/// overlaps. Objects nearer or farther than 8 m may appear twice there, since the lenses are 4 cm off the axis.
cv::Mat panorama(const std::array<Camera, 5>& cameras, const std::array<cv::Mat, 5>& images, int width);

}  // namespace urban_nav_sim::bench
