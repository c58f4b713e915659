// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "segway_drivers/clock/clock_filter.hpp"
#include "segway_drivers/stream/bytes.hpp"
#include "segway_drivers/stream/counters.hpp"
#include "segway_drivers/stream/frame_stream.hpp"

namespace segway_drivers {

/// Life cycle of every driver.
enum class DriverState { Absent, Opening, Identifying, Configuring, Streaming, Stalled, Lost };
/// "absent", "opening" ...
const char* toString(DriverState state);

/// Request of a driver to its transport.
struct DriverAction {
  enum class Kind { Write, SetBaud, Reopen } kind = Kind::Write;
  Bytes bytes;   ///< of Write
  int baud = 0;  ///< of SetBaud
};

/// Message for diagnostics and log.
struct DriverEvent {
  bool warning = false;
  std::string text;
};

/// Driver of one device without transport: given bytes and time, it requests writes and changes of the line rate. Times
/// are those of one steady clock, ns. Reads no clock, never blocks. Not thread-safe.
class DriverCore {
 public:
  virtual ~DriverCore() = default;

  /// Reports that the port was opened, with any settings.
  void open(TimeNs now);
  /// Reports that the port disappeared or was closed.
  void close(TimeNs now);
  virtual void feed(ByteView chunk, const ChunkArrival& arrival) = 0;
  /// Must be called at least every 10 ms while the port is open.
  virtual void tick(TimeNs now) = 0;

  /// Returns the actions since the last call, in order.
  std::vector<DriverAction> takeActions() { return std::exchange(actions_, {}); }
  std::vector<DriverEvent> takeEvents() { return std::exchange(events_, {}); }

  DriverState state() const { return state_; }
  /// Returns the identity reported by the device; empty until known.
  const std::string& identity() const { return identity_; }
  DeviceCounters counters() const;
  /// Returns null if the device has no clock.
  virtual const ClockFilter* clock() const { return nullptr; }

 protected:
  virtual void begin(TimeNs now) = 0;
  virtual DeviceCounters streamCounters() const = 0;

  void setState(DriverState state, const std::string& reason = "");
  void write(Bytes bytes) { actions_.push_back({DriverAction::Kind::Write, std::move(bytes), 0}); }
  void setBaud(int baud) { actions_.push_back({DriverAction::Kind::SetBaud, {}, baud}); }
  void reopen() { actions_.push_back({DriverAction::Kind::Reopen, {}, 0}); }
  void report(bool warning, std::string text) { events_.push_back({warning, std::move(text)}); }
  void setIdentity(std::string identity) { identity_ = std::move(identity); }
  void countUnexpected() { ++unexpected_; }
  void countTimeout() { ++timeouts_; }

 private:
  DriverState state_ = DriverState::Absent;
  std::string identity_;
  std::vector<DriverAction> actions_;
  std::vector<DriverEvent> events_;
  std::int64_t openings_ = 0, stalls_ = 0, unexpected_ = 0, timeouts_ = 0;
};

/// A request that is repeated until its answer arrives, at most three times.
class PendingRequest {
 public:
  /// Schedules the request for the next due().
  void start(Bytes bytes, TimeNs timeout, int tries = 3);
  void stop() { active_ = false; }
  bool isActive() const { return active_; }

  enum class Due { Nothing, Send, Failed };
  /// Returns whether to send the request, for the first time or again, or to give up.
  Due due(TimeNs now);
  const Bytes& bytes() const { return bytes_; }

 private:
  Bytes bytes_;
  TimeNs timeout_ = 0, deadline_ = 0;
  int tries_ = 0;
  bool active_ = false;
};

}  // namespace segway_drivers
