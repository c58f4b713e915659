// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>

#include "segway_drivers/stream/bytes.hpp"

namespace segway_drivers {

/// One message of measurements. Empty values were not in the message.
struct MtiSample {
  using Vector = std::array<double, 3>;
  std::optional<std::uint16_t> counter;              ///< +1 per message, wraps
  std::optional<std::uint32_t> sample_time_fine;     ///< 1/10000 s, wraps; not monotonic over messages
  std::optional<Vector> acceleration;                ///< m/s^2, specific force, axes of the sensor
  std::optional<Vector> rate;                        ///< rad/s, axes of the sensor
  std::optional<Vector> field;                       ///< units of the earth's field at the location of calibration
  std::optional<std::array<double, 4>> orientation;  ///< w x y z: sensor to the earth frame below
  enum class Earth { Enu, Ned, Nwu } earth = Earth::Nwu;
  std::optional<double> temperature;          ///< deg C
  std::optional<double> pressure;             ///< Pa
  std::optional<double> latitude, longitude;  ///< deg
  std::optional<double> height;               ///< m above the ellipsoid
};

/// Returns the orientation from sensor to ENU, w x y z, or nullopt if the sample has none.
std::optional<std::array<double, 4>> mtiOrientationEnu(const MtiSample& sample);

/// Decodes MTData2 (36h): items with identifiers; unknown ones are skipped. Returns nullopt if items overrun the
/// message or values are not finite.
std::optional<MtiSample> decodeMtiData2(ByteView data);

/// Returns the length of MTData (32h) implied by mode and settings, bytes, or nullopt for unsupported combinations.
std::optional<std::size_t> mtiDataLength(unsigned mode, unsigned settings);
/// Decodes MTData by the current mode and settings. Returns nullopt if the length differs from the implied one, or
/// values are not finite.
std::optional<MtiSample> decodeMtiData(ByteView data, unsigned mode, unsigned settings);

}  // namespace segway_drivers
