// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_sim/device/device_server.hpp"

#include <ctime>

namespace urban_nav_sim {

namespace {

constexpr DeviceTime kServerStep = 1'000'000;  // ns

DeviceTime readServerClock(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<DeviceTime>(now.tv_sec) * 1'000'000'000 + now.tv_nsec;
}

}  // namespace

DeviceTime serverTime() { return readServerClock(CLOCK_MONOTONIC); }

std::vector<DeviceTruth> serveDevice(SimulatedDevice& device, DeviceLink& link, const std::function<bool()>& stop,
                                     std::optional<DeviceTime> begin) {
  std::vector<DeviceTruth> truth;
  DeviceTime next = serverTime();
  device.start(begin.value_or(next));
  bool plugged = true;
  while (!device.isFinished() && !stop()) {
    next += kServerStep;
    const timespec wake{static_cast<time_t>(next / 1'000'000'000), static_cast<long>(next % 1'000'000'000)};
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &wake, nullptr);
    const DeviceTime now = serverTime();
    if (plugged != device.isPlugged(now)) {
      plugged = !plugged;
      link.setPlugged(plugged);
    }
    const int baud = link.hostBaud();
    device.receive(plugged ? link.read() : DeviceBytes(), baud, now);
    const DeviceBytes bytes = device.transmit(baud, now);
    if (plugged && !bytes.empty()) link.write(bytes);
    const DeviceTime offset = readServerClock(CLOCK_REALTIME) - serverTime();
    for (DeviceTruth each : device.takeTruth()) {
      each.time += offset;
      truth.push_back(each);
    }
  }
  return truth;
}

}  // namespace urban_nav_sim
