// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "segway_drivers/gps/fix.hpp"
#include "segway_drivers/stream/frame_stream.hpp"

namespace segway_drivers {

constexpr std::size_t kGpsdLongestLine = 16384;  // bytes

/// Returns the request for reports as JSON lines.
Bytes makeGpsdWatch();
/// Framing rule of lines of gpsd: from `{"class":` to the end of the line.
FrameProbe probeGpsdLine(ByteView bytes);

/// A line of gpsd.
struct GpsdReport {
  std::string kind;               ///< VERSION, DEVICES, WATCH, TPV, SKY ...
  std::optional<GpsFix> fix;      ///< of a TPV
  std::optional<int> satellites;  ///< used, of a SKY
  std::string version;            ///< release of a VERSION
};
/// Returns nullopt for text other than a JSON object with a class. Missing keys and values of other types are empty
/// values.
std::optional<GpsdReport> parseGpsdLine(std::string_view line);

}  // namespace segway_drivers
