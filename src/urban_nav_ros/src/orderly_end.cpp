// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/orderly_end.hpp"
#include "urban_nav_core/parallel/named_thread.hpp"

#include <ros/init.h>

#include <chrono>
#include <csignal>
#include <iterator>

namespace urban_nav_ros {

namespace {

constexpr std::chrono::milliseconds kPoll{50};
constexpr std::chrono::milliseconds kLastMessages{1500};  // time in which roscpp sends pending messages
// Longest time between the interrupts that roslaunch sends to a nodelet loader and to its manager.
constexpr std::chrono::milliseconds kInterruptFollows{1000};

volatile std::sig_atomic_t is_interrupted = 0;  // the only type that a signal handler may write

void noteInterrupt(int) { is_interrupted = 1; }

}  // namespace

OrderlyEnd& OrderlyEnd::ofProcess() {
  static OrderlyEnd end;
  return end;
}

OrderlyEnd::OrderlyEnd() : watcher_(urban_nav_core::namedThread("orderly_end", [this] { watch(); })) {
  std::signal(SIGINT, &noteInterrupt);
}

OrderlyEnd::~OrderlyEnd() {
  ends_ = true;
  watcher_.join();
}

int OrderlyEnd::add(int order, Finish finish) {
  const std::lock_guard<std::mutex> lock(mutex_);
  stages_.emplace(std::pair(order, next_), std::move(finish));
  return next_++;
}

void OrderlyEnd::remove(int number) {
  // The nodelet loaders are interrupted as well, and unload the nodelets, possibly before this process is interrupted.
  using Clock = std::chrono::steady_clock;
  const Clock::time_point latest = Clock::now() + kInterruptFollows;
  while (is_interrupted == 0 && !ends_ && ros::ok() && Clock::now() < latest) std::this_thread::sleep_for(kPoll);
  while (is_interrupted != 0 && !finished_ && !ends_) std::this_thread::sleep_for(kPoll);
  const std::lock_guard<std::mutex> lock(mutex_);
  for (auto each = stages_.begin(); each != stages_.end();)
    each = each->first.second == number ? stages_.erase(each) : std::next(each);
}

void OrderlyEnd::watch() {
  while (!ends_) {
    if (is_interrupted != 0) {
      finishAll();
      finished_ = true;
      std::this_thread::sleep_for(kLastMessages);
      ros::requestShutdown();
      return;
    }
    std::this_thread::sleep_for(kPoll);
  }
}

void OrderlyEnd::finishAll() {
  while (!ends_) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (stages_.empty()) return;
    const Finish finish = std::move(stages_.begin()->second);
    stages_.erase(stages_.begin());
    finish();
  }
}

}  // namespace urban_nav_ros
