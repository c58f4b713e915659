// SPDX-License-Identifier: BSD-3-Clause
#include "simulate/simulate.hpp"

#include <filesystem>

#include "base/console.hpp"
#include "base/json.hpp"
#include "base/parameters.hpp"
#include "simulate/calibration_errors.hpp"
#include "simulate/simulate_command.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

using urban_nav_core::UserError;

namespace {

constexpr double kLongest = 86400.0;  // s

/// Parses a comma-separated list of sensors. Throws UserError naming the option for an unknown word.
std::set<urban_nav_sim::Sensor> makeList(const std::string& option, const Arguments& arguments) {
  std::set<urban_nav_sim::Sensor> sensors;
  for (const std::string& word : arguments.list(option))
    sensors.insert(urban_nav_sim::parseSensor(word, "--" + option));
  return sensors;
}

std::set<urban_nav_sim::Sensor> parseSensors(const Arguments& arguments) {
  if (!arguments.has("sensors")) return urban_nav_sim::SessionOptions().sensors;
  std::set<urban_nav_sim::Sensor> sensors = makeList("sensors", arguments);
  if (sensors.empty()) throw UserError("--sensors", "none", urban_nav_sim::sensorList());
  return sensors;
}

SimulateJob makeJob(const Arguments& arguments) {
  SimulateJob job;
  job.session.world = arguments.get("world", job.session.world);
  job.session.route = arguments.get("route", job.session.route);
  job.session.seed = static_cast<std::uint32_t>(arguments.integer("seed", 1, 0, 4294967295));
  job.session.day = static_cast<int>(arguments.integer("day", 1, 1, 100000));
  job.session.light = urban_nav_sim::parseLight(arguments.get("light", "day"));
  job.session.duration = arguments.number("duration", job.session.duration, 0.1, kLongest);
  job.session.sensors = parseSensors(arguments);
  job.session.views = makeList("views", arguments);
  if (arguments.has("lidar")) {
    if (job.session.sensors.count(urban_nav_sim::Sensor::Lidar3d) == 0)
      throw UserError("--lidar", "needs the 3D LiDAR, which --sensors leaves out", "--sensors lidar3d,...");
    job.session.lidar = urban_nav_sim::parseLidarModel(arguments.get("lidar"), "--lidar");
  }
  for (const std::string& word : arguments.list("without")) job.session.defects.switchOff(word);
  for (const std::string& word : arguments.list("with")) job.session.defects.switchOn(word);
  for (const std::string& fault : arguments.all("fault"))
    job.session.faults.push_back(urban_nav_sim::parseFault(fault));
  job.lags = arguments.all("lag");
  job.misplaced = arguments.all("misplace");
  job.bag = arguments.get("output");
  if (const std::string ending = std::filesystem::path(job.bag).extension(); ending != ".bag" && ending != ".mcap")
    throw UserError("--output", job.bag, "a name that ends in .bag or .mcap; the truth is written next to it");
  job.part = arguments.number("split", 0.0, 0.1, kLongest);
  job.folder = arguments.get("folder");
  job.false_closures = arguments.number("false-closures", 0.0, 0.0, 1000.0);
  if (!job.folder.empty() && job.session.sensors.count(urban_nav_sim::Sensor::Stereo) == 0)
    throw UserError("--folder", "needs the stereo camera, which --sensors leaves out", "--sensors stereo,...");
  if (!job.folder.empty() && job.session.defects.has(urban_nav_sim::Sensor::Stereo, urban_nav_sim::Defect::Lens))
    throw UserError("--folder", "has rectified pairs, but --with stereo:lens makes raw ones", "one of the two");
  return job;
}

int runSimulate(const Arguments& arguments, Console& console) {
  const urban_nav_core::ThreadLimit threads(static_cast<int>(arguments.integer("threads", 0, 0, 1024)));
  loadParameters(arguments);  // the simulator has no parameters, but errors are reported
  const SimulateJob job = makeJob(arguments);
  const Simulated made = simulate(job, console);
  Json json = Json::object();
  json["bag"] = job.bag;
  Json& bags = json["bags"] = Json::array();
  for (const std::string& bag : made.bags) bags.append(bag);
  json["truth"] = made.truth_folder;
  json["distance_m"] = made.distance_m;
  Json& counts = json["messages"] = Json::object();
  for (const auto& [topic, count] : made.counts) {
    console.info("  " + topic + ": " + std::to_string(count));
    counts[topic] = count;
  }
  if (arguments.has("json")) urban_nav_core::writeAtomically(arguments.get("json"), json.print());
  for (const std::string& bag : made.bags) console.print(bag + "\n");
  return 0;
}

}  // namespace

