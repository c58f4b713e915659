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
#include "urban_nav_store/tables/depth_view.hpp"
#include "urban_nav_store/tables/ground_view.hpp"
#include "urban_nav_store/tables/mounted_lidar.hpp"

namespace laser_mapper {

using urban_nav_store::SessionId;
using urban_nav_store::Store;
namespace frames = urban_nav_core::frames;

namespace {

constexpr std::uint8_t kFirstOtherLaser = 2;
constexpr urban_nav_core::StampNs kLongestBeamGap = 500'000'000;  // between the poses around a beam
constexpr const char* kLidarRole = "points";
const std::string kLaserRole = "laser";
constexpr const char* kDepthRole = "depth";
constexpr BeamNoise kLidarNoise{0.02F, 1.0F, 0.005F, 0.002F};  // data sheet of the HDL-64E: 2 cm, 2 mrad

/// Returns the earliest row with the members of the key but the stamp.
template <typename Row>
std::optional<Row> findFirst(Store& store, Row key) {
  constexpr urban_nav_core::StampNs kEver = std::numeric_limits<urban_nav_core::StampNs>::max();
  const urban_nav_store::TableStore<Row> rows(store);
  const std::vector<urban_nav_core::StampNs> stamps = rows.keysBetween(key, 0, kEver);
  if (stamps.empty()) return std::nullopt;
  key.stamp = stamps.front();
  return rows.get(key);
}

std::optional<urban_nav_store::DepthImage> findDepthImage(Store& store, const SessionId& session, std::size_t camera) {
  urban_nav_store::DepthImage key;
  key.session = session;
  key.role = depthRole(camera);
  return findFirst(store, key);
}

bool hasDepth(Store& store, const SessionId& session) {
  for (std::size_t camera = 0; camera < kMostDepthCameras; ++camera)
    if (findDepthImage(store, session, camera)) return true;
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
      if (const auto image = findDepthImage(store, session, camera))
        names.push_back({depthSensor(camera), depthRole(camera), image->frame});
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
  for (std::size_t camera = 0; camera < kMostDepthCameras; ++camera)
    if (const auto image = findDepthImage(store, session, camera)) places[depthSensor(camera)] = image->T_base_camera;
  urban_nav_store::DepthView key;
  key.session = session;
  if (const auto view = findFirst(store, key)) places[kStereoSensor] = view->T_base_camera;
  return places;
}

std::optional<urban_nav_core::Vector3d> beamOrigin(const MapPoint& point, const urban_nav_core::Trajectory& T_map_base,
                                                   const std::map<std::uint8_t, urban_nav_core::Pose>& places) {
  const auto place = places.find(point.laser);
  if (place == places.end()) return std::nullopt;
  const std::optional<urban_nav_core::Pose> pose = T_map_base.at(point.stamp, kLongestBeamGap);
  return pose ? std::optional(*pose * place->second.t()) : std::nullopt;
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
