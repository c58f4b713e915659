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
/// Faults, clock and delay of a simulated device.
struct DeviceOptions {
  std::vector<DeviceFault> faults;
  DeviceClock clock;
  std::optional<DelayModel> delay;  ///< nullopt: that of the device, without jitter
  std::uint64_t seed = 1;
};

/// True time of a measurement.
struct DeviceTruth {
  std::int64_t sequence = 0;  ///< counter of the device before it wraps
  DeviceTime time = 0;        ///< ns
};

/// A device on a serial line with a given clock: receives bytes from the host, and sends bytes to it. Deterministic.
/// Not thread-safe.
class SimulatedDevice {
 public:
  SimulatedDevice(DeviceOptions options, double least_delay_ms, int baud);
  virtual ~SimulatedDevice() = default;

  /// Begins the session. Times of successive calls must ascend.
  void start(DeviceTime now);
  /// Receives bytes sent by the host at `host_baud`.
  void receive(const DeviceBytes& bytes, int host_baud, DeviceTime now);
  /// Measures what is due and returns the bytes that have arrived at the host by `now`.
  DeviceBytes transmit(int host_baud, DeviceTime now);
  /// Returns whether the port exists.
  bool isPlugged(DeviceTime now) const;
  /// Returns whether all measurements are done and all bytes are sent.
  bool isFinished() const { return measured_all_ && line_.empty(); }

  /// Returns the truth of the measurements since the last call.
  std::vector<DeviceTruth> takeTruth() { return std::exchange(truth_, {}); }

 protected:
  /// Processes a byte of the host at the correct rate.
  virtual void takeByte(std::uint8_t byte) = 0;
  /// Measures up to `t`, s since the start. Returns false when the session has ended.
  virtual bool measure(double t) = 0;
  /// Restarts the device after a loss of power.
  virtual void boot() = 0;

  double now() const { return now_s_; }
  int baud() const { return baud_; }
  void setBaud(int baud) { baud_ = baud; }
  const DeviceFault* fault(DeviceFaultKind kind) const { return findDeviceFault(options_.faults, kind, now_s_); }
  const DeviceClock& clock() const { return options_.clock; }
  std::mt19937_64& random() { return random_; }

  /// Sends the frame of a measurement at `t`, s, and records its true time.
  void sendMeasurement(DeviceBytes frame, double t, std::int64_t sequence);
  /// Sends further bytes of the same measurement, or unsolicited messages, immediately and without a truth.
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
