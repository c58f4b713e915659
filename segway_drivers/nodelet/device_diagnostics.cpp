// SPDX-License-Identifier: BSD-3-Clause
#include "device_diagnostics.hpp"

#include <utility>

namespace segway_drivers {

namespace {

constexpr unsigned char kLevelOk = 0, kLevelWarning = 1, kLevelError = 2;

unsigned char toLevel(DriverState state) {
  if (state == DriverState::Streaming) return kLevelOk;
  return state == DriverState::Absent || state == DriverState::Lost ? kLevelError : kLevelWarning;
}

}  // namespace

void DeviceDiagnostics::start(const ros::NodeHandle& nh, const ros::NodeHandle& private_nh, const std::string& name,
                              const std::string& hardware, const std::string& port, std::function<void(Status&)> more) {
  port_ = port;
  more_ = std::move(more);
  updater_ = std::make_unique<diagnostic_updater::Updater>(nh, private_nh, name);
  updater_->setHardwareID(hardware);
  updater_->add("driver", [this](Status& status) {
    fill(status);
    more_(status);
  });
  timer_ = nh.createWallTimer(ros::WallDuration(1.0), [this](const ros::WallTimerEvent&) { updater_->force_update(); });
}

void DeviceDiagnostics::set(DeviceSnapshot snapshot) {
  const std::lock_guard<std::mutex> guard(mutex_);
  snapshot_ = std::move(snapshot);
}

DeviceSnapshot DeviceDiagnostics::get() const {
  const std::lock_guard<std::mutex> guard(mutex_);
  return snapshot_;
}

void DeviceDiagnostics::fill(Status& status) const {
  const DeviceSnapshot now = get();
  status.summary(toLevel(now.state), toString(now.state));
  status.add("port", port_);
  status.add("identity", now.identity);
  if (now.state != DriverState::Streaming && !now.reason.empty()) status.add("reason", now.reason);
  status.add("bytes", now.counters.bytes);
  status.add("frames", now.counters.frames);
  status.add("bad checksums", now.counters.bad_checksums);
  status.add("bytes skipped", now.counters.bytes_skipped);
  status.add("gaps", now.counters.gaps);
  status.add("unexpected", now.counters.unexpected);
  status.add("timeouts", now.counters.timeouts);
  status.add("stalls", now.counters.stalls);
  status.add("reconnections", now.counters.reconnections);
  status.add("clock epochs", now.counters.epochs);
}

}  // namespace segway_drivers
