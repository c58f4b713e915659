// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>

#include "segway_drivers/driver/driver_core.hpp"
#include "segway_drivers/xsens_mti/stream.hpp"

namespace segway_drivers {

/// Driver of an MTi with MTData or MTData2. Brings the device into its configuration state, reads identity, period,
/// mode and settings back, writes differences, and starts the measurement. A device that ignores the request but
/// streams decodable data is used without changes.
class MtiDriver : public DriverCore {
 public:
  struct Options {
    MtiStream::Options stream;
    int rate = 100;  ///< Hz, requested
  };
  explicit MtiDriver(const Options& options);

  std::function<void(const MtiStampedSample&)> on_sample;

  void feed(ByteView chunk, const ChunkArrival& arrival) override { stream_.feed(chunk, arrival); }
  void tick(TimeNs now) override;
  const ClockFilter* clock() const override { return &stream_.clock(); }

 private:
  enum class Phase {
    Find,
    DeviceId,
    Product,
    Firmware,
    Kind,
    ReadPeriod,
    WritePeriod,
    ReadMode,
    WriteMode,
    ReadSettings,
    WriteSettings,
    WriteOutput,
    Start,
    Stream
  };

  void begin(TimeNs now) override;
  DeviceCounters streamCounters() const override { return stream_.counters(); }
  void enter(Phase phase);
  void find(std::size_t rate);
  void fail();
  void takeSample(const MtiStampedSample& sample);
  void takeReply(const MtiMessage& message);
  void takeAnswer(const MtiMessage& message);
  void takeError(const MtiMessage& message);
  void takePeriod(std::uint16_t counts);
  void takeMode(std::uint16_t mode);
  void takeSettings(std::uint32_t settings);
  void watch(TimeNs now);
  std::uint16_t periodCounts() const;

  Options options_;
  MtiStream stream_;
  PendingRequest request_;
  Phase phase_ = Phase::Find;
  std::size_t rate_ = 0;
  std::optional<std::size_t> known_rate_;  // rate at which the device has answered
  unsigned mode_ = 0, settings_ = 0;  // in force
  TimeNs now_ = 0, last_sample_ = 0;
  int ignored_ = 0, soft_restarts_ = 0;
  std::optional<std::uint16_t> written_period_, written_mode_;
  std::optional<std::uint32_t> written_settings_;
};

}  // namespace segway_drivers
