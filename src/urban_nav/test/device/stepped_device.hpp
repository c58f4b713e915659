// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "segway_drivers/driver/driver_core.hpp"
#include "urban_nav_sim/device/simulated_device.hpp"

namespace urban_nav::testing {

/// A driver and a simulated device on one stepped clock, without ports: an hour runs in seconds.
class SteppedDevice {
 public:
  /// `baud`: of a connection whose rate the driver does not set.
  SteppedDevice(segway_drivers::DriverCore& driver, urban_nav_sim::SimulatedDevice& device, int baud = 0)
      : driver_(driver), device_(device), baud_(baud) {
    device_.start(now_);
    open();
  }

  void run(double seconds) {
    for (const std::int64_t end = now_ + static_cast<std::int64_t>(1e9 * seconds); now_ < end; now_ += kStep) once();
  }
  std::int64_t now() const { return now_; }
  double seconds() const { return 1e-9 * static_cast<double>(now_ - kBegin); }
  const std::vector<urban_nav_sim::DeviceTruth>& truth() const { return truth_; }
  /// For long runs: what was recorded of the truth is dropped.
  void forgetTruth() { truth_.clear(); }
  const std::vector<segway_drivers::DriverEvent>& events() const { return events_; }
  bool reported(const std::string& text) const {
    return std::any_of(events_.begin(), events_.end(), [&](const segway_drivers::DriverEvent& each) {
      return each.text.find(text) != std::string::npos;
    });
  }
  /// When an event with this text was first reported at or after a time, s; empty: never.
  std::optional<double> reportedAt(const std::string& text, double after) const {
    for (std::size_t i = 0; i < events_.size(); ++i)
      if (event_times_[i] >= after && events_[i].text.find(text) != std::string::npos) return event_times_[i];
    return std::nullopt;
  }
  static constexpr std::int64_t kStep = 1'000'000, kBegin = 1'000'000'000'000;

 private:
  void open() {
    driver_.open(now_);
    is_open_ = true;
    act();
  }
  void lose() {
    driver_.close(now_);
    is_open_ = false;
    retry_at_ = now_ + 200'000'000;
  }
  void act() {
    for (const segway_drivers::DriverAction& action : driver_.takeActions()) {
      if (!is_open_) return;
      if (action.kind == segway_drivers::DriverAction::Kind::Write) device_.receive(action.bytes, baud_, now_);
      if (action.kind == segway_drivers::DriverAction::Kind::SetBaud) baud_ = action.baud;
      if (action.kind == segway_drivers::DriverAction::Kind::Reopen) lose();
    }
  }
  void once() {
    const std::vector<std::uint8_t> bytes = device_.transmit(baud_, now_);
    for (const auto& each : device_.takeTruth()) truth_.push_back(each);
    if (is_open_ && !device_.isPlugged(now_)) lose();
    if (!is_open_ && now_ >= retry_at_ && device_.isPlugged(now_)) open();
    if (is_open_) {
      if (!bytes.empty()) driver_.feed(bytes, {now_, 0});
      driver_.tick(now_);
      act();
    }
    for (segway_drivers::DriverEvent& event : driver_.takeEvents()) {
      events_.push_back(std::move(event));
      event_times_.push_back(seconds());
    }
  }

  segway_drivers::DriverCore& driver_;
  urban_nav_sim::SimulatedDevice& device_;
  std::int64_t now_ = kBegin, retry_at_ = 0;
  int baud_;
  bool is_open_ = false;
  std::vector<urban_nav_sim::DeviceTruth> truth_;
  std::vector<segway_drivers::DriverEvent> events_;
  std::vector<double> event_times_;  // s, of each event
};

}  // namespace urban_nav::testing
