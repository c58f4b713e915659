// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <utility>

namespace urban_nav_live {

/// Bounded queue between callbacks and a worker. Pushing never blocks. Thread-safe.
template <typename Item>
class BoundedQueue {
 public:
  explicit BoundedQueue(std::size_t capacity = 1) : capacity_(capacity) {}

  /// Appends an item. If the queue is full, drops the oldest item, since recent data matter more. No effect after
  /// close().
  void push(Item item) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (closed_) return;
      ++pushed_;
      if (items_.size() >= capacity_) {
        items_.pop_front();
        ++dropped_;
      }
      items_.push_back(std::move(item));
    }
    arrived_.notify_one();
  }

  /// Returns all items, oldest first. Blocks until there is one, until wake() or close(), or for `timeout`; then the
  /// result is empty.
  std::deque<Item> takeAll(std::chrono::milliseconds timeout) {
    std::unique_lock<std::mutex> lock(mutex_);
    arrived_.wait_for(lock, timeout, [this] { return closed_ || woken_ || !items_.empty(); });
    woken_ = false;
    return std::exchange(items_, {});
  }

  /// Ends the current or the next wait of takeAll() without an item.
  void wake() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      woken_ = true;
    }
    arrived_.notify_one();
  }

  /// Ends all waits. Items pushed later are ignored.
  void close() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      closed_ = true;
    }
    arrived_.notify_all();
  }

  /// Sets the capacity, at least 1.
  void setCapacity(std::size_t capacity) {
    const std::lock_guard<std::mutex> lock(mutex_);
    capacity_ = capacity;
  }
  std::size_t capacity() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return capacity_;
  }
  std::size_t size() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return items_.size();
  }
  bool isClosed() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return closed_;
  }
  /// Returns the number of items pushed, including dropped ones.
  std::int64_t pushed() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return pushed_;
  }
  /// Returns the number of items dropped because the queue was full.
  std::int64_t dropped() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return dropped_;
  }

 private:
  mutable std::mutex mutex_;  // guards all members below
  std::condition_variable arrived_;
  std::deque<Item> items_;
  std::size_t capacity_;
  std::int64_t pushed_ = 0, dropped_ = 0;
  bool closed_ = false, woken_ = false;
};

}  // namespace urban_nav_live
