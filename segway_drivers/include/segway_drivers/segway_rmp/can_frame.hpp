// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "segway_drivers/stream/bytes.hpp"
#include "segway_drivers/stream/frame_stream.hpp"

namespace segway_drivers {

/// CAN frame with an 11-bit identifier and 8 data bytes.
struct CanFrame {
  std::uint16_t id = 0;
  std::array<std::uint8_t, 8> data{};

  std::uint16_t word(std::size_t i) const { return bigWord(data.data() + 2 * i); }
  /// Returns the 32-bit value of two words from word `i`, the low one first.
  std::uint32_t pair(std::size_t i) const { return word(i) | static_cast<std::uint32_t>(word(i + 1)) << 16; }
};

constexpr std::size_t kRmpPacketSize = 18;  // bytes, in both directions

/// Returns the USB packet from the host to the base.
Bytes makeRmpPacket(const CanFrame& frame);
/// Returns the USB packet of a frame on channel A from the base.
Bytes makeRmpBasePacket(const CanFrame& frame);
/// Framing rule of USB packets from the base.
FrameProbe probeRmpPacket(ByteView bytes);
/// Returns the frame of a complete USB packet from the base, or nullopt for channel B.
std::optional<CanFrame> splitRmpPacket(ByteView packet);

/// A line of `candump -l`: `(sec.usec) can0 401#0010FFF800040000`.
struct CandumpLine {
  TimeNs time = 0;
  CanFrame frame;
};
/// Returns nullopt for other lines, other lengths and extended identifiers.
std::optional<CandumpLine> parseCandumpLine(std::string_view line);

}  // namespace segway_drivers
