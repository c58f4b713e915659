// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "segway_drivers/bumblebee2/frame.hpp"
#include "segway_drivers/camera/frame_source.hpp"
#include "segway_drivers/camera/mosaic.hpp"
#include "segway_drivers/driver/driver_core.hpp"

namespace segway_drivers {

/// A pair with its stamp on the steady clock.
struct Bb2StampedPair {
  Bb2Frame frame;
  TimeNs arrival = 0;  ///< ns
  TimeNs stamp = 0;    ///< from bus time, minus the latency, ns
  int missing = 0;     ///< pairs lost since the previous one, by the frame counter
};

/// Driver of a Bumblebee2 over a FrameSource: configures the order of the imagers and the embedded information, locates
/// the latter, and stamps pairs by the bus clock. Reports exchanged imagers. Not thread-safe.
class Bb2Camera {
 public:
  struct Options {
    double latency = 0.0;  ///< s from the middle of the exposure to the embedded time
    bool swap = false;     ///< even bytes belong to the left imager
    double rate = 20.0;    ///< Hz
  };
  Bb2Camera(FrameSource& source, const Options& options) : source_(source), options_(options) {}

  /// Opens and configures the camera and starts its stream. Returns false and sets `error` on failure.
  bool start(std::string& error);
  /// Waits up to `timeout` ns for a pair. Empty: none arrived, it was corrupt, or its time is not known yet.
  std::optional<Bb2StampedPair> next(TimeNs timeout);

  const std::string& identity() const { return identity_; }
  MosaicPattern pattern() const { return pattern_; }
  const DeviceCounters& counters() const { return counters_; }
  std::vector<DriverEvent> takeEvents() { return std::exchange(events_, {}); }

 private:
  bool findEmbedding(const CameraFrame& raw);
  void checkOrder(const Bb2Frame& frame);

  FrameSource& source_;
  Options options_;
  std::string identity_;
  MosaicPattern pattern_ = MosaicPattern::None;
  DeviceCounters counters_;
  std::vector<DriverEvent> events_;
  std::optional<Bb2Embedding> embedding_;
  std::array<std::vector<double>, 2> candidate_times_;  // by Bb2Embedding
  std::optional<std::uint32_t> last_sequence_;
  int checked_ = 0, reversed_ = 0;
  TimeNs last_stamp_ = 0;
};

}  // namespace segway_drivers
