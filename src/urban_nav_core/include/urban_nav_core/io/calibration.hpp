// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "urban_nav_core/camera/camera_info.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace urban_nav_core {

/// Readers of calibration files. All functions throw UserError with file and line for values that are missing, not
/// numeric, not finite or invalid (a matrix that is not a rotation, an image size of zero, a right camera that is not
/// to the right).

/// KITTI's calib.txt: lines `P0: ` and `P1: ` with 3x4 projection matrices, row by row (`P_rect_00: ` and `P_rect_01: `
/// in the raw data's calib_cam_to_cam.txt), 2 and 3 for the colour cameras. The file has no image size; it is taken
/// from the images.
enum class KittiPair { Grey, Colour };
StereoCamera readKittiCalibration(const std::string& path, int width, int height, KittiPair pair = KittiPair::Grey);
StereoCamera parseKittiCalibration(std::string_view text, const std::string& name, int width, int height,
                                   KittiPair pair = KittiPair::Grey);
/// Returns the position of camera 0 (m) in the frame of the left camera of a pair, both rectified; nullopt without its
/// row.
std::optional<Vector3d> parseKittiOffset(std::string_view text, const std::string& name, KittiPair pair);
/// Returns the content of calib.txt, P0 and P1; focal lengths and centre are read back exactly.
std::string printKittiCalibration(const StereoCamera& camera);

/// Reads camera_info YAML in the format of ROS's camera_calibration_parsers.
CameraInfo readCameraInfo(const std::string& path);
CameraInfo parseCameraInfo(std::string_view text, const std::string& name);
std::string printCameraInfo(const CameraInfo& info, const std::string& camera_name);

/// EuRoC's cam0/sensor.yaml: pose of the camera on the body, and its raw calibration.
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
