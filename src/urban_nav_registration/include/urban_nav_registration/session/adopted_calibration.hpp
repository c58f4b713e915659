// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav_registration {

/// Correction of one device that all stages use in place of what the recording of a session states.
struct AdoptedCalibration {
  std::string frame;                  ///< of a laser; kPanoramaDevice
  urban_nav_core::StampNs delay = 0;  ///< its stamps are late by this
  /// Of a laser: T_base_laser = T_base_stated * this. Of the panoramic head: T_base_camera = this * T_base_stated of
  /// each of its cameras.
  urban_nav_core::Pose T_stated_adopted;
};

/// Stands for the panoramic head, whose cameras are fixed to each other.
constexpr const char* kPanoramaDevice = "panorama";

/// Key of the state in StageStates.
constexpr const char* kCalibrationState = "laser_mapper.calibration";

std::string packCalibration(std::vector<AdoptedCalibration> devices);
/// Returns the corrections; throws DataError if the bytes are damaged or of another version.
std::vector<AdoptedCalibration> unpackCalibration(std::string_view bytes);

/// Returns the corrections of a session; empty: none was adopted. Throws DataError if the stored ones are damaged.
std::vector<AdoptedCalibration> readCalibration(urban_nav_store::Store& store,
                                                const urban_nav_store::SessionId& session);
/// Replaces the corrections of a session; none: everything is as stated.
void writeCalibration(urban_nav_store::Store& store, const urban_nav_store::SessionId& session,
                      std::vector<AdoptedCalibration> devices);

/// Correction of the panoramas of a session.
struct PanoramaCorrection {
  urban_nav_core::StampNs delay = 0;  ///< their stamps are late by this
  urban_nav_core::Pose T_correction;  ///< T_base_camera = this * T_base_camera as stated
};
/// Returns what a session has adopted; nothing is corrected without it. Throws DataError if the stored calibration is
/// damaged.
PanoramaCorrection panoramaCorrection(urban_nav_store::Store& store, const urban_nav_store::SessionId& session);

}  // namespace urban_nav_registration
