// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "stereo/reprojection.hpp"
#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace urban_nav_registration {

struct EstimateOptions {
  int steps = 10;                    ///< maximum
  double sigma_offset = 0.1;         ///< px, error common to all disparities; 0: none
  double largest_residual_px = 1e9;  ///< limit for an inlier, px of the level of the measurement
  /// Standard deviations of errors common to all residuals: apparent rotation of the other camera (px at the image
  /// centre) and apparent displacement (m).
  double common_px = 0.0, common_m = 0.0;
  bool scaled = true;  ///< the noise is scaled by the residuals if they exceed their expected size
};

/// Result for one measurement.
struct MeasurementOutcome {
  bool inlier = false;
  double chi2 = 0.0;         ///< at the best depth of the point, with the stated noise
  double residual_px = 0.0;  ///< distance in the other view, px of the level of the measurement
};

struct Estimate {
  bool found = false;  ///< false: the other members are undefined
  urban_nav_core::Pose T_a_b;
  double offset = 0.0;  ///< px
  urban_nav_core::Matrix6d information =
      urban_nav_core::Matrix6d::Zero();  ///< for boxPlus perturbations, the offset marginalised
  double noise_factor = 1.0;             ///< on standard deviations, >= 1
  std::vector<MeasurementOutcome> measurements;
  int inliers = 0;
  double reprojection_px = 0.0;  ///< mean over the inliers
};

/// Estimates the motion between two views by Gauss-Newton with a Huber kernel. The depth of each point is a variable,
/// constrained by its disparities in both views and eliminated: with fixed measured depths, their errors would also
/// affect the derivatives and bias the motion from far points towards zero. The error common to all disparities is a
/// variable as well. Serial, so that results are bit-identical.
Estimate estimate(const urban_nav_core::StereoCamera& camera, const std::vector<PointMeasurement>& measurements,
                  const urban_nav_core::Pose& start, const EstimateOptions& options);

}  // namespace urban_nav_registration
