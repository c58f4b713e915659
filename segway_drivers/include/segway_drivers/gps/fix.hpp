// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "segway_drivers/stream/bytes.hpp"

namespace segway_drivers {

/// One report of a receiver. Empty values are unknown.
struct GpsFix {
  enum class Mode { None = 1, Fix2D = 2, Fix3D = 3 } mode = Mode::None;
  std::string utc;                            ///< ISO 8601 with milliseconds, without the date if unknown; may be empty
  std::optional<double> latitude, longitude;  ///< deg
  std::optional<double> height;               ///< m above the ellipsoid
  std::optional<double> sigma_e, sigma_n, sigma_u;  ///< m, standard deviations of noise without multipath
  std::optional<double> speed;                      ///< m/s over ground
  std::optional<double> track;                      ///< deg clockwise from true north
  std::optional<double> climb;                      ///< m/s
  std::optional<int> satellites;                    ///< used
  bool differential = false;
  /// Ambiguities of the carrier phase (real-time kinematics); accurate to centimetres if fixed.
  enum class Carrier { None, Float, Fixed } carrier = Carrier::None;
  bool week_corrected = false;  ///< the receiver's date was 1024 weeks early
  std::string source;           ///< nmea, garmin, gpsd, ubx

  std::uint64_t offset = 0;  ///< of the first byte in the stream
  TimeNs arrival = 0;        ///< of the first byte, ns; 0: unknown
};

/// Returns the standard deviation (m) of a fix with a dilution of precision of one if the receiver states no errors:
/// 0.02 with fixed ambiguities (data sheets state a CEP of 0.01 m and 1 ppm of the baseline), 0.4 with floating
/// ones, otherwise `uere`.
double rangeError(GpsFix::Carrier carrier, double uere);

/// Returns "2010-07-18T16:50:07.000Z" from days since 1970-01-01 and ms of the day.
std::string printUtc(std::int64_t days, std::int64_t milliseconds);
/// Returns days since 1970-01-01 of a Gregorian date, or nullopt for an invalid date.
std::optional<std::int64_t> daysOfDate(int year, int month, int day);

}  // namespace segway_drivers
