// SPDX-License-Identifier: BSD-3-Clause
#include "live/work_queue.hpp"

#include <gtest/gtest.h>

#include <future>
#include <thread>
#include <vector>

namespace segway_drivers {
namespace {

/// A subscriber that never returns, or a disk that is full, must not hold up the thread that reads the device.
TEST(WorkQueue, WorkThatBlocksCostsLaterWorkAndNotTheProducer) {
  WorkQueue queue;
  queue.setCapacity(10);
  std::promise<void> begun, release;
  std::thread worker([&] { queue.run(); });
  queue.push([&] {
    begun.set_value();
    release.get_future().wait();
  });
  begun.get_future().wait();
  std::vector<int> done;
  int accepted = 0;
  for (int i = 0; i < 60; ++i) accepted += queue.push([&done, i] { done.push_back(i); }) ? 1 : 0;
  EXPECT_EQ(accepted, 10);
  EXPECT_EQ(queue.dropped(), 50);
  release.set_value();
  queue.stop();
  worker.join();
  ASSERT_EQ(done.size(), 10U) << "what is left is done at the end";
  for (int i = 0; i < 10; ++i) EXPECT_EQ(done[static_cast<std::size_t>(i)], i) << "in order";
}

TEST(WorkQueue, RunReturnsAtOnceIfStoppedWithoutWork) {
  WorkQueue queue;
  queue.stop();
  queue.run();
  EXPECT_EQ(queue.dropped(), 0);
}

}  // namespace
}  // namespace segway_drivers
