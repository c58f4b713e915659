// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "urban_nav_core/camera/camera_info.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace urban_nav_core {

/// Calibrations as files hold them. All functions throw UserError with file and line for what is missing, no number,
/// not finite or not possible (a matrix that is no rotation, a size of no pixels, a right camera that is not to the
/// right).

/// KITTI's calib.txt: lines `P0: ` and `P1: ` with 3x4 projection matrices, row by row (`P_rect_00: ` and `P_rect_01: `
/// in the raw data's calib_cam_to_cam.txt), 2 and 3 for the colour cameras. It has no image size: the images tell.
enum class KittiPair { Grey, Colour };
StereoCamera readKittiCalibration(const std::string& path, int width, int height, KittiPair pair = KittiPair::Grey);
StereoCamera parseKittiCalibration(std::string_view text, const std::string& name, int width, int height,
                                   KittiPair pair = KittiPair::Grey);
/// As such a file holds it, P0 to P1, with the numbers that read back to the same focal lengths and centre.
std::string printKittiCalibration(const StereoCamera& camera);

/// camera_info YAML as ROS's camera_calibration_parsers reads and writes it.
CameraInfo readCameraInfo(const std::string& path);
CameraInfo parseCameraInfo(std::string_view text, const std::string& name);
std::string printCameraInfo(const CameraInfo& info, const std::string& camera_name);

/// EuRoC's cam0/sensor.yaml: where the camera is on the body, and its raw calibration.
struct EurocCamera {
  Pose T_body_camera;
  double rate_hz = 0.0;  ///< 0 where the file does not state it
  CameraInfo info;       ///< R is the identity, P is K: the pair is rectified later
};
EurocCamera readEurocCamera(const std::string& path);
EurocCamera parseEurocCamera(std::string_view text, const std::string& name);

/// EuRoC's imu0/sensor.yaml; noise densities in continuous time, 0 where the file does not state them.
struct EurocImu {
  Pose T_body_imu;
  double rate_hz = 0.0;
  double gyroscope_noise = 0.0;      ///< rad/s/sqrt(Hz)
  double gyroscope_walk = 0.0;       ///< rad/s^2/sqrt(Hz)
  double accelerometer_noise = 0.0;  ///< m/s^2/sqrt(Hz)
  double accelerometer_walk = 0.0;   ///< m/s^3/sqrt(Hz)
};
EurocImu readEurocImu(const std::string& path);
EurocImu parseEurocImu(std::string_view text, const std::string& name);

}  // namespace urban_nav_core
