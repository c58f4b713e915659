// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/session/adopted_calibration.hpp"

#include "urban_nav_core/io/archive.hpp"

namespace urban_nav_registration {

using urban_nav_core::Archive;
using urban_nav_store::SessionId;
using urban_nav_store::Store;

namespace {

constexpr std::uint32_t kCalibrationVersion = 1;

}  // namespace

// Found by argument-dependent look-up from the archive.
void archive(Archive& archive, AdoptedCalibration& device) {
  archive(device.frame, device.delay, device.T_stated_adopted);
}

std::string packCalibration(std::vector<AdoptedCalibration> devices) {
  Archive archive;
  archive(devices);
  return urban_nav_core::seal(kCalibrationState, kCalibrationVersion, archive.take());
}

std::vector<AdoptedCalibration> unpackCalibration(std::string_view bytes) {
  std::vector<AdoptedCalibration> devices;
  Archive archive(urban_nav_core::unseal(kCalibrationState, kCalibrationVersion, bytes),
                  std::string("state of ") + kCalibrationState);
  archive(devices);
  archive.finish();
  return devices;
}

std::vector<AdoptedCalibration> readCalibration(Store& store, const SessionId& session) {
  const auto bytes = store.states().get(session, kCalibrationState);
  return bytes ? unpackCalibration(*bytes) : std::vector<AdoptedCalibration>();
}

void writeCalibration(Store& store, const SessionId& session, std::vector<AdoptedCalibration> devices) {
  if (devices.empty()) store.states().remove(session, kCalibrationState);
  else store.states().put(session, kCalibrationState, packCalibration(std::move(devices)));
}

PanoramaCorrection panoramaCorrection(Store& store, const SessionId& session) {
  for (const AdoptedCalibration& device : readCalibration(store, session))
    if (device.frame == kPanoramaDevice) return {device.delay, device.T_stated_adopted};
  return {};
}

}  // namespace urban_nav_registration
