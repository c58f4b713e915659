// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "segway_drivers/gps/fix.hpp"
#include "segway_drivers/gps/nmea.hpp"
#include "segway_drivers/stream/frame_stream.hpp"

namespace segway_drivers {

/// Stream of a receiver or of gpsd: NMEA sentences, binary packets of Garmin and u-blox and lines of gpsd,
/// distinguished by content. RTCM corrections are recognised. Each time is passed on once. Reads no clock. Not
/// thread-safe.
class GpsStream {
 public:
  struct Options {
    double uere = 4.5;     ///< m
    double latency = 0.0;  ///< s from the time of a fix to its first byte
  };
  explicit GpsStream(const Options& options);

  /// A fix and its stamp, ns: arrival of its first byte minus the latency.
  std::function<void(const GpsFix& fix, std::optional<TimeNs> stamp)> on_fix;
  /// Sentences and reports received, by kind: "GGA", "garmin 33", "ubx 01-07", "rtcm 1005", "gpsd TPV".
  std::function<void(const std::string& kind)> on_message;

  void feed(ByteView chunk, const ChunkArrival& arrival);
  /// Passes on the current group of sentences after 0.4 s of silence.
  void expire(TimeNs now);
  void finish();
  void clear() { frames_.clear(); }
  void setBaud(double baud) { frames_.setBaud(baud); }

  DeviceCounters counters() const;

 private:
  void take(const StreamFrame& frame);
  void takeGpsd(const StreamFrame& frame);
  void takeBinary(const StreamFrame& frame, std::optional<GpsFix> fix);
  void giveOut(GpsFix fix);

  Options options_;
  FrameStream frames_;
  FrameStream::Sink sink_;
  NmeaFixBuilder nmea_;
  NmeaFixBuilder::Sink nmea_sink_;
  std::string last_utc_;
  std::optional<int> satellites_;
  TimeNs last_arrival_ = 0;
  std::int64_t unexpected_ = 0;
};

}  // namespace segway_drivers
