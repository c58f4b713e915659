// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "segway_drivers/driver/driver_core.hpp"
#include "segway_drivers/lms291/stream.hpp"

namespace segway_drivers {

/// Driver of an LMS291-S14. Finds the line rate, raises it to 500 000 baud, reads type, status and configuration, and
/// requests ranges with reflectivities. A device that already streams is not interrupted.
class LmsDriver : public DriverCore {
 public:
  struct Options {
    LmsStream::Options stream;
    bool configure = false;  ///< rewrites a configuration whose ranges cannot be decoded
  };
  explicit LmsDriver(const Options& options);

  std::function<void(const LmsStampedScan&)> on_scan;

  void feed(ByteView chunk, const ChunkArrival& arrival) override { stream_.feed(chunk, arrival); }
  void tick(TimeNs now) override;
  const ClockFilter* clock() const override { return &stream_.clock(); }

 private:
  enum class Phase { Listen, Find, Raise, Settle, Status, Type, Configuration, Installation, Rewrite, Start, Stream };

  void begin(TimeNs now) override;
  DeviceCounters streamCounters() const override { return stream_.counters(); }
  void enter(Phase phase, TimeNs now);
  void find(std::size_t rate);
  void takeScan(const LmsStampedScan& scan);
  void takeReply(ByteView payload);
  void takeModeReply(ByteView payload);
  void takeStatus(ByteView payload);
  void takeType(ByteView payload);
  void takeConfiguration(ByteView payload);
  void takeRewritten(ByteView payload);
  void fail();
  void watch(TimeNs now);

  Options options_;
  LmsStream stream_;
  PendingRequest request_;
  Phase phase_ = Phase::Listen;
  std::size_t rate_ = 0;
  TimeNs now_ = 0, deadline_ = 0, last_scan_ = 0;
  int rounds_ = 0, soft_restarts_ = 0;
  Bytes configuration_;
  bool rewritten_ = false;
};

}  // namespace segway_drivers
