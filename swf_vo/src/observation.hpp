// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "swf_vo/frame.hpp"

namespace swf_vo {

/// Interface between front end and window: a landmark observed in a frame. z = (u_left, v, u_right) in px,
/// `information` its 3x3 inverse covariance (px^-2). A coordinate that was not measured (no match in the right image)
/// has zero rows and columns, so that one model serves monocular and stereo measurements.
struct Observation {
  LandmarkId landmark = 0;
  FrameId frame = 0;
  Eigen::Vector3d z = Eigen::Vector3d::Zero();
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  /// Template drift since the previous measurement: covariance of the displacement over the surface, px^2 in the left
  /// image of its first frame.
  Eigen::Matrix2d template_drift_covariance = Eigen::Matrix2d::Zero();
  /// Standard deviation of the alignment in one coordinate, px; excludes the share of `information` for errors that
  /// persist from frame to frame. 0: unknown.
  double sigma_px = 0.0;
  /// Factor by which the covariance was inflated from earlier residuals (NoiseScale); already included in
  /// `information`.
  double inflation = 1.0;
};

/// A landmark as estimated by the window, for matching: homogeneous, so that far points need no special case (w = 0: at
/// infinity).
struct MapPoint {
  LandmarkId landmark = 0;
  Eigen::Vector4d p_odom = Eigen::Vector4d::Zero();  ///< (x, y, z, w): the point (x, y, z) / w in `odom`, m
};

}  // namespace swf_vo
