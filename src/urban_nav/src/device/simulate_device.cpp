// SPDX-License-Identifier: BSD-3-Clause
#include "device/simulate_device.hpp"

#include <memory>

#include "device/session_readings.hpp"
#include "segway_drivers/transport/session_begin.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_sim/device/device_server.hpp"

namespace urban_nav {

namespace {

constexpr urban_nav_sim::DeviceTime session_lead = 4'000'000'000;  // ns, for the other devices to start

std::unique_ptr<urban_nav_sim::SimulatedDevice> makeSimulatedDevice(const SimulateDeviceJob& job,
                                                                    DeviceReadings readings) {
  if (job.kind == "lms291")
    return std::make_unique<urban_nav_sim::SimulatedLaser>(std::move(readings.lasers), job.options);
  if (job.kind == "xsens_mti")
    return std::make_unique<urban_nav_sim::SimulatedImu>(std::move(readings.imu), job.options);
  if (job.kind == "segway_rmp")
    return std::make_unique<urban_nav_sim::SimulatedBase>(std::move(readings.wheels), job.options);
  return std::make_unique<urban_nav_sim::SimulatedGps>(std::move(readings.gps), readings.gps_begin, job.tcp > 0,
                                                       job.options);
}

}  // namespace

std::int64_t simulateDevice(const SimulateDeviceJob& job, const std::function<bool()>& stop) {
  DeviceReadings readings =
      job.bag.empty() ? simulateReadings(job.session, job.kind, job.side) : readReadings(job.bag, job.kind, job.side);
  const auto device = makeSimulatedDevice(job, std::move(readings));
  const auto link = job.tcp > 0 ? urban_nav_sim::openTcpServer(job.tcp, urban_nav_sim::gpsdGreeting())
                                : urban_nav_sim::openPseudoTerminal(job.link);
  std::optional<urban_nav_sim::DeviceTime> begin;
  if (!job.begin.empty()) begin = segway_drivers::agreeOnBegin(job.begin, session_lead);
  const std::vector<urban_nav_sim::DeviceTruth> truth = serveDevice(*device, *link, stop, begin);
  if (!job.truth.empty()) {
    std::string text = "sequence,true_ns\n";
    for (const auto& each : truth) text += std::to_string(each.sequence) + "," + std::to_string(each.time) + "\n";
    urban_nav_core::writeAtomically(job.truth, text);
  }
  return static_cast<std::int64_t>(truth.size());
}

}  // namespace urban_nav