Command simulateCommand() {
  Command command;
  command.name = "simulate";
  command.summary = "Drives the simulated robot through a world and writes its sensor data and the truth.";
  command.options = {
      {"--world", "W", "world (default quad; below)", false, false, {}},
      {"--seed", "N", "seed of the world and of all random numbers (default 1)", false, false, {}},
      {"--route", "R", "route through the world (default loops; below)", false, false, {}},
      {"--duration", "S", "duration, s (default 60)", false, false, {}},
      {"--day",
       "D",
       "1, 2, ...: the same world with different weather, vehicles and people (default 1)",
       false,
       false,
       {}},
      {"--light",
       "L",
       "day, dusk (sun at 3 deg) or night (street lamps, lit windows), of any --day (default day)",
       false,
       false,
       {}},
      {"-o,--output",
       "BAG",
       "bag to write; it appears when it is complete, with the truth in BAG_STEM.truth/",
       true,
       false,
       {}},
      {"--split",
       "S",
       "a bag for every S seconds, BAG_STEM_0.bag and so on, each of which appears when it is complete",
       false,
       false,
       {}},
      {"--folder", "DIR", "also write the stereo stream as a KITTI folder", false, false, {}},
      {"--sensors", "LIST", "of " + urban_nav_sim::sensorList() + " (default: all but lidar3d)", false, true, {}},
      {"--lidar",
       "KIND",
       "rings of lidar3d, 16 to 128 (default 64), planar: one horizontal ring, or livox: a rosette",
       false,
       false,
       {}},
      {"--without",
       "LIST",
       "SENSOR:DEFECT,... to disable; all for either: imu:noise, gps:all, all:jitter (below)",
       false,
       true,
       {}},
      {"--with",
       "LIST",
       "SENSOR:DEFECT,... to add: stereo:lens (raw pairs), lasers:offset, lidar3d:times, all:clock (below)",
       false,
       true,
       {}},
      {"--views",
       "LIST",
       "of stereo, ladybug, lasers, lidar3d: also write depth and class of each pixel and beam to BAG_STEM.truth/",
       false,
       true,
       {}},
      {"--fault",
       "FAULT",
       "KIND:SENSOR:START_S:DURATION_S[:VALUE], KIND one of " + urban_nav_sim::faultList() +
           "; VALUE: share of drop and corrupt, seconds of jump",
       false,
       true,
       {}},
      {"--lag",
       "DEVICE:S",
       "stamps of " + calibrationDevices() + " that are delayed by a constant time, in s",
       false,
       true,
       {}},
      {"--misplace",
       "FRAME:ROLL,PITCH,YAW",
       "a mounting error in deg, in /tf_static only: laser_left:0,1,0, lidar3d:1,0,0; FRAME ladybug: the whole head",
       false,
       true,
       {}},
      {"--false-closures",
       "PERCENT",
       "number of false closures in closures_false.csv, in percent of the true ones",
       false,
       false,
       {}},
      threadsOption(),
      configOption(),
      setOption(),
      jsonOption()};
  command.more_help = [](const Arguments& arguments) {
    return urban_nav_sim::worldHelp() + "\n" + urban_nav_sim::defectHelp() + "\n" + commonHelp(arguments);
  };
  command.examples = {
      "urban_nav simulate --world quad --seed 7 --route loops --duration 300 --day 2 -o day2.bag",
      "urban_nav simulate --world street --light dusk --day 2 -o dusk.bag",
      "urban_nav simulate --sensors stereo --folder quad/ -o quad.bag",
      "urban_nav simulate --without all:all --with stereo:lens --views stereo,lasers -o ideal.bag",
      "urban_nav simulate --world tunnel --sensors stereo,lidar3d --lidar 16 --views lidar3d -o tunnel.bag",
      "urban_nav simulate --fault unplug:lasers:20:5 --fault drop:stereo:30:10:0.3 -o faults.bag"};
  command.run = runSimulate;
  return command;
}

}  // namespace urban_nav
