// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_sim/ros/measurement_messages.hpp"

namespace urban_nav {

/// Constant calibration errors in a bag: delayed stamps of devices, and wrong rotations of frames in /tf_static.
/// Measurements and truth are those of the robot without errors.
struct CalibrationErrors {
  std::map<std::string, urban_nav_core::StampNs> lags;  ///< by device: one of calibrationDevices()
  /// R_true_stated by frame; of "ladybug", the head with all its cameras, about their centre in the axes of their
  /// parent frame.
  std::map<std::string, urban_nav_core::Matrix3d> turns;

  bool any() const { return !lags.empty() || !turns.empty(); }
  /// Shifts the stamp of a message of a device with a lag.
  void apply(urban_nav_sim::TopicMessage& message) const;
  /// Rotates the misplaced frames about their axes.
  void apply(std::vector<geometry_msgs::TransformStamped>& transforms) const;
};

/// Devices whose stamps --lag shifts, separated by commas.
std::string calibrationDevices();

/// Returns the errors of the options --lag DEVICE:S and --misplace FRAME:ROLL,PITCH,YAW (deg). `frames`: of the robot.
/// Throws UserError listing the valid devices and frames.
CalibrationErrors parseCalibrationErrors(const std::vector<std::string>& lags,
                                         const std::vector<std::string>& misplaced,
                                         const std::vector<std::string>& frames);

}  // namespace urban_nav
