// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>

namespace urban_nav_live {

/// Pause state of a stage, with counters of messages that do not reach its worker. Thread-safe.
class InputGate {
 public:
  struct Counts {
    std::int64_t paused_dropped = 0;  ///< messages that arrived during a pause
    std::int64_t received = 0;        ///< messages, including those dropped
    std::int64_t invalid = 0;         ///< messages that could not be converted: not finite, unknown enumerators, ...
  };

  void pause() { paused_ = true; }
  void resume() { paused_ = false; }
  bool isPaused() const { return paused_; }

  /// Returns true if a message may pass; otherwise counts it as dropped.
  bool pass() {
    countReceived();
    if (!paused_) return true;
    ++paused_dropped_;
    return false;
  }
  void countReceived() { ++received_; }
  void countInvalid() { ++invalid_; }
  Counts counts() const { return {paused_dropped_, received_, invalid_}; }

 private:
  std::atomic<bool> paused_{false};
  std::atomic<std::int64_t> paused_dropped_{0}, received_{0}, invalid_{0};
};

}  // namespace urban_nav_live
