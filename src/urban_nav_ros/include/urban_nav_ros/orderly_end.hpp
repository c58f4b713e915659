// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <mutex>
#include <thread>
#include <utility>

namespace urban_nav_ros {

/// Ends the stages of a process in order when it is interrupted (SIGINT, by Ctrl-C or roslaunch): sources first, so
/// that later stages in the same process receive the content of a source's window, and ROS last. Without it roscpp
/// closes all topics at once. Thread-safe.
class OrderlyEnd {
 public:
  using Finish = std::function<void()>;

  /// Returns the instance of this process, which handles SIGINT once a stage is added.
  static OrderlyEnd& ofProcess();
  ~OrderlyEnd();
  OrderlyEnd(const OrderlyEnd&) = delete;
  OrderlyEnd& operator=(const OrderlyEnd&) = delete;

  /// Adds a stage. `order`: stages with smaller values end first. `finish` is called once, in a separate thread, and
  /// must return in bounded time. Returns the stage's number.
  int add(int order, Finish finish);
  /// Removes a stage. Blocks while it is being finished and, after an interrupt, until all stages are.
  void remove(int number);

 private:
  OrderlyEnd();
  void watch();
  void finishAll();

  std::mutex mutex_;                                   // guards stages_ and next_; locked while a stage is finished
  std::multimap<std::pair<int, int>, Finish> stages_;  // by order and number
  int next_ = 0;
  std::atomic<bool> ends_{false}, finished_{false};
  std::thread watcher_;
};

}  // namespace urban_nav_ros
