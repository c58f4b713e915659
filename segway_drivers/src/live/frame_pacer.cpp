// SPDX-License-Identifier: BSD-3-Clause
#include "live/frame_pacer.hpp"

#include <chrono>
#include <thread>
#include <utility>

namespace segway_drivers {

void FramePacer::sent(TimeNs stamp, TimeNs now) {
  const std::lock_guard<std::mutex> lock(mutex_);
  unanswered_.push_back(stamp);
  if (unanswered_.size() > kAhead) unanswered_.pop_front();
  newest_ = now;
}

void FramePacer::answered(TimeNs stamp) {
  const std::lock_guard<std::mutex> lock(mutex_);
  while (!unanswered_.empty() && unanswered_.front() <= stamp) unanswered_.pop_front();
}

bool FramePacer::isFree(TimeNs now) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return unanswered_.size() < kAhead || now - newest_ >= kPatience;
}

FrameReader FramePacer::pace(FrameReader read, std::function<bool()> is_absent, const std::atomic<bool>& stop) const {
  return [this, read = std::move(read), is_absent = std::move(is_absent), &stop] {
    while (!stop && (is_absent() || !isFree(steadyTime()))) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    return read();
  };
}

}  // namespace segway_drivers
