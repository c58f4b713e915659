// SPDX-License-Identifier: BSD-3-Clause
// Processor time of each driver: for serial devices with transport over pseudo-terminals in real time, for cameras from
// frames in memory.
//
//   urban_nav-bench-driver_load [-o FILE.json] [--seconds 20]

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <thread>

#include "segway_drivers/driver/run_device.hpp"
#include "support/camera_sessions.hpp"
#include "support/device_sessions.hpp"
#include "urban_nav_core/testing/bench_table.hpp"
#include "urban_nav_core/testing/processor_time.hpp"
#include "urban_nav_sim/device/device_server.hpp"

namespace {

using segway_drivers::TimeNs;
using urban_nav_core::testing::cell;
using urban_nav_core::testing::threadMs;

struct Load {
  double share = 0.0;  ///< share of a core
  double rate = 0.0;   ///< messages per second
};

/// Runs a driver like its nodelet, with waits of 2 ms, and the device in another thread.
Load runSerial(urban_nav::bench::DeviceSession& session, double seconds, const std::string& folder) {
  const std::string port = folder + "/port";
  const auto link = urban_nav_sim::openPseudoTerminal(port);
  std::atomic<bool> stop{false};
  std::thread server([&] { serveDevice(*session.device, *link, [&] { return stop.load(); }); });
  segway_drivers::DriverLoop loop(*session.driver, port);
  loop.open();
  const auto runUntil = [&](TimeNs end) {
    while (segway_drivers::steadyTime() < end) loop.step(2'000'000);
  };
  const TimeNs second = 1'000'000'000, begin = segway_drivers::steadyTime() + 4 * second;  // identified by then
  runUntil(begin);
  const double before = 1e-3 * threadMs();
  const std::int64_t messages = *session.messages;
  runUntil(begin + static_cast<TimeNs>(1e9 * seconds));
  Load load{(1e-3 * threadMs() - before) / seconds, static_cast<double>(*session.messages - messages) / seconds};
  stop = true;
  server.join();
  return load;
}

/// Returns the processor time for frames of 20 s.
Load runCamera(const urban_nav::bench::CameraSession& session) {
  constexpr double kDuration = 20.0;
  const double before = 1e-3 * threadMs();
  const int taken = session.run_until(static_cast<int>(kDuration / session.period));
  return {(1e-3 * threadMs() - before) / kDuration, taken / kDuration};
}

}  // namespace

int main(int argc, char** argv) {
  urban_nav_core::testing::BenchTable table({"driver", "messages a second", "share of a core, %"}, argc, argv);
  std::string output;
  double seconds = 20.0;
  for (int i = 1; i + 1 < argc; i += 2) {
    if (std::string(argv[i]) == "-o") output = argv[i + 1];
    if (std::string(argv[i]) == "--seconds") seconds = std::max(std::atof(argv[i + 1]), 2.0);
  }
  const std::string folder = (std::filesystem::temp_directory_path() / "urban_nav_driver_load").string();
  double total = 0.0;
  const auto add = [&](const std::string& name, const Load& load) {
    total += load.share;
    table.add({name, cell(load.rate, 1), cell(100.0 * load.share, 2)});
  };
  urban_nav::bench::forEachSerialDevice(seconds + 10.0, [&](urban_nav::bench::DeviceSession& session) {
    add(session.name, runSerial(session, seconds, folder));
  });
  urban_nav::bench::forEachCamera(
      [&](const urban_nav::bench::CameraSession& session) { add(session.name, runCamera(session)); });
  table.add({"all", "", cell(100.0 * total, 2)});
  table.note(
      "Processor time of the reading thread, with transport, checks and clock; without ROS. Cameras with the copy of "
      "each frame.");
  std::filesystem::remove_all(folder);
  std::fputs(table.text().c_str(), stdout);
  if (!output.empty()) table.write(output);
  return 0;
}
