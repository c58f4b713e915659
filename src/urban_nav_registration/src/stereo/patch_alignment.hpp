// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "stereo/described_keyframe.hpp"
#include "stereo/reprojection.hpp"
#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace urban_nav_registration {

struct AligningOptions {
  int coarser = 0;         ///< pyramid levels above those of the points
  double reach = 2.0;      ///< px of the level: search radius around the predicted position
  double floor_px = 0.03;  ///< px of the level, added to the standard deviation of each coordinate
};

struct Aligned {
  std::vector<PointMeasurement> measurements;
  int visible = 0;        ///< points that should be visible in the other view, and large enough
  double likeness = 0.0;  ///< mean correlation of their patches with the other view
};

/// Aligns every point of one view to the other, at its position by T_a_b: the patch is warped by its surface and
/// aligned at the pyramid level at which its size is similar in both views. Points of a in b first, then those points
/// of b in a that are not near a measured point of a: a corner detected in both views is measured once, with the
/// disparity from b as third coordinate of the measurement.
Aligned alignViews(const urban_nav_core::StereoCamera& camera, const View& a, const View& b,
                   const urban_nav_core::Pose& T_a_b, double offset, const AligningOptions& options);

}  // namespace urban_nav_registration
