// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "laser_mapper/calibration/laser_calibration.hpp"
#include "laser_mapper/calibration/view_calibration.hpp"

namespace urban_nav {

/// Calibration of the lasers and panoramas of one session, with --calibrate.
struct SessionCalibration {
  std::size_t number = 0;  ///< over all sessions
  std::string session;     ///< name
  laser_mapper::CalibrationResult found;
  std::optional<laser_mapper::ViewCalibration> panorama = {};  ///< nullopt: there are no panoramas
};

}  // namespace urban_nav
