// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <set>

#include "segway_drivers/driver/driver_core.hpp"
#include "segway_drivers/gps/stream.hpp"

namespace segway_drivers {

/// Driver of a receiver on a serial port, or of gpsd. Finds the line rate by two correct checksums. Sends no data to a
/// receiver.
class GpsDriver : public DriverCore {
 public:
  struct Options {
    GpsStream::Options stream;
    bool gpsd = false;  ///< requests reports instead of searching the line rate
  };
  explicit GpsDriver(const Options& options);

  std::function<void(const GpsFix& fix, std::optional<TimeNs> stamp)> on_fix;

  void feed(ByteView chunk, const ChunkArrival& arrival) override;
  void tick(TimeNs now) override;

 private:
  void begin(TimeNs now) override;
  DeviceCounters streamCounters() const override { return stream_.counters(); }
  void tryRate(TimeNs now);

  Options options_;
  GpsStream stream_;
  std::set<std::string> kinds_;
  std::size_t rate_ = 0;
  int messages_ = 0;  // since the last change of rate
  TimeNs now_ = 0, last_message_ = 0;
};

}  // namespace segway_drivers
