// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "camera/heads.hpp"
#include "laser/lms291.hpp"
#include "lidar/lidar3d.hpp"
#include "proprioception/clock.hpp"
#include "proprioception/gps.hpp"
#include "proprioception/imu.hpp"
#include "proprioception/wheels.hpp"
#include "urban_nav_sim/defect.hpp"

namespace urban_nav_sim {

// Settings with exactly these defects.
StereoImages stereoImages(const Defects& defects);
/// `sensor`: Stereo or Ladybug.
CameraDefects cameraDefects(const Defects& defects, Sensor sensor);
Lms291::Settings laserSettings(const Defects& defects);
Lidar3d::Settings lidarSettings(const Defects& defects);
ImuOptions imuOptions(const Defects& defects);
WheelOptions wheelOptions(const Defects& defects);
GpsOptions gpsOptions(const Defects& defects);
/// `seed`: of offsets and skews.
ClockOptions clockOptions(const Defects& defects, Sensor sensor, std::uint64_t seed);

}  // namespace urban_nav_sim
