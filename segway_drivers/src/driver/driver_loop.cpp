// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>

#include "segway_drivers/driver/run_device.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/types/error.hpp"

namespace segway_drivers {

namespace {

constexpr TimeNs kShortestPause = 200'000'000, kLongestPause = 2'000'000'000;  // ns

}  // namespace

std::unique_ptr<Port> openPort(const std::string& name, std::string& error) {
  const std::size_t colon = name.rfind(':');
  if (colon != std::string::npos && name.find('/') == std::string::npos) {
    const auto number = urban_nav_core::parseInteger(std::string_view(name).substr(colon + 1));
    if (number && *number > 0 && *number < 65536)
      return openTcpPort(name.substr(0, colon), static_cast<int>(*number), error);
  }
  const bool is_interface =
      colon == std::string::npos && name.find('/') == std::string::npos && name.find("can") != std::string::npos;
  return is_interface ? openCanPort(name, error) : openSerialPort(name, error);
}

DriverLoop::DriverLoop(DriverCore& core, std::string port) : core_(core), name_(std::move(port)) {}

void DriverLoop::open() {
  std::string error;
  port_ = openPort(name_, error);
  if (!port_) throw urban_nav_core::DataError(name_, error, "");
  remark_ = port_->remark();
  core_.open(steadyTime());
  act();
}

void DriverLoop::step(TimeNs wait) {
  if (!port_) {
    const TimeNs now = steadyTime();
    if (now >= next_try_) tryOpen(now);
    if (!port_) {
      const timespec rest{0, static_cast<long>(std::min<TimeNs>(wait, 100'000'000))};
      nanosleep(&rest, nullptr);
      return;
    }
  }
  std::array<std::uint8_t, 65536> buffer;
  const Port::ReadResult read = port_->read(buffer.data(), buffer.size(), wait);
  if (read.outcome == Port::Outcome::Data) core_.feed({buffer.data(), read.size}, {read.time, 0});
  const TimeNs now = steadyTime();
  if (read.outcome == Port::Outcome::Gone) {
    lose(now);
    return;
  }
  core_.tick(now);
  act();
}

void DriverLoop::act() {
  for (const DriverAction& action : core_.takeActions()) {
    if (!port_) return;
    switch (action.kind) {
      case DriverAction::Kind::Write: port_->write(action.bytes); break;
      case DriverAction::Kind::SetBaud: port_->setBaud(action.baud); break;
      case DriverAction::Kind::Reopen: lose(steadyTime()); break;
    }
  }
}

void DriverLoop::lose(TimeNs now) {
  port_.reset();
  core_.close(now);
  pause_ = kShortestPause;
  next_try_ = now + pause_;
}

void DriverLoop::tryOpen(TimeNs now) {
  std::string error;
  port_ = openPort(name_, error);
  if (port_) {
    remark_ = port_->remark();
    core_.open(now);
    act();
    return;
  }
  pause_ = std::min(pause_ + kShortestPause, kLongestPause);
  next_try_ = now + pause_;
}

}  // namespace segway_drivers
