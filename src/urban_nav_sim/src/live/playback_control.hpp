// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>

namespace urban_nav_sim {

/// Requests of the services to the worker, and the waiting of the worker. Thread-safe.
class PlaybackControl {
 public:
  using Wall = std::chrono::steady_clock::time_point;
  enum class Answer {
    Go,      ///< due
    Wait,    ///< not yet
    Paused,  ///< not before resume()
    End      ///< the session must restart, or the worker must end
  };

  void pause(bool paused) {
    change([&] { paused_ = paused; });
  }
  void reset() {
    change([&] { reset_ = true; });
  }
  /// All later answers are End.
  void close() {
    change([&] { closed_ = true; });
  }

  /// Begins a session, which completes a previous reset. Returns false when closed.
  bool begin() {
    const std::lock_guard<std::mutex> lock(mutex_);
    reset_ = false;
    return !closed_;
  }
  /// Waits until `due`, at most for `patience`, so that the worker can report progress.
  Answer wait(Wall due, std::chrono::milliseconds patience) {
    std::unique_lock<std::mutex> lock(mutex_);
    const Wall end = std::chrono::steady_clock::now() + patience;
    const bool was_paused = paused_;
    changed_.wait_until(lock, was_paused || end < due ? end : due,
                        [&] { return closed_ || reset_ || paused_ != was_paused; });
    if (closed_ || reset_) return Answer::End;
    if (was_paused || paused_) return Answer::Paused;
    return std::chrono::steady_clock::now() >= due ? Answer::Go : Answer::Wait;
  }

 private:
  template <typename Change>
  void change(const Change& what) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      what();
    }
    changed_.notify_all();
  }

  std::mutex mutex_;  // guards the following members
  std::condition_variable changed_;
  bool paused_ = false, reset_ = false, closed_ = false;
};

}  // namespace urban_nav_sim
