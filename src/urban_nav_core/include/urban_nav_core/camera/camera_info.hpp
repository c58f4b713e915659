// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "urban_nav_core/camera/raw_camera.hpp"
#include "urban_nav_core/camera/stereo_camera.hpp"

namespace urban_nav_core {

/// Calibration of one camera, with the fields of sensor_msgs/CameraInfo and its YAML form.
struct CameraInfo {
  int width = 0, height = 0;                        ///< px
  std::string distortion_model;                     ///< "plumb_bob", "rational_polynomial", "equidistant"; "" for none
  std::vector<double> D;                            ///< coefficients, order as in distortion.hpp
  Eigen::Matrix3d K = Eigen::Matrix3d::Zero();      ///< raw pinhole, px
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();  ///< R_rectified_raw
  /// Rectified pinhole; P(0,3) = -fx baseline of a right camera.
  Eigen::Matrix<double, 3, 4> P = Eigen::Matrix<double, 3, 4>::Zero();
};

/// Returns the calibration with the raw camera filled in where only P is given, as converters of rectified sequences
/// write it: K from P, no rotation, no distortion. Other calibrations are returned unchanged.
CameraInfo withRawCamera(CameraInfo info);

/// Returns the raw camera. Throws UserError that begins with `where` (file or topic) if size, K or D are invalid.
RawCamera rawCamera(const CameraInfo& info, const std::string& where);
/// Returns the rectified pinhole, from P. Throws UserError that begins with `where` if P is invalid.
Pinhole rectifiedPinhole(const CameraInfo& info, const std::string& where);
/// Returns whether images of this camera must be remapped to be rectified.
bool needsRectification(const CameraInfo& info);

/// Returns the rectified pair. Throws UserError that begins with `where` if sizes, focal lengths or rows of the two
/// cameras differ, or if the right camera is not to the right (P(0,3) >= 0: images exchanged, or a monocular
/// calibration).
StereoCamera stereoCamera(const CameraInfo& left, const CameraInfo& right, const std::string& where);

/// Return the calibration of the left or right camera of a rectified pair.
CameraInfo leftInfo(const StereoCamera& camera);
CameraInfo rightInfo(const StereoCamera& camera);

}  // namespace urban_nav_core
