// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/ladybug2/camera.hpp"

#include <cmath>

#include "segway_drivers/camera/bus_time.hpp"

namespace segway_drivers {

namespace {

constexpr std::uint64_t kLadyBaseSerial = 0x1F20, kLadyHeadSerial = 0x1F80, kLadyJpeg = 0x1E80, kLadyFill = 0x1E84,
                        kLadySelection = 0x1E88;
constexpr std::uint32_t kLadyJpegAutomatic = 0x83000000, kLadyFull = 0x8000007F, kLadyRingOnly = 0x80FFFFF0;
constexpr double kLeastShareOfPeriod = 0.75;

CameraFormat ladybugFormat() {
  CameraFormat format;
  format.mode = 7;
  format.width = 512;
  format.height = 2015;
  format.raw16 = false;
  format.packet = 8000;
  format.speed = 800;
  return format;
}

}  // namespace

bool LadybugCamera::start(std::string& error) {
  if (!source_.open(error)) return false;
  const auto base = source_.readRegister(kLadyBaseSerial), head = source_.readRegister(kLadyHeadSerial);
  if (!base || !head) {
    error = "registers cannot be read";
    return false;
  }
  identity_ = "Ladybug2, base " + std::to_string(*base) + ", head " + std::to_string(*head);
  const bool set =
      source_.writeRegister(kLadyJpeg, kLadyJpegAutomatic | static_cast<std::uint32_t>(options_.quality)) &&
      source_.writeRegister(kLadyFill, kLadyFull) && source_.writeRegister(kLadySelection, kLadyRingOnly);
  const auto selection = source_.readRegister(kLadySelection);
  if (!set || !selection || (*selection & 0xFFFFFFU) != (kLadyRingOnly & 0xFFFFFFU))
    events_.push_back({true, "selection or quality of the JPEGs cannot be set"});
  return source_.start(ladybugFormat(), error);
}

std::optional<LadybugStampedFrame> LadybugCamera::next(TimeNs timeout) {
  std::optional<CameraFrame> raw = source_.next(timeout);
  if (!raw) return std::nullopt;
  counters_.bytes += static_cast<std::int64_t>(raw->bytes.size());
  const auto frame = raw->corrupt ? std::nullopt : splitLadybugFrame(raw->bytes, false);
  if (!frame) {
    ++counters_.bad_checksums;
    return std::nullopt;
  }
  ++counters_.frames;
  const bool advances = countFrame(*frame);
  const auto cycle = source_.readCycle();
  if (!frame->bus_time || !cycle || !advances) {
    ++counters_.unexpected;
    return std::nullopt;
  }
  LadybugStampedFrame stamped;
  stamped.stamp = hostTimeOfBusTime(*frame->bus_time, cycle->bus_s, cycle->host) -
                  static_cast<TimeNs>(std::llround(1e9 * options_.latency));
  const auto least = static_cast<TimeNs>(1e9 * kLeastShareOfPeriod / options_.rate);
  if (last_stamp_ && stamped.stamp < *last_stamp_ + least) return std::nullopt;
  last_stamp_ = stamped.stamp;
  stamped.sequence = frame->sequence;
  stamped.bus_time = *frame->bus_time;
  stamped.arrival = raw->arrival;
  raw->bytes.resize(bigWord32(raw->bytes.data() + 0x08));
  stamped.bytes = std::move(raw->bytes);
  return stamped;
}

/// Counts missing frames. Returns false for a repeated frame.
bool LadybugCamera::countFrame(const LadybugFrame& frame) {
  int bad = 0;
  for (std::size_t camera = 0; camera + 1 < kLadybugCameras; ++camera)
    for (const ByteView plane : frame.planes[camera]) bad += plane.size == 0 ? 1 : 0;
  bad_channels_ += bad;
  if (bad > 0 && !reported_channels_)
    events_.push_back(
        {true, std::to_string(bad) + " channels are missing: lower quality, or a lens without a picture"});
  reported_channels_ = bad > 0;
  const auto before = std::exchange(last_sequence_, frame.sequence);
  if (!before) return true;
  if (frame.sequence == *before) return false;
  if (frame.sequence < *before) events_.push_back({true, "the sequence begins again: the head was off"});
  else counters_.gaps += frame.sequence - *before - 1;
  return true;
}

}  // namespace segway_drivers
