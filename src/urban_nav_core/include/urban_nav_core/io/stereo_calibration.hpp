// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "urban_nav_core/camera/camera_info.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace urban_nav_core {

/// Calibrations of stereo cameras in the formats of calibration programs. All functions throw UserError with file and
/// line for values that are missing, not numeric, not finite or invalid.

/// Left and right camera, with the rectification of the pair in R and P.
using CameraPair = std::pair<CameraInfo, CameraInfo>;

/// Formats of calibration files, recognised by content.
enum class CalibrationKind {
  CameraInfo,  ///< camera_info YAML of ROS, one camera
  Euroc,       ///< sensor.yaml of EuRoC, one camera with its pose on the body
  Camchain,    ///< camchain.yaml of Kalibr, both cameras
  Ost,         ///< ost.txt of camera_calibration, one camera or both
  Other        ///< such as KITTI's calib.txt
};
CalibrationKind calibrationKind(std::string_view text);

/// Reads one file that holds both cameras (Camchain, Ost) or two files of one kind that hold one each (CameraInfo,
/// Euroc, Ost). `names`: the paths, for errors, as many as `texts`.
CameraPair parseStereoCalibration(const std::vector<std::string>& texts, const std::vector<std::string>& names);

/// Returns the sections of an ost.txt, one per camera, in the order of the file.
std::vector<CameraInfo> parseOst(std::string_view text, const std::string& name);
/// Returns the first two cameras of a camchain.yaml (pinhole; radtan, equidistant or none).
CameraPair parseCamchain(std::string_view text, const std::string& name);

/// Returns two raw cameras with the rectification for their relative pose; rectified pairs are returned unchanged.
CameraPair rectifiedPair(const CameraInfo& left, const CameraInfo& right, const Pose& T_right_left,
                         const std::string& where);

}  // namespace urban_nav_core
