// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "segway_drivers/driver/driver_core.hpp"
#include "segway_drivers/segway_rmp/command_guard.hpp"
#include "segway_drivers/segway_rmp/odometry.hpp"
#include "segway_drivers/segway_rmp/stream.hpp"

namespace segway_drivers {

/// Driver of a base over USB packets. tick() writes the motion command of the guard every 20 ms in all states.
class RmpDriver : public DriverCore {
 public:
  struct Options {
    double latency = 0.0;  ///< s
    RmpCommandGuard::Limits limits;
  };
  explicit RmpDriver(const Options& options);

  std::function<void(const RmpStampedFrame&)> on_frame;

  RmpCommandGuard& guard() { return guard_; }
  const RmpOdometry& odometry() const { return odometry_; }

  void feed(ByteView chunk, const ChunkArrival& arrival) override;
  void tick(TimeNs now) override;
  const ClockFilter* clock() const override { return &stream_.clock(); }

 private:
  void begin(TimeNs now) override;
  DeviceCounters streamCounters() const override { return stream_.counters(); }
  void takeFrame(const RmpStampedFrame& frame);

  RmpStream stream_;
  RmpCommandGuard guard_;
  RmpOdometry odometry_;
  TimeNs now_ = 0, next_command_ = 0, last_frame_ = 0;
  double commanded_ = 0.0;
  TimeNs unheeded_since_ = 0;
};

}  // namespace segway_drivers
