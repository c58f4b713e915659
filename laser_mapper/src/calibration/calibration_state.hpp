// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/types/stamp.hpp"

namespace laser_mapper {

/// Correction of one laser that the map of a session uses.
struct AdoptedCalibration {
  std::string frame;
  urban_nav_core::StampNs delay = 0;  ///< its stamps are late by this
  urban_nav_core::Pose T_stated_laser;
};

/// Key of the state in StageStates.
constexpr const char* kCalibrationState = "laser_mapper.calibration";

std::string packCalibration(std::vector<AdoptedCalibration> lasers);
/// Returns the corrections; throws DataError if the bytes are damaged or of another version.
std::vector<AdoptedCalibration> unpackCalibration(std::string_view bytes);

}  // namespace laser_mapper
