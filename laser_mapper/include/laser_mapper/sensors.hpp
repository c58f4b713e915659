// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "laser_mapper/map_point.hpp"
#include "laser_mapper/parameters.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"
#include "urban_nav_store/store.hpp"

namespace laser_mapper {

/// Sensor ids of points (MapPoint::laser, column `laser` of the files): 0 and 1 are the lasers at the frames laser_left
/// and laser_right, 2...31 other planar lasers in the order of their frames, kFirstLidar + N the 3D LiDAR with the role
/// pointsN, kFirstDepthCamera + N the depth camera with the role depthN.
constexpr std::uint8_t kFirstLidar = 32, kLastLidar = 122;
/// Dense stereo.
constexpr std::uint8_t kStereoSensor = 255;

inline bool isLidar(std::uint8_t sensor) { return sensor >= kFirstLidar && sensor <= kLastLidar; }

/// Returns the id of a planar laser. `index`: in the order of the session's frames.
std::uint8_t planarSensor(const std::string& frame, std::size_t index);
/// Returns the id of a 3D LiDAR by its role ("points0"); kLastLidar for any other word.
std::uint8_t lidarSensor(const std::string& role);

/// Returns the id of a depth camera, 0 ... kMostDepthCameras - 1, and its role ("depth0").
std::uint8_t depthSensor(std::size_t camera);
std::string depthRole(std::size_t camera);

/// Role and frame of a sensor id.
struct SensorName {
  std::uint8_t id = 0;
  std::string role;   ///< "laser_left", "points0", "depth0", "stereo"; "laser0" ... for other planar lasers
  std::string frame;  ///< frame of its measurements
};
/// Returns the sensors with stored measurements in the sessions, ascending by id. An id of different frames in
/// different sessions has an entry for each.
std::vector<SensorName> storedSensors(urban_nav_store::Store& store,
                                      const std::vector<urban_nav_store::SessionId>& sessions);

/// Returns the poses of a session's sensors on the robot by id, those of planar lasers with the adopted calibration.
std::map<std::uint8_t, urban_nav_core::Pose> sensorPlaces(urban_nav_store::Store& store,
                                                          const urban_nav_store::SessionId& session);

/// Returns the origin of the beams of a point, m in the map; nullopt if its sensor has no place, or there are no poses
/// around its stamp.
std::optional<urban_nav_core::Vector3d> beamOrigin(const MapPoint& point, const urban_nav_core::Trajectory& T_map_base,
                                                   const std::map<std::uint8_t, urban_nav_core::Pose>& places);

/// Returns the measurements that a map of a session lacks: "no laser scans, sweeps of a 3D LiDAR or depth images of
/// dense stereo"; empty if it can be made.
std::string missingMeasurements(urban_nav_store::Store& store, const urban_nav_store::SessionId& session);

/// Error model of a sensor's beams.
struct BeamNoise {
  float range_sigma = 0.0F;  ///< m, standard deviation of a range
  float far_factor = 1.0F;   ///< factor of the standard deviation beyond 20 m
  float range_bias = 0.0F;   ///< m, standard deviation of the constant error of ranges
  float beam_width = 0.0F;   ///< rad, divergence
};
/// Returns the error model of a sensor: for planar lasers from the parameters, for 3D LiDARs that of the HDL-64E. Not
/// for dense stereo, whose points have individual standard deviations.
BeamNoise beamNoise(const Parameters& parameters, std::uint8_t sensor);

}  // namespace laser_mapper
