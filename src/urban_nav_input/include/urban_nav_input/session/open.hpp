// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "urban_nav_core/laser/cloud/point_times.hpp"
#include "urban_nav_input/recording/receipt_range.hpp"
#include "urban_nav_input/sensors/pairing_examination.hpp"
#include "urban_nav_input/session/sessions.hpp"
#include "urban_nav_input/session/source.hpp"
#include "urban_nav_ros/sensor_corrections.hpp"

namespace urban_nav_input {

/// Options of the user for the clouds of 3D LiDARs.
struct PointsOptions {
  std::optional<urban_nav_core::PointTimes> times;  ///< as input.points_time; nullopt: determined from the values
  std::optional<bool> deskewed;                     ///< as input.points_deskewed; nullopt: by the kind of the input
  double near = 0.5;                                ///< m, as input.points_near
  std::array<double, 2> delays = {};                ///< ms, of points0 and points1, as input.points0_delay and so on
};

/// Options of the user for inputs.
struct SourceOptions {
  std::vector<std::string> topics;                ///< ROLE:=NAME or preset:=NAME, for bags
  std::string calibration;                        ///< file for bags and KITTI folders; empty: that of the input
  double rate = 0.0;                              ///< Hz of an image folder without stamps; 0: 10 Hz
  std::string motion_input = "none";              ///< as input.motion_input
  double wheel_noise = 0.0;                       ///< as input.wheel_noise
  double gyro_noise = 0.0;                        ///< as input.gyro_noise
  PairingConvention pairing = {};                 ///< as input.right_delay and input.pairing_tolerance
  double baseline_scale = 1.0;                    ///< as input.baseline_scale
  std::vector<std::string> read_elsewhere = {};   ///< topics of bags that are not reported as unused
  urban_nav_ros::SensorCorrections sensors = {};  ///< as input.imu_delay and so on
  std::vector<std::string> transforms = {};       ///< PARENT,CHILD:X,Y,Z,QX,QY,QZ,QW, overriding tf; with a leading
                                                  ///< `?`: used if tf has none (giveTransforms())
  PointsOptions points = {};
  /// Whether sweeps of 3D LiDARs are read. If so, a session without images but with sweeps is accepted.
  bool with_sweeps = false;
  /// Whether the scans of a horizontal planar laser are also read as sweeps if there are images. Without images and
  /// without clouds of a 3D LiDAR they are, if sweeps are.
  bool with_planar_sweeps = false;
  /// Whether the images of depth cameras are read.
  bool with_depth = false;
  /// Whether the images of cameras that colour the map are read.
  bool with_colour = false;
  SessionRule sessions = SessionRule::Auto;  ///< as input.sessions
};
/// Format of an input.
enum class InputKind { KittiFolder, EurocFolder, NewCollegeFolder, Bag };

/// Returns the kind of input at `path`. Throws UserError listing the known kinds if it is none of them.
InputKind inputKind(const std::string& path);

/// Opens one session: a folder, or the bags of a recording (several if it was split). `after`: state of another reader
/// at the end of a bag, which has read the first `after->bags` of `paths`; null to begin at the start. `part`: range of
/// receipt within the bags. Throws UserError if the bags do not follow.
std::unique_ptr<Source> openSource(const std::vector<std::string>& paths, const SourceOptions& options,
                                   const BagEnd* after = nullptr, const ReceiptRange& part = {});

std::unique_ptr<Source> openKittiFolder(const std::string& folder, const SourceOptions& options);
std::unique_ptr<Source> openEurocFolder(const std::string& folder, const SourceOptions& options);
std::unique_ptr<Source> openNewCollegeFolder(const std::string& folder, const SourceOptions& options);
std::unique_ptr<Source> openBags(const std::vector<std::string>& paths, const SourceOptions& options,
                                 const BagEnd* after = nullptr, const ReceiptRange& part = {});

}  // namespace urban_nav_input
