// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <functional>
#include <map>
#include <stdexcept>

#include "base/console.hpp"
#include "base/held_signals.hpp"
#include "base/json.hpp"
#include "device/device_command.hpp"
#include "device/device_options.hpp"
#include "device/simulate_camera.hpp"
#include "device/simulate_device.hpp"
#include "segway_drivers/driver/run_device.hpp"
#include "segway_drivers/parameters.hpp"
#include "segway_drivers/table/decode_file.hpp"
#include "segway_drivers/table/encode_command.hpp"
#include "segway_drivers/table/row_decoder.hpp"
#include "segway_drivers/table/stamp_file.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/parameters/print.hpp"
#include "urban_nav_core/parameters/sources.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_sim/device/device_fault.hpp"

namespace urban_nav {

using urban_nav_core::UserError;

namespace {

urban_nav_core::Loaded<segway_drivers::Parameters> loadDriverParameters(const Arguments& arguments) {
  std::vector<urban_nav_core::Assignment> assignments;
  for (const std::string& path : arguments.all("config")) {
    const std::vector<urban_nav_core::Assignment> file = urban_nav_core::readParameters(path);
    assignments.insert(assignments.end(), file.begin(), file.end());
  }
  for (const std::string& setting : arguments.all("set")) {
    assignments.push_back(urban_nav_core::parseSetting(setting));
    urban_nav_core::refuseUnknownStages({assignments.back()}, {segway_drivers::table().stage()});
  }
  return urban_nav_core::load(segway_drivers::table(), assignments);
}

std::string requiredValue(const Arguments& arguments, const std::string& option) {
  if (!arguments.has(option)) throw UserError("urban_nav device", "--" + option + " is missing", "");
  return arguments.get(option);
}

/// Returns the words after the action. Throws UserError unless there are `count`, or at least `count` with `more`.
std::vector<std::string> deviceWords(const Arguments& arguments, std::size_t count, bool more,
                                     const std::string& usage) {
  std::vector<std::string> words = arguments.all("ARGUMENT");
  // roslaunch appends __name:=... and __log:=...
  words.erase(
      std::remove_if(words.begin(), words.end(), [](const std::string& word) { return word.rfind("__", 0) == 0; }),
      words.end());
  if (words.size() < count || (!more && words.size() > count))
    throw UserError("urban_nav device", std::to_string(words.size()) + " arguments after the action", usage);
  return words;
}

Json jsonOfCounters(const segway_drivers::DeviceCounters& counters, const std::string& state) {
  Json json = Json::object();
  json["bytes"] = counters.bytes;
  json["frames"] = counters.frames;
  json["bad_checksums"] = counters.bad_checksums;
  json["bytes_skipped"] = counters.bytes_skipped;
  json["gaps"] = counters.gaps;
  json["unexpected"] = counters.unexpected;
  json["timeouts"] = counters.timeouts;
  json["stalls"] = counters.stalls;
  json["reconnections"] = counters.reconnections;
  json["epochs"] = counters.epochs;
  json["state"] = state;
  return json;
}

int runDecode(const Arguments& arguments, Console& console) {
  const auto words = deviceWords(arguments, 2, false, "decode KIND FILE -o OUT.csv");
  segway_drivers::DecodeJob job;
  job.kind = words[0];
  job.input = words[1];
  job.output = requiredValue(arguments, "output");
  job.arrivals = arguments.get("arrivals");
  job.chunk = static_cast<int>(arguments.integer("chunk", 4096, 0, 1 << 24));
  job.seed = static_cast<std::uint64_t>(arguments.integer("seed", 1, 0, 4294967295));
  const auto counters = segway_drivers::decodeFile(job, loadDriverParameters(arguments).parameters);
  console.info(std::to_string(counters.frames) + " frames, " + std::to_string(counters.bad_checksums) +
               " bad checksums, " + std::to_string(counters.bytes_skipped) + " of " + std::to_string(counters.bytes) +
               " bytes skipped");
  if (arguments.has("json"))
    urban_nav_core::writeAtomically(arguments.get("json"), jsonOfCounters(counters, "decoded").print());
  return 0;
}

int runEncode(const Arguments& arguments, Console& console) {
  const auto words = deviceWords(arguments, 1, true, "encode KIND COMMAND [ARGUMENT...]");
  loadDriverParameters(arguments);
  console.print(segway_drivers::printHex(segway_drivers::encodeCommand(words[0], {words.begin() + 1, words.end()})) +
                "\n");
  return 0;
}

int runStamp(const Arguments& arguments, Console& console) {
  const auto words = deviceWords(arguments, 1, false, "stamp IN.csv -o OUT.csv");
  loadDriverParameters(arguments);
  segway_drivers::StampJob job;
  job.input = words[0];
  job.output = requiredValue(arguments, "output");
  job.period = arguments.number("period", 0.01, 1e-6, 1e4);
  job.tolerance = 1e-6 * arguments.number("tolerance-ppm", 200.0, 0.1, 50000.0);
  job.latency = 1e-3 * arguments.number("latency-ms", 0.0, 0.0, 1e5);
  const segway_drivers::StampResult result = segway_drivers::stampFile(job);
  console.info(std::to_string(result.rows) + " rows, " + std::to_string(result.epochs) + " new epochs");
  if (arguments.has("json")) {
    Json json = Json::object();
    json["rows"] = result.rows;
    json["epochs"] = result.epochs;
    json["skew_ppm"] = result.skew_ppm;
    json["sigma_us"] = result.sigma_us;
    urban_nav_core::writeAtomically(arguments.get("json"), json.print());
  }
  return 0;
}

int runDeviceRun(const Arguments& arguments, Console& console) {
  const auto words = deviceWords(arguments, 1, false, "run KIND --port PATH --duration S -o OUT.csv");
  const segway_drivers::Parameters parameters = loadDriverParameters(arguments).parameters;
  segway_drivers::RunJob job;
  job.kind = words[0];
  segway_drivers::rowColumns(job.kind);  // refuses an unknown kind
  job.port = requiredValue(arguments, "port");
  requiredValue(arguments, "duration");
  job.duration = arguments.number("duration", 0.0, 0.0, 1e7);
  job.output = requiredValue(arguments, "output");
  job.drive = arguments.get("drive");
  const auto report = [&](const segway_drivers::DriverEvent& event) {
    if (event.warning) console.warn(job.kind + ": " + event.text);
    else console.info(job.kind + ": " + event.text);
  };
  const segway_drivers::RunResult result = segway_drivers::runDevice(job, parameters, report);
  if (arguments.has("json")) {
    Json json = jsonOfCounters(result.counters, result.state);
    json["identity"] = result.identity;
    json["offset_s"] = result.offset_s;
    json["skew_ppm"] = result.skew_ppm;
    json["sigma_us"] = result.sigma_us;
    urban_nav_core::writeAtomically(arguments.get("json"), json.print());
  }
  return 0;
}

std::int64_t runSimulatedCamera(const std::string& kind, const Arguments& arguments,
                                const std::function<bool()>& stop) {
  SimulateCameraJob job;
  job.kind = kind;
  job.source = requiredValue(arguments, "source");
  job.bag = arguments.get("bag");
  job.session = simulatedSession(arguments);
  job.truth = arguments.get("truth");
  job.options = simulatedDeviceOptions(arguments);
  return simulateCamera(job, stop);
}

std::int64_t runSimulatedDevice(const std::string& kind, const Arguments& arguments,
                                const std::function<bool()>& stop) {
  SimulateDeviceJob job;
  job.device.kind = kind;
  if (arguments.has("source")) throw UserError("--source", kind, "bumblebee2, ladybug2");
  job.device.tcp = static_cast<int>(arguments.integer("tcp", 0, 1, 65535));
  if (job.device.tcp > 0 && kind != "gps") throw UserError("--tcp", kind, "gps");
  if (job.device.tcp == 0) job.device.link = requiredValue(arguments, "link");
  job.bag = arguments.get("bag");
  job.session = simulatedSession(arguments);
  job.side = arguments.get("side", "left");
  job.device.begin = arguments.get("begin");
  job.device.truth = arguments.get("truth");
  job.device.options = simulatedDeviceOptions(arguments);
  return simulateDevice(job, stop);
}

int runDeviceSimulate(const Arguments& arguments, Console& console) {
  const auto words = deviceWords(arguments, 1, false, "simulate KIND --link PATH (--bag BAG | --world W)");
  loadDriverParameters(arguments);
  const std::string& kind = words[0];
  segway_drivers::rowColumns(kind);  // refuses an unknown kind
  const HeldSignals signals;
  const auto stop = [&signals] {
    try {
      signals.check();
      return false;
    } catch (const std::runtime_error&) {
      return true;
    }
  };
  const std::int64_t measurements =
      isCamera(kind) ? runSimulatedCamera(kind, arguments, stop) : runSimulatedDevice(kind, arguments, stop);
  console.info(std::to_string(measurements) + " measurements");
  return 0;
}

const std::map<std::string, std::function<int(const Arguments&, Console&)>>& deviceActions() {
  static const std::map<std::string, std::function<int(const Arguments&, Console&)>> actions = {
      {"decode", runDecode},
      {"encode", runEncode},
      {"run", runDeviceRun},
      {"simulate", runDeviceSimulate},
      {"stamp", runStamp}};
  return actions;
}

int runDevice(const Arguments& arguments, Console& console) {
  arguments.integer("threads", 0, 1, 1024);
  return deviceActions().at(arguments.get("ACTION"))(arguments, console);
}

std::string deviceHelp(const Arguments& arguments) {
  std::string kinds;
  for (const std::string& kind : segway_drivers::deviceKinds()) kinds += (kinds.empty() ? "" : ", ") + kind;
  return "actions:\n"
         "  decode KIND FILE -o OUT.csv          bytes as a device sent them, as a table\n"
         "  encode KIND COMMAND [ARGUMENT...]    the bytes of a command, in hexadecimal\n"
         "  run KIND --port PATH --duration S -o OUT.csv  a device at a serial port, or gpsd at HOST:PORT\n"
         "  simulate KIND --link PATH --bag BAG  a device on a pseudo-terminal, fed by a bag of simulate or by "
         "--world\n"
         "  simulate CAMERA --source FILE --bag BAG  raw frames of a camera, and FILE.csv, their index; or by --world\n"
         "  stamp IN.csv -o OUT.csv              device_s,arrival_ns through the clock filter\n"
         "kinds: " +
         kinds + "\n\nparameters (--config FILE, --set segway_drivers.KEY=VALUE):\n" +
         urban_nav_core::printHelp(segway_drivers::table().stage(), segway_drivers::table().rows(),
                                   loadDriverParameters(arguments).settings);
}

}  // namespace

Command deviceCommand() {
  Command command;
  command.name = "device";
  command.summary = "Runs, decodes and simulates the robot's devices without ROS.";
  std::vector<std::string> actions;
  for (const auto& action : deviceActions()) actions.push_back(action.first);
  command.options = {
      {"ACTION", "", "action", true, false, actions},
      {"ARGUMENT", "", "arguments of the action, see below", false, true, {}},
      {"-o,--output", "OUT.csv", "table to write", false, false, {}},
      {"--chunk",
       "N",
       "decode: bytes per call, 0 for random lengths; without effect on the result (default 4096)",
       false,
       false,
       {}},
      {"--arrivals", "FILE", "decode: offset,arrival_ns of each read; adds stamps", false, false, {}},
      {"--port", "PATH", "run: serial port, preferably by /dev/serial/by-id; HOST:PORT of gpsd", false, false, {}},
      {"--duration", "S", "run: s to run; simulate --world: s of the session (default 60)", false, false, {}},
      {"--drive", "FILE", "run segway_rmp: t_s,linear_mps,angular_radps since the port was opened", false, false, {}},
      {"--link", "PATH", "simulate: link to make to the pseudo-terminal", false, false, {}},
      {"--source", "FILE", "simulate a camera: file of raw frames to write, with FILE.csv", false, false, {}},
      {"--tcp", "PORT", "simulate gps: serve the gpsd protocol at this port instead", false, false, {}},
      {"--bag", "BAG", "simulate: recorded session", false, false, {}},
      {"--world", "W", "simulate: simulate a session in this world first, instead of --bag", false, false, {}},
      {"--route", "R", "simulate: its route (default loops)", false, false, {}},
      {"--day", "D", "simulate: its day (default 1)", false, false, {}},
      {"--light", "L", "simulate: its light, day, dusk or night (default day)", false, false, {}},
      {"--side", "SIDE", "simulate lms291: which laser (default left)", false, false, {"left", "right"}},
      {"--fault", "KIND:START_S:DURATION_S[:VALUE]", "simulate: " + urban_nav_sim::deviceFaultList(), false, true, {}},
      {"--clock", "OFFSET_S:PPM", "simulate: clock of the device relative to that of the host", false, false, {}},
      {"--delay", "MODEL", "simulate: exponential:MIN:MEAN:MAX, uniform:MIN:MAX or batch:MS, in ms", false, false, {}},
      {"--begin", "FILE", "simulate: devices with the same new file begin their sessions together", false, false, {}},
      {"--truth", "FILE", "simulate: write sequence,true_ns of each measurement", false, false, {}},
      {"--period", "S", "stamp: nominal spacing of the device times, s (default 0.01)", false, false, {}},
      {"--tolerance-ppm", "P", "stamp: largest skew of the device clock, ppm (default 200)", false, false, {}},
      {"--latency-ms", "L", "stamp: delay to subtract, ms (default 0)", false, false, {}},
      {"--seed", "N", "seed of random lengths and of simulated noise (default 1)", false, false, {}},
      jsonOption(),
      configOption(),
      setOption(),
      threadsOption()};
  command.examples = {"urban_nav device decode lms291 laser.bin -o scans.csv",
                      "urban_nav device encode segway_rmp velocity 0.5 0"};
  command.more_help = deviceHelp;
  command.run = runDevice;
  return command;
}

}  // namespace urban_nav
