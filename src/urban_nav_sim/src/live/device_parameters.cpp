// SPDX-License-Identifier: BSD-3-Clause
#include "live/device_parameters.hpp"

#include <cstdint>
#include <limits>

#include "live/split_words.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_sim {

using urban_nav_core::Table;
using urban_nav_core::UserError;

DeviceParameters::DeviceParameters() { deviceTable().setDefaults(*this); }

// clang-format would give each of the columns a line.
// clang-format off
const Table<DeviceParameters>& deviceTable() {
  using P = DeviceParameters;
  static const Table<DeviceParameters> rows(
      "device",
      {
          {"kind", &P::kind, "", "lms291", false, false, serialDeviceKinds(), "Kind of the device.", ""},
          {"bag", &P::bag, "", "", false, false, {},
           "Recorded session of `urban_nav simulate` that the device reproduces.", ""},
          {"side", &P::side, "", "left", false, false, {"left", "right"}, "Side of the laser.", ""},
          {"link", &P::link, "", "", false, false, {}, "Path of the link to the pseudo-terminal.", ""},
          {"tcp", &P::tcp, "", 0, 0, 65535, {},
           "Port of the gpsd protocol of a receiver, instead of the link; 0: none.", ""},
          {"fault", &P::fault, "", "", false, false, {},
           "Faults, separated by commas: KIND:START_S:DURATION_S[:VALUE], as for `urban_nav device simulate --fault`.",
           ""},
          {"clock", &P::clock, "", "", false, false, {},
           "Clock of the device relative to that of the host: OFFSET_S:PPM; empty: equal.", ""},
          {"delay", &P::delay, "", "", false, false, {},
           "Delays from measurement to first byte: exponential:MIN:MEAN:MAX, uniform:MIN:MAX or batch:MS, in ms; "
           "empty: that of the device, without jitter.",
           ""},
          {"begin", &P::begin, "", "", false, false, {},
           "File by which devices begin their sessions together, new for each launch; empty: at once.", ""},
          {"held", &P::held, "", false, false, true, {},
           "Whether there is no port before another process has written the begin, ns of the steady clock, to that "
           "file.",
           ""},
          {"truth", &P::truth, "", "", false, false, {},
           "File for sequence,true_ns of each measurement, written at the end; empty: none.", ""},
          {"seed", &P::seed, "", 1, 0, std::int64_t{std::numeric_limits<int>::max()}, {},
           "Seed of delays and faults.", ""},
      });
  return rows;
}
// clang-format on

SimulatedDeviceJob simulatedDeviceJob(const DeviceParameters& parameters, const std::string& where) {
  if (parameters.bag.empty()) throw UserError(where + "bag", "is empty", "a bag of urban_nav simulate");
  SimulatedDeviceJob job;
  job.kind = parameters.kind;
  job.link = parameters.link;
  job.tcp = parameters.tcp;
  if (job.tcp > 0 && job.kind != "gps") throw UserError(where + "tcp", job.kind, "gps");
  if (job.tcp == 0 && job.link.empty()) throw UserError(where + "link", "is empty", "a path");
  job.truth = parameters.truth;
  job.begin = parameters.begin;
  job.held = parameters.held;
  if (job.held && job.begin.empty()) throw UserError(where + "begin", "is empty, and the session is held", "a path");
  job.options.seed = static_cast<std::uint64_t>(parameters.seed);
  for (const std::string& word : splitWords(parameters.fault))
    job.options.faults.push_back(parseDeviceFault(word, where + "fault"));
  if (!parameters.clock.empty()) job.options.clock = DeviceClock::parse(parameters.clock, where + "clock");
  if (!parameters.delay.empty()) job.options.delay = DelayModel::parse(parameters.delay, 1.0, where + "delay");
  return job;
}

}  // namespace urban_nav_sim
