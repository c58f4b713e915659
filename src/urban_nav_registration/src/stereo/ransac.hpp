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
  int samples = 0;                      ///< triples that were tried
  std::vector<DescriptorMatch> others;  ///< the pairs that do not agree
};

/// The motion that most pairs agree with (RANSAC, Fischler and Bolles 1981): triples of 3D points by a fixed sequence,
/// as many as the share of inliers asks for; each moves onto the other by its triangle, then by Gauss-Newton in pixels,
/// since depth is known far worse than direction; the best are estimated anew from all that agree (Chum, Matas, Kittler
/// 2003). Scored in the other view by (u, v, disparity), with the error of the first disparity allowed for.
Consensus findConsensus(const urban_nav_core::StereoCamera& camera, const View& a, const View& b,
                        const std::vector<DescriptorMatch>& pairs);

}  // namespace urban_nav_registration
