// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/types/stereo_pair.hpp"

namespace urban_nav_registration::bench {

enum class Feature { Sift, Orb };

/// Pose estimation with OpenCV, composed as in its tutorials: features of both left images, brute-force matching with
/// the ratio test, depth of those of a by block matching (StereoSGBM), solvePnPRansac on three points,
/// solvePnPRefineLM. Accepted from 50 inliers on; empty below.
std::optional<urban_nav_core::Pose> poseByOpenCv(Feature feature, const urban_nav_core::StereoCamera& camera,
                                                 const urban_nav_core::StereoPair& a,
                                                 const urban_nav_core::StereoPair& b);

}  // namespace urban_nav_registration::bench
