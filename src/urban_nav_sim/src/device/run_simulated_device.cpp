// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_sim/device/run_simulated_device.hpp"

#include <chrono>
#include <memory>
#include <optional>
#include <thread>
#include <utility>

#include "urban_nav_core/io/agreed_number.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_sim/device/device_server.hpp"

namespace urban_nav_sim {

namespace {

constexpr DeviceTime kSessionLead = 4'000'000'000;  // ns, for the other devices to start
constexpr std::chrono::milliseconds kPoll{50};

}  // namespace

std::int64_t runSimulatedDevice(const SimulatedDeviceJob& job, DeviceReadings readings,
                                const std::function<bool()>& stop) {
  const auto device = makeSimulatedDevice(job.kind, std::move(readings), job.options, job.tcp > 0);
  while (job.held && !urban_nav_core::findAgreedNumber(job.begin)) {
    if (stop()) return 0;
    std::this_thread::sleep_for(kPoll);
  }
  const auto link = job.tcp > 0 ? openTcpServer(job.tcp, gpsdGreeting()) : openPseudoTerminal(job.link);
  std::optional<DeviceTime> begin;
  if (!job.begin.empty()) begin = urban_nav_core::agreeOnNumber(job.begin, serverTime() + kSessionLead);
  const std::vector<DeviceTruth> truth = serveDevice(*device, *link, stop, begin);
  if (!job.truth.empty()) {
    std::string text = "sequence,true_ns\n";
    for (const auto& each : truth) text += std::to_string(each.sequence) + "," + std::to_string(each.time) + "\n";
    urban_nav_core::writeAtomically(job.truth, text);
  }
  return static_cast<std::int64_t>(truth.size());
}

}  // namespace urban_nav_sim
