// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "swf_vo/frame.hpp"

namespace swf_vo {

/// The border between front_end and window: which landmark, seen from which frame, where, and how well.
/// z = (u_left, v, u_right) in px, `information` its 3x3 inverse covariance (px^-2). A coordinate that was not measured
/// (no match in the right image) has zero rows and columns, so that one model serves one camera and two.
struct Observation {
  LandmarkId landmark = 0;
  FrameId frame = 0;
  Eigen::Vector3d z = Eigen::Vector3d::Zero();
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  /// By how much what is measured may have crept over its surface since it was seen last: px^2 in the left image of its
  /// first frame.
  Eigen::Matrix2d template_drift_covariance = Eigen::Matrix2d::Zero();
  /// Standard deviation of the alignment alone, px, in one coordinate: without what `information` has for errors that
  /// stay the same from frame to frame. 0: not known.
  double sigma_px = 0.0;
  /// By how much earlier residuals taught to make the covariance larger than the alignment says: it is in `information`
  /// already.
  double inflation = 1.0;
};

/// A landmark as the window knows it, for matching: homogeneous, so that far points need no special case (w = 0: at
/// infinity).
struct MapPoint {
  LandmarkId landmark = 0;
  Eigen::Vector4d p_odom = Eigen::Vector4d::Zero();  ///< (x, y, z, w): the point (x, y, z) / w in `odom`, m
};

}  // namespace swf_vo
