// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "stereo/described_keyframe.hpp"
#include "stereo/reprojection.hpp"
#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace urban_nav_registration {

struct AligningOptions {
  int coarser = 0;         ///< levels further up the pyramid than the points' own
  double reach = 2.0;      ///< px of the level: how far from its place a patch may be found
  double floor_px = 0.03;  ///< added to the standard deviation of each coordinate, of the level
};

struct Aligned {
  std::vector<Sight> sights;
  int visible = 0;        ///< points that the other view should show, and large enough
  double likeness = 0.0;  ///< mean correlation of their patches with what it shows there
};

/// Looks for every point of one view in the other, at its place by T_a_b: the patch is warped by its surface and
/// aligned at the pyramid level where both views show it about equally large. First those of a in b, then those of b in
/// a of which a shows nothing yet: a corner that both views have chosen is measured once, and what b says of its
/// disparity is the measurement's third coordinate.
Aligned alignViews(const urban_nav_core::StereoCamera& camera, const View& a, const View& b,
                   const urban_nav_core::Pose& T_a_b, double offset, const AligningOptions& options);

}  // namespace urban_nav_registration
