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
  std::string frame;                      ///< of a laser; kPanoramaDevice
  urban_nav_core::StampNs delay = 0;      ///< its stamps are late by this
  urban_nav_core::Pose T_stated_adopted;  ///< T_base_device = T_base_stated * this; identity for the panorama
};

/// Stands for the panoramic head, whose stamps alone are corrected.
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

/// Returns by how much the panoramas of a session are late. Throws DataError if the stored calibration is damaged.
urban_nav_core::StampNs panoramaDelay(urban_nav_store::Store& store, const urban_nav_store::SessionId& session);

}  // namespace urban_nav_registration
