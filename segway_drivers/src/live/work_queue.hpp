// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>

namespace segway_drivers {

/// Queue of work from a thread that must never wait to another: beyond the capacity new work is dropped and counted.
/// Thread-safe.
class WorkQueue {
 public:
  using Work = std::function<void()>;

  void setCapacity(std::size_t capacity);
  /// Never blocks. Returns false if the queue is full and the work was dropped.
  bool push(Work work);
  /// Does the work until stop(), then the remaining work. Blocks.
  void run();
  void stop();
  std::int64_t dropped() const;

 private:
  mutable std::mutex mutex_;  // guards the following members
  std::condition_variable wake_;
  std::deque<Work> waiting_;
  std::size_t capacity_ = 1000;
  std::int64_t dropped_ = 0;
  bool stop_ = false;
};

}  // namespace segway_drivers
