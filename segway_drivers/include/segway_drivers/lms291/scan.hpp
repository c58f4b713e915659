// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "segway_drivers/stream/bytes.hpp"

namespace segway_drivers {

/// Encoding of ranges, from the configuration of the device.
struct LmsRangeFormat {
  int bits = 15;            ///< 13...16 bits of range; the bits above are flags
  bool millimetres = true;  ///< otherwise centimetres

  /// Returns the format of a measuring mode (byte 5 of the configuration) and a unit (byte 6), or nullopt for modes
  /// without ranges.
  static std::optional<LmsRangeFormat> fromConfiguration(std::uint8_t measuring_mode, std::uint8_t unit);
  /// Returns the largest range that is not a code, m.
  double maxRange() const;
};

/// One revolution of the mirror. Beams are counter-clockwise from above.
struct LmsScan {
  std::vector<float> ranges;                 ///< m; +inf for no return (codes -1, -6, -9), NaN for other codes
  std::vector<int> codes;                    ///< counts by code -1...-9 at [1]...[9]; [0] counts ranges
  std::vector<std::uint8_t> reflectivities;  ///< 0...255, uncalibrated; as many as ranges, or none
  std::optional<std::uint8_t> index;         ///< telegram index modulo 256
  std::uint8_t status = 0;                   ///< status byte of the telegram

  bool polluted() const { return (status & 0x80) != 0; }
};

/// Decodes the payload of a scan (B0h or C4h) of mode 24h, 30h or 50h. The unit is that of the telegram; `format` gives
/// the bits of a range. Returns nullopt for other telegrams, partial scans, and counts inconsistent with the length.
std::optional<LmsScan> decodeLmsScan(ByteView payload, const LmsRangeFormat& format);

}  // namespace segway_drivers
