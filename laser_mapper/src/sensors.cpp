// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/sensors.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <tuple>

#include "laser_mapper/map_cell.hpp"
#include "mounted_laser.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/depth_image.hpp"
#include "urban_nav_store/tables/ground_view.hpp"
#include "urban_nav_store/tables/mounted_lidar.hpp"

namespace laser_mapper {

using urban_nav_store::SessionId;
using urban_nav_store::Store;
namespace frames = urban_nav_core::frames;

namespace {

constexpr std::uint8_t kFirstOtherLaser = 2;
constexpr const char* kLidarRole = "points";
const std::string kLaserRole = "laser";
constexpr const char* kDepthRole = "depth";
constexpr BeamNoise kLidarNoise{0.02F, 1.0F, 0.005F, 0.002F};  // data sheet of the HDL-64E: 2 cm, 2 mrad

/// Returns the frame of a depth camera; nullopt if no image of it is stored.
std::optional<std::string> findDepthFrame(Store& store, const SessionId& session, const std::string& role) {
  constexpr urban_nav_core::StampNs kEver = std::numeric_limits<urban_nav_core::StampNs>::max();
  urban_nav_store::TableStore<urban_nav_store::DepthImage> images(store);
  urban_nav_store::DepthImage key;
  key.session = session;
  key.role = role;
  const std::vector<urban_nav_core::StampNs> stamps = images.keysBetween(key, 0, kEver);
  if (stamps.empty()) return std::nullopt;
  key.stamp = stamps.front();
  const auto first = images.get(key);
  return first ? std::optional(first->frame) : std::nullopt;
}

bool hasDepth(Store& store, const SessionId& session) {
  for (std::size_t camera = 0; camera < kMostDepthCameras; ++camera)
    if (findDepthFrame(store, session, depthRole(camera))) return true;
  return false;
}

bool hasStereo(Store& store, const SessionId& session) {
  bool any = false;
  urban_nav_store::TableStore<urban_nav_store::GroundView>(store).forEach(
      session, [&](const urban_nav_store::GroundView&) { any = true; });
  return any;
}

std::vector<urban_nav_store::MountedLidar> lidars(Store& store, const SessionId& session) {
  std::vector<urban_nav_store::MountedLidar> found;
  urban_nav_store::TableStore<urban_nav_store::MountedLidar>(store).forEach(
      session, [&](const urban_nav_store::MountedLidar& row) { found.push_back(row); });
  return found;
}

}  // namespace

std::uint8_t planarSensor(const std::string& frame, std::size_t index) {
  if (frame == frames::kLaserLeft) return 0;
  if (frame == frames::kLaserRight) return 1;
  return static_cast<std::uint8_t>(std::min<std::size_t>(kFirstOtherLaser + index, kFirstLidar - 1));
}

std::uint8_t lidarSensor(const std::string& role) {
  const std::string prefix = kLidarRole;
  if (role.rfind(prefix, 0) != 0) return kLastLidar;
  const auto number = urban_nav_core::parseInteger(role.substr(prefix.size()));
  if (!number || *number < 0 || *number > kLastLidar - kFirstLidar) return kLastLidar;
  return static_cast<std::uint8_t>(kFirstLidar + *number);
}

std::uint8_t depthSensor(std::size_t camera) { return static_cast<std::uint8_t>(kFirstDepthCamera + camera); }

std::string depthRole(std::size_t camera) { return kDepthRole + std::to_string(camera); }

std::vector<SensorName> storedSensors(Store& store, const std::vector<SessionId>& sessions) {
  std::vector<SensorName> names;
  for (const SessionId& session : sessions) {
    const std::vector<MountedLaser> lasers = statedLasers(store, session);
    std::size_t others = 0;
    for (std::size_t i = 0; i < lasers.size(); ++i) {
      const std::uint8_t id = planarSensor(lasers[i].frame, i);
      names.push_back(
          {id, id < kFirstOtherLaser ? lasers[i].frame : kLaserRole + std::to_string(others++), lasers[i].frame});
    }
    for (const urban_nav_store::MountedLidar& lidar : lidars(store, session))
      names.push_back({lidarSensor(lidar.role), lidar.role, lidar.frame});
    for (std::size_t camera = 0; camera < kMostDepthCameras; ++camera)
      if (const auto frame = findDepthFrame(store, session, depthRole(camera)))
        names.push_back({depthSensor(camera), depthRole(camera), *frame});
    if (hasStereo(store, session)) names.push_back({kStereoSensor, "stereo", frames::kStereoLeft});
  }
  const auto key = [](const SensorName& name) { return std::tie(name.id, name.role, name.frame); };
  std::sort(names.begin(), names.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
  names.erase(std::unique(names.begin(), names.end(), [&](const auto& a, const auto& b) { return key(a) == key(b); }),
              names.end());
  return names;
}

std::map<std::uint8_t, urban_nav_core::Pose> sensorPlaces(Store& store, const SessionId& session) {
  std::map<std::uint8_t, urban_nav_core::Pose> places;
  const std::vector<MountedLaser> lasers = mountedLasers(store, session);
  for (std::size_t i = 0; i < lasers.size(); ++i) places[planarSensor(lasers[i].frame, i)] = lasers[i].T_base_laser;
  for (const urban_nav_store::MountedLidar& lidar : lidars(store, session))
    places[lidarSensor(lidar.role)] = lidar.T_base_lidar;
  return places;
}

std::string missingMeasurements(Store& store, const SessionId& session) {
  if (!store.scans().lasers(session).empty() || !lidars(store, session).empty() || hasStereo(store, session) ||
      hasDepth(store, session))
    return {};
  return "no laser scans, sweeps of a 3D LiDAR, images of a depth camera or of dense stereo";
}

BeamNoise beamNoise(const Parameters& parameters, std::uint8_t sensor) {
  if (isLidar(sensor)) return kLidarNoise;
  return {static_cast<float>(parameters.range_sigma), 2.0F,  // data sheet of the LMS291
          static_cast<float>(parameters.range_bias), static_cast<float>(parameters.beam_width)};
}

}  // namespace laser_mapper
