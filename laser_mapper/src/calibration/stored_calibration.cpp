// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "laser_mapper/calibration/laser_calibration.hpp"
#include "laser_mapper/calibration/view_calibration.hpp"
#include "urban_nav_registration/session/adopted_calibration.hpp"

namespace laser_mapper {

using urban_nav_core::Vector3d;
using urban_nav_registration::AdoptedCalibration;
using urban_nav_store::SessionId;
using urban_nav_store::Store;

namespace {

Vector3d adoptedVector(const DeviceCalibration& laser, CalibrationTerm first) {
  const auto begin = static_cast<std::size_t>(first);
  return {laser.terms[begin].adopted, laser.terms[begin + 1].adopted, laser.terms[begin + 2].adopted};
}

/// Returns the adopted calibration of a session: either of its panorama or of its lasers.
std::vector<AdoptedCalibration> readDevices(Store& store, const SessionId& session, bool panorama) {
  std::vector<AdoptedCalibration> devices = urban_nav_registration::readCalibration(store, session);
  devices.erase(std::remove_if(devices.begin(), devices.end(),
                               [&](const AdoptedCalibration& device) {
                                 return (device.frame == urban_nav_registration::kPanoramaDevice) != panorama;
                               }),
                devices.end());
  return devices;
}

}  // namespace

bool DeviceCalibration::isAdopted() const {
  return std::any_of(terms.begin(), terms.end(), [](const CalibrationEstimate& term) { return term.adopted != 0.0; });
}

void storeCalibration(Store& store, const SessionId& session, const CalibrationResult& calibration) {
  std::vector<AdoptedCalibration> devices;
  for (const DeviceCalibration& laser : calibration.lasers)
    if (laser.isAdopted())
      devices.push_back({laser.frame, std::llround(1e9 * laser.at(CalibrationTerm::Delay).adopted),
                         urban_nav_core::Pose(urban_nav_core::expSo3(adoptedVector(laser, CalibrationTerm::TurnX)),
                                              adoptedVector(laser, CalibrationTerm::ShiftX))});
  for (AdoptedCalibration& panorama : readDevices(store, session, true)) devices.push_back(std::move(panorama));
  urban_nav_registration::writeCalibration(store, session, std::move(devices));
}

void storeViewCalibration(Store& store, const SessionId& session, const ViewCalibration& calibration) {
  std::vector<AdoptedCalibration> devices = readDevices(store, session, false);
  if (calibration.head.isAdopted())
    devices.push_back({urban_nav_registration::kPanoramaDevice,
                       std::llround(1e9 * calibration.head.at(CalibrationTerm::Delay).adopted),
                       calibration.headCorrection()});
  urban_nav_registration::writeCalibration(store, session, std::move(devices));
}

void forgetCalibration(Store& store, const SessionId& session) {
  urban_nav_registration::writeCalibration(store, session, {});
}

}  // namespace laser_mapper
