// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>

#include "segway_drivers/clock/clock_filter.hpp"
#include "segway_drivers/clock/counter_unwrapper.hpp"
#include "segway_drivers/lms291/scan.hpp"
#include "segway_drivers/stream/frame_stream.hpp"

namespace segway_drivers {

constexpr double kLmsPeriod =
    0.013338;  // s, of the mirror; measured on both lasers of the New College log (nominal 75 Hz)

/// A scan with its position in the stream and its stamp.
struct LmsStampedScan {
  LmsScan scan;
  std::uint64_t offset = 0;     ///< of the telegram's first byte in the stream
  std::int64_t count = 0;       ///< scans since the first, losses included
  TimeNs arrival = 0;           ///< of the first byte, ns; 0: unknown
  std::optional<TimeNs> stamp;  ///< of the first beam, ns; empty while the clock settles
  double sigma = 0.0;           ///< s
  int epoch = 0;                ///< of the clock; stamps increase within an epoch
};

/// Stream of an LMS291: bytes with arrival times in, stamped scans and replies out. Reads no clock. Not thread-safe.
class LmsStream {
 public:
  struct Options {
    LmsRangeFormat format;
    double latency = 0.00433;  ///< s from the first beam to the first byte
  };
  explicit LmsStream(const Options& options);

  std::function<void(const LmsStampedScan&)> on_scan;
  /// Payload of a telegram other than a scan; valid during the call.
  std::function<void(ByteView payload)> on_reply;

  void feed(ByteView chunk, const ChunkArrival& arrival);
  void expire(TimeNs now);
  void finish();
  /// Discards buffered bytes.
  void clear() { frames_.clear(); }
  void setBaud(double baud) { frames_.setBaud(baud); }
  void setFormat(const LmsRangeFormat& format) { options_.format = format; }

  DeviceCounters counters() const;
  const ClockFilter& clock() const { return clock_; }

 private:
  void take(const StreamFrame& frame);

  Options options_;
  FrameStream frames_;
  FrameStream::Sink sink_;
  ClockFilter clock_;
  CounterUnwrapper counter_;
  std::int64_t gaps_ = 0, repeats_ = 0;
};

}  // namespace segway_drivers
