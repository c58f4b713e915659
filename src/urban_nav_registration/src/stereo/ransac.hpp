// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "stereo/described_keyframe.hpp"
#include "stereo/estimate.hpp"
#include "urban_nav_registration/stereo/descriptor.hpp"

namespace urban_nav_registration {

struct Consensus {
  bool found = false;
  urban_nav_core::Pose T_a_b;
  int inliers = 0;
  int samples = 0;                      ///< number of triples tested
  std::vector<DescriptorMatch> others;  ///< pairs that are not inliers
};

/// Finds the motion with most inlier pairs (RANSAC, Fischler and Bolles 1981): triples of 3D points by a fixed
/// sequence, as many as the inlier ratio requires; each gives a motion by its triangle, refined by Gauss-Newton in
/// pixels, since depth is much less accurate than direction; the best are estimated again from all inliers (Chum,
/// Matas, Kittler 2003). Scored in the other view by (u, v, disparity), including the error of the first disparity.
Consensus findConsensus(const urban_nav_core::StereoCamera& camera, const View& a, const View& b,
                        const std::vector<DescriptorMatch>& pairs);

}  // namespace urban_nav_registration
