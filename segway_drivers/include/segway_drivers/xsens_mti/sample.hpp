// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>

#include "segway_drivers/stream/bytes.hpp"

namespace segway_drivers {

/// One message of measurements. Absent values were not in the message.
struct MtiSample {
  using Vector = std::array<double, 3>;
  std::optional<std::uint16_t> counter;              ///< +1 per message, wraps
  std::optional<std::uint32_t> sample_time_fine;     ///< 1/10000 s, wraps; not monotonic over messages
  std::optional<Vector> acceleration;                ///< m/s^2 with gravity, axes of the sensor
  std::optional<Vector> rate;                        ///< rad/s, axes of the sensor
  std::optional<Vector> field;                       ///< units of the earth's field at the place of calibration
  std::optional<std::array<double, 4>> orientation;  ///< w x y z: sensor to the earth frame below
  enum class Earth { Enu, Ned, Nwu } earth = Earth::Nwu;
  std::optional<double> temperature;          ///< deg C
  std::optional<double> pressure;             ///< Pa
  std::optional<double> latitude, longitude;  ///< deg
  std::optional<double> height;               ///< m above the ellipsoid
};

/// Orientation from sensor to ENU, w x y z. Returns nullopt if the sample has none.
std::optional<std::array<double, 4>> mtiOrientationEnu(const MtiSample& sample);

/// Decodes MTData2 (36h): items with identifiers; unknown ones are skipped. Returns nullopt if items overrun the
/// message or values are not finite.
std::optional<MtiSample> decodeMtiData2(ByteView data);

/// Length of MTData (32h) that a mode and settings imply, bytes. Returns nullopt for combinations that this decoder
/// does not know.
std::optional<std::size_t> mtiDataLength(unsigned mode, unsigned settings);
/// Decodes MTData by the mode and settings in force. Returns nullopt if the length is not the one they imply, or values
/// are not finite.
std::optional<MtiSample> decodeMtiData(ByteView data, unsigned mode, unsigned settings);

}  // namespace segway_drivers
