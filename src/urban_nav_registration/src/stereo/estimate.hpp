// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "stereo/reprojection.hpp"
#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace urban_nav_registration {

struct EstimateOptions {
  int steps = 10;                    ///< at most
  double sigma_offset = 0.1;         ///< px, of the error of all disparities; 0: there is none
  double largest_residual_px = 1e9;  ///< of an inlier, px of the level where it was measured
  /// Standard deviations of what no residual shows: the other camera seems turned (px at the centre of the image), and
  /// to stand elsewhere (m).
  double common_px = 0.0, common_m = 0.0;
  bool scaled = true;  ///< the noise follows the residuals where they are larger than promised
};

/// What one sight says at the end.
struct SightOutcome {
  bool inlier = false;
  double chi2 = 0.0;         ///< with the point's depth as it fits best, noise as promised
  double residual_px = 0.0;  ///< distance in the other view, px of the level where it was measured
};

struct Estimate {
  bool found = false;  ///< all else is of no use if false
  urban_nav_core::Pose T_a_b;
  double offset = 0.0;  ///< px
  urban_nav_core::Matrix6d information =
      urban_nav_core::Matrix6d::Zero();  ///< of boxPlus perturbations, the offset marginalised
  double noise_factor = 1.0;             ///< of standard deviations, >= 1
  std::vector<SightOutcome> sights;
  int inliers = 0;
  double reprojection_px = 0.0;  ///< mean of the inliers
};

/// The motion between two views by Gauss-Newton with a Huber kernel. Each point's depth is a variable of its own, bound
/// by its disparities in either view and eliminated: were it taken as measured, its error would stand in the
/// derivatives too, and pull far points' motion towards zero. The disparities' common error is one more variable.
/// Serial, so that the bits are always the same.
Estimate estimate(const urban_nav_core::StereoCamera& camera, const std::vector<Sight>& sights,
                  const urban_nav_core::Pose& start, const EstimateOptions& options);

}  // namespace urban_nav_registration
