// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/ladybug2/camera.hpp"

#include <cmath>

#include "segway_drivers/camera/bus_time.hpp"

namespace segway_drivers {

namespace {

constexpr std::uint64_t lady_base_serial = 0x1F20, lady_head_serial = 0x1F80, lady_jpeg = 0x1E80, lady_fill = 0x1E84,
                        lady_selection = 0x1E88;
constexpr std::uint32_t lady_jpeg_automatic = 0x83000000, lady_full = 0x8000007F, lady_ring_only = 0x80FFFFF0;
constexpr double least_share_of_period = 0.75;

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
  const auto base = source_.readRegister(lady_base_serial), head = source_.readRegister(lady_head_serial);
  if (!base || !head) {
    error = "registers cannot be read";
    return false;
  }
  identity_ = "Ladybug2, base " + std::to_string(*base) + ", head " + std::to_string(*head);
  const bool set =
      source_.writeRegister(lady_jpeg, lady_jpeg_automatic | static_cast<std::uint32_t>(options_.quality)) &&
      source_.writeRegister(lady_fill, lady_full) && source_.writeRegister(lady_selection, lady_ring_only);
  const auto selection = source_.readRegister(lady_selection);
  if (!set || !selection || (*selection & 0xFFFFFFU) != (lady_ring_only & 0xFFFFFFU))
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
  const auto least = static_cast<TimeNs>(1e9 * least_share_of_period / options_.rate);
  if (last_stamp_ && stamped.stamp < *last_stamp_ + least) return std::nullopt;
  last_stamp_ = stamped.stamp;
  stamped.sequence = frame->sequence;
  stamped.bus_time = *frame->bus_time;
  stamped.arrival = raw->arrival;
  raw->bytes.resize(bigWord32(raw->bytes.data() + 0x08));
  stamped.bytes = std::move(raw->bytes);
  return stamped;
}

/// Counts what is missing. Returns false for a frame that came before.
bool LadybugCamera::countFrame(const LadybugFrame& frame) {
  int bad = 0;
  for (std::size_t camera = 0; camera + 1 < ladybug_cameras; ++camera)
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
