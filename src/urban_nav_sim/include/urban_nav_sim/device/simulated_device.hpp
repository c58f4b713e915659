// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "urban_nav_sim/device/delay_model.hpp"
#include "urban_nav_sim/device/device_fault.hpp"
#include "urban_nav_sim/device/line_queue.hpp"

namespace urban_nav_sim {

struct DeviceOptions {
  std::vector<DeviceFault> faults;
  DeviceClock clock;
  std::optional<DelayModel> delay;  ///< empty: the device's own, without jitter
  std::uint64_t seed = 1;
};

/// True time of a measurement.
struct DeviceTruth {
  std::int64_t sequence = 0;  ///< counter of the device before it wraps
  DeviceTime time = 0;        ///< ns
};

/// A device at the end of a serial line, on a clock that is handed in: bytes from the host in, bytes to the host out.
/// Deterministic. Not thread-safe.
class SimulatedDevice {
 public:
  SimulatedDevice(DeviceOptions options, double least_delay_ms, int baud);
  virtual ~SimulatedDevice() = default;

  /// Begins the session. Times of all calls rise.
  void start(DeviceTime now);
  /// Bytes that the host sent at `host_baud`.
  void receive(const DeviceBytes& bytes, int host_baud, DeviceTime now);
  /// Measures what is due and returns the bytes that have arrived at the host by `now`.
  DeviceBytes transmit(int host_baud, DeviceTime now);
  /// Whether the port is there.
  bool isPlugged(DeviceTime now) const;
  /// No more measurements, and all bytes are sent.
  bool isFinished() const { return measured_all_ && line_.empty(); }

  /// Truth of the measurements since the last call.
  std::vector<DeviceTruth> takeTruth() { return std::exchange(truth_, {}); }

 protected:
  /// A byte of the host at the right rate.
  virtual void takeByte(std::uint8_t byte) = 0;
  /// Measures up to `t`, s since the start. Returns false when the session has ended.
  virtual bool measure(double t) = 0;
  /// The device comes back from a loss of power.
  virtual void boot() = 0;

  double now() const { return now_s_; }
  int baud() const { return baud_; }
  void setBaud(int baud) { baud_ = baud; }
  const DeviceFault* fault(DeviceFaultKind kind) const { return findDeviceFault(options_.faults, kind, now_s_); }
  const DeviceClock& clock() const { return options_.clock; }
  std::mt19937_64& random() { return random_; }

  /// Sends the frame of a measurement at `t`, s; its true time goes to the truth.
  void sendMeasurement(DeviceBytes frame, double t, std::int64_t sequence);
  /// Further bytes of the same measurement, or unasked messages: sent at once without a truth.
  void sendNow(DeviceBytes bytes);
  void sendReply(DeviceBytes reply, double delay_s);

 private:
  DeviceBytes damage(DeviceBytes frame);
  void watchPower();

  DeviceOptions options_;
  DelayModel delay_;
  LineQueue line_;
  std::mt19937_64 random_;
  DeviceTime start_ = 0, now_ = 0;
  double now_s_ = 0.0, boots_at_ = 0.0;
  int baud_;
  bool off_ = false, measured_all_ = false;
  std::vector<DeviceTruth> truth_;
};

}  // namespace urban_nav_sim
