// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "segway_drivers/gps/fix.hpp"
#include "segway_drivers/stream/frame_stream.hpp"

namespace segway_drivers {

/// Framing rule of the binary protocol of Garmin: DLE, identifier, size, data, checksum, DLE, ETX, with DLE doubled
/// inside.
FrameProbe probeGarminPacket(ByteView bytes);

/// Identifier and data of a complete packet.
struct GarminPacket {
  std::uint8_t id = 0;
  Bytes data;
};
GarminPacket splitGarminPacket(ByteView packet);

/// Decodes a packet of position, velocity and time (33h). A date before the stated leap second is 1024 weeks early and
/// is corrected. Returns nullopt for other packets and for impossible values.
std::optional<GpsFix> decodeGarminFix(const GarminPacket& packet);

}  // namespace segway_drivers
