// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "segway_drivers/gps/fix.hpp"
#include "segway_drivers/stream/frame_stream.hpp"

namespace segway_drivers {

/// Framing rule of Garmin's binary protocol: DLE, identifier, size, data, checksum, DLE, ETX, with DLE doubled inside.
FrameProbe probeGarminPacket(ByteView bytes);

/// Identifier and data of a whole packet.
struct GarminPacket {
  std::uint8_t id = 0;
  Bytes data;
};
GarminPacket splitGarminPacket(ByteView packet);

/// Fix of a packet of position, velocity and time (33h). A date before the leap second that it states is 1024 weeks
/// early and is corrected. Returns nullopt for other packets and for values that are not possible.
std::optional<GpsFix> decodeGarminFix(const GarminPacket& packet);

}  // namespace segway_drivers
