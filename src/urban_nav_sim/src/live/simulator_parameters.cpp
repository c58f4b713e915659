// SPDX-License-Identifier: BSD-3-Clause
#include "live/simulator_parameters.hpp"

#include <cstdint>
#include <limits>

#include "live/split_words.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_sim {

using urban_nav_core::Table;

SimulatorParameters::SimulatorParameters() { simulatorTable().setDefaults(*this); }

// clang-format would give each of the columns a line.
// clang-format off
const Table<SimulatorParameters>& simulatorTable() {
  using P = SimulatorParameters;
  static const Table<SimulatorParameters> rows(
      "",
      {
          {"world", &P::world, "", "quad", false, false, {},
           "World; `urban_nav simulate --help` lists them with their routes.", ""},
          {"route", &P::route, "", "loops", false, false, {}, "Route through the world.", ""},
          {"seed", &P::seed, "", 1, 0, std::int64_t{std::numeric_limits<int>::max()}, {},
           "Seed of the world and of all random numbers: the same seed gives the same bytes.", "docs/conventions.md"},
          {"day", &P::day, "", 1, 1, 100000, {},
           "Day: the same world with different weather, vehicles and people.", ""},
          {"light", &P::light, "", "day", false, false, {"day", "dusk", "night"},
           "Time of day: the sun of the day, 3 deg above the horizon, or none, with street lamps and lit windows.", ""},
          {"duration", &P::duration, "s", 60.0, 0.1, 86400.0, {}, "Duration of the session.", ""},
          {"sensors", &P::sensors, "", "stereo, ladybug, lasers, imu, wheels, gps", false, false, {},
           "Sensors of the robot, separated by commas; others take no time.", "docs/architecture.md"},
          {"lidar", &P::lidar, "", "64", false, false, {},
           "Kind of the 3D LiDAR, if lidar3d is among the sensors: number of its rings, 16 to 128, livox, or planar.",
           ""},
          {"with", &P::with, "", "", false, false, {},
           "Defects of the sensors in addition to the default ones, separated by commas: stereo:lens, all:clock, as "
           "for `urban_nav simulate --with`.",
           ""},
          {"without", &P::without, "", "", false, false, {},
           "Default defects to disable: imu:noise, gps:all, as for `urban_nav simulate --without`.", ""},
          {"fault", &P::fault, "", "", false, false, {},
           "Faults, separated by commas: KIND:SENSOR:START_S:DURATION_S[:VALUE], as for `urban_nav simulate --fault`.",
           ""},
          {"rate", &P::rate, "s/s", 1.0, 0.0, 1000.0, {},
           "Seconds of the session per second of time, if the machine is fast enough; 0: as fast as possible.", ""},
          {"delay", &P::delay, "s", 2.0, 0.0, 3600.0, {},
           "Minimum time for subscribers to connect before the first message.", "rosbag play --delay"},
          {"paused", &P::paused, "", false, false, true, {}, "Whether to wait at the first message for ~resume.", ""},
          {"exit", &P::exit, "", true, false, true, {},
           "Whether the process ends with the session; false for a manager with other nodelets: wait for ~reset.",
           ""},
          {"threads", &P::threads, "", 0, 0, 1024, {},
           "Threads for rendering, in the whole process; 0: one per processor. Without effect on the output.", ""},
          {"queue", &P::queue, "messages", 1000, 1, 100000, {},
           "Messages of a topic that may wait for a subscriber; beyond that the oldest is dropped.", ""},
      });
  return rows;
}
// clang-format on

SessionOptions sessionOptions(const SimulatorParameters& parameters, const std::string& where) {
  SessionOptions options;
  options.where = where;
  options.world = parameters.world;
  options.route = parameters.route;
  options.seed = static_cast<std::uint32_t>(parameters.seed);
  options.day = parameters.day;
  options.light = parseLight(parameters.light, where + "light");
  options.duration = parameters.duration;
  options.lidar = parseLidarModel(parameters.lidar, where + "lidar");
  options.sensors.clear();
  for (const std::string& word : splitWords(parameters.sensors))
    options.sensors.insert(parseSensor(word, where + "sensors"));
  if (options.sensors.empty()) throw urban_nav_core::UserError(where + "sensors", "none", sensorList());
  for (const std::string& word : splitWords(parameters.without)) options.defects.switchOff(word, where + "without");
  for (const std::string& word : splitWords(parameters.with)) options.defects.switchOn(word, where + "with");
  for (const std::string& word : splitWords(parameters.fault))
    options.faults.push_back(parseFault(word, where + "fault"));
  checkPlace(options);
  return options;
}

}  // namespace urban_nav_sim
