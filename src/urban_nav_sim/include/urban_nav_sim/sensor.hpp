// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace urban_nav_sim {

/// Sensors of the robot, with their names on the command line.
enum class Sensor : std::uint8_t { Stereo, Ladybug, Lasers, Imu, Wheels, Gps, Lidar3d };
inline constexpr std::array<Sensor, 7> kAllSensors = {Sensor::Stereo, Sensor::Ladybug, Sensor::Lasers, Sensor::Imu,
                                                      Sensor::Wheels, Sensor::Gps,     Sensor::Lidar3d};
/// The sensors of the robot of the paper, the default; a 3D LiDAR only on request.
inline constexpr std::array<Sensor, 6> kDefaultSensors = {Sensor::Stereo, Sensor::Ladybug, Sensor::Lasers,
                                                          Sensor::Imu,    Sensor::Wheels,  Sensor::Gps};

/// "stereo", "ladybug", "lasers", "imu", "wheels", "gps", "lidar3d".
const char* toString(Sensor sensor);
/// Throws UserError listing the sensors; `where`: the option.
Sensor parseSensor(const std::string& word, const std::string& where);
std::string sensorList();

}  // namespace urban_nav_sim
