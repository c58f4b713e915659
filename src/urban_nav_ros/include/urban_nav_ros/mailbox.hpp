// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <utility>

namespace urban_nav_ros {

/// A bounded queue between the callbacks of a nodelet and its worker: putting never waits. Thread-safe.
template <typename Item>
class Mailbox {
 public:
  /// Where the box is full its oldest item goes: late work is worth less than fresh work.
  void put(Item item) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (closed_) return;
      if (items_.size() >= capacity_) {
        items_.pop_front();
        ++dropped_;
      }
      items_.push_back(std::move(item));
    }
    arrived_.notify_one();
  }

  /// All there is, oldest first; waits up to `patience` for something. Empty after that, when it was woken, or when the
  /// box was closed.
  std::deque<Item> takeAll(std::chrono::milliseconds patience) {
    std::unique_lock<std::mutex> lock(mutex_);
    arrived_.wait_for(lock, patience, [this] { return closed_ || woken_ || !items_.empty(); });
    woken_ = false;
    return std::exchange(items_, {});
  }

  /// Ends a wait, or the next one: there is something to do that is no item.
  void wake() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      woken_ = true;
    }
    arrived_.notify_one();
  }

  /// Wakes the worker; from now on nothing is taken in.
  void close() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      closed_ = true;
    }
    arrived_.notify_all();
  }

  void setCapacity(std::size_t capacity) {
    const std::lock_guard<std::mutex> lock(mutex_);
    capacity_ = capacity;
  }
  bool closed() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return closed_;
  }
  std::int64_t dropped() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return dropped_;
  }

 private:
  mutable std::mutex mutex_;  // guards everything below
  std::condition_variable arrived_;
  std::deque<Item> items_;
  std::size_t capacity_ = 1;
  std::int64_t dropped_ = 0;
  bool closed_ = false, woken_ = false;
};

}  // namespace urban_nav_ros
