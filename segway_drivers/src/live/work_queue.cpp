// SPDX-License-Identifier: BSD-3-Clause
#include "live/work_queue.hpp"

#include <utility>

namespace segway_drivers {

void WorkQueue::setCapacity(std::size_t capacity) {
  const std::lock_guard<std::mutex> guard(mutex_);
  capacity_ = capacity;
}

bool WorkQueue::push(Work work) {
  {
    const std::lock_guard<std::mutex> guard(mutex_);
    if (waiting_.size() >= capacity_) {
      ++dropped_;
      return false;
    }
    waiting_.push_back(std::move(work));
  }
  wake_.notify_one();
  return true;
}

void WorkQueue::run() {
  while (true) {
    Work work;
    {
      std::unique_lock<std::mutex> guard(mutex_);
      wake_.wait(guard, [this] { return stop_ || !waiting_.empty(); });
      if (waiting_.empty()) return;
      work = std::move(waiting_.front());
      waiting_.pop_front();
    }
    work();
  }
}

void WorkQueue::stop() {
  {
    const std::lock_guard<std::mutex> guard(mutex_);
    stop_ = true;
  }
  wake_.notify_all();
}

std::int64_t WorkQueue::dropped() const {
  const std::lock_guard<std::mutex> guard(mutex_);
  return dropped_;
}

}  // namespace segway_drivers
