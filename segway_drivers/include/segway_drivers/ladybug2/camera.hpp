// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "segway_drivers/camera/frame_source.hpp"
#include "segway_drivers/driver/driver_core.hpp"
#include "segway_drivers/ladybug2/frame.hpp"

namespace segway_drivers {

/// A frame as received, with its stamp on the steady clock.
struct LadybugStampedFrame {
  Bytes bytes;  ///< up to the size stated by its header
  std::uint32_t sequence = 0;
  double bus_time = 0.0;  ///< s modulo 128
  TimeNs arrival = 0;     ///< ns
  TimeNs stamp = 0;       ///< from bus time, minus the latency, ns
};

/// Driver of a Ladybug2 over a FrameSource: configures quality and selection of the JPEGs, checks frames, stamps them
/// by the bus clock, and limits the rate. Not thread-safe.
class LadybugCamera {
 public:
  struct Options {
    double latency = 0.0;  ///< s from the middle of the exposure to the embedded time
    double rate = 3.0;     ///< Hz, largest rate of frames
    int quality = 60;      ///< of the JPEGs, 1...100
  };
  LadybugCamera(FrameSource& source, const Options& options) : source_(source), options_(options) {}

  /// Opens and configures the camera and starts its stream. Returns false and sets `error` on failure.
  bool start(std::string& error);
  /// Waits up to `timeout` ns for a frame. Empty: none arrived, it was corrupt, it exceeds the rate, or its time is
  /// unknown.
  std::optional<LadybugStampedFrame> next(TimeNs timeout);

  const std::string& identity() const { return identity_; }
  const DeviceCounters& counters() const { return counters_; }
  /// Returns the number of missing or damaged channels of the ring cameras.
  std::int64_t badChannels() const { return bad_channels_; }
  std::vector<DriverEvent> takeEvents() { return std::exchange(events_, {}); }

 private:
  bool countFrame(const LadybugFrame& frame);

  FrameSource& source_;
  Options options_;
  std::string identity_;
  DeviceCounters counters_;
  std::vector<DriverEvent> events_;
  std::optional<std::uint32_t> last_sequence_;
  std::optional<TimeNs> last_stamp_;
  std::int64_t bad_channels_ = 0;
  bool reported_channels_ = false;
};

}  // namespace segway_drivers
