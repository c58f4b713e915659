// SPDX-License-Identifier: BSD-3-Clause
// Time and memory of an hour of each serial device and its driver, and of a minute of each camera, on a stepped clock.
//
//   urban_nav-bench-device_hour [-o FILE.json] [--seconds 3600]
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

#include "../test/device/stepped_device.hpp"
#include "support/camera_sessions.hpp"
#include "support/device_sessions.hpp"
#include "urban_nav_core/testing/bench_table.hpp"

namespace {

using urban_nav_core::testing::cell;

/// Returns the memory of this process, MB.
double residentMb() {
  std::ifstream file("/proc/self/statm");
  double pages = 0.0, resident = 0.0;
  file >> pages >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

}  // namespace

int main(int argc, char** argv) {
  urban_nav_core::testing::BenchTable table({"device", "time simulated, s", "time taken, s", "messages", "gaps",
                                             "clock epochs", "memory, MB: growth after a sixth"},
                                            argc, argv);
  std::string output;
  double seconds = 3600.0;
  for (int i = 1; i + 1 < argc; i += 2) {
    if (std::string(argv[i]) == "-o") output = argv[i + 1];
    if (std::string(argv[i]) == "--seconds") seconds = std::max(std::atof(argv[i + 1]), 60.0);
  }
  double total = 0.0;
  urban_nav::bench::forEachSerialDevice(seconds + 2.0, [&](urban_nav::bench::DeviceSession& session) {
    const auto begin = std::chrono::steady_clock::now();
    urban_nav::testing::SteppedDevice pair(*session.driver, *session.device);
    double early = 0.0;
    while (pair.seconds() < seconds) {
      pair.run(10.0);
      pair.forgetTruth();
      if (early == 0.0 && pair.seconds() >= seconds / 6.0) early = residentMb();
    }
    const double taken = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    total += taken;
    const auto counters = session.driver->counters();
    table.add({session.name, cell(pair.seconds(), 0), cell(taken, 1), std::to_string(*session.messages),
               std::to_string(counters.gaps), std::to_string(counters.epochs), cell(residentMb() - early, 1)});
  });
  table.add({"all serial devices", cell(seconds, 0), cell(total, 1), "", "", "", ""});
  urban_nav::bench::forEachCamera([&](const urban_nav::bench::CameraSession& session) {
    constexpr double kMinute = 60.0;  // s
    const auto begin = std::chrono::steady_clock::now();
    const int frames = static_cast<int>(kMinute / session.period);
    int taken = session.run_until(frames / 6);
    const double early = residentMb();
    taken += session.run_until(frames);
    const double time = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    table.add({session.name, cell(kMinute, 0), cell(time, 1), std::to_string(taken), std::to_string(frames - taken), "",
               cell(residentMb() - early, 1)});
  });
  table.note("One core. Delays of 1 ms and an exponential of 1 ms, skew 50 ppm.");
  std::fputs(table.text().c_str(), stdout);
  if (!output.empty()) table.write(output);
  return 0;
}
