// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>

#include "segway_drivers/clock/clock_filter.hpp"
#include "segway_drivers/clock/counter_unwrapper.hpp"
#include "segway_drivers/stream/frame_stream.hpp"
#include "segway_drivers/xsens_mti/message.hpp"
#include "segway_drivers/xsens_mti/sample.hpp"

namespace segway_drivers {

/// A sample with its position in the stream and its stamp.
struct MtiStampedSample {
  MtiSample sample;
  std::uint64_t offset = 0;
  TimeNs arrival = 0;           ///< of the first byte, ns; 0: unknown
  std::optional<TimeNs> stamp;  ///< of the measurement, ns; empty while the clock settles
  double sigma = 0.0;           ///< s
};

/// Stream of an MTi: bytes with arrival times in, stamped samples and replies out, for MTData and MTData2. Reads no
/// clock. Not thread-safe.
class MtiStream {
 public:
  struct Options {
    unsigned mode = 6, settings = 1;  ///< of MTData
    double period = 0.01;             ///< s between samples of MTData
    double latency = 0.0025;          ///< s from the measurement to the first byte
  };
  explicit MtiStream(const Options& options);

  std::function<void(const MtiStampedSample&)> on_sample;
  /// A message without measurements; valid during the call.
  std::function<void(const MtiMessage&)> on_reply;

  void feed(ByteView chunk, const ChunkArrival& arrival) { frames_.feed(chunk, arrival, sink_); }
  void expire(TimeNs now) { frames_.expire(now, sink_); }
  void finish() { frames_.finish(sink_); }
  void clear() { frames_.clear(); }
  void setBaud(double baud) { frames_.setBaud(baud); }
  void setDataFormat(unsigned mode, unsigned settings);
  void setPeriod(double period);

  DeviceCounters counters() const;
  const ClockFilter& clock() const { return clock_; }

 private:
  void take(const StreamFrame& frame);
  void place(MtiStampedSample& sample);
  void placeByCounter(MtiStampedSample& sample);
  void placeBySampleTime(MtiStampedSample& sample);

  Options options_;
  FrameStream frames_;
  FrameStream::Sink sink_;
  ClockFilter clock_;
  CounterUnwrapper counter_;
  std::optional<std::uint32_t> last_fine_;
  double fine_s_ = 0.0;  // s, unwrapped
  std::int64_t gaps_ = 0, unexpected_ = 0;
};

}  // namespace segway_drivers
