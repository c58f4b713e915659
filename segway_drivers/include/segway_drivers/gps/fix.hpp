// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "segway_drivers/stream/bytes.hpp"

namespace segway_drivers {

/// One report of a receiver. Absent values are not known.
struct GpsFix {
  enum class Mode { None = 1, Fix2D = 2, Fix3D = 3 } mode = Mode::None;
  std::string utc;  ///< ISO 8601 with milliseconds, or without the date if that is not known; may be empty
  std::optional<double> latitude, longitude;        ///< deg
  std::optional<double> height;                     ///< m above the ellipsoid
  std::optional<double> sigma_e, sigma_n, sigma_u;  ///< m, standard deviations; noise, not multipath
  std::optional<double> speed;                      ///< m/s over ground
  std::optional<double> track;                      ///< deg clockwise from true north
  std::optional<double> climb;                      ///< m/s
  std::optional<int> satellites;                    ///< used
  bool differential = false;
  /// Ambiguities of the phase of the carrier: real-time kinematics, which is good to centimetres where they are fixed.
  enum class Carrier { None, Float, Fixed } carrier = Carrier::None;
  bool week_corrected = false;  ///< the receiver's date was 1024 weeks early
  std::string source;           ///< nmea, garmin, gpsd, ubx

  std::uint64_t offset = 0;  ///< of the first byte in the stream
  TimeNs arrival = 0;        ///< of the first byte, ns; 0: unknown
};

/// Returns the standard deviation (m) of a fix with a dilution of precision of one, where the receiver states no
/// errors: 0.02 with fixed ambiguities (data sheets state a CEP of 0.01 m and 1 ppm of the baseline), 0.4 with floating
/// ones, otherwise `uere`.
double rangeError(GpsFix::Carrier carrier, double uere);

/// "2010-07-18T16:50:07.000Z" from days since 1970-01-01 and ms of the day.
std::string printUtc(std::int64_t days, std::int64_t milliseconds);
/// Days since 1970-01-01 of a Gregorian date. Returns nullopt for a date that does not exist.
std::optional<std::int64_t> daysOfDate(int year, int month, int day);

}  // namespace segway_drivers
