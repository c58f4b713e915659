// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace urban_nav_sim {

/// What the robot carries, as the command line names it.
enum class Sensor : std::uint8_t { Stereo, Ladybug, Lasers, Imu, Wheels, Gps, Lidar3d };
inline constexpr std::array<Sensor, 7> kAllSensors = {Sensor::Stereo, Sensor::Ladybug, Sensor::Lasers, Sensor::Imu,
                                                      Sensor::Wheels, Sensor::Gps,     Sensor::Lidar3d};
/// The sensors of the paper's robot, the default; a 3D LiDAR comes only on request.
inline constexpr std::array<Sensor, 6> kDefaultSensors = {Sensor::Stereo, Sensor::Ladybug, Sensor::Lasers,
                                                          Sensor::Imu,    Sensor::Wheels,  Sensor::Gps};

/// "stereo", "ladybug", "lasers", "imu", "wheels", "gps", "lidar3d".
const char* toString(Sensor sensor);
/// Throws UserError that names what there is; `where`: its option.
Sensor parseSensor(const std::string& word, const std::string& where);
std::string sensorList();

}  // namespace urban_nav_sim
