// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/calibration_state.hpp"

#include <algorithm>
#include <cmath>

#include "laser_mapper/calibration/laser_calibration.hpp"
#include "urban_nav_core/io/archive.hpp"

namespace laser_mapper {

using urban_nav_core::Archive;
using urban_nav_core::Pose;
using urban_nav_core::Vector3d;

namespace {

constexpr std::uint32_t kCalibrationVersion = 1;
constexpr const char* kPanorama = "panorama";  // beside the frames of lasers

std::vector<AdoptedCalibration> adoptedCalibrations(urban_nav_store::Store& store,
                                                    const urban_nav_store::SessionId& session) {
  const auto bytes = store.states().get(session, kCalibrationState);
  return bytes ? unpackCalibration(*bytes) : std::vector<AdoptedCalibration>();
}

Vector3d adoptedVector(const LaserCalibration& laser, CalibrationTerm first) {
  const auto begin = static_cast<std::size_t>(first);
  return {laser.terms[begin].adopted, laser.terms[begin + 1].adopted, laser.terms[begin + 2].adopted};
}

}  // namespace

void archive(Archive& archive, AdoptedCalibration& laser) { archive(laser.frame, laser.delay, laser.T_stated_laser); }

std::string packCalibration(std::vector<AdoptedCalibration> lasers) {
  Archive archive;
  archive(lasers);
  return urban_nav_core::seal(kCalibrationState, kCalibrationVersion, archive.take());
}

std::vector<AdoptedCalibration> unpackCalibration(std::string_view bytes) {
  std::vector<AdoptedCalibration> lasers;
  Archive archive(urban_nav_core::unseal(kCalibrationState, kCalibrationVersion, bytes),
                  std::string("state of ") + kCalibrationState);
  archive(lasers);
  archive.finish();
  return lasers;
}

bool LaserCalibration::isAdopted() const {
  for (const CalibrationEstimate& term : terms)
    if (term.adopted != 0.0) return true;
  return false;
}

void storeCalibration(urban_nav_store::Store& store, const urban_nav_store::SessionId& session,
                      const CalibrationResult& calibration) {
  std::vector<AdoptedCalibration> lasers;
  for (const LaserCalibration& laser : calibration.lasers)
    if (laser.isAdopted())
      lasers.push_back({laser.frame, std::llround(1e9 * laser.at(CalibrationTerm::Delay).adopted),
                        Pose(urban_nav_core::expSo3(adoptedVector(laser, CalibrationTerm::TurnX)),
                             adoptedVector(laser, CalibrationTerm::ShiftX))});
  if (lasers.empty()) forgetCalibration(store, session);
  else store.states().put(session, kCalibrationState, packCalibration(std::move(lasers)));
}

void storePanoramaDelay(urban_nav_store::Store& store, const urban_nav_store::SessionId& session, double delay) {
  std::vector<AdoptedCalibration> adopted = adoptedCalibrations(store, session);
  adopted.erase(
      std::remove_if(adopted.begin(), adopted.end(), [](const auto& each) { return each.frame == kPanorama; }),
      adopted.end());
  if (delay != 0.0) adopted.push_back({kPanorama, std::llround(1e9 * delay), Pose()});
  if (adopted.empty()) forgetCalibration(store, session);
  else store.states().put(session, kCalibrationState, packCalibration(std::move(adopted)));
}

urban_nav_core::StampNs panoramaDelay(urban_nav_store::Store& store, const urban_nav_store::SessionId& session) {
  for (const AdoptedCalibration& each : adoptedCalibrations(store, session))
    if (each.frame == kPanorama) return each.delay;
  return 0;
}

void forgetCalibration(urban_nav_store::Store& store, const urban_nav_store::SessionId& session) {
  store.states().remove(session, kCalibrationState);
}

}  // namespace laser_mapper
