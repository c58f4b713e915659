// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "urban_nav_core/camera/raw_camera.hpp"
#include "urban_nav_core/camera/stereo_camera.hpp"

namespace urban_nav_core {

/// One camera's calibration as sensor_msgs/CameraInfo and its YAML have it.
struct CameraInfo {
  int width = 0, height = 0;                        ///< px
  std::string distortion_model;                     ///< "plumb_bob", "rational_polynomial", "equidistant"; "" for none
  std::vector<double> D;                            ///< coefficients, order as in distortion.hpp
  Eigen::Matrix3d K = Eigen::Matrix3d::Zero();      ///< raw pinhole, px
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();  ///< R_rectified_raw
  /// Rectified pinhole; P(0,3) = -fx baseline of a right camera.
  Eigen::Matrix<double, 3, 4> P = Eigen::Matrix<double, 3, 4>::Zero();
};

/// Fills in the raw camera of a calibration that has P alone, as converters of rectified sequences write it: K from P,
/// no rotation, no distortion. Returns others as they are.
CameraInfo withRawCamera(CameraInfo info);

/// The raw camera. Throws UserError that begins with `where` (file or topic) if size, K or D cannot be those of a
/// camera.
RawCamera rawCamera(const CameraInfo& info, const std::string& where);
/// The pinhole after rectification, by P. Throws UserError as above.
Pinhole rectifiedPinhole(const CameraInfo& info, const std::string& where);
/// Does an image of this camera need a remap to become rectified?
bool needsRectification(const CameraInfo& info);

/// The pair. Throws UserError if the two do not belong together: sizes, focal lengths or rows that differ, or a right
/// camera that is not to the right (P(0,3) >= 0: images swapped, or a monocular calibration).
StereoCamera stereoCamera(const CameraInfo& left, const CameraInfo& right, const std::string& where);

/// As a message would have it, of one side of a rectified pair.
CameraInfo leftInfo(const StereoCamera& camera);
CameraInfo rightInfo(const StereoCamera& camera);

}  // namespace urban_nav_core
