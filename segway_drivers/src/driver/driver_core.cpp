// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/driver/driver_core.hpp"

#include <algorithm>

namespace segway_drivers {

const char* toString(DriverState state) {
  switch (state) {
    case DriverState::Absent: return "absent";
    case DriverState::Opening: return "opening";
    case DriverState::Identifying: return "identifying";
    case DriverState::Configuring: return "configuring";
    case DriverState::Streaming: return "streaming";
    case DriverState::Stalled: return "stalled";
    case DriverState::Lost: return "lost";
  }
  return "";
}

void DriverCore::open(TimeNs now) {
  ++openings_;
  actions_.clear();
  setState(DriverState::Opening);
  begin(now);
}

void DriverCore::close(TimeNs) {
  actions_.clear();
  setState(DriverState::Lost, "port closed");
}

void DriverCore::setState(DriverState state, const std::string& reason) {
  if (state == state_) return;
  state_ = state;
  stalls_ += state == DriverState::Stalled ? 1 : 0;
  const bool warning = state == DriverState::Stalled || state == DriverState::Lost;
  report(warning, std::string(toString(state)) + (reason.empty() ? "" : ": " + reason));
}

DeviceCounters DriverCore::counters() const {
  DeviceCounters counters = streamCounters();
  counters.unexpected += unexpected_;
  counters.timeouts += timeouts_;
  counters.stalls = stalls_;
  counters.reconnections = std::max<std::int64_t>(openings_ - 1, 0);
  return counters;
}

void PendingRequest::start(Bytes bytes, TimeNs timeout, int tries) {
  bytes_ = std::move(bytes);
  timeout_ = timeout;
  deadline_ = 0;
  tries_ = tries;
  active_ = true;
}

PendingRequest::Due PendingRequest::due(TimeNs now) {
  if (!active_ || (deadline_ != 0 && now < deadline_)) return Due::Nothing;
  if (tries_ == 0) {
    active_ = false;
    return Due::Failed;
  }
  --tries_;
  deadline_ = now + timeout_;
  return Due::Send;
}

}  // namespace segway_drivers
