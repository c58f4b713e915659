// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/bumblebee2/camera.hpp"

#include <cmath>

#include "segway_drivers/camera/bus_time.hpp"

namespace segway_drivers {

namespace {

constexpr std::uint64_t kBb2DataFormat = 0x1048, kBb2Embedded = 0x12F8, kBb2Pattern = 0x1040, kBb2Sensor = 0x1F28;
constexpr std::uint32_t kBb2Present = 0x80000000, kBb2EmbeddedMask = 0x47;  // time, gain, shutter, frame counter
constexpr std::size_t kBb2TrialFrames = 5;
constexpr double kBb2TrialTolerance = 1e-3;  // s
constexpr int kBb2OrderFrames = 5;

/// Returns whether times advance by multiples of the frame period.
bool advances(const std::vector<double>& times, double period) {
  for (std::size_t i = 1; i < times.size(); ++i) {
    double step = times[i] - times[i - 1];
    if (step < 0.0) step += kBusTimeWrap;
    const double periods = std::round(step / period);
    if (periods < 1.0 || periods > 20.0 || std::abs(step - periods * period) > kBb2TrialTolerance * periods)
      return false;
  }
  return times.size() == kBb2TrialFrames;
}

}  // namespace

bool Bb2Camera::start(std::string& error) {
  embedding_.reset();
  for (auto& times : candidate_times_) times.clear();
  last_sequence_.reset();
  checked_ = reversed_ = 0;
  if (!source_.open(error)) return false;
  source_.writeRegister(kBb2DataFormat, kBb2Present);
  source_.writeRegister(kBb2Embedded, kBb2Present | kBb2EmbeddedMask);
  const auto sensor = source_.readRegister(kBb2Sensor), pattern = source_.readRegister(kBb2Pattern);
  const auto format = source_.readRegister(kBb2DataFormat), embedded = source_.readRegister(kBb2Embedded);
  if (!sensor || !format || !embedded) {
    error = "registers cannot be read";
    return false;
  }
  identity_ = "Bumblebee2, sensor code " + std::to_string(*sensor & 0xFU);
  if (*format != kBb2Present) events_.push_back({true, "order of the imagers cannot be set"});
  if ((*embedded & kBb2EmbeddedMask) != kBb2EmbeddedMask)
    events_.push_back({true, "embedded information cannot be switched on"});
  if (pattern) {
    std::string text;
    for (int shift = 24; shift >= 0; shift -= 8) text += static_cast<char>(*pattern >> shift & 0xFFU);
    pattern_ = parseMosaicPattern(text).value_or(MosaicPattern::None);
  }
  return source_.start(CameraFormat{}, error);
}

std::optional<Bb2StampedPair> Bb2Camera::next(TimeNs timeout) {
  const std::optional<CameraFrame> raw = source_.next(timeout);
  if (!raw) return std::nullopt;
  counters_.bytes += static_cast<std::int64_t>(raw->bytes.size());
  if (raw->corrupt || raw->bytes.size() < kBb2FrameSize) {
    ++counters_.bad_checksums;
    return std::nullopt;
  }
  ++counters_.frames;
  if (!embedding_ && !findEmbedding(*raw)) return std::nullopt;
  Bb2StampedPair pair;
  pair.arrival = raw->arrival;
  pair.frame = splitBb2Frame(raw->bytes, options_.swap, *embedding_);
  const auto cycle = source_.readCycle();
  if (!pair.frame.bus_time || !cycle) {
    ++counters_.unexpected;
    return std::nullopt;
  }
  pair.stamp = hostTimeOfBusTime(*pair.frame.bus_time, cycle->bus_s, cycle->host) -
               static_cast<TimeNs>(std::llround(1e9 * options_.latency));
  if (pair.stamp <= last_stamp_) {
    ++counters_.unexpected;
    return std::nullopt;
  }
  last_stamp_ = pair.stamp;
  if (last_sequence_) pair.missing = static_cast<int>(pair.frame.sequence - *last_sequence_) - 1;
  if (pair.missing < 0) pair.missing = 0;  // the camera was off
  counters_.gaps += pair.missing;
  last_sequence_ = pair.frame.sequence;
  checkOrder(pair.frame);
  return pair;
}

/// Finds the location of the embedded words whose times advance by the frame period over five frames.
bool Bb2Camera::findEmbedding(const CameraFrame& raw) {
  for (const Bb2Embedding embedding : {Bb2Embedding::Raw, Bb2Embedding::Imager}) {
    std::vector<double>& times = candidate_times_[static_cast<std::size_t>(embedding)];
    times.push_back(splitBb2Frame(raw.bytes, options_.swap, embedding).bus_time.value_or(-1.0));
    if (times.size() > kBb2TrialFrames) times.erase(times.begin());
    if (advances(times, 1.0 / options_.rate)) embedding_ = embedding;
  }
  if (!embedding_ && counters_.frames == 20 * static_cast<std::int64_t>(kBb2TrialFrames))
    events_.push_back({true, "no time of the bus in the images"});
  return embedding_.has_value();
}

void Bb2Camera::checkOrder(const Bb2Frame& frame) {
  if (checked_ >= kBb2OrderFrames) return;
  const auto disparity = medianDisparity(frame.left, frame.right);
  if (!disparity) return;
  ++checked_;
  reversed_ += *disparity < 0.0 ? 1 : 0;
  if (checked_ == kBb2OrderFrames && 2 * reversed_ > checked_)
    events_.push_back({true, "left and right are exchanged: set bumblebee2.swap_images"});
}

}  // namespace segway_drivers
