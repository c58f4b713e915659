// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "segway_drivers/gps/fix.hpp"
#include "segway_drivers/stream/frame_stream.hpp"

namespace segway_drivers {

constexpr std::size_t kUbxLongestFrame = 8192;  // bytes

/// Framing rule of u-blox' binary protocol: B5 62, class, message, length, payload, checksum of Fletcher's kind (u-blox
/// 8 / M8 receiver description, UBX-13003221, section 32.2).
FrameProbe probeUbxFrame(ByteView bytes);

/// "ubx 01-07" of a whole frame: class and message in hexadecimal digits.
std::string ubxName(ByteView frame);

/// Fix of a whole frame that is a NAV-PVT (01-07; of 92 bytes, or of 84 as older receivers send it). The horizontal
/// accuracy is a radius: each axis has its part by the square root of two. Returns nullopt for other messages and for
/// values that are not possible.
std::optional<GpsFix> decodeUbxFix(ByteView frame);

/// Framing rule of RTCM 3 (RTCM 10403.3, section 4): D3, ten bits of length, message, CRC-24Q. Corrections hold no fix.
FrameProbe probeRtcmFrame(ByteView bytes);

/// "rtcm 1005" of a whole frame: the number of its message; "rtcm" for an empty one.
std::string rtcmName(ByteView frame);

}  // namespace segway_drivers
