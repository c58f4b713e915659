// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "segway_drivers/stream/bytes.hpp"
#include "segway_drivers/stream/frame_stream.hpp"

namespace segway_drivers {

constexpr std::size_t kLmsMaxTelegram = 812;  // bytes

/// CRC of SICK LMS telegrams over all bytes from STX on: 16 bits, polynomial 0x8005, with the previous byte in the high
/// half.
std::uint16_t computeLmsCrc(ByteView bytes);

/// Returns a telegram to address 0 (broadcast): STX, address, length, `payload`, CRC.
Bytes makeLmsTelegram(ByteView payload);

/// Framing rule of telegrams from a device at the default address. A length impossible for the command is no frame.
FrameProbe probeLmsTelegram(ByteView bytes);

/// Returns the payload of a complete telegram: command byte, data, and final status byte.
ByteView lmsPayload(ByteView telegram);

}  // namespace segway_drivers
