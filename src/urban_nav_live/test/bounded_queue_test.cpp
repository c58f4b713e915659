// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_live/bounded_queue.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <thread>

namespace urban_nav_live {
namespace {

constexpr std::chrono::milliseconds no_wait{0}, long_wait{10000};

TEST(BoundedQueue, ReturnsAllItemsOldestFirst) {
  BoundedQueue<int> queue(5);
  for (int i = 0; i < 3; ++i) queue.push(i);
  EXPECT_EQ(queue.takeAll(no_wait), (std::deque<int>{0, 1, 2}));
  EXPECT_TRUE(queue.takeAll(no_wait).empty());
}

TEST(BoundedQueue, DropsTheOldestAndCounts) {
  BoundedQueue<int> queue;
  queue.setCapacity(2);
  for (int i = 0; i < 5; ++i) queue.push(i);
  EXPECT_EQ(queue.dropped(), 3);
  EXPECT_EQ(queue.takeAll(no_wait), (std::deque<int>{3, 4}));
}

TEST(BoundedQueue, AnItemEndsAWait) {
  BoundedQueue<std::unique_ptr<int>> queue;
  std::thread writer([&queue] { queue.push(std::make_unique<int>(7)); });
  const auto items = queue.takeAll(long_wait);
  writer.join();
  ASSERT_EQ(items.size(), 1U);
  EXPECT_EQ(*items[0], 7);
}

TEST(BoundedQueue, WakeEndsAWaitWithoutAnItem) {
  BoundedQueue<int> queue(2);
  queue.wake();
  EXPECT_TRUE(queue.takeAll(long_wait).empty());
  std::thread waker([&queue] { queue.wake(); });
  EXPECT_TRUE(queue.takeAll(long_wait).empty());
  waker.join();
  queue.push(1);
  EXPECT_EQ(queue.takeAll(long_wait).size(), 1U);
}

TEST(BoundedQueue, CloseEndsAWaitAndIgnoresLaterItems) {
  BoundedQueue<int> queue;
  std::thread closer([&queue] { queue.close(); });
  EXPECT_TRUE(queue.takeAll(long_wait).empty());
  closer.join();
  EXPECT_TRUE(queue.isClosed());
  queue.push(1);
  EXPECT_TRUE(queue.takeAll(no_wait).empty());
}

}  // namespace
}  // namespace urban_nav_live
