// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav_registration {

/// Correction of one device that all stages apply to the calibration stated in the recording of a session.
struct AdoptedCalibration {
  std::string frame;                  ///< frame of a laser, or kPanoramaDevice
  urban_nav_core::StampNs delay = 0;  ///< delay of its stamps
  /// For a laser: T_base_laser = T_base_stated * this. For the panoramic head: T_base_camera = this * T_base_stated for
  /// each of its cameras.
  urban_nav_core::Pose T_stated_adopted;
};

/// Identifies the panoramic head, whose cameras are rigidly connected.
constexpr const char* kPanoramaDevice = "panorama";

/// Key of the state in StageStates.
constexpr const char* kCalibrationState = "laser_mapper.calibration";

std::string packCalibration(std::vector<AdoptedCalibration> devices);
/// Unpacks the corrections. Throws DataError if the bytes are damaged or of another version.
std::vector<AdoptedCalibration> unpackCalibration(std::string_view bytes);

/// Returns the corrections of a session; empty if none was adopted. Throws DataError if the stored ones are damaged.
std::vector<AdoptedCalibration> readCalibration(urban_nav_store::Store& store,
                                                const urban_nav_store::SessionId& session);
/// Replaces the corrections of a session; an empty list removes them.
void writeCalibration(urban_nav_store::Store& store, const urban_nav_store::SessionId& session,
                      std::vector<AdoptedCalibration> devices);

/// Correction of the panoramas of a session.
struct PanoramaCorrection {
  urban_nav_core::StampNs delay = 0;  ///< delay of their stamps
  urban_nav_core::Pose T_correction;  ///< T_base_camera = this * T_base_camera as stated
};
/// Returns the adopted correction of a session; identity without one. Throws DataError if the stored calibration is
/// damaged.
PanoramaCorrection panoramaCorrection(urban_nav_store::Store& store, const urban_nav_store::SessionId& session);

}  // namespace urban_nav_registration
