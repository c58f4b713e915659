// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/xsens_mti/stream.hpp"

#include <cmath>

namespace segway_drivers {

namespace {

constexpr double kMtiFineUnit = 1e-4;         // s
constexpr std::int32_t kMtiDisorder = 10000;  // units by which slow outputs may precede the previous message

ClockOptions mtiClockOptions(double period) {
  ClockOptions options;
  options.period = period;
  options.tolerance = options.hard_tolerance = 100e-6;
  return options;
}

}  // namespace

MtiStream::MtiStream(const Options& options)
    : options_(options),
      frames_(kMtiMaxMessage, probeMtiMessage),
      sink_([this](const StreamFrame& frame) { take(frame); }),
      clock_(mtiClockOptions(options.period)),
      counter_(65536, options.period) {
  frames_.setBaud(115200);
}

void MtiStream::setDataFormat(unsigned mode, unsigned settings) {
  options_.mode = mode;
  options_.settings = settings;
}

void MtiStream::setPeriod(double period) {
  options_.period = period;
  counter_.setPeriod(period);
}

void MtiStream::take(const StreamFrame& frame) {
  const MtiMessage message = splitMtiMessage(frame.bytes);
  std::optional<MtiSample> sample;
  if (message.mid == static_cast<std::uint8_t>(MtiMid::Data2)) {
    sample = decodeMtiData2(message.data);
  } else if (message.mid == static_cast<std::uint8_t>(MtiMid::Data)) {
    sample = decodeMtiData(message.data, options_.mode, options_.settings);
  } else {
    if (on_reply) on_reply(message);
    return;
  }
  if (!sample) {
    ++unexpected_;
    return;
  }
  MtiStampedSample stamped;
  stamped.sample = *sample;
  stamped.offset = frame.offset;
  stamped.arrival = frame.arrival;
  place(stamped);
  if (on_sample) on_sample(stamped);
}

void MtiStream::place(MtiStampedSample& sample) {
  if (sample.sample.counter) placeByCounter(sample);
  if (sample.sample.sample_time_fine) placeBySampleTime(sample);
}

/// Counts gaps, and gives the device time if there is no sample time.
void MtiStream::placeByCounter(MtiStampedSample& sample) {
  const bool is_clock = !sample.sample.sample_time_fine;
  const UnwrappedCount position = counter_.add(*sample.sample.counter, is_clock ? sample.arrival : 0);
  gaps_ += position.missing;
  if (position.restarted) clock_.restart();
  if (!is_clock || sample.arrival == 0 || position.repeated) return;
  const ClockEstimate estimate = clock_.add(static_cast<double>(position.count) * options_.period, sample.arrival);
  sample.sigma = estimate.sigma;
  if (estimate.time) sample.stamp = *estimate.time - static_cast<TimeNs>(std::llround(1e9 * options_.latency));
}

void MtiStream::placeBySampleTime(MtiStampedSample& sample) {
  const std::uint32_t fine = *sample.sample.sample_time_fine;
  const auto step = last_fine_ ? static_cast<std::int32_t>(fine - *last_fine_) : 0;
  if (step <= -kMtiDisorder) {
    clock_.restart();
    last_fine_.reset();
  }
  const bool in_order = !last_fine_ || step > 0;
  if (in_order) {
    fine_s_ += last_fine_ ? kMtiFineUnit * step : 0.0;
    last_fine_ = fine;
  }
  if (sample.arrival == 0) return;
  const ClockEstimate estimate =
      in_order ? clock_.add(fine_s_, sample.arrival) : clock_.estimate(fine_s_ + kMtiFineUnit * step);
  sample.sigma = estimate.sigma;
  if (estimate.time) sample.stamp = *estimate.time - static_cast<TimeNs>(std::llround(1e9 * options_.latency));
}

DeviceCounters MtiStream::counters() const {
  DeviceCounters counters = frames_.counters();
  counters.gaps = gaps_;
  counters.unexpected = unexpected_;
  counters.epochs = clock_.epoch();
  return counters;
}

}  // namespace segway_drivers
