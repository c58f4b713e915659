// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <set>
#include <vector>

#include "lidar/lidar3d.hpp"
#include "motion/motion.hpp"
#include "noise/noise.hpp"
#include "proprioception/clock.hpp"
#include "urban_nav_core/camera/camera_info.hpp"
#include "urban_nav_sim/defect.hpp"
#include "urban_nav_sim/fault.hpp"
#include "urban_nav_sim/measurement.hpp"
#include "world/world.hpp"

namespace urban_nav_sim {

/// The cameras and lasers of a session: all sensors that trace rays. Measurements of one device must be requested in
/// order; each comes with the views of it that the session requests. Not thread-safe (each call uses all threads);
/// world and motion must outlive it.
class OpticalSensors {
 public:
  /// `faults`: its knocks turn the left laser and the Ladybug.
  OpticalSensors(const World& world, const Motion& motion, const Noise& noise, const Defects& defects,
                 const LidarModel& lidar, const std::set<Sensor>& views, const std::vector<Fault>& faults = {});
  ~OpticalSensors();

  std::vector<Measurement> stereo(std::int64_t k, const Clock& clock);
  std::vector<Measurement> panorama(std::int64_t k, const Clock& clock);
  std::vector<Measurement> laser(Side side, std::int64_t k, const Clock& clock);
  std::vector<Measurement> lidar(std::int64_t k, const Clock& clock);
  /// Constant errors of the 3D LiDAR's rings, and its pattern.
  const Lidar3d& lidarDevice() const;

  static urban_nav_core::CameraInfo stereoInfo(Side side, const Defects& defects);
  static urban_nav_core::CameraInfo ladybugInfo(int camera);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace urban_nav_sim
