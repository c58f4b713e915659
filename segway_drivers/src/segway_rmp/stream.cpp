// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/segway_rmp/stream.hpp"

#include <cmath>

#include "segway_drivers/segway_rmp/units.hpp"

namespace segway_drivers {

namespace {

constexpr double kRmpPeriod = 0.01;  // s
constexpr double kRmpUsbBaud = 460800.0;
constexpr TimeNs kRmpSilence = 50'000'000;  // ns, largest gap between messages of adjacent cycles

ClockOptions rmpClockOptions() {
  ClockOptions options;
  options.period = kRmpPeriod;
  options.tolerance = 200e-6;
  options.hard_tolerance = 1000e-6;
  return options;
}

}  // namespace

RmpStream::RmpStream(double latency)
    : latency_(latency),
      packets_(kRmpPacketSize, probeRmpPacket),
      sink_([this](const StreamFrame& packet) {
        const auto frame = splitRmpPacket(packet.bytes);
        if (frame) add(*frame, packet.offset, packet.arrival);
      }),
      clock_(rmpClockOptions()),
      counter_(65536, kRmpPeriod) {
  packets_.setBaud(kRmpUsbBaud);
}

void RmpStream::add(const CanFrame& frame, std::uint64_t offset, TimeNs arrival) {
  ++frames_;
  if (!decodeRmpValues(frame)) {
    ++unexpected_;
    return;
  }
  placeCycle(frame, arrival);
  if (on_frame) on_frame({frame, offset, arrival, cycle_stamp_});
}

void RmpStream::placeCycle(const CanFrame& frame, TimeNs arrival) {
  if (arrival == 0) return;
  const auto latency = static_cast<TimeNs>(std::llround(1e9 * latency_));
  if (last_arrival_ && arrival - *last_arrival_ > kRmpSilence) {  // the time of this cycle is unknown before its count
    cycle_arrival_.reset();
    cycle_stamp_.reset();
    is_resumed_ = true;
  }
  last_arrival_ = arrival;
  if (frame.id == 0x400) {
    cycle_arrival_ = arrival;
    const ClockEstimate estimate = clock_.estimate(cycle_time_ + kRmpPeriod);
    cycle_stamp_.reset();
    if (estimate.time && !is_resumed_) cycle_stamp_ = *estimate.time - latency;
  }
  if (frame.id != 0x402) return;
  is_resumed_ = false;
  const TimeNs begin = cycle_arrival_.value_or(arrival);
  cycle_arrival_.reset();
  const UnwrappedCount position = counter_.add(frame.word(3), begin);
  gaps_ += position.missing;
  if (position.restarted) clock_.restart();
  if (position.repeated) return;
  cycle_time_ = static_cast<double>(position.count) * kRmpPeriod;
  const ClockEstimate estimate = clock_.add(cycle_time_, begin);
  cycle_stamp_.reset();
  if (estimate.time) cycle_stamp_ = *estimate.time - latency;
}

DeviceCounters RmpStream::counters() const {
  DeviceCounters counters = packets_.counters();
  if (counters.frames == 0) counters.frames = frames_;
  counters.gaps = gaps_;
  counters.unexpected = unexpected_;
  counters.epochs = clock_.epoch();
  return counters;
}

}  // namespace segway_drivers
