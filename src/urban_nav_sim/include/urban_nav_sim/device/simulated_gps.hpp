// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_sim/device/simulated_device.hpp"

namespace urban_nav_sim {

/// Fix of a session.
struct GpsReading {
  double time = 0.0;  ///< s since the begin of the session
  bool valid = false;
  double latitude = 0.0, longitude = 0.0;  ///< deg
  double height = 0.0;                     ///< m above the ellipsoid
  double speed = 0.0, track = 0.0;         ///< m/s, deg
  double sigma = 5.0;                      ///< m, horizontal
};

/// Return a fix as text: sentences GGA, GSA and RMC of a receiver, or lines of gpsd. `seconds`: UTC, s since 1970.
std::string nmeaOfReading(const GpsReading& reading, double seconds);
std::string gpsdOfReading(const GpsReading& reading, double seconds);
/// Return the messages of gpsd to a new client, and after its WATCH.
std::string gpsdGreeting();
std::string gpsdWatchAnswer();

/// A receiver that sends NMEA sentences at 9 600 baud. `utc`: s since 1970 at the begin of the session.
class SimulatedGps : public SimulatedDevice {
 public:
  SimulatedGps(std::vector<GpsReading> readings, double utc, bool gpsd, const DeviceOptions& options);

 private:
  void takeByte(std::uint8_t byte) override;
  bool measure(double t) override;
  void boot() override {}

  std::vector<GpsReading> readings_;
  std::size_t next_ = 0;
  double utc_;
  bool gpsd_, watched_ = false;
  std::string line_;
};

}  // namespace urban_nav_sim
