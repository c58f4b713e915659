// SPDX-License-Identifier: BSD-3-Clause
#include "view/page_events.hpp"

#include <algorithm>
#include <chrono>

#include "base/json.hpp"

namespace urban_nav {

PageEvents::State PageEvents::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

void PageEvents::begin(const std::string& command) {
  const std::lock_guard lock(mutex_);
  ++state_.number;
  state_.running = command;
  changed_.notify_all();
}

void PageEvents::finish(const std::string& outcome, bool changed) {
  const std::lock_guard lock(mutex_);
  ++state_.number;
  if (changed) ++state_.revision;
  state_.running.clear();
  state_.outcome = outcome;
  changed_.notify_all();
}

void PageEvents::changed() {
  const std::lock_guard lock(mutex_);
  ++state_.number;
  ++state_.revision;
  changed_.notify_all();
}

PageEvents::State PageEvents::wait(std::int64_t known) const {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, std::chrono::seconds(1), [&] { return state_.number != known; });
  return state_;
}

std::string asData(const PageEvents::State& state) {
  std::string json =
      Json::object({{"revision", state.revision}, {"running", state.running}, {"outcome", state.outcome}}).print();
  std::replace(json.begin(), json.end(), '\n', ' ');  // within texts they are escaped
  return json;
}

}  // namespace urban_nav
