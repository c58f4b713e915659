// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/lms291/stream.hpp"

#include <cmath>

#include "segway_drivers/lms291/telegram.hpp"

namespace segway_drivers {

namespace {

/// The mirror is not crystal-controlled: its period may vary within 0.5 %, initially within 0.05 %.
ClockOptions lmsClockOptions() {
  ClockOptions options;
  options.period = kLmsPeriod;
  options.tolerance = 500e-6;
  options.hard_tolerance = 5000e-6;
  options.max_skew_change = 20e-6;
  return options;
}

}  // namespace

LmsStream::LmsStream(const Options& options)
    : options_(options),
      frames_(kLmsMaxTelegram, probeLmsTelegram),
      sink_([this](const StreamFrame& frame) { take(frame); }),
      clock_(lmsClockOptions()),
      counter_(256, kLmsPeriod) {
  frames_.setBaud(500000);
}

void LmsStream::feed(ByteView chunk, const ChunkArrival& arrival) { frames_.feed(chunk, arrival, sink_); }
void LmsStream::expire(TimeNs now) { frames_.expire(now, sink_); }
void LmsStream::finish() { frames_.finish(sink_); }

void LmsStream::take(const StreamFrame& frame) {
  const ByteView payload = lmsPayload(frame.bytes);
  std::optional<LmsScan> scan = decodeLmsScan(payload, options_.format);
  if (!scan) {
    if (on_reply) on_reply(payload);
    return;
  }
  LmsStampedScan stamped;
  stamped.offset = frame.offset;
  stamped.arrival = frame.arrival;
  if (scan->index) {
    const UnwrappedCount position = counter_.add(*scan->index, frame.arrival);
    gaps_ += position.missing;
    repeats_ += position.repeated ? 1 : 0;
    if (position.restarted) clock_.restart();
    stamped.count = position.count;
    if (frame.arrival != 0) {
      const ClockEstimate estimate = clock_.add(static_cast<double>(position.count) * kLmsPeriod, frame.arrival);
      stamped.sigma = estimate.sigma;
      stamped.epoch = estimate.epoch;
      if (estimate.time) stamped.stamp = *estimate.time - static_cast<TimeNs>(std::llround(1e9 * options_.latency));
    }
  }
  stamped.scan = std::move(*scan);
  if (on_scan) on_scan(stamped);
}

DeviceCounters LmsStream::counters() const {
  DeviceCounters counters = frames_.counters();
  counters.gaps = gaps_;
  counters.unexpected = repeats_;
  counters.epochs = clock_.epoch();
  return counters;
}

}  // namespace segway_drivers
