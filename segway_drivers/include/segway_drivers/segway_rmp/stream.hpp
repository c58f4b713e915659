// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>

#include "segway_drivers/clock/clock_filter.hpp"
#include "segway_drivers/clock/counter_unwrapper.hpp"
#include "segway_drivers/segway_rmp/can_frame.hpp"
#include "segway_drivers/stream/frame_stream.hpp"

namespace segway_drivers {

/// A message of the base with its position in the stream and its stamp.
struct RmpStampedFrame {
  CanFrame frame;
  std::uint64_t offset = 0;
  TimeNs arrival = 0;           ///< ns; 0: unknown
  std::optional<TimeNs> stamp;  ///< of the cycle of the message, ns; empty while the clock settles
};

/// Stream of a base: USB packets or CAN frames in, stamped messages out. The clock relates the count of servo frames
/// (message 0402) to the arrival of the first message of a cycle. Reads no clock. Not thread-safe.
class RmpStream {
 public:
  explicit RmpStream(double latency);

  std::function<void(const RmpStampedFrame&)> on_frame;

  /// Adds bytes of the USB connection.
  void feed(ByteView chunk, const ChunkArrival& arrival) { packets_.feed(chunk, arrival, sink_); }
  /// Adds a frame of a CAN bus.
  void add(const CanFrame& frame, std::uint64_t offset, TimeNs arrival);
  void expire(TimeNs now) { packets_.expire(now, sink_); }
  void finish() { packets_.finish(sink_); }
  void clear() { packets_.clear(); }

  DeviceCounters counters() const;
  const ClockFilter& clock() const { return clock_; }

 private:
  void placeCycle(const CanFrame& frame, TimeNs arrival);

  double latency_;
  FrameStream packets_;
  FrameStream::Sink sink_;
  ClockFilter clock_;
  CounterUnwrapper counter_;
  std::optional<TimeNs> last_arrival_, cycle_arrival_, cycle_stamp_;
  bool is_resumed_ = false;  // after silence, until the next count
  double cycle_time_ = 0.0;  // s of the device
  std::int64_t frames_ = 0, gaps_ = 0, unexpected_ = 0;
};

}  // namespace segway_drivers
