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
  /// Two words, the low one first, from word `i` on.
  std::uint32_t pair(std::size_t i) const { return word(i) | static_cast<std::uint32_t>(word(i + 1)) << 16; }
};

constexpr std::size_t kRmpPacketSize = 18;  // bytes, in both directions

/// USB packet from the host to the base.
Bytes makeRmpPacket(const CanFrame& frame);
/// USB packet from the base, as it would send the frame on channel A.
Bytes makeRmpBasePacket(const CanFrame& frame);
/// Framing rule of USB packets from the base.
FrameProbe probeRmpPacket(ByteView bytes);
/// Frame of a whole USB packet from the base. Returns nullopt for channel B.
std::optional<CanFrame> splitRmpPacket(ByteView packet);

/// A line of `candump -l`: `(sec.usec) can0 401#0010FFF800040000`.
struct CandumpLine {
  TimeNs time = 0;
  CanFrame frame;
};
/// Returns nullopt for other lines, other lengths and extended identifiers.
std::optional<CandumpLine> parseCandumpLine(std::string_view line);

}  // namespace segway_drivers
