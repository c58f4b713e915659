// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "segway_drivers/gps/fix.hpp"
#include "segway_drivers/stream/frame_stream.hpp"

namespace segway_drivers {

constexpr std::size_t kUbxLongestFrame = 8192;  // bytes

/// Framing rule of the binary protocol of u-blox: B5 62, class, message, length, payload, Fletcher checksum (u-blox
/// 8 / M8 receiver description, UBX-13003221, section 32.2).
FrameProbe probeUbxFrame(ByteView bytes);

/// Returns "ubx 01-07" for a complete frame: class and message in hexadecimal digits.
std::string ubxName(ByteView frame);

/// Decodes a complete NAV-PVT frame (01-07; 92 bytes, or 84 of older receivers). The horizontal accuracy is a radius:
/// each axis has its 1/sqrt(2). Returns nullopt for other messages and for impossible values.
std::optional<GpsFix> decodeUbxFix(ByteView frame);

/// Framing rule of RTCM 3 (RTCM 10403.3, section 4): D3, ten bits of length, message, CRC-24Q. Corrections contain no
/// fix.
FrameProbe probeRtcmFrame(ByteView bytes);

/// Returns "rtcm 1005" for a complete frame: its message number; "rtcm" for an empty one.
std::string rtcmName(ByteView frame);

}  // namespace segway_drivers
